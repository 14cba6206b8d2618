"""Keys and axes → Twist: the exact map of teleop_twist_keyboard, and arrows and WASD for the browser.

Pure data and two small classes; no messages, no terminal, no browser. A `Motion` is linear first, in the base frame.
"""

from collections.abc import Collection
from dataclasses import dataclass
from math import isfinite
from typing import Any, NamedTuple

Direction = tuple[float, float, float, float]
"""x, y, z and turn, each -1, 0 or 1: the factors of speed, speed, speed and turn."""

MOVES: dict[str, Direction] = {
    "i": (1, 0, 0, 0),
    "o": (1, 0, 0, -1),
    "j": (0, 0, 0, 1),
    "l": (0, 0, 0, -1),
    "u": (1, 0, 0, 1),
    ",": (-1, 0, 0, 0),
    ".": (-1, 0, 0, 1),
    "m": (-1, 0, 0, -1),
    "O": (1, -1, 0, 0),
    "I": (1, 0, 0, 0),
    "J": (0, 1, 0, 0),
    "L": (0, -1, 0, 0),
    "U": (1, 1, 0, 0),
    "<": (-1, 0, 0, 0),
    ">": (-1, -1, 0, 0),
    "M": (-1, 1, 0, 0),
    "t": (0, 0, 1, 0),
    "b": (0, 0, -1, 0),
}
"""Motion keys of teleop_twist_keyboard; shift strafes. Any other key stops."""

SPEEDS: dict[str, tuple[float, float]] = {
    "q": (1.1, 1.1),
    "z": (0.9, 0.9),
    "w": (1.1, 1.0),
    "x": (0.9, 1.0),
    "e": (1.0, 1.1),
    "c": (1.0, 0.9),
}
"""Speed keys of teleop_twist_keyboard: factors on speed and turn."""

ARROWS: dict[str, Direction] = {
    "ArrowUp": (1, 0, 0, 0),
    "ArrowDown": (-1, 0, 0, 0),
    "ArrowLeft": (0, 0, 0, 1),
    "ArrowRight": (0, 0, 0, -1),
}
"""Arrow keys, by the names browsers give them (``KeyboardEvent.key``)."""

WASD: dict[str, Direction] = {"w": (1, 0, 0, 0), "s": (-1, 0, 0, 0), "a": (0, 0, 0, 1), "d": (0, 0, 0, -1)}
"""WASD keys. `w` replaces the speed key of teleop_twist_keyboard, therefore `x` is not a speed key either."""

KEYBOARD_LAYOUT = MOVES
"""The terminal's keys: exactly those of teleop_twist_keyboard."""

HELD_LAYOUT: dict[str, Direction] = {**MOVES, **ARROWS, **WASD}
"""The browser's motion keys, which can be held down."""

HELD_SPEEDS = {key: factors for key, factors in SPEEDS.items() if key not in ("w", "x")}
"""The browser's speed keys: those whose letters do not drive."""


class Motion(NamedTuple):
    """A velocity command: `linear` [m/s] and `angular` [rad/s], x y z each."""

    linear: tuple[float, float, float]
    angular: tuple[float, float, float]

    def message(self) -> Any:
        """Return it as a ``geometry_msgs/msg/Twist``.

        Raises:
            MissingDependencyError: rosbags is not installed.
        """
        from urdfkit.messages import twist

        return twist(self.linear, self.angular)


STOP = Motion((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
"""Zero velocity."""


@dataclass(slots=True)
class Teleop:
    """Speed settings and the motion of the last key.

    `key` is for the terminal (one key at a time, the motion continues until another key); `held` is for the browser (a
    set of pressed keys, whose directions add up); `axes` is for touch pads and joysticks.

    Attributes:
        speed: [m/s] at full linear motion.
        turn: [rad/s] at full angular motion.
        speed_limit: `speed` never exceeds it [m/s].
        turn_limit: `turn` never exceeds it [rad/s].
    """

    speed: float = 0.5
    turn: float = 1.0
    speed_limit: float = 1000.0
    turn_limit: float = 1000.0
    _direction: Direction = (0, 0, 0, 0)

    def key(self, key: str) -> Motion:
        """Return the command after one key press, as teleop_twist_keyboard does.

        A motion key moves, a speed key scales the present motion, any other key (also ``k`` and space) stops.
        """
        if key in SPEEDS:
            self._scale(*SPEEDS[key])
        else:
            self._direction = KEYBOARD_LAYOUT.get(key, (0, 0, 0, 0))
        return self._motion(*self._direction)

    def held(self, keys: Collection[str]) -> Motion:
        """Return the command while these keys are down: directions add up and are clamped to full motion."""
        directions = [HELD_LAYOUT[key] for key in sorted(keys) if key in HELD_LAYOUT]
        x, y, z, turn = (max(-1.0, min(1.0, float(sum(d[i] for d in directions)))) for i in range(4))
        return self._motion(x, y, z, turn)

    def axes(self, x: float, turn: float, y: float = 0.0, z: float = 0.0) -> Motion | None:
        """Return the command for stick positions in -1..1 (clamped); None, to be dropped, when one is not finite."""
        values = (x, y, z, turn)
        if not all(isfinite(value) for value in values):
            return None
        return self._motion(*(max(-1.0, min(1.0, value)) for value in values))

    def status(self) -> str:
        """Return the line that teleop_twist_keyboard prints after a change of speed."""
        return f"currently:\tspeed {self.speed:.3g}\tturn {self.turn:.3g} "

    def _scale(self, speed: float, turn: float) -> None:
        self.speed = min(self.speed_limit, self.speed * speed)
        self.turn = min(self.turn_limit, self.turn * turn)

    def _motion(self, x: float, y: float, z: float, turn: float) -> Motion:
        return Motion((x * self.speed, y * self.speed, z * self.speed), (0.0, 0.0, turn * self.turn))
