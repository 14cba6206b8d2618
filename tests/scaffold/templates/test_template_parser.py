"""What is wrong with a template.toml is said with its line and the nearest right thing."""

import pytest

from urdfkit.errors import ResourceError
from urdfkit.resources import templates_dir
from urdfkit.scaffold import load_template, template_names

GOOD = """summary = "a thing"

[[question]]
name = "colour"
prompt = "Colour"
kind = "choice"
choices = ["red", "blue"]
default = "red"

[[fact]]
name = "warm"
any = [{ colour = ["red"] }]

[[word]]
name = "tone"
by = "colour"
says = { red = "warm", blue = "cold" }

[[check]]
otherwise = "no"
when = { colour = ["blue"] }

[[layer]]
folder = "all"
when = { warm = ["yes"] }

[[next]]
commands = ["look"]
"""


def read(folder, text):
    (folder / "template.toml").write_text(text)
    return load_template(folder)


def test_good(tmp_path):
    template = read(tmp_path, GOOD)
    assert template.name == tmp_path.name
    assert template.answers({})["warm"] == "yes"


@pytest.mark.parametrize("name", template_names())
def test_ours(name):
    assert load_template(templates_dir() / name).name == name


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('summary = "a thing"', 'sumary = "a thing"', "1: no `sumary` in a template; did you mean `summary`?"),
        ('summary = "a thing"', "summary = 3", "1: `summary` has to be a text"),
        ("[[layer]]", "[[layers]]", "23: no `layers` in a template; did you mean `layer`?"),
        ("[[question]]", "[question]", "3: `question` has to be a list of tables: [[question]]"),
        ('prompt = "Colour"\n', "", "3: this [[question]] lacks its `prompt`"),
        ('kind = "choice"', 'kind = "choise"', "6: no kind of question `choise`; did you mean `choice`?"),
        ('["red", "blue"]', '"red"', "7: `choices` has to be a list of texts"),
        ('name = "colour"', 'name = "Colour"', "4: `Colour` cannot be a placeholder: a-z, 0-9 and _"),
        ("any = [{ colour", "any = [{ color", "10: no question `color` before; did you mean `colour`?"),
        ('by = "colour"', 'by = "colur"', "16: no question `colur`; did you mean `colour`?"),
        ('colour = ["blue"] }', 'colour = ["bleu"] }', "21: `bleu` is no answer to `colour`; did you mean `blue`?"),
        ('warm = ["yes"]', 'warm = "yes"', "25: `warm` has to be a list of texts"),
        ('folder = "all"', 'folder = "all"\nappend = 1', "25: `append` has to be true or false"),
        ('commands = ["look"]', 'comands = ["look"]', "28: no `comands` in a [[next]]; did you mean `commands`?"),
        ('["look"]', "[look]", ":28:13: Invalid value"),
    ],
)
def test_errors_have_their_line(tmp_path, old, new, message):
    assert GOOD.count(old) == 1
    with pytest.raises(ResourceError) as caught:
        read(tmp_path, GOOD.replace(old, new))
    said = str(caught.value)
    assert said.startswith(f"{tmp_path}/template.toml:{message.removeprefix(':')}")
    assert "\n" not in said


@pytest.mark.parametrize(
    ("more", "message"),
    [
        ('default = "= 2 *"', "14: `2 *` is no expression"),
        ('default = "= 2*size"', "14: no question `size` before"),
        ('default = "= 1/0"', "14: `1/0` divides by zero"),
        ("default = 3", '14: `default` has to be a text: default = "3"'),
        ('default_for = { colour = { red = "= a.b" } }', "14: cannot compute `a.b` in `a.b`"),
        ('[[check]]\nholds = "width"\notherwise = "no"', "15: `width` is no comparison of two values"),
        ('[[check]]\nholds = "widht < 2"\notherwise = "no"', "15: no question `widht` before; did you mean `width`?"),
        ('[[word]]\nname = "w"\nby = "colour"\nsays = { red = "= 2**3" }', "17: cannot compute `2 ** 3` in `2**3`"),
    ],
)
def test_sums_have_their_line(tmp_path, more, message):
    wide = f'[[question]]\nname = "width"\nprompt = "Width"\nkind = "number"\n{more}\n\n[[fact]]'
    with pytest.raises(ResourceError) as caught:
        read(tmp_path, GOOD.replace("[[fact]]", wide))
    assert str(caught.value).startswith(f"{tmp_path}/template.toml:{message}")


def test_what_is_no_text(tmp_path):
    (tmp_path / "template.toml").write_bytes(b"\xff")
    with pytest.raises(ResourceError, match="is not UTF-8"):
        load_template(tmp_path)
