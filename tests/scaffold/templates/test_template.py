from pathlib import Path

import pytest

from urdfkit.errors import ResourceError, UsageError
from urdfkit.resources import templates_dir
from urdfkit.scaffold import create, load_template, template_names
from urdfkit.scaffold.templates.template import fill

BUILT_IN = {"year": "2026", "into": "src"}


def test_templates_we_ship_load():
    assert "robot" in template_names()


def test_python_files_of_templates_compile():
    """Some packagers compile all Python files of an installation, and fail if one is invalid."""
    files = sorted(path for path in templates_dir().rglob("*.py"))
    assert len(files) > 5
    for path in files:
        compile(path.read_text(), str(path), "exec")


def test_answers_are_checked_and_completed(small_template):
    template = load_template(small_template)
    assert template.answers({"name": "box", "size": "3"}) == {"name": "box", "size": "3", "twice": "6", "colour": "red"}


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({}, "name is missing"),
        ({"name": "box", "size": "big"}, "`big` is not a number"),
        ({"name": "box", "twice": "0.5"}, "--twice must be at least --size"),
        ({"name": "box", "colur": "red"}, "no question `colur`; did you mean `colour`?"),
    ],
)
def test_invalid_answers_to_the_questions_of_a_template_are_rejected(small_template, given, message):
    with pytest.raises(UsageError, match=message):
        load_template(small_template).answers(given)


def test_render(small_template, tmp_path):
    template = load_template(small_template)
    answers = template.answers({"name": "box"}) | BUILT_IN
    out = tmp_path / "out"
    out.mkdir()
    assert template.render(answers, out) == [Path("box/src/box.txt")]
    text = (out / "box/src/box.txt").read_bytes()
    assert text == b"box is 1 m: ${x} $(find box) user@example.com @ year 2026\n"


def test_compiled_python_is_no_part_of_a_template(small_template, tmp_path):
    (small_template / "all/@name@/__pycache__").mkdir()
    (small_template / "all/@name@/__pycache__/a.pyc").write_bytes(b"\xa7\r\r\n")
    template = load_template(small_template)
    assert template.render(template.answers({"name": "box"}) | BUILT_IN, tmp_path) == [Path("box/src/box.txt")]


def test_what_is_not_text(small_template, tmp_path):
    (small_template / "all/logo.png").write_bytes(b"\x89PNG\xff")
    template = load_template(small_template)
    with pytest.raises(ResourceError, match=r"logo\.png is not UTF-8"):
        template.render(template.answers({"name": "box"}) | BUILT_IN, tmp_path)


def test_layers_by_answer_into_several_folders(small_template, tmp_path):
    template = load_template(small_template)
    answers = template.answers({"name": "box", "colour": "blue"}) | BUILT_IN
    assert sorted(str(path) for path in template.render(answers, tmp_path)) == [
        "box/COLOUR",
        "box/src/box.txt",
        "paint/COLOUR",
    ]


def test_next_steps(small_template):
    template = load_template(small_template)
    assert template.next_steps({"name": "box", "colour": "red"} | BUILT_IN) == [("", ["look src/box"])]
    blue = template.next_steps({"name": "box", "colour": "blue"} | BUILT_IN)
    assert blue[1] == ("in blue", ["paint"])


def test_unknown_placeholder_says_where():
    with pytest.raises(ResourceError, match=r"^file:2:4: no question `nmae`; did you mean `name`\?$"):
        fill("@name@\nab @nmae@", {"name": "x"}, where="file")


def test_two_layers_must_not_write_the_same_file(small_template):
    (small_template / "blue/src").mkdir()
    (small_template / "blue/src/@name@.txt").write_text("")
    template = load_template(small_template)
    with pytest.raises(ResourceError, match=r"both become box/src/box\.txt"):
        list(template.files(template.answers({"name": "box", "colour": "blue"})))


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("summary = ", r"template\.toml:1: Invalid value, found the end of the file"),
        ("summary = 'x'", r"template\.toml:1: the template has no `layer`"),
        ("summary = 'x'\nlayer = []\n[[question]]\nname = 'a'\nwhat = 1", r"toml:5: unknown key `what` in a \[\[question\]\]"),
    ],
)
def test_broken_toml(tmp_path, text, message):
    (tmp_path / "template.toml").write_text(text)
    with pytest.raises(ResourceError, match=message):
        load_template(tmp_path)


def test_no_toml(tmp_path):
    with pytest.raises(ResourceError, match=r"template\.toml: No such file"):
        load_template(tmp_path)


SEVERAL = """
summary = "a thing"
[[question]]
name = "colour"
prompt = "Colour"
kind = "choice"
choices = ["red", "blue"]
default = "red"
[[question]]
name = "part"
prompt = "Part"
kind = "choices"
choices = ["arm", "leg", "eye"]
default = ""
[[question]]
name = "depth"
prompt = "Depth of the blue"
kind = "number"
default = "1"
when = { colour = ["blue"] }
[[word]]
name = "tone"
by = "colour"
values = { red = "warm", blue = "cold, @depth@" }
[[word]]
name = "bone"
by = "part"
values = { arm = "ulna", leg = "femur" }
[[check]]
holds = "depth < 3"
otherwise = "too deep"
when = { part = ["eye"] }
[[layer]]
folder = "all"
[[layer]]
folder = "more"
append = true
when = { part = ["leg", "eye"] }
"""


