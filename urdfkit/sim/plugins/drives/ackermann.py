"""Ackermann drive: gazebo_ros_ackermann_drive (ROS 2). The command's angular.z is the steering angle, not a rate.

Sources: gazebo_ros_pkgs ros2, gazebo_plugins/src/gazebo_ros_ackermann_drive.cpp; gazebo-classic, Joint.cc,
CheckAndTruncateForce. Gazebo applies an effort for one step after each update; urdfkit distributes the same impulse
over the steps until the next update.
"""

from math import copysign, dist, hypot, inf, tan
from typing import Any

from urdfkit.bus import Topic
from urdfkit.description.urdf.robot import Joint
from urdfkit.errors import SimulationError
from urdfkit.messages import message_type
from urdfkit.sim.plugins.controllers.joint_limits import JointLimits
from urdfkit.sim.plugins.drives.odometry_parameters import odometry_topics
from urdfkit.sim.plugins.drives.velocity_drive import VelocityDrive, put
from urdfkit.sim.plugins.drives.wheel_messages import Wheels
from urdfkit.sim.plugins.parameters import Parameters
from urdfkit.sim.plugins.setup import Setup
from urdfkit.sim.plugins.wheel_geometry import steering_angles, wheel_centre, wheel_radius
from urdfkit.sim.state.joint_commands import Motors, effort_limit
from urdfkit.sim.state.periodic_steps import PeriodicSteps
from urdfkit.sim.state.pid import Gains, GazeboPid
from urdfkit.sim.state.robot_state import State

JOINTS = (
    "front_right_joint",
    "front_left_joint",
    "rear_right_joint",
    "rear_left_joint",
    "right_steering_joint",
    "left_steering_joint",
)
"""Parameters of the required joints, in the order of publication."""

STEERING_WHEEL = "steering_wheel_joint"
"""Parameter of the steering wheel in the cabin, which turns with the steering; optional."""


