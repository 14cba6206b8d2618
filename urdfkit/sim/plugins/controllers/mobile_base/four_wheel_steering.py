"""four_wheel_steering_controller of ROS 1: four driven wheels on knuckles; the rear ones steer against the front.

Sources: ros_controllers noetic, four_wheel_steering_controller.cpp, odometry.cpp; urdf_geometry_parser.cpp.
"""

from __future__ import annotations

from math import atan, copysign, cos, dist, hypot, inf, pi, sin, sqrt, tan
from typing import TYPE_CHECKING, ClassVar

from urdfkit.description.urdf.robot import Cylinder, Sphere
from urdfkit.errors import DescriptionError
from urdfkit.sim.plugins.controllers.controller import Law
from urdfkit.sim.plugins.controllers.mobile_base.diff_drive import RATE, TIMEOUT, limits_of_ros_1
from urdfkit.sim.plugins.controllers.mobile_base.odometry import Reckoning
from urdfkit.sim.plugins.controllers.mobile_base.velocity_reference import Reference
from urdfkit.sim.plugins.wheel_odometry import along_arc

if TYPE_CHECKING:
    from urdfkit.sim.plugins.controllers.command_output import Output
    from urdfkit.sim.state.joint_commands import Motors
    from urdfkit.sim.state.robot_state import State

STANDING = 0.001
"""Speeds up to this [m/s] turn no wheels."""


