"""What is wrong with a template.toml is reported with its line and the nearest right thing."""

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
values = { red = "warm", blue = "cold" }

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
        ('summary = "a thing"', 'sumary = "a thing"', "1: unknown key `sumary` in a template; did you mean `summary`?"),
        ('summary = "a thing"', "summary = 3", "1: `summary` must be a string"),
        ("[[layer]]", "[[layers]]", "23: unknown key `layers` in a template; did you mean `layer`?"),
        ("[[question]]", "[question]", "3: `question` must be a list of tables: [[question]]"),
        ('prompt = "Colour"\n', "", "3: this [[question]] has no `prompt`"),
        ('kind = "choice"', 'kind = "choise"', "6: unknown kind of question `choise`; did you mean `choice`?"),
        ('["red", "blue"]', '"red"', "7: `choices` must be a list of strings"),
        ('name = "colour"', 'name = "Colour"', "4: `Colour` is not a valid placeholder: use a-z, 0-9 and _"),
        ("any = [{ colour", "any = [{ color", "10: no earlier question `color`; did you mean `colour`?"),
        ('by = "colour"', 'by = "colur"', "16: unknown question `colur`; did you mean `colour`?"),
        ('colour = ["blue"] }', 'colour = ["bleu"] }', "21: `bleu` is not an answer to `colour`; did you mean `blue`?"),
        ('warm = ["yes"]', 'warm = "yes"', "25: `warm` must be a list of strings"),
        ('folder = "all"', 'folder = "all"\nappend = 1', "25: `append` must be true or false"),
        ('commands = ["look"]', 'comands = ["look"]', "28: unknown key `comands` in a [[next]]; did you mean `commands`?"),
        ('["look"]', "[look]", ":28:13: Invalid value"),
    ],
)
def test_errors_have_their_line(tmp_path, old, new, message):
    assert GOOD.count(old) == 1
    with pytest.raises(ResourceError) as caught:
        read(tmp_path, GOOD.replace(old, new))
    reported = str(caught.value)
    assert reported.startswith(f"{tmp_path}/template.toml:{message.removeprefix(':')}")
    assert "\n" not in reported


@pytest.mark.parametrize(
    ("more", "message"),
    [
        ('default = "= 2 *"', "14: invalid expression `2 *`"),
        ('default = "= 2*size"', "14: no earlier question `size`"),
        ('default = "= 1/0"', "14: `1/0` divides by zero"),
        ("default = 3", '14: `default` must be a string: default = "3"'),
        ('default_for = { colour = { red = "= a.b" } }', "14: cannot compute `a.b` in `a.b`"),
        ('[[check]]\nholds = "width"\notherwise = "no"', "15: `width` is not a comparison of two values"),
        ('[[check]]\nholds = "widht < 2"\notherwise = "no"', "15: no earlier question `widht`; did you mean `width`?"),
        ('[[word]]\nname = "w"\nby = "colour"\nvalues = { red = "= 2**3" }', "17: cannot compute `2 ** 3` in `2**3`"),
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
