"""Wheel odometry: a planar pose integrated from the distances that wheels have rolled, for drives and controllers."""

from abc import ABC, abstractmethod
from collections.abc import Sequence
from math import copysign, cos, hypot, pi, sin, sqrt, tan

from urdfkit.sim.state.odometer import Encoder, OdometerReading

Twist = tuple[float, float, float]
"""Forward [m/s], to the left [m/s], turning [rad/s]."""


class WheelOdometry(ABC):
    """Planar pose that starts at the origin, heading along x.

    An update takes the distances that the wheels have rolled since the start of the simulation, not their speeds, so
    nothing is lost between updates. The first update only stores them.

    Attributes:
        x: position [m].
        y: position [m].
        heading: yaw angle [rad], not wrapped.
        moved: displacement of the last update in the robot's axes: forward [m], to the left [m], turned [rad].
        distance: length of the last displacement [m]; never negative, also when driving backwards.
        t: time of the last update [s].
        period: time between the last two updates [s].
    """

    def __init__(self) -> None:
        self.reset()

    def reset(self) -> None:
        """Return to the origin and clear the stored wheel distances."""
        self.rolled: tuple[float, ...] | None = None
        self.x = self.y = self.heading = self.distance = self.t = self.period = 0.0
        self.moved = (0.0, 0.0, 0.0)

    @property
    def started(self) -> bool:
        """Whether `update` has been called."""
        return self.rolled is not None

    @property
    def velocity(self) -> Twist:
        """Mean velocity of the last update; zero while no time has passed."""
        if not self.period:
            return (0.0, 0.0, 0.0)
        forward, left, turned = self.moved
        return forward / self.period, left / self.period, turned / self.period

    def update(self, t: float, *rolled: float) -> None:
        """Integrate up to time `t` [s], at which the wheels have rolled so far [m]."""
        before, self.rolled = self.rolled, rolled
        self.t, self.period = t, t - self.t
        if before is not None:
            self.integrate(before, rolled)

    @abstractmethod
    def integrate(self, before: tuple[float, ...], now: tuple[float, ...]) -> None:
        """Advance by the motion between two readings of the wheels."""

    def advance(self, forward: float, left: float, turn: float, *, exact: bool = True) -> None:
        """Advance along the arc of a constant twist.

        Args:
            forward: displacement along the robot's axis x [m].
            left: displacement along its axis y [m].
            turn: change of heading [rad].
            exact: follow the arc; else the chord at the mid-point heading.
        """
        middle = self.heading + turn / 2
        dx, dy = along_arc(forward, self.heading, turn) if exact else (forward * cos(middle), forward * sin(middle))
        if left:
            across = along_arc(left, self.heading + pi / 2, turn)
            dx, dy = dx + across[0], dy + across[1]
        self.x += dx
        self.y += dy
        self.heading += turn
        self.moved, self.distance = (forward, left, turn), hypot(dx, dy)


class EncoderOdometry(WheelOdometry):
    """Odometry from positions of joints, each with a constant effect; the engine computes the same by itself.

    An update takes the positions of the encoders [rad] or [m].

    Args:
        encoders: the joints.
        axles: distance between the axles of a bicycle, which turns by its steering angle [m]; zero for other drives.
        exact: follow the exact arc instead of the chord at the mid-point heading.

    Attributes:
        encoders: the joints.
        axles: see above.
        exact: see above.
    """

    def __init__(self, encoders: Sequence[Encoder], *, axles: float = 0.0, exact: bool = True) -> None:
        super().__init__()
        self.encoders, self.axles, self.exact = tuple(encoders), axles, exact

    def integrate(self, before: tuple[float, ...], now: tuple[float, ...]) -> None:
        """Advance by the sum of the displacements."""
        forward = left = turn = angle = 0.0
        for encoder, old, new in zip(self.encoders, before, now, strict=True):
            forward += encoder.forward * (new - old)
            left += encoder.left * (new - old)
            turn += encoder.turn * (new - old)
            angle += encoder.angle * 0.5 * (new + old)
        if self.axles:
            turn += forward * tan(angle) / self.axles
        self.advance(forward, left, turn, exact=self.exact)

    def take(self, reading: OdometerReading, dt: float) -> None:
        """Set the odometry to a reading of the engine, whose steps have `dt` [s]."""
        self.t, self.period, self.rolled = reading.step * dt, reading.steps * dt, reading.positions
        (self.x, self.y, self.heading), self.moved, self.distance = reading.pose, reading.moved, reading.distance


class DifferentialOdometry(EncoderOdometry):
    """Odometry from the left and the right wheel.

    Args:
        separation: distance between the wheels [m].
        joints: joints of the left and the right wheel; an update takes the distances they rolled if they have no names.
        radius: radius of the wheels [m].
        exact: follow the exact arc (``gz::math::DiffDriveOdometry``) instead of the chord at the mid-point heading
            (Sigwart and Nourbakhsh 2004, eq. 5.7, as in gazebo_ros_diff_drive). The chord is longer by the fraction
            Δθ²/24: 1e-6 at 0.5 rad/s and 100 Hz.
    """

    def __init__(
        self, separation: float, joints: Sequence[str] = ("", ""), radius: float = 1.0, *, exact: bool = False
    ) -> None:
        encoders = (
            Encoder(joint, radius / 2, 0.0, side * radius / separation)
            for joint, side in zip(joints, (-1.0, 1.0), strict=True)
        )
        super().__init__(tuple(encoders), exact=exact)