class FourWheelSteeringController(Law):
    """Wheels and steering, each the left one first, for the speed and the yaw rate on ``cmd_vel``.

    The circle's middle lies abreast of the robot's, so both axles steer by the same angles, the rear one to the other
    side. Track, wheel base, wheel radius and how far the wheels are from what they steer about are those of the URDF
    where no parameter says otherwise; the last one has none.
    """

    types: ClassVar[dict[str, str]] = {"four_wheel_steering_controller/FourWheelSteeringController": ""}

    def configure(self) -> None:
        """Read the parameters, advertise and subscribe.

        Raises:
            DescriptionError: a joint or a measure is missing, or a parameter makes no sense.
        """
        read = self.settings
        if self.hardware.ros != 1:
            raise DescriptionError(f"`{self.type}` is one of ROS 1", position=read.group("type").position)
        self._wheels = (*self._pair("front_wheel", "velocity"), *self._pair("rear_wheel", "velocity"))
        self._steering = (*self._pair("front_steering", "position"), *self._pair("rear_steering", "position"))
        self.outputs = (*self._wheels, *self._steering)
        left, right, behind = (self._place(self._wheels[i]) for i in range(3))
        self._offset = dist(self._place(self._steering[0]), left)
        self._track = self._measure("track", dist(left, right)) - 2 * self._offset
        self._base = self._measure("wheel_base", dist(left, behind))
        self._radius = self._measure("wheel_radius", self._collision_radius())
        self._limiters = (limits_of_ros_1(read.group("linear/x")), limits_of_ros_1(read.group("angular/z")))
        self._reference = Reference(self, read.number("cmd_vel_timeout", TIMEOUT))
        self._rate = read.number("publish_rate", RATE)
        self.reckoning = Reckoning(self, self._reckon, self._rate)

    def _pair(self, name: str, interface: str) -> tuple[Output, Output]:
        found = self.settings.texts(name)
        if len(found) != 2:
            if not found:
                self.settings.text(name)
            place = self.settings.group(name).place
            raise DescriptionError(
                f"`{name}` names {len(found)} joints; there are two, the left one first", position=place
            )
        left, right = (self.hardware.output(entry, interface) for entry in found)
        return left, right

    def _place(self, output: Output) -> tuple[float, ...]:
        """Return where a joint is below the root: the sum of the origins, as urdf_geometry_parser has it."""
        robot = self.hardware.setup.kinematics.robot
        by_child = {joint.child: joint for joint in robot.joints}
        joint = robot.joint_by_name.get(output.handle.name)
        x = y = z = 0.0
        while joint is not None:
            x, y, z = (here + more for here, more in zip((x, y, z), joint.origin.xyz, strict=True))
            joint = by_child.get(joint.parent)
        return x, y, z

    def _collision_radius(self) -> float:
        robot = self.hardware.setup.kinematics.robot
        link = robot.link_by_name[robot.joint_by_name[self._wheels[0].handle.name].child or ""]
        for collision in link.collisions:
            if isinstance(collision.geometry, Cylinder | Sphere):
                return collision.geometry.radius
        return 0.0

    def _measure(self, name: str, measured: float) -> float:
        found = self.settings.number(name, measured)
        if found <= 0.0:
            raise DescriptionError(
                f"`{name}` is {found:g} m; it must be greater than zero", position=self.settings.group(name).place
            )
        return found

    # At work

    def start(self, state: State) -> None:
        """Stand, steer straight on, and believe to be at the origin."""
        super().start(state)
        self._reference.clear()
        for limiter in self._limiters:
            limiter.reset()
        self._x = self._y = self._heading = 0.0
        self._rolled, self._angles = self._turns(state), self._axles(state)

    def update(self, state: State, motors: Motors) -> float:
        """Turn and steer the wheels, and keep the odometry."""
        self._integrate(state)
        v, _, w = self._reference.at(state.t) or (0.0, 0.0, 0.0)
        pairs = tuple(zip(self._limiters, (v, w), strict=True))
        v, w = (limiter.limit(wish, self.hardware.period) for limiter, wish in pairs)
        rest = inf
        for i, side in enumerate((-1.0, 1.0, -1.0, 1.0)):
            along = v + side * w * self._track / 2
            rate = angle = 0.0
            if abs(v) > STANDING:
                rate = copysign(hypot(along, self._base * w / 2), v) + side * w * self._offset
                # The circle's middle between the wheels is too near to steer about.
                outside = 2.0 * abs(v) > abs(w * self._track)
                angle = atan(w * self._base / 2 / along) if outside else copysign(pi / 2, w)
            rest = min(rest, self._wheels[i].write(state, motors, rate / self._radius))
            rest = min(rest, self._steering[i].write(state, motors, angle if i < 2 else -angle))
        if rest <= 0.0 or not all(limiter.settled(wish) for limiter, wish in pairs):
            return 0.0
        return min(1.0 / self._rate, self._reference.left(state.t))

    # Odometry

    def _turns(self, state: State) -> list[float]:
        return [state.position(output.handle.name) * self._radius for output in self._wheels]

    def _axles(self, state: State) -> tuple[float, float]:
        """Return the angles of the two wheels that would steer as both axles do [rad]."""
        tangents = [tan(state.position(output.handle.name)) for output in self._steering]

        def mean(left: float, right: float) -> float:
            return atan(2 * left * right / (left + right)) if left + right and left * right else 0.0

        return mean(*tangents[:2]), mean(*tangents[2:])

    def _advance(self, ways: list[float], angles: tuple[float, float]) -> tuple[float, float, float]:
        """Return how far the middle comes forward, to the left and round when wheels roll so far, or so fast."""
        bend = (tan(angles[0]) - tan(angles[1])) / self._base
        ahead = left = turn = 0.0
        for angle, (one, other) in zip(angles, (ways[:2], ways[2:]), strict=True):
            own = bend * cos(angle)
            tight = (self._track * own / 2) ** 2
            slopes = [own / sqrt(1 + side * self._track * own * cos(angle) + tight) for side in (-1.0, 1.0)]
            plain = one / (1 - self._offset * slopes[0]), other / (1 + self._offset * slopes[1])
            way = copysign(sqrt((plain[0] ** 2 + plain[1] ** 2) / (2 + 2 * tight)), plain[0] + plain[1])
            ahead, left, turn = ahead + way * cos(angle) / 2, left + way * sin(angle) / 2, turn + way * own / 2
        return ahead, left, turn

    def _integrate(self, state: State) -> None:
        rolled, angles = self._turns(state), self._axles(state)
        ways = [now - before for now, before in zip(rolled, self._rolled, strict=True)]
        ahead, left, turn = self._advance(ways, ((angles[0] + self._angles[0]) / 2, (angles[1] + self._angles[1]) / 2))
        self._rolled, self._angles = rolled, angles
        dx, dy = along_arc(ahead, self._heading, turn)
        sx, sy = along_arc(left, self._heading + pi / 2, turn)
        self._x, self._y, self._heading = self._x + dx + sx, self._y + dy + sy, self._heading + turn

    def _reckon(self, state: State) -> tuple[tuple[float, float, float], tuple[float, float, float]]:
        self._integrate(state)
        speeds = [state.velocity(output.handle.name) * self._radius for output in self._wheels]
        return (self._x, self._y, self._heading), self._advance(speeds, self._angles)
