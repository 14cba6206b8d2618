"""four_wheel_steering_controller of ROS 1: four driven and steered wheels; the rear axle steers opposite to the front.

Sources: ros_controllers noetic, four_wheel_steering_controller.cpp, odometry.cpp; urdf_geometry_parser.cpp.
"""

from math import atan, copysign, dist, hypot, inf, pi, tan
from typing import ClassVar

from urdfkit.errors import DescriptionError
from urdfkit.sim.plugins.controllers.command_output import Output
from urdfkit.sim.plugins.controllers.mobile_base.velocity_reference import usual_reference
from urdfkit.sim.plugins.controllers.mobile_base.wheeled_base import RATE, TIMEOUT, WheeledBase, limits_of_ros_1
from urdfkit.sim.plugins.speed_limits import SpeedLimits
from urdfkit.sim.plugins.wheel_odometry import FourWheelOdometry, Twist, WheelOdometry
from urdfkit.sim.state.joint_commands import Motors
from urdfkit.sim.state.robot_state import State

STANDING = 0.001
"""Speed up to which the wheels stay at rest [m/s]."""


class FourWheelSteeringController(WheeledBase):
    """Drives and steers four wheels, the left one of each axle first, by speed and yaw rate on ``cmd_vel``.

    The rear axle has the negative steering angles of the front axle. Track, wheel base and wheel radius default to the
    values of the URDF; the distance from a wheel to its steering joint is always that of the URDF.
    """

    types: ClassVar[dict[str, str]] = {"four_wheel_steering_controller/FourWheelSteeringController": ""}

    def configure(self) -> None:
        """Read the parameters, advertise and subscribe.

        Raises:
            DescriptionError: a joint or a length is missing, or a parameter is invalid.
        """
        read = self.settings
        if self.hardware.ros != 1:
            raise DescriptionError(f"`{self.type}` is a ROS 1 controller", position=read.group("type").position)
        self._wheels = (*self._pair("front_wheel", "velocity"), *self._pair("rear_wheel", "velocity"))
        self._steering = (*self._pair("front_steering", "position"), *self._pair("rear_steering", "position"))
        self.outputs = (*self._wheels, *self._steering)
        left, right, behind = (self._place(self._wheels[i]) for i in range(3))
        self._offset = dist(self._place(self._steering[0]), left)
        self._track = self._length("track", dist(left, right)) - 2 * self._offset
        self._base = self._length("wheel_base", dist(left, behind))
        self._radius = self._length("wheel_radius", self.radius(self._wheels[0]))
        self.limits = SpeedLimits(*(limits_of_ros_1(read.group(name)) for name in ("linear/x", "angular/z")))
        self.reference = usual_reference(self, read.number("cmd_vel_timeout", TIMEOUT))
        self.rate = read.number("publish_rate", RATE)
        self.odometry: FourWheelOdometry = FourWheelOdometry(self._base, self._track, self._offset)
        self.publish_odometry()

    def _pair(self, name: str, interface: str) -> tuple[Output, Output]:
        found = self.settings.texts(name, required=True)
        if len(found) != 2:
            place = self.settings.group(name).place
            raise DescriptionError(
                f"`{name}` names {len(found)} joints; it must name two, the left one first", position=place
            )
        left, right = (self.hardware.output(entry, interface) for entry in found)
        return left, right

    def _place(self, output: Output) -> tuple[float, ...]:
        """Return the position of a joint as the sum of the origins from the root on, as in urdf_geometry_parser [m]."""
        robot = self.hardware.setup.kinematics.robot
        by_child = {joint.child: joint for joint in robot.joints}
        joint = robot.joint_by_name.get(output.handle.name)
        x = y = z = 0.0
        while joint is not None:
            x, y, z = (here + more for here, more in zip((x, y, z), joint.origin.xyz, strict=True))
            joint = by_child.get(joint.parent)
        return x, y, z

    def _length(self, name: str, measured: float) -> float:
        found = self.settings.number(name, measured)
        if found <= 0.0:
            raise DescriptionError(
                f"`{name}` is {found:g} m; it must be greater than zero", position=self.settings.group(name).place
            )
        return found

    def update(self, state: State, motors: Motors) -> float:
        """Write the wheel and steering commands, and update the odometry."""
        self.measure(state, self.odometry)
        targets = (self.reference.at(state.t) or (0.0, 0.0, 0.0))[::2]
        v, w = self.limits.limit(targets, self.hardware.period)
        rest = inf
        for i, side in enumerate((-1.0, 1.0, -1.0, 1.0)):
            along = v + side * w * self._track / 2
            rate = angle = 0.0
            if abs(v) > STANDING:
                rate = copysign(hypot(along, self._base * w / 2), v) + side * w * self._offset
                # With the centre of rotation between the wheels, the steering angle is ±90°.
                outside = 2.0 * abs(v) > abs(w * self._track)
                angle = atan(w * self._base / 2 / along) if outside else copysign(pi / 2, w)
            rest = min(rest, self._wheels[i].write(state, motors, rate / self._radius))
            rest = min(rest, self._steering[i].write(state, motors, angle if i < 2 else -angle))
        return self.rest(state.t, settled=rest > 0.0 and self.limits.settled(targets))

    # Odometry

    def _axles(self, state: State) -> tuple[float, float]:
        """Return the equivalent steering angles of a single wheel at the centre of each axle [rad]."""
        tangents = [tan(state.position(output.handle.name)) for output in self._steering]

        def mean(left: float, right: float) -> float:
            return atan(2 * left * right / (left + right)) if left + right and left * right else 0.0

        return mean(*tangents[:2]), mean(*tangents[2:])

    def measure(self, state: State, odometry: WheelOdometry) -> Twist:
        """Update the odometry to the present state, and return the measured velocity."""
        angles = self._axles(state)
        odometry.update(state.t, *(state.position(each.handle.name) * self._radius for each in self._wheels), *angles)
        speeds = [state.velocity(output.handle.name) * self._radius for output in self._wheels]
        return self.odometry.displacement(speeds, *angles)
