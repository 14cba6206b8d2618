"""What the description says about wheels: where they are, how large, which way they turn the robot."""

from __future__ import annotations

from typing import TYPE_CHECKING

from urdfkit.description.urdf.robot import Cylinder, Sphere
from urdfkit.errors import SimulationError
from urdfkit.sim.state.quaternion import rotate

if TYPE_CHECKING:
    from urdfkit.description.xml.source import Position
    from urdfkit.kinematics import Kinematics

Vector = tuple[float, float, float]


def wheel_radius(kinematics: Kinematics, joint: str, place: Position) -> float:
    """Return the radius [m] of the wheel a joint turns: that of its link's first collision, a cylinder or sphere.

    Raises:
        SimulationError: it has none, or its radius is not positive; at the place that asked for it.
    """
    link = kinematics.robot.joint_by_name[joint].child or ""
    collisions = kinematics.robot.link_by_name[link].collisions
    geometry = collisions[0].geometry if collisions else None
    if not isinstance(geometry, Cylinder | Sphere) or geometry.radius <= 0:
        raise SimulationError(
            f"the wheel of joint `{joint}` has no radius: the first <collision> of link `{link}` must be a cylinder "
            "or a sphere",
            position=place,
        )
    return geometry.radius


def wheel_centre(kinematics: Kinematics, joint: str) -> Vector:
    """Return where a wheel's first collision is, or its link without one, in the root link with all joints at zero."""
    link = kinematics.robot.joint_by_name[joint].child or ""
    pose = kinematics.link_poses(kinematics.neutral())[kinematics.link_names.index(link)]
    collisions = kinematics.robot.link_by_name[link].collisions
    within = rotate(pose[3:], collisions[0].origin.xyz) if collisions else (0.0, 0.0, 0.0)
    return float(pose[0]) + within[0], float(pose[1]) + within[1], float(pose[2]) + within[2]


def turns_right(kinematics: Kinematics, left: str, right: str) -> bool:
    """Whether the robot turns clockwise when the left wheel's rate is negative and the right wheel's positive.

    A wheel with axis a rolls along a × z; what that turns the root link by is the moment of the two about z.
    """
    moment = 0.0
    poses = kinematics.link_poses(kinematics.neutral())
    for name, rate in ((left, -1.0), (right, 1.0)):
        joint = kinematics.robot.joint_by_name[name]
        pose = poses[kinematics.link_names.index(joint.child or "")]
        axis = rotate(pose[3:], joint.axis)
        moment += rate * (float(pose[0]) * -axis[0] - float(pose[1]) * axis[1])
    return moment < 0.0
