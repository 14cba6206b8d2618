"""`urdfkit new robot` on a terminal: it asks, and the page in the browser follows the answers."""

import asyncio
import codecs
import os
import re
import select
import signal
import sys
import time
from contextlib import ExitStack

import pytest

from tests.processes import running
from tests.time_limit import PATIENCE
from urdfkit.app.viewer.preview import Preview, can_preview
from urdfkit.description import load
from urdfkit.errors import ResourceError
from urdfkit.lint import lint
from urdfkit.resources import templates_dir
from urdfkit.scaffold import load_template

pty = pytest.importorskip("pty")
TEMPLATE = load_template(templates_dir() / "robot")


class Terminal:
    """urdfkit at work on a terminal of its own, of which `master` is our end."""

    def __init__(self, master, process):
        self.master, self.process = master, process
        self.decoder = codecs.getincrementaldecoder("utf-8")()
        self.reported = ""

    def until(self, pattern):
        """Read until something is reported; return the match."""
        end = time.monotonic() + PATIENCE
        while (found := re.search(pattern, self.reported)) is None:
            assert time.monotonic() < end, self.reported
            if select.select([self.master], [], [], 0.2)[0]:
                try:
                    self.reported += self.decoder.decode(os.read(self.master, 65536))
                except OSError:  # the other side is closed
                    raise AssertionError(self.reported) from None
        self.reported = self.reported[found.end() :]
        return found

    def type(self, line):
        os.write(self.master, f"{line}\n".encode())


@pytest.fixture
def terminal(tmp_path):
    env = {key: value for key, value in os.environ.items() if key not in ("DISPLAY", "WAYLAND_DISPLAY", "BROWSER")}
    env |= {
        "HOME": str(tmp_path),
        "GIT_CONFIG_NOSYSTEM": "1",
        "GIT_CONFIG_GLOBAL": "/dev/null",
        "TMPDIR": str(tmp_path),
        "TERM": "xterm",  # on a dumb terminal, readline shows the end of a long line only
    }
    with ExitStack() as programs:

        def start(*words):
            master, slave = pty.openpty()
            programs.callback(os.close, master)
            ends = dict.fromkeys(("stdin", "stdout", "stderr"), slave)
            program = running([sys.executable, "-m", "urdfkit", *words], cwd=tmp_path, env=env, **ends)
            try:
                return Terminal(master, programs.enter_context(program))
            finally:
                os.close(slave)

        yield start


def links_on(url):
    """Return the links that a page shows."""
    from urdfkit.view.protocol.client import connect

    async def ask():
        async with await connect(url) as client:
            while (text := await client.text(PATIENCE)) is not None:
                if text["type"] == "model":
                    return {node.rsplit("/", 1)[-1] for node in text["nodes"]}
        raise AssertionError("no model")

    return asyncio.run(ask())


@pytest.mark.slow
def test_the_page_follows_the_answers(terminal, until, tmp_path):
    asking = terminal("new", "robot")
    url = asking.until(r"preview: (http://127\.0\.0\.1:\d+/\?token=\S+)")[1]
    assert "left_wheel" in " ".join(links_on(url))  # before anything was asked
    asking.until("Name of the robot")
    asking.type("rover")
    asking.until(r"ROS distribution[^\n]*: ")
    asking.type("jazzy")
    asking.until(r"Drive [^\n]*: ")
    asking.type("skid")
    asking.until(r"Length of the base[^\n]*: ")
    until(lambda: "front_left_wheel" in " ".join(links_on(url)))
    for _ in range(30):
        asking.type("")
    asking.until(r"rover_description +\d+ files")
    asking.process.wait(PATIENCE)
    assert load(tmp_path / "rover_description/urdf/rover.urdf.xacro").name == "rover"
    assert list(tmp_path.glob("urdfkit-preview-*")) == []
    with pytest.raises(ResourceError):
        links_on(url)


@pytest.mark.slow
def test_without_a_preview_only_the_questions_are_printed(terminal, tmp_path):
    asking = terminal("new", "robot", "rover", "--no-preview")
    asking.until("ROS distribution")
    for _ in range(30):
        asking.type("")
    assert "preview:" not in asking.until(r"(?s).*rover_description +\d+ files")[0]


def test_who_does_not_know_may_ask(terminal):
    asking = terminal("new", "robot", "rover", "--no-preview")
    asking.until("ROS distribution")
    asking.type("?")
    asking.until("noetic is ROS 1, the others are ROS 2")
    asking.until("ROS distribution")
    asking.type("quit")
    asking.until("--ros `quit` is not available.*; press Ctrl-C to exit without writing")


def test_answers_can_be_edited_and_earlier_ones_called_back(terminal):
    pytest.importorskip("readline")
    asking = terminal("new", "robot", "rover", "--no-preview")
    asking.until("ROS distribution")
    asking.type("nobbtic\x1b[D\x1b[D\x1b[D\x7f\x7fe")  # three to the left, two away
    asking.until("Drive|Simulator")
    asking.type("\x1b[A")  # what was typed before: no drive and no simulator
    asking.until("`noetic` is not available")


def test_an_answer_that_contradicts_earlier_answers_repeats_the_question_if_another_answer_fits(terminal):
    sizes = ("--base-length", "0.1", "--base-width", "0.1", "--base-height", "0.05", "--mass", "0.2")
    asking = terminal("new", "robot", "rover", "--no-preview", "--ros", "none", "--drive", "none", *sizes)
    asking.until("Sensors ")
    asking.type("lidar")
    asking.until("the base has no room for the sensors: --base-length must be at least 0.3 m")
    asking.until("Sensors ")
    asking.type("")
    asking.until("Number of joints of the arm")


@pytest.mark.slow
@pytest.mark.parametrize("how", [signal.SIGINT, signal.SIGHUP])
def test_an_interrupt_leaves_nothing(terminal, tmp_path, how):
    asking = terminal("new", "robot", "rover")
    url = asking.until(r"preview: (http://\S+)")[1]
    asking.until("ROS distribution")
    asking.type("jazzy")
    asking.process.send_signal(how)
    assert asking.process.wait(PATIENCE) == 128 + how
    assert list(tmp_path.iterdir()) == []
    with pytest.raises(ResourceError):
        links_on(url)


def test_answers_that_make_no_robot_leave_the_last_one(monkeypatch):
    monkeypatch.setattr(Preview, "_start", lambda self: None)
    with Preview(TEMPLATE) as shown:
        shown.follow({"wheel_radius": "5"})
        assert list(shown.folder.iterdir()) == []
        shown.follow({"drive": "diff"})
        assert load(shown.model).name == "robot"  # no name yet
        shown.follow({"name": "rover", "drive": "diff"})
        assert load(shown.model).name == "rover"
        assert [str(finding) for finding in lint([shown.model])] == []
        drive = shown.folder / "rover_description/urdf/drive.xacro"
        before = drive.read_bytes()
        shown.follow({"name": "rover", "drive": "diff", "wheel_radius": "5"})
        assert drive.read_bytes() == before
        shown.follow({"name": "rover", "drive": "diff", "base_length": "0.6", "arm": "6"})
        assert load(shown.model).joint_by_name["elbow_joint"].type == "revolute"
        folder = shown.folder
    assert not folder.exists()


def test_nobody_is_shown_what_they_cannot_see(monkeypatch):
    assert not can_preview(TEMPLATE)  # not on a terminal
    assert not can_preview(load_template(templates_dir() / "world"))