class BicycleOdometry(WheelOdometry):
    """Odometry of the middle of the driven axle, from one or two wheels on it and the steering angle [rad], the last.

    The heading changes by distance·tan(angle)/base, as in gz sim's AckermannSteering. Gazebo integrates every
    step with the heading at its end. Here each update follows the exact arc of its mean steering angle, which is the
    limit for short steps regardless of the time between updates.

    Args:
        base: distance between the axles [m].
        track: distance between two driven wheels, the right one first [m].
    """

    def __init__(self, base: float, track: float = 0.0) -> None:
        super().__init__()
        self._base = base
        self._track = track

    def integrate(self, before: tuple[float, ...], now: tuple[float, ...]) -> None:
        """Advance along the arc of the mean steering angle."""
        angle = (now[-1] + before[-1]) / 2
        arc = self.middle([new - old for new, old in zip(now[:-1], before[:-1], strict=True)], angle)
        self.advance(arc, 0.0, arc * tan(angle) / self._base)

    def middle(self, wheels: Sequence[float], angle: float) -> float:
        """Return distance or speed of the axle's middle from those of its wheels, at a steering angle [rad]."""
        bend = tan(angle) / self._base
        sides = (1.0, -1.0) if len(wheels) == 2 else (0.0,)
        return sum(way / (1.0 + side * bend * self._track / 2) for way, side in zip(wheels, sides, strict=True)) / len(
            wheels
        )


class FourWheelOdometry(WheelOdometry):
    """Odometry of the middle between two steered axles.

    An update takes four distances, the left wheel of each axle first, and the steering angles of both axles [rad].

    Source: ros_controllers noetic, four_wheel_steering_controller, odometry.cpp.

    Args:
        base: distance between the axles [m].
        track: distance between the steering joints of an axle [m].
        offset: distance from a wheel to its steering joint [m].
    """

    def __init__(self, base: float, track: float, offset: float) -> None:
        super().__init__()
        self._base, self._track, self._offset = base, track, offset

    def integrate(self, before: tuple[float, ...], now: tuple[float, ...]) -> None:
        """Advance by the displacement at the mean steering angles."""
        ways = [new - old for new, old in zip(now[:4], before[:4], strict=True)]
        self.advance(*self.displacement(ways, (now[4] + before[4]) / 2, (now[5] + before[5]) / 2))

    def displacement(self, ways: Sequence[float], front: float, rear: float) -> Twist:
        """Return displacement, or velocity, of the middle from those of the wheels.

        Args:
            ways: displacements [m] or speeds [m/s] of the four wheels.
            front: steering angle of the front axle [rad].
            rear: steering angle of the rear axle [rad].
        """
        bend = (tan(front) - tan(rear)) / self._base
        ahead = left = turn = 0.0
        for angle, (one, other) in ((front, ways[:2]), (rear, ways[2:])):
            own = bend * cos(angle)
            tight = (self._track * own / 2) ** 2
            slopes = [own / sqrt(1 + side * self._track * own * cos(angle) + tight) for side in (-1.0, 1.0)]
            plain = one / (1 - self._offset * slopes[0]), other / (1 + self._offset * slopes[1])
            way = copysign(sqrt((plain[0] ** 2 + plain[1] ** 2) / (2 + 2 * tight)), plain[0] + plain[1])
            ahead, left, turn = ahead + way * cos(angle) / 2, left + way * sin(angle) / 2, turn + way * own / 2
        return ahead, left, turn


class MecanumOdometry(EncoderOdometry):
    """Odometry from four mecanum wheels: front left, front right, back left, back right.

    Wheels roll at vx ∓ vy ∓ w·(separation + base)/2 (front left: both minus); each displacement is the mean of the four
    distances with the signs of its term.

    Args:
        reach: (separation + base) / 2 [m].
        joints: joints of the wheels; an update takes the distances they rolled if they have no names.
        radius: radius of the wheels [m].
    """

    def __init__(self, reach: float, joints: Sequence[str] = ("",) * 4, radius: float = 1.0) -> None:
        signs = ((-1.0, -1.0), (1.0, 1.0), (1.0, -1.0), (-1.0, 1.0))
        super().__init__(
            [
                Encoder(joint, radius / 4, left * radius / 4, turn * radius / 4 / reach)
                for joint, (left, turn) in zip(joints, signs, strict=True)
            ]
        )


def along_arc(arc: float, heading: float, turn: float) -> tuple[float, float]:
    """Return the displacement along an arc of length `arc` [m] that begins at `heading` and turns by `turn` [rad]."""
    chord = arc * sin(turn / 2) / (turn / 2) if abs(turn) > 1e-6 else arc
    return chord * cos(heading + turn / 2), chord * sin(heading + turn / 2)
