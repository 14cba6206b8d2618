"""Start pose of a robot: root link, joints and velocities; on the ground if no height is given."""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from urdfkit.description.urdf.queries import tree_order
from urdfkit.errors import SimulationError
from urdfkit.kinematics import Kinematics
from urdfkit.kinematics.variable_names import PARTS
from urdfkit.linear_algebra import Array
from urdfkit.scene import Scene, lowest_point
from urdfkit.scene.pose_matrices import pose_matrices
from urdfkit.sim.state.arguments import vector
from urdfkit.sim.state.poses_and_energy import link_poses
from urdfkit.sim.state.quaternion import from_rpy, rotate


@dataclass(frozen=True, slots=True)
class Spawn:
    """Start pose and velocity of a robot.

    Attributes:
        x: position of the root link [m].
        y: [m].
        z: [m]; None: the lowest collision point is on the ground.
        roll: fixed-axis angles [rad].
        pitch: [rad].
        yaw: [rad].
        twist: linear [m/s] and angular velocity [rad/s] of the root link, in world axes.
        joints: joint → position [rad] or [m].
        velocities: joint → velocity [rad/s] or [m/s].

    Examples:
        >>> import urdfkit
        >>> from urdfkit.sim import Spawn
        >>> start = Spawn(x=1.0, yaw=1.57, joints={"left_wheel_joint": 0.3})
        >>> simulator = urdfkit.Simulator("simpleton", spawn=start)
        >>> simulator.state.base_pose[:2]
        (1.0, 0.0)
        >>> pose = start.place(simulator.kinematics, simulator.scene, ground=0.5)
        >>> float(pose[2].round(3))  # height of the root link on ground at z = 0.5 m
        0.5
        >>> q, v = start.configuration(simulator.kinematics, pose)
        >>> simulator.kinematics.positions(q)["left_wheel_joint"]
        0.3
    """

    x: float = 0.0
    y: float = 0.0
    z: float | None = None
    roll: float = 0.0
    pitch: float = 0.0
    yaw: float = 0.0
    twist: tuple[float, float, float, float, float, float] = (0.0,) * 6
    joints: Mapping[str, float] = field(default_factory=dict)
    velocities: Mapping[str, float] = field(default_factory=dict)

    def place(self, kinematics: Kinematics, scene: Scene, ground: float | None) -> Array:
        """Return the pose of the root link: x y z [m] and quaternion x y z w; shape (7,).

        Args:
            kinematics: model of the robot.
            scene: shapes of the robot.
            ground: height of the ground below [m]; None without ground.

        Raises:
            SimulationError: a value is not a finite number.
            KinematicsError: a joint is unknown.
        """
        pose = (self.x, self.y, 0.0 if self.z is None else self.z, self.roll, self.pitch, self.yaw)
        vector(pose, 6, "the start pose", "m, rad")
        vector(self.twist, 6, "the initial velocity", "m/s, rad/s")
        quaternion = from_rpy(self.roll, self.pitch, self.yaw)
        height = self.z
        if height is None:
            height = 0.0 if ground is None else ground
            if ground is not None and (lowest := self._lowest(kinematics, scene, quaternion)) is not None:
                height -= lowest
        return np.array([self.x, self.y, height, *quaternion])

    def _lowest(self, kinematics: Kinematics, scene: Scene, quaternion: tuple[float, ...]) -> float | None:
        upright = np.array([0.0, 0.0, 0.0, *quaternion])
        if kinematics.floating_base:
            return lowest_point(scene, kinematics.link_poses(kinematics.configuration(self.joints, base=upright)))
        return lowest_point(scene, link_poses(kinematics, kinematics.configuration(self.joints), upright))

    def configuration(
        self, kinematics: Kinematics, pose: Array, raised: Mapping[str, float] | None = None
    ) -> tuple[Array, Array]:
        """Return the initial q and v.

        Args:
            kinematics: model of the robot.
            pose: pose of the root link, from `place`.
            raised: positions of floating joints that the spawn does not set, see `raised_joints`.

        Raises:
            KinematicsError: a joint is unknown, or a value is not a finite number.
            JointLimitError: a joint is outside its limits.
            SimulationError: a robot with a fixed base has a twist.
        """
        floats = kinematics.floating_base
        joints = {**(raised or {}), **self.joints}
        q = kinematics.configuration(joints, base=pose if floats else None, check_limits=bool(self.joints))
        if not floats and any(self.twist):
            raise SimulationError("a robot with a fixed base cannot have an initial velocity of its root link")
        inverse = np.array([-pose[3], -pose[4], -pose[5], pose[6]])
        twist = np.array([*rotate(inverse, self.twist[:3]), *rotate(inverse, self.twist[3:])])
        return q, kinematics.velocity(self.velocities, base=twist if floats else None, q=q)


def raised_joints(kinematics: Kinematics, scene: Scene, base: Array, ground: float | None) -> dict[str, float]:
    """Return positions of floating joints that place on the ground what would start below it.

    A description with the root link `world` and a floating joint usually has the robot's base at the height 0.

    Args:
        kinematics: model of a robot with a fixed base.
        scene: shapes of the robot.
        base: pose of the root link, x y z [m] and quaternion x y z w.
        ground: height of the ground [m]; None without ground.
    """
    if ground is None or kinematics.floating_base:
        return {}
    carried: dict[str, set[str]] = {}
    carrier: dict[str | None, str] = {}
    for joint in tree_order(kinematics.robot):
        name = carrier.get(joint.parent, joint.name if joint.type == "floating" else None)
        if name is not None and joint.child is not None:
            carrier[joint.child] = name
            carried.setdefault(name, set()).add(joint.child)
    poses = link_poses(kinematics, kinematics.configuration(), base)
    raised: dict[str, float] = {}
    for name, links in carried.items():
        lowest = lowest_point(scene, poses, of=links)
        if lowest is not None and lowest < ground:
            # The joint's axes are those of its child in the initial configuration.
            child = kinematics.link_names.index(kinematics.robot.joint_by_name[name].child or "")
            up = pose_matrices(poses)[child, 2, :3] * (ground - lowest)
            raised.update(zip([f"{name}/{part}" for part in PARTS["floating"][:3]], up.tolist(), strict=True))
    return raised
