"""Templates of the user's own: in a folder, or of an installed package."""

import sys

import pytest

from urdfkit.errors import ResourceError
from urdfkit.scaffold import named_template, template_at, template_names


@pytest.fixture
def installed(tmp_path, small_template, monkeypatch):
    """An installed package with an entry point; returns what to write as its value."""
    site = tmp_path / "site"
    (site / "mine-1.dist-info").mkdir(parents=True)
    (site / "mine_templates.py").write_text(f"FOLDER = {str(small_template)!r}\nNOTHING = 3\n")
    monkeypatch.syspath_prepend(str(site))
    monkeypatch.delitem(sys.modules, "mine_templates", raising=False)

    def put(value):
        (site / "mine-1.dist-info/entry_points.txt").write_text(f"[urdfkit.templates]\nthing = {value}\n")

    return put


def test_of_an_installed_package(installed):
    installed("mine_templates:FOLDER")
    assert "thing" in template_names()
    template = named_template("thing")
    assert (template.name, template.summary) == ("thing", "a thing")


@pytest.mark.parametrize("value", ["mine_templates:NOTHING", "mine_templates:GONE", "nowhere:X"])
def test_a_broken_package_is_named(installed, value):
    installed(value)
    with pytest.raises(ResourceError, match=r"mine-1\.dist-info: entry point thing = "):
        named_template("thing")


def test_ours_come_first(installed, tmp_path):
    installed("mine_templates:FOLDER")
    path = tmp_path / "site/mine-1.dist-info/entry_points.txt"
    path.write_text(path.read_text().replace("thing =", "robot ="))
    assert named_template("robot").summary.startswith("a robot")


def test_in_a_folder(small_template, monkeypatch):
    monkeypatch.chdir(small_template.parent)
    template = template_at("./template")
    assert (template.name, template.source) == ("template", "template")
    assert template_at("template/template.toml").folder == template.folder


@pytest.mark.parametrize(
    ("place", "message"),
    [
        ("tmplate", "--template: no such folder: tmplate; did you mean `template`"),
        ("template/all", r"--template template/all: it contains no template\.toml"),
    ],
)
def test_a_folder_without_a_template_is_rejected(small_template, monkeypatch, place, message):
    monkeypatch.chdir(small_template.parent)
    with pytest.raises(ResourceError, match=f"^{message}"):
        template_at(place)


def test_no_such_name():
    with pytest.raises(ResourceError, match="no template `robto`; did you mean `robot`"):
        named_template("robto")
