"""Whatever happens on the way, there is all of a robot or nothing of it, and nothing of the user's is touched."""

import os
import shutil
import signal
import subprocess
import sys
import time

import pytest

from urdfkit.cli import main

NEW = [
    sys.executable,
    "-m",
    "urdfkit",
    "new",
    "robot",
    "scout",
    "--arm",
    "6",
    "--sensor",
    "lidar,camera",
    "--yes",
    "-q",
]


def started(folder, *options):
    """Start to write a robot; return the process when it has begun to write."""
    process = subprocess.Popen([*NEW, *options], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    while process.poll() is None and not list(folder.glob("**/.urdfkit-*/*")):
        time.sleep(0.005)
    assert process.poll() is None, "too quick to be interrupted"
    return process


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "mine").write_text("mine")
    return tmp_path


def test_ctrl_c_leaves_nothing(folder):
    process = started(folder)
    process.send_signal(signal.SIGINT)
    _, said = process.communicate(timeout=60)
    assert process.returncode == 130
    assert "Traceback" not in said
    assert [path.name for path in folder.iterdir()] == ["mine"]


@pytest.mark.parametrize("how", [signal.SIGTERM, signal.SIGHUP])
def test_being_told_to_end_leaves_nothing_not_even_the_folder_it_made(folder, how):
    process = started(folder, "--into", "src")
    process.send_signal(how)
    _, said = process.communicate(timeout=60)
    assert process.returncode == 128 + how
    assert said == ""
    assert [path.name for path in folder.iterdir()] == ["mine"]


def test_a_closed_terminal_does_not_end_what_was_told_not_to_mind(folder):
    before = signal.signal(signal.SIGHUP, signal.SIG_IGN)  # as nohup does
    try:
        process = started(folder)
    finally:
        signal.signal(signal.SIGHUP, before)
    process.send_signal(signal.SIGHUP)
    process.communicate(timeout=60)
    assert process.returncode == 0
    assert (folder / "scout_description").is_dir()


def test_what_a_killed_run_leaves_is_hidden_and_gone_with_the_next(folder):
    process = started(folder)
    process.kill()
    process.communicate(timeout=60)
    left = sorted(path.name for path in folder.iterdir())
    assert len(left) == 2
    assert left[0].startswith(".urdfkit-")
    assert subprocess.run(NEW, cwd=folder, capture_output=True, check=False, timeout=120).returncode == 0
    assert sorted(path.name for path in folder.iterdir()) == [
        "mine",
        *(f"scout_{package}" for package in ("bringup", "control", "description", "gazebo")),
    ]


def test_the_folder_of_a_run_that_goes_on_stays(folder):
    process = started(folder)
    process.send_signal(signal.SIGSTOP)
    try:
        (stage,) = folder.glob(".urdfkit-*")
        other = [word.replace("scout", "other") for word in NEW]
        assert subprocess.run(other, cwd=folder, capture_output=True, check=False, timeout=120).returncode == 0
        assert stage.is_dir()
    finally:
        process.send_signal(signal.SIGCONT)
    process.communicate(timeout=120)
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
    said = capsys.readouterr().err
    assert said.startswith("urdfkit: cannot write ")
    assert said.endswith(": No space left on device\n")
    assert [path.name for path in disk.iterdir()] == ["mine"]
    monkeypatch.chdir("/")


def test_a_disk_that_is_read_only(mounted, monkeypatch, capsys):
    disk = mounted("ro,size=64k")
    for into in (disk, disk / "a/b"):
        assert main(["new", "robot", "scout", "--into", str(into), "--yes"]) == 2
        assert capsys.readouterr().err == f"urdfkit: cannot write into {into}: Read-only file system\n"