@pytest.fixture
def several(tmp_path):
    """A template with a question of several answers, words, and a layer that goes behind."""
    folder = tmp_path / "template"
    (folder / "all").mkdir(parents=True)
    (folder / "all/a").write_text("@colour@ is @tone@\n  <@part@>\n<@part@ of @colour@>\n@bone@\nend\n")
    (folder / "more").mkdir()
    (folder / "more/a").write_text("more\n")
    (folder / "template.toml").write_text(SEVERAL)
    return load_template(folder)


@pytest.mark.parametrize(
    ("given", "text"),
    [
        ({}, "red is warm\nend\n"),
        ({"part": "arm"}, "red is warm\n  <arm>\n<arm of red>\nulna\nend\n"),
        (
            {"part": "eye arm", "colour": "blue", "depth": "2"},
            "blue is cold, 2\n  <arm>\n  <eye>\n<arm of blue>\n<eye of blue>\nulna\nend\nmore\n",
        ),
    ],
)
def test_lines_come_once_for_each_answer(several, tmp_path, given, text):
    assert several.render(several.answers(given), tmp_path) == [Path("a")]
    assert (tmp_path / "a").read_text() == text


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"depth": "2"}, "--depth requires --colour blue"),
        ({"part": "arm arm"}, "--part `arm` is repeated"),
        ({"part": "leg, am"}, "--part `am` is not available; did you mean `arm`"),
        ({"part": "eye", "colour": "blue", "depth": "4"}, "too deep"),
    ],
)
def test_what_several_answers_may_not_be(several, given, message):
    with pytest.raises(UsageError, match=message):
        several.answers(given)


def test_facts_and_words_that_are_lists(small_template):
    (small_template / "all/@name@/list.txt").write_text("begin\n- @part@ of @name@\nend @thrice@\n")
    with (small_template / "template.toml").open("a") as file:
        file.write(
            """
            [[fact]]
            name = "special"
            any = [{ colour = ["blue"] }, { name = ["zed"] }]
            [[word]]
            name = "part"
            by = "special"
            values = { no = [], yes = ["arm", "@name@ hand"] }
            [[word]]
            name = "thrice"
            by = "special"
            values = { no = "none", yes = "= 3*size/7" }
            """
        )
    template = load_template(small_template)
    for given, special, lines in (
        ({"name": "ox"}, "no", []),
        ({"name": "zed"}, "yes", ["- arm of zed", "- zed hand of zed"]),
        ({"name": "ox", "colour": "blue"}, "yes", ["- arm of ox", "- ox hand of ox"]),
    ):
        answers = template.answers(given) | {"year": "2026", "into": "."}
        assert answers["special"] == special
        folder = small_template.parent / f"{given['name']}{special}"
        template.render(answers, folder)
        assert (folder / given["name"] / "list.txt").read_text().splitlines() == [
            "begin",
            *lines,
            "end 0.4286" if special == "yes" else "end none",
        ]


@pytest.mark.parametrize(
    ("into", "spare"),
    [
        ('["../../@name@"]', "false"),
        ('["/tmp/x"]', "false"),
        ('["a/../.."]', "true"),
        ('["/"]', "true"),
        ('["@where@"]', "false"),
    ],
)
def test_nothing_is_written_outside(small_template, tmp_path, into, spare):
    place = tmp_path / "above" / "place"
    place.mkdir(parents=True)
    (tmp_path / "box").mkdir()
    (tmp_path / "box" / "COLOUR").write_text("mine")
    path = small_template / "template.toml"
    asked = '[[question]]\nname = "where"\nprompt = "Where"\nkind = "text"\ndefault = "../../box"\n'
    layer = f'\n[[layer]]\nspare = {spare}\nfolder = "blue"\ninto = {into}\n'
    path.write_text(path.read_text().replace("        [[question]]", asked + "        [[question]]", 1) + layer)
    template = load_template(small_template)
    line = path.read_text().splitlines().index(f"into = {into}") + 1
    with pytest.raises(ResourceError, match=rf"template\.toml:{line}: .* is outside the output folder"):
        create(template, template.answers({"name": "box"}) | BUILT_IN, place)
    assert list(place.iterdir()) == []
    assert (tmp_path / "box" / "COLOUR").read_text() == "mine"


def test_a_way_back_inside_is_none_outside(small_template, tmp_path):
    path = small_template / "template.toml"
    path.write_text(path.read_text() + '\n[[layer]]\nfolder = "blue"\ninto = ["@name@/src/../.", ""]\n')
    template = load_template(small_template)
    written = [target.as_posix() for _, target in template.files(template.answers({"name": "box"}) | BUILT_IN)]
    assert written == ["box/src/box.txt", "box/COLOUR", "COLOUR"]
