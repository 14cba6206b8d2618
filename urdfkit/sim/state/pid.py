"""PID: gains and integral of ros_control's control_toolbox (noetic, src/pid.cpp), and the PID of Gazebo's drives."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf
from typing import TYPE_CHECKING

from urdfkit.errors import SimulationError

if TYPE_CHECKING:
    from collections.abc import Callable

    from urdfkit.description.control import Settings


@dataclass(frozen=True, slots=True)
class Gains:
    """What a PID law multiplies.

    Attributes:
        p: of the error [N·m/rad] (or per rad/s, for a velocity).
        i: of its integral.
        d: of its derivative.
        i_min: least the integral part may be.
        i_max: most it may be.
        antiwindup: stop integrating there; without, the integral itself goes on growing.
    """

    p: float
    i: float = 0.0
    d: float = 0.0
    i_min: float = 0.0
    i_max: float = 0.0
    antiwindup: bool = False

    @property
    def integrates(self) -> bool:
        """Whether there is an integral part."""
        return self.i != 0.0 and self.i_max > self.i_min


def read_gains(settings: Settings, path: str, note: Callable[[str], None]) -> Gains | None:
    """Return the gains in a group of parameters; None where there is no group.

    `p` is required, `i`, `d` and ``i_clamp`` are zero when left out. So an `i` without ``i_clamp`` does nothing, which
    is noted.

    Raises:
        DescriptionError: a gain is no number or `p` is missing.
        SimulationError: a negative gain, which drives the joint away from where it should be.
    """
    group = settings.find(path)
    if group is None:
        return None
    clamp = abs(group.number("i_clamp", 0.0))
    gains = Gains(
        group.number("p"),
        group.number("i", 0.0),
        group.number("d", 0.0),
        -abs(group.number("i_clamp_min", -clamp)),
        abs(group.number("i_clamp_max", clamp)),
        group.flag("antiwindup", False),
    )
    for name, gain in (("p", gains.p), ("i", gains.i), ("d", gains.d)):
        if gain < 0.0:
            where = group.find(name)
            raise SimulationError(
                f"gain `{name}` of `{path}` is {gain:g}; a negative gain drives the joint away from its target",
                position=(where or group).position,
            )
    if gains.i and not gains.integrates:
        note(f"{group.place.file}: `i` has no effect without `i_clamp`, which is 0 when left out")
    return gains


class Integral:
    """The integral of an error and its part of the effort."""

    def __init__(self, gains: Gains) -> None:
        self.gains = gains
        self.reset()

    def reset(self) -> None:
        """Forget the past."""
        self._sum = 0.0
        self._last: tuple[float, float] | None = None
        self._fresh = True
        self.part = 0.0

    def begins(self) -> bool:
        """Return whether the past has been forgotten since the last call."""
        fresh, self._fresh = self._fresh, False
        return fresh

    def update(self, t: float, error: float) -> float:
        """Integrate up to time `t` [s], straight from the last error to this one; return the integral part."""
        gains = self.gains
        if self._last is not None:
            before, last = self._last
            self._sum += 0.5 * (last + error) * (t - before)
            if gains.antiwindup and gains.i > 0.0:
                self._sum = min(gains.i_max / gains.i, max(gains.i_min / gains.i, self._sum))
        self._last = (t, error)
        self.part = min(gains.i_max, max(gains.i_min, gains.i * self._sum))
        return self.part


@dataclass(slots=True)
class GazeboPid:
    """PID of gazebo::common::PID and gz::math::PID on an error that is the measured minus the desired value.

    Attributes:
        gains: p [1], i [1/s], d [s] and the bounds of the integral part.
        bounds: of the command.
        offset: added to the command before it is bounded.
        integral: integral part of the command so far.
        before: the last error.
    """

    gains: Gains
    bounds: tuple[float, float] = (-inf, inf)
    offset: float = 0.0
    integral: float = 0.0
    before: float = 0.0

    @property
    def idle(self) -> bool:
        """Whether the command is always zero."""
        return self.gains.p == self.gains.i == self.gains.d == self.offset == 0.0

    def update(self, error: float, dt: float) -> float:
        """Return the command `dt` [s] after the last one."""
        gains = self.gains
        self.integral = max(gains.i_min, min(gains.i_max, self.integral + gains.i * dt * error))
        slope = (error - self.before) / dt
        self.before = error
        command = self.offset - gains.p * error - self.integral - gains.d * slope
        return max(self.bounds[0], min(self.bounds[1], command))

    def reset(self) -> None:
        """Clear integral and last error."""
        self.integral = self.before = 0.0
