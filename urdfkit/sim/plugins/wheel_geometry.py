"""Geometry of wheels: radius, position and sense of rotation from the description, and Ackermann steering angles."""

from math import atan2

from urdfkit.description.urdf.robot import Cylinder, Robot, Sphere
from urdfkit.description.xml.source import Position
from urdfkit.errors import SimulationError
from urdfkit.kinematics import Kinematics
from urdfkit.sim.state.quaternion import rotate

Vector = tuple[float, float, float]


def collision_radius(robot: Robot, joint: str) -> float | None:
    """Return the radius [m] of the first cylinder or sphere a joint's wheel collides with; None if missing."""
    link = robot.link_by_name[robot.joint_by_name[joint].child or ""]
    shapes = (collision.geometry for collision in link.collisions)
    return next((shape.radius for shape in shapes if isinstance(shape, Cylinder | Sphere)), None)


def wheel_radius(robot: Robot, joint: str, place: Position) -> float:
    """Return the radius [m] of a wheel whose first collision is a cylinder or a sphere.

    Raises:
        SimulationError: it is another shape, or its radius is not positive; at the position of the parameter.
    """
    link = robot.joint_by_name[joint].child or ""
    first = next((collision.geometry for collision in robot.link_by_name[link].collisions), None)
    if not isinstance(first, Cylinder | Sphere) or first.radius <= 0:
        raise SimulationError(
            f"the wheel of joint `{joint}` has no radius: the first <collision> of link `{link}` must be a cylinder "
            "or a sphere",
            position=place,
        )
    return first.radius


def steering_angles(slope: float, ratio: float) -> tuple[float, float]:
    """Return the angles [rad] of the left and the right wheel at which both circle the same point (Ackermann).

    Args:
        slope: tangent of the angle of one wheel at the middle of the axle, positive to the left.
        ratio: half the track divided by the wheel base.
    """
    skew = ratio * slope
    return atan2(slope, 1 - skew), atan2(slope, 1 + skew)


def wheel_centre(kinematics: Kinematics, joint: str) -> Vector:
    """Return the position of a wheel's first collision, else of its link, in the root link with all joints at zero."""
    link = kinematics.robot.joint_by_name[joint].child or ""
    pose = kinematics.link_poses(kinematics.neutral())[kinematics.link_names.index(link)]
    collisions = kinematics.robot.link_by_name[link].collisions
    within = rotate(pose[3:], collisions[0].origin.xyz) if collisions else (0.0, 0.0, 0.0)
    return float(pose[0]) + within[0], float(pose[1]) + within[1], float(pose[2]) + within[2]


def turns_right(kinematics: Kinematics, left: str, right: str) -> bool:
    """Whether the robot turns clockwise when the left wheel's rate is negative and the right wheel's positive.

    A wheel with axis a rolls along a × z; the moment of both about z turns the root link.
    """
    moment = 0.0
    poses = kinematics.link_poses(kinematics.neutral())
    for name, rate in ((left, -1.0), (right, 1.0)):
        joint = kinematics.robot.joint_by_name[name]
        pose = poses[kinematics.link_names.index(joint.child or "")]
        axis = rotate(pose[3:], joint.axis)
        moment += rate * (float(pose[0]) * -axis[0] - float(pose[1]) * axis[1])
    return moment < 0.0
