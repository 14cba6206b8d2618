"""mecanum_drive_controller of ROS 2: four wheels with rollers.

Source: ros2_controllers, mecanum_drive_controller.cpp and odometry.cpp.
"""

from __future__ import annotations

from math import cos, inf, sin
from typing import TYPE_CHECKING, ClassVar

from urdfkit.errors import DescriptionError
from urdfkit.sim.plugins.controllers.controller import Law
from urdfkit.sim.plugins.controllers.mobile_base.diff_drive import limits_of_ros_2
from urdfkit.sim.plugins.controllers.mobile_base.odometry import Reckoning
from urdfkit.sim.plugins.controllers.mobile_base.velocity_reference import Reference
from urdfkit.sim.plugins.wheel_odometry import MecanumOdometry

if TYPE_CHECKING:
    from urdfkit.sim.state.joint_commands import Motors
    from urdfkit.sim.state.robot_state import State

CORNERS = {"front_left": (-1, -1), "front_right": (1, 1), "rear_left": (1, -1), "rear_right": (-1, 1)}
"""With which sign a wheel's rate has the velocity to the left, and the yaw rate; in the order of `MecanumOdometry`."""

COVARIANCE = (0.0, 7.0, 14.0, 21.0, 28.0, 35.0)
"""Default of both covariances."""


class MecanumController(Law):
    """Wheels at vx ± vy ± w·(lx + ly), seen from the wheels' centre, which may lie off the base's frame."""

    types: ClassVar[dict[str, str]] = {"mecanum_drive_controller/MecanumDriveController": ""}

    def configure(self) -> None:
        """Read the parameters, advertise and subscribe.

        Raises:
            DescriptionError: a wheel or a measure is missing, or a parameter makes no sense.
        """
        read = self.settings
        wheels = []
        for corner in CORNERS:
            name = f"{corner}_wheel_command_joint_name"
            read.text(name)
            (entry,) = read.texts(name)[:1]
            wheels.append(self.hardware.output(entry, "velocity"))
        self.outputs = tuple(wheels)
        shape = read.group("kinematics")
        self._radius, self._reach = (
            self._positive(name) for name in ("wheels_radius", "sum_of_robot_center_projection_on_X_Y_axis")
        )
        offset = shape.group("base_frame_offset")
        self._offset = (offset.number("x", 0.0), offset.number("y", 0.0), offset.number("theta", 0.0))
        self._limiters = tuple(limits_of_ros_2(read.group(name)) for name in ("linear/x", "linear/y", "angular/z"))
        self._reference = Reference(self, read.number("reference_timeout", 0.0))
        self._rate = 1.0 / self.hardware.period
        self.reckoning = Reckoning(
            self, self._reckon, self._rate, topic="odometry", transforms="tf_odometry", prefixed=True,
            covariance=COVARIANCE,
        )  # fmt: skip

    def _positive(self, name: str) -> float:
        found = self.settings.number(f"kinematics/{name}")
        if found <= 0.0:
            place = self.settings.group(f"kinematics/{name}").position
            raise DescriptionError(f"`{name}` is {found:g} m; it must be greater than zero", position=place)
        return found

    def start(self, state: State) -> None:
        """Stand, and believe to be at the origin."""
        super().start(state)
        self._reference.clear()
        for limiter in self._limiters:
            limiter.reset()
        self._odometry = MecanumOdometry(self._reach)
        self._integrate(state)

    def update(self, state: State, motors: Motors) -> float:
        """Turn the wheels and keep the odometry."""
        self._integrate(state)
        wanted = self._reference.at(state.t) or (0.0, 0.0, 0.0)
        pairs = tuple(zip(self._limiters, wanted, strict=True))
        vx, vy, w = (limiter.limit(wish, self.hardware.period) for limiter, wish in pairs)
        x, y, theta = self._offset
        ahead = vx * cos(theta) - vy * sin(theta) + y * w
        left = vx * sin(theta) + vy * cos(theta) - x * w
        rest = inf
        for output, (across, turn) in zip(self.outputs, CORNERS.values(), strict=True):
            rate = (ahead + across * left + turn * self._reach * w) / self._radius
            rest = min(rest, output.write(state, motors, rate))
        if rest <= 0.0 or not all(limiter.settled(wish) for limiter, wish in pairs):
            return 0.0
        return min(10 * self.hardware.period, self._reference.left(state.t))

    def _integrate(self, state: State) -> None:
        rolled = [state.position(output.handle.name) * self._radius for output in self.outputs]
        self._odometry.update(rolled[0], rolled[1], rolled[2], rolled[3])

    def _reckon(self, state: State) -> tuple[tuple[float, float, float], tuple[float, float, float]]:
        """Return where the base is and how it moves, from what the wheels' centre does."""
        self._integrate(state)
        x, y, theta = self._offset
        centre = self._odometry
        c, s = cos(centre.heading), sin(centre.heading)
        # The base's place as the centre first saw the world, then as the base did.
        dx, dy = centre.x + c * x - s * y - x, centre.y + s * x + c * y - y
        here = (cos(theta) * dx + sin(theta) * dy, cos(theta) * dy - sin(theta) * dx, centre.heading)
        rates = [state.velocity(output.handle.name) * self._radius for output in self.outputs]
        signs = list(CORNERS.values())
        ahead = sum(rates) / 4
        left = sum(rate * across for rate, (across, _) in zip(rates, signs, strict=True)) / 4
        w = sum(rate * turn for rate, (_, turn) in zip(rates, signs, strict=True)) / 4 / self._reach
        ahead, left = ahead - y * w, left + x * w
        return here, (cos(theta) * ahead + sin(theta) * left, cos(theta) * left - sin(theta) * ahead, w)
