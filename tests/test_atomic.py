import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from urdfkit.atomic import clean_up, move_into_place, staging, undisturbed, write_bytes, write_text
from urdfkit.errors import ResourceError


def test_write_new_and_replace(tmp_path):
    path = tmp_path / "a.txt"
    write_text(path, "one\n")
    write_text(path, "zwei ü\r\n")
    assert path.read_bytes() == "zwei ü\r\n".encode()
    assert [p.name for p in tmp_path.iterdir()] == ["a.txt"]


def test_permissions_and_links_are_kept(tmp_path):
    path = tmp_path / "a.sh"
    write_text(path, "1")
    path.chmod(0o754)
    link = tmp_path / "link"
    link.symlink_to(path)
    write_bytes(link, b"2")
    assert link.is_symlink()
    assert path.read_text() == "2"
    assert path.stat().st_mode & 0o777 == 0o754


def test_a_pipe_and_a_device_stay_what_they_are(tmp_path):
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    with subprocess.Popen(["cat", str(pipe)], stdout=subprocess.PIPE) as reader:
        write_bytes(pipe, b"x" * 100_000)
        assert reader.communicate()[0] == b"x" * 100_000
    assert pipe.is_fifo()
    write_bytes(Path("/dev/null"), b"1")
    assert Path("/dev/null").is_char_device()
    with pytest.raises(ResourceError, match=r"cannot write /dev/full: No space left on device"):
        write_bytes(Path("/dev/full"), b"1")
    assert Path("/dev/full").is_char_device()


def test_new_files_follow_the_umask(tmp_path):
    before = os.umask(0o027)
    try:
        write_text(tmp_path / "a", "")
    finally:
        os.umask(before)
    assert (tmp_path / "a").stat().st_mode & 0o777 == 0o640


def test_a_failed_write_leaves_the_old_file_and_nothing_else(tmp_path, monkeypatch):
    path = tmp_path / "a"
    write_text(path, "old")

    def full(self, target):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, "replace", full)
    with pytest.raises(ResourceError, match=r"cannot write .*: No space left on device"):
        write_text(path, "new")
    assert path.read_text() == "old"
    assert [p.name for p in tmp_path.iterdir()] == ["a"]


def test_no_folder(tmp_path):
    with pytest.raises(ResourceError, match="no such folder"):
        write_text(tmp_path / "no" / "a", "")


def test_staging_is_gone_afterwards(tmp_path):
    def interrupted():
        with staging(tmp_path) as stage:
            (stage / "a").write_text("x")
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        interrupted()
    assert list(tmp_path.iterdir()) == []


def test_staging_needs_a_folder_it_can_write(tmp_path):
    with pytest.raises(ResourceError, match="cannot write into"), staging(tmp_path / "no"):
        pass


def test_move_into_place(tmp_path):
    with staging(tmp_path) as stage:
        (stage / "b").mkdir()
        (stage / "b" / "f").write_text("x")
        (stage / "a").write_text("y")
        assert move_into_place(stage, tmp_path) == [tmp_path / "a", tmp_path / "b"]
    assert (tmp_path / "b" / "f").read_text() == "x"


def test_nothing_is_overwritten(tmp_path):
    (tmp_path / "b").mkdir()
    with staging(tmp_path) as stage:
        (stage / "a").write_text("y")
        (stage / "b").mkdir()
        with pytest.raises(ResourceError, match="b already exists; nothing is overwritten"):
            move_into_place(stage, tmp_path)
    assert [p.name for p in tmp_path.iterdir()] == ["b"]


def test_moves_are_undone_when_one_fails(tmp_path, monkeypatch):
    rename = Path.rename

    def fail_on_b(self, target):
        if self.name == "b":
            raise OSError(30, "Read-only file system")
        return rename(self, target)

    with staging(tmp_path) as stage:
        (stage / "a").write_text("y")
        (stage / "b").write_text("y")
        monkeypatch.setattr(Path, "rename", fail_on_b)
        with pytest.raises(ResourceError, match="Read-only"):
            move_into_place(stage, tmp_path)
    assert list(tmp_path.iterdir()) == []


