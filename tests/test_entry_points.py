"""Entry points, next to importlib.metadata."""

from __future__ import annotations

import importlib.metadata
import os
import sys
import time

import pytest

from urdfkit.entry_points import EntryPoint, entry_points, load
from urdfkit.errors import ResourceError


@pytest.mark.parametrize("group", ["console_scripts", "pytest11", "no.such.group"])
def test_it_finds_what_the_standard_library_finds(group):
    ours = {(entry.name, entry.value.replace(" ", "")) for entry in entry_points(group)}
    theirs = {
        (entry.name, entry.value.partition("[")[0].replace(" ", ""))
        for entry in importlib.metadata.entry_points(group=group)
    }
    assert ours == theirs
    assert ours or group == "no.such.group"


def test_loading(tmp_path, monkeypatch):
    (tmp_path / "a-1.dist-info").mkdir()
    text = "# comment\n[x]\nname = os.path:join\n\n[y]\nname=json\n; no\nbroken = json:nothing [extra]\n"
    (tmp_path / "a-1.dist-info" / "entry_points.txt").write_text(text)
    (tmp_path / "b.dist-info").mkdir()
    (tmp_path / "c.egg-info").write_text("an old kind")
    monkeypatch.setattr(sys, "path", [str(tmp_path), str(tmp_path / "missing")])
    import os.path

    assert load("x") == [os.path.join]
    assert [entry.name for entry in entry_points("y")] == ["broken", "name"]
    assert [entry.name for entry in entry_points("x", "y")] == ["broken", "name", "name"]
    with pytest.raises(ResourceError, match=r"a-1\.dist-info: entry point broken = json:nothing: module 'json' has no"):
        load("y")
    assert EntryPoint("a", "b:c", "d") < EntryPoint("b", "a:c", "d")


def test_files_are_read_again_only_after_a_change_of_their_folder(tmp_path):
    def install(package, attribute):
        (tmp_path / package).mkdir(exist_ok=True)
        (tmp_path / package / "entry_points.txt").write_text(f"[x]\n{package} = os:{attribute}\n")

    def attributes():
        return [entry.value for entry in entry_points("x", path=[str(tmp_path)])]

    install("a.dist-info", "first")
    assert attributes() == ["os:first"]
    install("a.dist-info", "second")
    assert attributes() == ["os:second"]  # the folder has just changed, so an installation may still write into it
    an_hour_ago = time.time() - 3600
    os.utime(tmp_path, (an_hour_ago, an_hour_ago))
    assert attributes() == ["os:second"]
    (tmp_path / "a.dist-info" / "entry_points.txt").unlink()
    assert attributes() == ["os:second"]
    install("b.dist-info", "third")
    assert attributes() == ["os:third"]


def test_sources_that_are_installed_again(tmp_path):
    """``pip install -e`` writes the entry points again in place, which does not change the folder."""
    folder = tmp_path / "robot.egg-info"
    folder.mkdir()
    for attribute in ("first", "second"):
        (folder / "entry_points.txt").write_text(f"[x]\nname = os:{attribute}\n")
        an_hour_ago = time.time() - 3600
        os.utime(tmp_path, (an_hour_ago, an_hour_ago))
        assert [entry.value for entry in entry_points("x", path=[str(tmp_path)])] == [f"os:{attribute}"]
