"""Differential drive: gazebo_ros_diff_drive (ROS 1, ROS 2) and gz sim's DiffDrive system; skid steer of ROS 1.

ROS 2 and gz sim use the differential drive with more pairs of wheels instead of skid steer.

Sources: gazebo_ros_pkgs noetic-devel and ros2, gazebo_plugins/src/gazebo_ros_diff_drive.cpp and
gazebo_ros_skid_steer_drive.cpp; gz-sim main, src/systems/diff_drive/DiffDrive.cc. Until Lunar, ROS 1 swapped left and
right (``legacyMode``); urdfkit emulates this for these distributions only.
"""

from typing import Any

from urdfkit.description.plugins import PluginSpec
from urdfkit.description.plugins.parameter_values import unpaired_wheels
from urdfkit.description.urdf.robot import Plugin
from urdfkit.errors import SimulationError
from urdfkit.messages import BOOL
from urdfkit.sim.plugins.drives.odometry_parameters import by_encoder, odometry_topics
from urdfkit.sim.plugins.drives.velocity_drive import VelocityDrive
from urdfkit.sim.plugins.drives.wheel_messages import Wheels
from urdfkit.sim.plugins.odometry import Estimate, planar
from urdfkit.sim.plugins.parameters import Parameters
from urdfkit.sim.plugins.setup import Setup
from urdfkit.sim.plugins.speed_limits import SpeedLimits, limiter
from urdfkit.sim.plugins.topic_names import Topics
from urdfkit.sim.plugins.wheel_geometry import turns_right
from urdfkit.sim.plugins.wheel_odometry import DifferentialOdometry, WheelOdometry
from urdfkit.sim.state.joint_commands import Motors
from urdfkit.sim.state.robot_state import State

CLOSE = 0.01
"""Difference to the target below which a wheel speed is set without the acceleration limit [m/s]."""


