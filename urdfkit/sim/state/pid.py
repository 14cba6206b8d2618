"""PID: gains and integral of ros_control's control_toolbox (noetic, src/pid.cpp), and the PID of Gazebo's drives."""

from collections.abc import Callable
from dataclasses import dataclass
from math import inf

from urdfkit.description.control import Settings
from urdfkit.errors import SimulationError


@dataclass(frozen=True, slots=True)
class Gains:
    """Gains of a PID controller and bounds of its integral term.

    Attributes:
        p: gain of the error [N·m/rad] (or per rad/s, for a velocity).
        i: gain of the integral of the error.
        d: gain of the derivative of the error.
        i_min: lower bound of the integral term.
        i_max: upper bound of the integral term.
        antiwindup: stop integrating at the bounds. Otherwise only the integral term is clamped, not the integral.
    """

    p: float
    i: float = 0.0
    d: float = 0.0
    i_min: float = 0.0
    i_max: float = 0.0
    antiwindup: bool = False

    @property
    def integrates(self) -> bool:
        """Whether the integral term can be other than zero."""
        return self.i != 0.0 and self.i_max > self.i_min


def read_gains(settings: Settings, path: str, note: Callable[[str], None]) -> Gains | None:
    """Return the gains in a group of parameters; None if the group does not exist.

    `p` is required; `i`, `d` and ``i_clamp`` default to zero. An `i` without ``i_clamp`` therefore has no effect and is
    reported.

    Raises:
        DescriptionError: a gain is not a number, or `p` is missing.
        SimulationError: a gain is negative, which drives the joint away from its target.
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
            message = f"gain `{name}` of `{path}` is {gain:g}; a negative gain drives the joint away from its target"
            raise SimulationError(message, position=(where or group).position)
    if gains.i and not gains.integrates:
        note(f"{group.place.file}: `i` has no effect without `i_clamp`, which defaults to 0")
    return gains


class Integral:
    """Integral of an error, and the integral term of the effort."""

    def __init__(self, gains: Gains) -> None:
        self.gains = gains
        self.reset()

    def reset(self) -> None:
        """Reset the integral to zero."""
        self._sum = 0.0
        self._last: tuple[float, float] | None = None
        self._fresh = True
        self.part = 0.0

    def begins(self) -> bool:
        """Return whether the integral was reset since the last call of this method."""
        fresh, self._fresh = self._fresh, False
        return fresh

    def update(self, t: float, error: float) -> float:
        """Integrate up to time `t` [s] with the trapezoidal rule; return the integral term."""
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
    """PID of gazebo::common::PID and gz::math::PID; the error is the measured minus the desired value.

    Attributes:
        gains: p [1], i [1/s], d [s] and the bounds of the integral term.
        bounds: lower and upper bound of the command.
        offset: added to the command before it is clamped.
        integral: integral term of the command so far.
        before: last error.
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
