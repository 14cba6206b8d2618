"""Several files are replaced together: after an error none is new, after a kill the next clean-up restores them."""

import errno
import os
import signal
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import pytest

from urdfkit.atomic import clean_up, replace_and_move, staging
from urdfkit.errors import ResourceError


@dataclass
class Change:
    path: Path
    before: bytes | None
    after: bytes


def changes(folder):
    return [
        Change(folder / "sub/made", None, b"made"),
        Change(folder / "one", b"1", b"new 1"),
        Change(folder / "link", b"2", b"new 2"),
    ]


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "one").write_bytes(b"1")
    (tmp_path / "two").write_bytes(b"2")
    (tmp_path / "two").chmod(0o754)
    (tmp_path / "link").symlink_to("two")
    return tmp_path


def contents(folder):
    return {
        path.relative_to(folder).as_posix(): path.read_text()
        for path in folder.rglob("*")
        if path.is_file() and ".urdfkit-" not in str(path.relative_to(folder))
    }


OLD = {"one": "1", "two": "2", "link": "2"}
NEW = {"one": "new 1", "two": "new 2", "link": "new 2", "sub/made": "made", "package/file": "p"}


def replace(folder):
    with staging(folder) as staged:
        (staged / "package").mkdir()
        (staged / "package/file").write_text("p")
        return replace_and_move(changes(folder), staged, folder)


def test_files_are_replaced_and_packages_moved(folder):
    assert replace(folder) == [folder / "package"]
    assert contents(folder) == NEW
    assert (folder / "link").is_symlink()
    assert (folder / "two").stat().st_mode & 0o777 == 0o754
    assert not list(folder.rglob(".urdfkit-*"))


@pytest.mark.parametrize("at", ["made", "one", "two", "package"])
def test_an_error_at_any_file_changes_none(folder, monkeypatch, at):
    def failing(move):
        def fail(self, target):
            if Path(target).name == at and not self.name.endswith(".old"):
                raise OSError(errno.ENOSPC, "No space left on device", str(target))
            return move(self, target)

        return fail

    for name in ("replace", "rename"):
        monkeypatch.setattr(Path, name, failing(getattr(Path, name)))
    with pytest.raises(ResourceError, match=r"cannot write .*: No space left on device"):
        replace(folder)
    assert contents(folder) == OLD
    assert not list(folder.rglob(".urdfkit-*"))


def test_a_file_that_changed_since_it_was_read_is_not_replaced(folder):
    (folder / "one").write_bytes(b"edited")
    with pytest.raises(ResourceError, match="one was changed in the meantime; nothing was changed"):
        replace(folder)
    (folder / "one").write_bytes(b"1")
    (folder / "sub").mkdir()
    (folder / "sub/made").write_bytes(b"mine")
    with pytest.raises(ResourceError, match="made already exists; nothing was changed"):
        replace(folder)
    assert contents(folder) == {**OLD, "sub/made": "mine"}


def test_files_on_another_file_system(folder, monkeypatch):
    move = Path.replace

    def fail(self, target):
        if self.parent.name == ".urdfkit-files":
            raise OSError(errno.EXDEV, "Invalid cross-device link")
        return move(self, target)

    monkeypatch.setattr(Path, "replace", fail)
    replace(folder)
    assert contents(folder) == NEW
    assert (folder / "two").stat().st_mode & 0o777 == 0o754


KILLED = """
import os, signal, sys
from pathlib import Path
from tests.test_file_replacement import replace

moves = 0

def kill(event, arguments):
    global moves
    moves += event == "os.rename"
    if event == "os.rename" and moves == int(sys.argv[1]):
        os.kill(os.getpid(), signal.SIGKILL)

sys.addaudithook(kill)
replace(Path(sys.argv[2]))
"""
"""Replaces the files; killed just before the move whose number is the argument."""


def killed_before_move(number, folder):
    command = [sys.executable, "-c", KILLED, str(number), str(folder)]
    root = Path(__file__).parents[1]
    result = subprocess.run(command, cwd=root, capture_output=True, check=False, env={**os.environ, "PYTHONPATH": "."})
    assert result.returncode == -signal.SIGKILL, result.stderr
    return contents(folder)


@pytest.mark.parametrize(
    ("move", "new"), [(1, []), (2, []), (3, ["sub/made"]), (4, ["sub/made", "one"]), (5, ["sub/made", "one", "two"])]
)
def test_after_a_kill_the_next_clean_up_restores_the_files(folder, move, new):
    found = killed_before_move(move, folder)
    assert {name for name in found if found[name] != OLD.get(name)} - {"link"} == set(new)
    clean_up(folder)
    assert contents(folder) == OLD
    assert (folder / "two").stat().st_mode & 0o777 == 0o754
    assert not list(folder.rglob(".urdfkit-*"))


def test_files_that_were_edited_after_the_kill_stay_so(folder):
    killed_before_move(4, folder)
    (folder / "one").write_text("edited")
    clean_up(folder)
    assert contents(folder) == {**OLD, "one": "edited", "sub/made": "made"}
