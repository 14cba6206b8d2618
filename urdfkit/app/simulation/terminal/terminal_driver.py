"""Drive a robot by the keys of teleop_twist_keyboard, and show its speeds and pose on one line of the terminal."""

import math
import os
import sys
import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from typing import TextIO

from urdfkit.app.simulation.loop import DriveLoop
from urdfkit.app.simulation.terminal.key_input import KeyInput, key_input
from urdfkit.sim.state.quaternion import yaw_of
from urdfkit.teleop import ARROWS, KEYBOARD_LAYOUT, SPEEDS, Direction, Teleop
from urdfkit.view.protocol.websocket_messages import Axes

FIRST_HOLD = 0.6
"""Seconds that a key counts as held after its first press: terminals repeat a held key after up to 0.5 s and report no
release."""
REPEATED_HOLD = 0.2
"""Seconds that a key counts as held after a repetition; terminals repeat at 15 to 40 Hz."""
STATUS_PERIOD = 0.1
"""Seconds between two status lines."""
CLIENT = -1
"""Number of this driver in the drive lock; pages have positive numbers."""
DIRECTIONS: dict[str, Direction] = {**KEYBOARD_LAYOUT, **ARROWS}
HELP = """\
Keys:   u i o     i forwards, comma backwards, j and l turn, the others do both; with Shift they move sideways
        j k l     arrows drive as well; space or k stops; a released key stops the robot
        m , .     q/z both speeds ±10 %, w/x the linear, e/c the turning speed; t/b up and down; Ctrl-C exits"""


class TerminalDriver:
    """Turns keys into input of the drive lock, and the state of the robot into a status line.

    Args:
        loop: the simulation.
        clock: monotonic clock [s].
    """

    def __init__(self, loop: DriveLoop, clock: Callable[[], float] = time.monotonic) -> None:
        self._loop, self._clock = loop, clock
        self._teleop = Teleop()
        self._key, self._until = "", -math.inf
        self._refused = False

    def press(self, keys: Iterable[str]) -> None:
        """Handle pressed keys, then renew or release the lock."""
        now = self._clock()
        for key in keys:
            if key in SPEEDS:
                self._teleop.key(key)
            elif key in DIRECTIONS:
                repeated = key == self._key and now <= self._until
                self._key, self._until = key, now + (REPEATED_HOLD if repeated else FIRST_HOLD)
            elif key in (" ", "k"):
                self._key = ""
                self._loop.stop()
        if self._key and now > self._until:
            self._key = ""
        axes = tuple(map(float, DIRECTIONS[self._key])) if self._key else (0.0, 0.0, 0.0, 0.0)
        lock = self._loop.server.drive_lock
        accepted = lock.update(CLIENT, Axes(axes, self._teleop.speed, self._teleop.turn))  # type: ignore[arg-type]
        self._refused = bool(self._key) and not accepted

    def release(self) -> None:
        """Release the lock."""
        self._loop.server.drive_lock.leave(CLIENT)

    def status(self) -> str:
        """Return the speeds, the pose of the driven robot and the simulated time."""
        simulator = self._loop.simulator
        pose = simulator.state.base_pose
        parts = [
            f"speed {self._teleop.speed:.3g} m/s  turn {self._teleop.turn:.3g} rad/s",
            f"x {pose[0]:.2f}  y {pose[1]:.2f} m  yaw {math.degrees(yaw_of(pose[3:])):.0f}°",
            f"{simulator.t:.1f} s",
        ]
        if simulator.paused:
            parts.append("paused")
        if self._refused:
            parts.append("a page drives")
        return "   ".join(parts)


class StatusLine:
    """One line of a terminal, written again and again.

    Args:
        stream: a terminal; nothing is written to another file.
    """

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream
        self._shown = ""
        self._on = stream.isatty()

    def show(self, text: str) -> None:
        """Replace the line, cut to the width of the terminal."""
        if not self._on:
            return
        try:
            width = os.get_terminal_size(self._stream.fileno()).columns or 80
        except OSError:
            width = 80
        cut = text if len(text) < width else text[: max(width - 2, 0)] + "…"
        if cut != self._shown:
            self._write("\r" + cut + " " * max(0, min(len(self._shown), width - 1) - len(cut)))
            self._shown = cut

    def clear(self) -> None:
        """Remove the line, so that another line can be printed."""
        if self._shown:
            self._write("\r" + " " * len(self._shown) + "\r")
            self._shown = ""

    def _write(self, text: str) -> None:
        try:
            self._stream.write(text)
            self._stream.flush()
        except OSError:  # the terminal was closed
            self._on = False


@contextmanager
def driven_from_terminal(loop: DriveLoop) -> Iterator[None]:
    """Let the keys of standard input drive the simulation inside the context; `can_read_keys` must be true."""
    driver, line = TerminalDriver(loop), StatusLine(sys.stderr)
    look, report = loop.look, loop.report
    shown = -math.inf

    def tick(keys: KeyInput) -> None:
        nonlocal shown
        look()
        driver.press(keys.read())
        if time.monotonic() - shown >= STATUS_PERIOD:
            shown = time.monotonic()
            line.show(driver.status())

    def print_above(text: str) -> None:
        line.clear()
        report(text)

    with key_input() as keys:
        loop.look, loop.report = lambda: tick(keys), print_above
        try:
            yield
        finally:
            loop.look, loop.report = look, report
            driver.release()
            line.clear()