def test_errors_do_not_name_the_temporary_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)

    def full(path):
        raise OSError(28, "No space left on device", str(path))

    for folder, shown in ((Path(), "pkg/a.txt"), (Path("src"), "src/pkg/a.txt"), (tmp_path, f"{tmp_path}/pkg/a.txt")):
        folder.mkdir(exist_ok=True)
        with pytest.raises(ResourceError) as caught, staging(folder) as stage:
            full(stage / "pkg/a.txt")
        assert str(caught.value) == f"cannot write {shown}: No space left on device"
        with pytest.raises(ResourceError) as caught, staging(folder) as stage:
            raise ResourceError(f"{stage}/pkg/a.txt: of no use")
        assert str(caught.value) == f"{shown}: of no use"
    with pytest.raises(OSError, match="elsewhere"), staging(tmp_path):
        full("elsewhere")


@pytest.mark.parametrize("how", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_a_signal_waits_until_the_body_is_done(how):
    arrived, done = [], []
    before = signal.signal(how, lambda number, _: arrived.append((number, list(done))))
    try:
        with undisturbed():
            signal.raise_signal(how)
            done.append("body")
        assert arrived == [(how, ["body"])]
    finally:
        signal.signal(how, before)


def test_a_reader_that_goes_away_is_no_file_that_cannot_be_written(tmp_path):
    with pytest.raises(BrokenPipeError), staging(tmp_path):
        raise BrokenPipeError(32, "Broken pipe")
    assert list(tmp_path.iterdir()) == []


KILLED = """
import os, signal, sys
from pathlib import Path
from urdfkit.atomic import move_into_place, staging, write_text

def kill(event, arguments):
    if event == "os.rename" and str(arguments[0]).endswith(sys.argv[1]):
        os.kill(os.getpid(), signal.SIGKILL)

write_text(Path("old"), "old")
sys.addaudithook(kill)
write_text(Path("old"), "new")
with staging(Path()) as stage:
    for name in "abc":
        (stage / name).write_text(name)
    move_into_place(stage, Path())
"""
"""Replaces a file, then moves three into place; killed just before the path that ends in the argument is moved."""


def killed_before(move, folder):
    result = subprocess.run([sys.executable, "-c", KILLED, move], cwd=folder, capture_output=True, check=False)
    assert result.returncode == -signal.SIGKILL, result.stderr
    return {path.name for path in folder.iterdir() if not path.name.startswith(".urdfkit-")}


@pytest.mark.parametrize(
    ("move", "begun", "completed"),
    [("/.urdfkit-moves.part", "", ""), ("/a", "", ""), ("/b", "a", "abc"), ("/c", "ab", "abc")],
)
def test_a_killed_program_has_moved_all_or_nothing_after_the_next(tmp_path, move, begun, completed):
    assert killed_before(move, tmp_path) == {"old", *begun}
    clean_up(tmp_path)
    assert {path.name for path in tmp_path.iterdir()} == {"old", *completed}
    assert all((tmp_path / name).read_text() == name for name in completed)


def test_what_was_removed_or_made_since_stays_so(tmp_path):
    killed_before("/b", tmp_path)
    (tmp_path / "b").write_text("mine")
    clean_up(tmp_path)
    assert (tmp_path / "b").read_text() == "mine"
    for name in "abc":
        (tmp_path / name).unlink()
    killed_before("/b", tmp_path)
    (tmp_path / "a").unlink()
    clean_up(tmp_path)
    assert {path.name for path in tmp_path.iterdir()} == {"old"}


def test_a_program_killed_while_it_writes_leaves_the_old_file_and_the_next_removes_the_rest(tmp_path):
    code = KILLED.replace("endswith(sys.argv[1])", "rpartition('/')[2].startswith('.urdfkit-')")
    subprocess.run([sys.executable, "-c", code, ""], cwd=tmp_path, capture_output=True, check=False)
    assert (tmp_path / "old").read_text() == "old"
    assert len(list(tmp_path.iterdir())) == 2
    write_text(tmp_path / "other", "")
    assert {path.name for path in tmp_path.iterdir()} == {"old", "other"}
