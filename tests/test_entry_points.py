"""Entry points, next to importlib.metadata."""

from __future__ import annotations

import importlib.metadata
import sys

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
