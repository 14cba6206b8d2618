"""Mecanum drive: gz sim's MecanumDrive, four wheels with rollers at 45° (friction along ``<fdir1>`` only).

Source: gz-sim main, src/systems/mecanum_drive/MecanumDrive.cc.
"""

from urdfkit.sim.plugins.drives.odometry_parameters import odometry_topics
from urdfkit.sim.plugins.drives.velocity_drive import VelocityDrive, joints_of
from urdfkit.sim.plugins.setup import Setup
from urdfkit.sim.plugins.speed_limits import SpeedLimits, limiter
from urdfkit.sim.plugins.wheel_odometry import MecanumOdometry
from urdfkit.sim.state.joint_commands import Motors
from urdfkit.sim.state.robot_state import State

CORNERS = {
    "front_left_joint": (-1, -1),
    "front_right_joint": (1, 1),
    "back_left_joint": (1, -1),
    "back_right_joint": (-1, 1),
}
"""Wheel → signs of the lateral velocity and of the yaw rate in its speed."""


class MecanumDrive(VelocityDrive):
    """Drives four wheels at vx ± vy ± w·(separation + base)/2. A command is valid until the next one."""

    kind = "mecanum_drive"

    def configure(self, setup: Setup) -> None:
        """Read the parameters, advertise and subscribe.

        Raises:
            SimulationError: a parameter is invalid, with its position.
        """
        read = self.parameters(setup)
        topics = self.topic_names()
        self._setup = setup
        self._joints = {corner: joints_of(setup, read, corner) for corner in CORNERS}
        separation = read.number("wheel_separation")
        self._reach = (separation + read.number("wheel_base")) / 2
        self._radius = read.number("wheel_radius")
        # The longitudinal and the lateral velocity have equal limits, but separate limiters.
        self.limits = SpeedLimits(limiter(read, "linear"), limiter(read, "linear"), limiter(read, "angular"))
        self.read_rate = read.number("odometry_rate")
        self.subscribe(setup, topics.resolve(read.text("command_topic")))
        self.topics = odometry_topics(setup, read, topics, published=True, with_tf=True)
        joints = [joints[0] for joints in self._joints.values()]
        self.odometry = MecanumOdometry(self._reach, joints, self._radius)

    def write(self, state: State, motors: Motors) -> None:
        """Set the wheels' velocity motors."""
        self.start_odometry(state)
        targets = (*self.command.linear[:2], self.command.angular[2])
        vx, vy, w = self.limits.limit(targets, self._setup.dt)
        self.resting = self.limits.settled(targets)
        for corner, (left, turn) in CORNERS.items():
            for joint in self._joints[corner]:
                motors.drive(joint, (vx + left * vy + turn * w * self._reach) / self._radius)
