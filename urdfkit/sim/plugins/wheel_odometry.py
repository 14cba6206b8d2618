"""The integrators of wheel odometry, shared by every drive."""

from __future__ import annotations

from math import cos, hypot, pi, sin, tan


class WheelOdometry:
    """Planar pose from the distances that the left and the right wheel have rolled.

    Starts at the origin, heading along x. The caller feeds the wheels' rolled distances, not their speeds, so nothing
    is lost between updates however far apart they are.

    Args:
        separation: distance between the wheels [m].
        exact: follow the exact arc (``gz::math::DiffDriveOdometry``) instead of the chord at the mid-point heading
            (Sigwart and Nourbakhsh 2004, eq. 5.7, as in gazebo_ros_diff_drive). The chord is longer by the fraction
            Δθ²/24: 1e-6 at 0.5 rad/s and 100 Hz.

    Attributes:
        x: [m].
        y: [m].
        heading: [rad], not wrapped.
        distance: length of the last update's displacement [m]; never negative, also when driving backwards.
        turned: the last update's change of heading [rad].
        advanced: signed length of the last update's arc [m].
    """

    def __init__(self, separation: float, *, exact: bool = False) -> None:
        self._separation = separation
        self._exact = exact
        self._left: float | None = None
        self._right = 0.0
        self.x = self.y = self.heading = 0.0
        self.distance = self.turned = self.advanced = 0.0

    @property
    def started(self) -> bool:
        """Whether it knows where the wheels stood first."""
        return self._left is not None

    def update(self, left: float, right: float) -> None:
        """Integrate up to the distances `left` and `right` [m] that the wheels have rolled since ever.

        The first call only remembers where the wheels stand.
        """
        if self._left is None:
            self._left, self._right = left, right
            return
        s_left, s_right = left - self._left, right - self._right
        self._left, self._right = left, right
        arc = (s_left + s_right) / 2
        turn = (s_right - s_left) / self._separation
        if self._exact:
            dx, dy = along_arc(arc, self.heading, turn)
        else:
            middle = self.heading + turn / 2
            dx, dy = arc * cos(middle), arc * sin(middle)
        self.x += dx
        self.y += dy
        self.heading += turn
        self.distance, self.turned, self.advanced = hypot(dx, dy), turn, arc


class BicycleOdometry:
    """Planar pose from the distance rolled and the angle of the steered wheel, at the middle of the rear axle.

    The law of the new Gazebo's AckermannSteering: the heading turns by distance·tan(angle)/base. Gazebo follows it step
    by step and takes the heading at the end of each; here each update follows the exact arc of its mean steering angle,
    which is the limit for short steps however far apart the updates are.

    Args:
        base: distance between the axles [m].

    Attributes:
        x: [m].
        y: [m].
        heading: [rad], not wrapped.
        distance: length of the last update's displacement [m]; never negative.
        turned: the last update's change of heading [rad].
        advanced: signed length of the last update's arc [m].
    """

    def __init__(self, base: float) -> None:
        self._base = base
        self._rolled: float | None = None
        self._angle = 0.0
        self.x = self.y = self.heading = 0.0
        self.distance = self.turned = self.advanced = 0.0

    @property
    def started(self) -> bool:
        """Whether it knows where the wheels stood first."""
        return self._rolled is not None

    def update(self, rolled: float, angle: float) -> None:
        """Integrate up to the distance `rolled` [m] since ever, the steered wheel now at `angle` [rad].

        The first call only remembers where the wheels stand.
        """
        if self._rolled is None:
            self._rolled, self._angle = rolled, angle
            return
        arc = rolled - self._rolled
        turn = arc * tan((angle + self._angle) / 2) / self._base
        self._rolled, self._angle = rolled, angle
        dx, dy = along_arc(arc, self.heading, turn)
        self.x += dx
        self.y += dy
        self.heading += turn
        self.distance, self.turned, self.advanced = hypot(dx, dy), turn, arc


class MecanumOdometry:
    """Planar pose from the distances that four mecanum wheels have rolled.

    Wheels roll at vx ∓ vy ∓ w·(separation + base)/2 (front left: both minus); four distances make three displacements,
    their mean with the signs of each. Each update follows the arc of a constant twist.

    Args:
        reach: (separation + base) / 2 [m].

    Attributes:
        x: [m].
        y: [m].
        heading: [rad], not wrapped.
        moved: the last update's displacement in its own axes: forward [m], to the left [m], turned [rad].
    """

    def __init__(self, reach: float) -> None:
        self._reach = reach
        self._rolled: tuple[float, float, float, float] | None = None
        self.x = self.y = self.heading = 0.0
        self.moved = (0.0, 0.0, 0.0)

    @property
    def started(self) -> bool:
        """Whether it knows where the wheels stood first."""
        return self._rolled is not None

    def update(self, front_left: float, front_right: float, back_left: float, back_right: float) -> None:
        """Integrate up to the distances [m] that the wheels have rolled since ever.

        The first call only remembers where the wheels stand.
        """
        rolled = (front_left, front_right, back_left, back_right)
        before, self._rolled = self._rolled, rolled
        if before is None:
            return
        a, b, c, d = (now - then for now, then in zip(rolled, before, strict=True))
        forward, left, turn = (a + b + c + d) / 4, (b + c - a - d) / 4, (b + d - a - c) / 4 / self._reach
        along = along_arc(forward, self.heading, turn)
        across = along_arc(left, self.heading + pi / 2, turn)
        self.x += along[0] + across[0]
        self.y += along[1] + across[1]
        self.heading += turn
        self.moved = (forward, left, turn)


def along_arc(arc: float, heading: float, turn: float) -> tuple[float, float]:
    """Return the displacement along an arc of length `arc` [m] that begins at `heading` and turns by `turn` [rad]."""
    chord = arc * sin(turn / 2) / (turn / 2) if abs(turn) > 1e-6 else arc
    return chord * cos(heading + turn / 2), chord * sin(heading + turn / 2)
