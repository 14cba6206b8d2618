"""Whatever happens on the way, there is all of a robot or nothing of it, and nothing of the user's is touched."""

import os
import shutil
import signal
import subprocess
import sys
from contextlib import contextmanager
from pathlib import Path

import pytest

from tests.processes import running
from tests.time_limit import PATIENCE
from urdfkit.cli import main

SCOUT = ["new", "robot", "scout", "--arm", "6", "--sensor", "lidar,camera", "--yes", "-q"]
NEW = [sys.executable, "-m", "urdfkit", *SCOUT]
HELD = """
from urdfkit import atomic

def held(staged, folder):
    print("written", flush=True)
    input()
    return move(staged, folder)

move, atomic.move_into_place = atomic.move_into_place, held
from urdfkit.cli import program
program()
"""
"""urdfkit, which waits for a line on standard input when a robot is written and not yet moved into place."""


@contextmanager
def writing(folder, *options, ignored=()):
    """Start to write a robot; yield the process when it has written and waits."""
    pipes = dict.fromkeys(("stdin", "stdout", "stderr"), subprocess.PIPE)
    command = [sys.executable, "-c", HELD, *SCOUT, *options]
    with running(command, ignored=ignored, cwd=folder, text=True, **pipes) as process:
        assert process.stdout.readline() == "written\n"
        assert list(folder.glob("**/.urdfkit-*/*"))
        yield process


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "mine").write_text("mine")
    return tmp_path


@pytest.mark.slow
@pytest.mark.parametrize("ignored", [[], [signal.SIGINT]], ids=["terminal", "background job"])
def test_sigint_leaves_nothing(folder, ignored):
    with writing(folder, ignored=ignored) as process:
        process.send_signal(signal.SIGINT)
        _, reported = process.communicate(timeout=PATIENCE)
    assert process.returncode == 130
    assert "Traceback" not in reported
    assert [path.name for path in folder.iterdir()] == ["mine"]


@pytest.mark.slow
@pytest.mark.parametrize("how", [signal.SIGTERM, signal.SIGHUP])
def test_being_told_to_end_leaves_nothing_not_even_the_folder_it_made(folder, how):
    with writing(folder, "--into", "src") as process:
        process.send_signal(how)
        _, reported = process.communicate(timeout=PATIENCE)
    assert process.returncode == 128 + how
    assert reported == ""
    assert [path.name for path in folder.iterdir()] == ["mine"]


@pytest.mark.slow
def test_sighup_under_nohup_stays_ignored(folder):
    with writing(folder, ignored=[signal.SIGHUP]) as process:
        process.send_signal(signal.SIGHUP)
        process.communicate("\n", timeout=PATIENCE)
    assert process.returncode == 0
    assert (folder / "scout_description").is_dir()


@pytest.mark.slow
def test_what_a_killed_run_leaves_is_hidden_and_gone_with_the_next(folder):
    with writing(folder) as process:
        process.kill()
        process.communicate(timeout=PATIENCE)
    left = sorted(path.name for path in folder.iterdir())
    assert len(left) == 2
    assert left[0].startswith(".urdfkit-")
    assert subprocess.run(NEW, cwd=folder, capture_output=True, check=False).returncode == 0
    assert sorted(path.name for path in folder.iterdir()) == [
        "mine",
        *(f"scout_{package}" for package in ("bringup", "control", "description", "gazebo")),
    ]


@pytest.mark.slow
def test_the_folder_of_a_run_that_goes_on_stays(folder):
    with writing(folder) as process:
        (stage,) = folder.glob(".urdfkit-*")
        other = [word.replace("scout", "other") for word in NEW]
        assert subprocess.run(other, cwd=folder, capture_output=True, check=False).returncode == 0
        assert stage.is_dir()
        process.communicate("\n", timeout=PATIENCE)
    assert process.returncode == 0
    assert (folder / "scout_description").is_dir()


@pytest.fixture
def mounted(tmp_path):
    """Return what mounts a file system of 64 kB, with options."""
    place = tmp_path / "disk"
    place.mkdir()
    done = []

    def mount(options):
        asked = ["mount", "-t", "tmpfs", "-o", options, "none", str(place)]
        if (
            os.geteuid()
            or not shutil.which("mount")
            or subprocess.run(asked, capture_output=True, check=False).returncode
        ):
            pytest.skip("mounting is not allowed here")
        done.append(place)
        return place

    yield mount
    for place in done:
        subprocess.run(["umount", str(place)], check=True)


def test_a_full_disk(mounted, monkeypatch, capsys):
    disk = mounted("size=64k")
    (disk / "mine").write_text("mine")
    monkeypatch.chdir(disk)
    assert main(["new", "robot", "scout", "--yes"]) == 2
    reported = capsys.readouterr().err
    assert reported.startswith("urdfkit: cannot write ")
    assert reported.endswith(": No space left on device\n")
    assert [path.name for path in disk.iterdir()] == ["mine"]
    monkeypatch.chdir("/")


def test_a_disk_that_is_read_only(mounted, monkeypatch, capsys):
    disk = mounted("ro,size=64k")
    for into in (disk, disk / "a/b"):
        assert main(["new", "robot", "scout", "--into", str(into), "--yes"]) == 2
        assert capsys.readouterr().err == f"urdfkit: cannot write into {into}: Read-only file system\n"


@pytest.mark.slow
def test_commands_that_write_survive_sigkill_full_disks_and_damaged_caches():
    script = Path(__file__).parents[1] / "bench/kills.py"
    sample = ["--count", "4", "--disks", "2", "--caches", "4"]
    result = subprocess.run([sys.executable, script, *sample], capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stdout + result.stderr