class Ackermann(VelocityDrive):
    """PIDs for two steered front wheels and two driven rear wheels; the command is linear.x [m/s] and the angle [rad].

    Track, wheel base and wheel radius come from the collision shapes. In reverse, the steering angle changes sign.
    """

    kind = "ackermann"

    def configure(self, setup: Setup) -> None:
        """Read the parameters, advertise and subscribe.

        Raises:
            SimulationError: a parameter is invalid, with its position.
        """
        read = self.parameters(setup)
        topics = self.topic_names()
        self._setup = setup
        self._read_geometry(setup, read)
        self._read_gains(setup, read)
        self.write_rate = self.read_rate = read.number("update_rate")
        self._ticks = PeriodicSteps(self.write_rate, setup.dt)
        self.subscribe(setup, topics.resolve("cmd_vel"))
        self.wake()
        self.topics = odometry_topics(
            setup,
            read,
            topics,
            published=read.flag("publish_odometry"),
            with_tf=read.flag("publish_odometry_tf"),
            twist_covariance=True,
        )
        steering_wheel = (self._steering_wheel,) if self._steering_wheel else ()
        self.wheels = Wheels(
            setup,
            (*self._joints.values(), *steering_wheel),
            with_tf=read.flag("publish_wheel_tf"),
            base=read.text("base_frame"),
        )
        self._distance_topic = self._angle_topic = None
        if read.flag("publish_distance"):
            self._distance_topic = setup.bus.advertise(topics.resolve("distance"), "std_msgs/msg/Float32")
        if read.flag("publish_steer_angle"):
            self._angle_topic = setup.bus.advertise(topics.resolve("steerangle"), "std_msgs/msg/Float32")
        self._distance = 0.0
        self._last: tuple[float, ...] | None = None

    def _read_geometry(self, setup: Setup, read: Parameters) -> None:
        """Find the joints; compute track, wheel base and wheel radius."""
        self._joints = {meaning: setup.joint(read.text(meaning), read.place(meaning)) for meaning in JOINTS}
        self._steering_wheel = ""
        if read.has(STEERING_WHEEL):
            self._steering_wheel = setup.joint(read.text(STEERING_WHEEL), read.place(STEERING_WHEEL))
        elif STEERING_WHEEL in setup.kinematics.joint_names:
            self._steering_wheel = STEERING_WHEEL
        centres = {meaning: wheel_centre(setup.kinematics, joint) for meaning, joint in self._joints.items()}
        front_left, front_right = centres["front_left_joint"], centres["front_right_joint"]
        rear_left, rear_right = centres["rear_left_joint"], centres["rear_right_joint"]
        self._track = dist(front_left, front_right)
        front = [(left + right) / 2 for left, right in zip(front_left, front_right, strict=True)]
        rear = [(left + right) / 2 for left, right in zip(rear_left, rear_right, strict=True)]
        self._base = dist(front, rear)
        if self._track <= 0 or self._base <= 0:
            message = f"the wheels are {self._track:g} m apart and the axles {self._base:g} m; both must be positive"
            raise SimulationError(message, position=read.place("front_left_joint"))
        self._radius = wheel_radius(
            setup.kinematics.robot, self._joints["rear_right_joint"], read.place("rear_right_joint")
        )
        self._fastest = read.number("max_speed")
        self._steepest = read.number("max_steer")
        self._ratio = self._steepest / read.number("max_steering_angle")
        written = setup.kinematics.robot.joint_by_name
        self._limits = {meaning: _limits(written[joint]) for meaning, joint in self._joints.items()}

    def _read_gains(self, setup: Setup, read: Parameters) -> None:
        def pid(meaning: str) -> GazeboPid:
            p, i, d = read.vector(f"{meaning}_gains", 3)
            i_min, i_max = read.vector(f"{meaning}_range", 2)
            made = GazeboPid(Gains(p, i, d, i_min, i_max))
            if made.idle:
                tag = read.tag(f"{meaning}_gains")
                what = "drive" if meaning == "speed" else f"steer with its {meaning.partition('_')[0]} wheel"
                setup.note(f"{read.place(f'{meaning}_gains')}: <{tag}> is 0 0 0, so the robot does not {what}")
            return made

        self._pids = {meaning: pid(meaning) for meaning in ("speed", "right_steering", "left_steering")}

    def write(self, state: State, motors: Motors) -> None:
        """Apply efforts to the steering joints and the rear wheels."""
        joints, pids, period = self._joints, self._pids, self._ticks.period
        drive = pids["speed"].update(state.velocity(joints["rear_right_joint"]) - self._turning, period)
        self._exert("rear_right_joint", drive, state, motors)
        self._exert("rear_left_joint", drive, state, motors)
        off = state.position(joints["right_steering_joint"]) - self._right
        self._exert("right_steering_joint", pids["right_steering"].update(off, period), state, motors)
        off = state.position(joints["left_steering_joint"]) - self._left
        self._exert("left_steering_joint", pids["left_steering"].update(off, period), state, motors)
        if self._steering_wheel:
            angle = self._mean_angle(state) / self._ratio
            put(self._steering_wheel, angle, period, setup=self._setup, state=state, motors=motors)

    def _exert(self, meaning: str, effort: float, state: State, motors: Motors) -> None:
        joint = self._joints[meaning]
        granted = self._limits[meaning].exerting(effort, state.position(joint), state.velocity(joint))
        motors.exert(joint, granted / self._ticks.steps)

    def wake(self) -> None:
        """Compute the targets of a command: wheel speed [rad/s] and steering angles [rad]."""
        speed, angle = self.command.linear[0], self.command.angular[2]
        self._turning = max(-self._fastest, min(self._fastest, speed)) / self._radius
        self._right, self._left = self.angles(copysign(1.0, speed) * angle)

    def angles(self, angle: float) -> tuple[float, float]:
        """Return the steering angles of the right and the left wheel for the angle of the bicycle model [rad]."""
        slope = tan(max(-self._steepest, min(self._steepest, angle)))
        left, right = steering_angles(slope, self._track / 2 / self._base)
        return right, left

    def read(self, state: State) -> None:
        """Publish odometry (the true pose in the world), wheel transforms, distance travelled and steering angle."""
        super().read(state)
        pose = state.base_pose
        if self._distance_topic is not None:
            here = pose[:2]
            if self._last is not None:
                self._distance += hypot(here[0] - self._last[0], here[1] - self._last[1])
            self._last, distance = here, self._distance
            self._distance_topic.offer(lambda: self._number(distance))
        if self._angle_topic is not None:
            angle = self._mean_angle(state)
            self._angle_topic.offer(lambda: self._number(angle))

    @property
    def published(self) -> tuple[Topic, ...] | None:
        """Topics of odometry and wheels; None if `read` adds up the distance travelled."""
        return super().published if self._distance_topic is self._angle_topic is None else None

    def _mean_angle(self, state: State) -> float:
        return sum(state.position(self._joints[f"{side}_steering_joint"]) for side in ("left", "right")) / 2

    def _number(self, value: float) -> Any:
        return message_type("std_msgs/msg/Float32")(value)

    def reset(self) -> None:
        """Clear the command, the PIDs and the distance."""
        super().reset()
        self.wake()
        for pid in self._pids.values():
            pid.reset()
        self._distance = 0.0
        self._last = None


def _limits(joint: Joint) -> JointLimits:
    """Return the limits of an effort in Gazebo Classic, which are those of `<limit>`."""
    return JointLimits(velocity=(joint.limit.velocity if joint.limit else None) or inf, effort=effort_limit(joint))
