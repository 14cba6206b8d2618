"""Driving by the keys of a terminal: the keys alone, the lock shared with pages, and a real pseudo-terminal."""

from __future__ import annotations

import os
import pty
import re
import signal
import subprocess
import sys
import termios
import threading
import time
from types import SimpleNamespace
from typing import Any

import pytest

from urdfkit.app.simulation.terminal.key_input import split_keys
from urdfkit.app.simulation.terminal.terminal_driver import FIRST_HOLD, REPEATED_HOLD, TerminalDriver
from urdfkit.view.protocol.websocket_messages import Axes
from urdfkit.view.server.drive_lock import DriveLock


@pytest.mark.parametrize(
    ("text", "keys", "rest"),
    [
        ("ii,", ["i", "i", ","], ""),
        ("\x1b[A\x1bOD", ["ArrowUp", "ArrowLeft"], ""),
        ("q\x1b[", ["q"], "\x1b["),
        ("\x1b[1;5Hk", ["k"], ""),
        ("\x1bi", ["i"], ""),
    ],
)
def test_keys_of_a_text(text: str, keys: list[str], rest: str) -> None:
    assert split_keys(text) == (keys, rest)


class Driven:
    """A driver of a lock, with a clock that the test moves."""

    def __init__(self) -> None:
        self.time = 0.0
        self.stopped = 0
        self.lock = DriveLock(clock=lambda: self.time)
        loop: Any = SimpleNamespace(server=SimpleNamespace(drive_lock=self.lock), stop=self.stop)
        self.driver = TerminalDriver(loop, lambda: self.time)

    def stop(self) -> None:
        self.stopped += 1
        self.lock.release()

    def axes(self, keys: str = "", after: float = 0.0) -> tuple[float, ...] | None:
        self.time += after
        self.driver.press(keys)
        return None if self.lock.axes is None else self.lock.axes.axes


def test_a_key_drives_until_it_is_released() -> None:
    driven = Driven()
    assert driven.axes("i") == (1, 0, 0, 0)
    assert driven.axes("", FIRST_HOLD - 0.01) == (1, 0, 0, 0)
    assert driven.axes("i") == (1, 0, 0, 0)
    assert driven.axes("", REPEATED_HOLD + 0.01) is None
    assert driven.axes("j") == (0, 0, 0, 1)
    assert driven.axes(",") == (-1, 0, 0, 0)
    assert driven.axes(" ") is None
    assert driven.stopped == 1


def test_speed_keys_scale_the_command_and_other_keys_do_nothing() -> None:
    driven = Driven()
    driven.axes("qei")
    axes = driven.lock.axes
    assert axes is not None
    assert (axes.speed, axes.turn) == pytest.approx((0.55, 1.21))
    assert driven.axes("", 5.0) is None
    assert driven.axes("?") is None


def test_a_page_that_drives_keeps_the_lock() -> None:
    driven = Driven()
    driven.lock.update(1, Axes((0.0, 0.0, 0.0, 1.0), 1.0, 1.0))
    assert driven.axes("i") == (0, 0, 0, 1)
    driven.lock.leave(1)
    assert driven.axes("i") == (1, 0, 0, 0)


class Session:
    """`urdfkit sim teleop --terminal` in a pseudo-terminal."""

    def __init__(self) -> None:
        self.terminal, other = pty.openpty()
        self.before = termios.tcgetattr(other)
        self._other = other
        command = [sys.executable, "-m", "urdfkit", "sim", "teleop", "simpleton", "--terminal", "--port", "0"]

        def owns_terminal() -> None:
            import fcntl

            fcntl.ioctl(0, termios.TIOCSCTTY, 0)
            signal.signal(signal.SIGINT, signal.SIG_DFL)  # ignored where the tests are started in the background

        self.process = subprocess.Popen(
            command, stdin=other, stdout=other, stderr=other, start_new_session=True, preexec_fn=owns_terminal
        )
        self.text = ""
        threading.Thread(target=self._read, daemon=True).start()

    def _read(self) -> None:
        while True:
            try:
                found = os.read(self.terminal, 65536)
            except OSError:
                return
            if not found:
                return
            self.text += found.decode("utf-8", "replace")

    @property
    def x(self) -> float | None:
        found = re.findall(r"x (-?\d+\.\d+)  y", self.text)
        return float(found[-1]) if found else None

    def wait(self, what: Any, seconds: float = 90.0) -> None:
        end = time.monotonic() + seconds
        while not what():
            assert time.monotonic() < end, self.text[-2000:]
            assert self.process.poll() is None, self.text[-2000:]
            time.sleep(0.03)

    def attributes(self) -> list[Any]:
        return termios.tcgetattr(self._other)

    def close(self) -> None:
        if self.process.poll() is None:
            self.process.kill()
        self.process.wait()
        os.close(self.terminal)
        os.close(self._other)


@pytest.mark.slow
@pytest.mark.parametrize("end", [b"\x03", signal.SIGTERM])
def test_a_robot_is_driven_by_a_terminal_which_is_restored(end: Any) -> None:
    session = Session()
    try:
        session.wait(lambda: session.x is not None)
        assert session.attributes() != session.before

        def driven() -> bool:
            os.write(session.terminal, b"i")
            return (session.x or 0.0) > 1.0

        session.wait(driven)

        def stopped() -> bool:
            before = session.x
            time.sleep(0.5)
            return session.x == before

        session.wait(stopped, FIRST_HOLD + 20.0)  # a busy machine reads the keys late
        if end == b"\x03":
            os.write(session.terminal, end)
        else:
            session.process.send_signal(end)
        session.process.wait(10.0)
        assert session.process.returncode == 0
        assert session.attributes() == session.before
    finally:
        session.close()


@pytest.mark.slow
def test_without_a_terminal_one_line_says_so() -> None:
    command = [sys.executable, "-m", "urdfkit", "sim", "teleop", "simpleton", "--terminal"]
    done = subprocess.run(command, capture_output=True, text=True, stdin=subprocess.DEVNULL, check=False)
    assert done.returncode == 2
    assert done.stderr == "urdfkit: --terminal reads the keys of a terminal, but standard input is not a terminal\n"