class DiffDrive(VelocityDrive):
    """Drives one or more pairs of wheels at v ± w·separation/2.

    A command is valid until the next one. The direction of a joint axis is not corrected.
    """

    kind = "diff_drive"

    def __init__(self, plugin: Plugin, spec: PluginSpec) -> None:
        super().__init__(plugin, spec)
        self._gz = spec.generation == "gz"
        self._enabled = True

    def configure(self, setup: Setup) -> None:
        """Read the parameters, advertise and subscribe.

        Raises:
            SimulationError: a parameter is invalid, with its position.
        """
        read = self.parameters(setup)
        topics = self._topic_names(setup)
        self._setup = setup
        self._read_wheels(setup, read)
        # gz sim has no torque parameter: the joints' <limit effort> applies.
        self._torque = None if self._gz else read.number("max_wheel_torque")
        self._acceleration = read.number("max_wheel_acceleration")
        self._instructed = [0.0] * (2 * len(self._pairs))
        if self._gz:
            self.read_rate = read.number("odometry_rate")
            self.limits = SpeedLimits(limiter(read, "linear"), limiter(read, "angular"))
        else:
            self.write_rate = self.read_rate = read.number("update_rate")
        self._period = max(setup.dt, 1 / self.write_rate if self.write_rate > 0 else 0.0)
        self.subscribe(setup, topics.resolve(read.text("command_topic", "cmd_vel")))
        if self._gz:
            setup.bus.subscribe(f"/model/{setup.model}/enable", BOOL, self._enable)
        self._advertise(setup, read, topics)

    def _topic_names(self, setup: Setup) -> Topics:
        return self.topic_names(setup.model)

    def _read_wheels(self, setup: Setup, read: Parameters) -> None:
        """Read the joints, the separation and the radius of each pair."""
        left, right = read.texts("left_joint"), read.texts("right_joint")
        pairs = int(read.number("wheel_pairs", len(left)))
        if (fault := unpaired_wheels(self.plugin, self.spec)) is not None:
            raise SimulationError(fault[1], position=fault[0].origin.position, code="Z831")
        names = {meaning: [setup.joint(n, read.place(meaning, i)) for i, n in enumerate(texts)]
                 for meaning, texts in (("left_joint", left), ("right_joint", right))}  # fmt: skip
        self._pairs = tuple(zip(names["left_joint"], names["right_joint"], strict=True))
        self._swapped = self._legacy(setup, read)
        separations = read.numbers("wheel_separation")
        if self._gz:
            radii: tuple[float, ...] = read.numbers("wheel_radius")
        else:
            radii = tuple(diameter / 2 for diameter in read.numbers("wheel_diameter"))
        # Defaults of missing values: the first value in gz sim, the parameter's default in ROS 2.
        rest = (separations[0], radii[0]) if self._gz else (0.34, 0.075)
        self._separations = (separations + (rest[0],) * pairs)[:pairs]
        self._radii = (radii + (rest[1],) * pairs)[:pairs]

    def _legacy(self, setup: Setup, read: Parameters) -> bool:
        """Return whether left and right are swapped: always before Kinetic, by default in Kinetic and Lunar."""
        if self.spec.generation != "ros1" or not setup.distro.before("melodic"):
            if self.spec.generation == "ros1" and not setup.distro.name:
                self._note_legacy(setup, read)
            return False
        text = read.text("legacy_mode").lower()
        return setup.distro.before("kinetic") or text not in ("false", "0")

    def _note_legacy(self, setup: Setup, read: Parameters) -> None:
        """Report a warning for a model that seems to rely on swapped sides."""
        place, remedy = read.place("legacy_mode"), "--ros-distro kinetic swaps them"
        if read.text("legacy_mode").lower() in ("true", "1"):
            setup.note(
                f"{place}: legacyMode, which swaps left and right up to ROS Lunar, is ignored: the sides are not "
                f"swapped; {remedy}"
            )
        elif not read.has("legacy_mode") and turns_right(setup.kinematics, *self._pairs[0]):
            setup.note(
                f"{place}: left joint `{self._pairs[0][0]}` turns the robot like a right wheel, as in models for "
                f"releases before Melodic, which swap left and right; {remedy}"
            )

    def _advertise(self, setup: Setup, read: Parameters, topics: Topics) -> None:
        if by_encoder(read):
            # The first pair has the encoders.
            pair = self._pairs[0][::-1] if self._swapped else self._pairs[0]
            self.odometry = DifferentialOdometry(self._separations[0], pair, self._radii[0], exact=self._gz)
        published = self._gz or read.flag("publish_odometry")
        # <publishOdomTF> exists since Kinetic. Before, the transform was always published with the message.
        with_tf = self._gz or read.flag("publish_odometry_tf")
        if self.spec.generation == "ros1":
            with_tf = published and (with_tf or setup.distro.before("kinetic"))
        self.topics = odometry_topics(
            setup, read, topics, published=published, with_tf=with_tf, twist_covariance=self.spec.generation == "ros2"
        )
        wheel_states = self.spec.generation == "ros1" and read.flag("publish_wheel_joint_state")
        self.wheels = Wheels(
            setup,
            [joint for pair in self._pairs for joint in pair],
            with_tf=not self._gz and read.flag("publish_wheel_tf"),
            states=topics.resolve("joint_states") if wheel_states else None,
        )

    # Commands

    def _enable(self, message: Any) -> None:
        self._enabled = bool(message.data)
        if not self._enabled:
            self.command.clear()
        self.resting = False

    # Before the step

    def write(self, state: State, motors: Motors) -> None:
        """Set the wheels' velocity motors."""
        self.start_odometry(state)
        v, w = self.command.linear[0], self.command.angular[2]
        if self._gz:
            targets = (v, w) if self._enabled else (0.0, 0.0)
            v, w = self.limits.limit(targets, self._period)
            self.resting = self.limits.settled(targets)
        else:
            self.resting = self._acceleration == 0.0
        for i, (pair, separation, radius) in enumerate(zip(self._pairs, self._separations, self._radii, strict=True)):
            speeds = [v - w * separation / 2, v + w * separation / 2]
            if self._swapped:
                speeds.reverse()
            if self._acceleration != 0.0:
                self._accelerate(i, pair, radius, speeds, state)
            for joint, speed in zip(pair, speeds, strict=True):
                motors.drive(joint, speed / radius, self._torque)

    def _accelerate(self, i: int, pair: tuple[str, str], radius: float, speeds: list[float], state: State) -> None:
        """Limit the acceleration of wheel speeds [m/s], as gazebo_ros_diff_drive does.

        ROS 1 sets the targets directly once one wheel is close to its target, ROS 2 once both are.
        """
        now = [state.velocity(joint) * radius for joint in pair]
        near = [abs(speed - current) < CLOSE for speed, current in zip(speeds, now, strict=True)]
        if any(near) if self.spec.generation == "ros1" else all(near):
            return
        most = self._acceleration * self._period
        for side in (0, 1):
            self._instructed[2 * i + side] += max(-most, min(most, speeds[side] - now[side]))
            speeds[side] = self._instructed[2 * i + side]

    # After the step

    def measure(self, state: State, odometry: WheelOdometry | None) -> Estimate:
        """Return the estimate of the present state; gazebo_ros_diff_drive reports the absolute value of the speed."""
        now = super().measure(state, odometry)
        if odometry is None or self._gz or not odometry.period:
            return now
        _, _, turning = odometry.velocity
        return planar(odometry.x, odometry.y, odometry.heading, (odometry.distance / odometry.period, 0.0, turning))

    def reset(self) -> None:
        """Clear commands and odometry."""
        super().reset()
        self._enabled = True
        self._instructed = [0.0] * len(self._instructed)


class SkidSteer(DiffDrive):
    """Drives two wheels on each side at v ± w·separation/2; the motion of the robot results from wheel friction.

    The odometry is the true pose in the world with a height of zero. Left and right are never swapped.
    """

    kind = "skid_steer"

    def _topic_names(self, setup: Setup) -> Topics:
        # Unlike the differential drive, its default namespace is empty.
        return self.topic_names()

    def _read_wheels(self, setup: Setup, read: Parameters) -> None:
        def joint(meaning: str) -> str:
            return setup.joint(read.text(meaning), read.place(meaning))

        self._pairs = tuple((joint(f"left_{end}_joint"), joint(f"right_{end}_joint")) for end in ("front", "rear"))
        self._separations = (read.number("wheel_separation"),) * 2
        self._radii = (read.number("wheel_diameter") / 2,) * 2
        self._swapped = False

    def _advertise(self, setup: Setup, read: Parameters, topics: Topics) -> None:
        self.topics = odometry_topics(
            setup,
            read,
            topics,
            published=True,
            with_tf=read.flag("publish_odometry_tf"),
            twist_covariance=True,
            flat=True,
        )
