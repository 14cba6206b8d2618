"""Robot → pin.Model, joint by joint.

The model has the joints, frames, inertias and order of ``pinocchio.buildModelFromURDF`` (children sorted by joint
name), so a configuration of one is a configuration of the other. Two differences are intended:

- a planar joint moves in the plane perpendicular to its ``<axis>``, as http://wiki.ros.org/urdf/XML/joint defines it;
  Pinocchio always uses the x-y plane;
- a mimic joint stays a joint of its own in ``q`` and ``v`` (`urdfkit.kinematics.mimic` couples them): Pinocchio's own
  mimic joints have no forward dynamics (``aba``), and must be of the same kind as their master.
"""

from typing import Any

import numpy as np

from urdfkit.description.urdf.robot import Joint, Link, Pose, Robot
from urdfkit.errors import KinematicsError
from urdfkit.kinematics.joint_limits import position_limits
from urdfkit.kinematics.pinocchio_requirement import require_pinocchio
from urdfkit.linear_algebra import Array, matmul, vector_norm

pin: Any = require_pinocchio()

ROOT_JOINT = "root_joint"
"""Name of the free-flyer above a floating root link, as Pinocchio names it."""


def build_model(robot: Robot, *, floating_base: bool = False) -> Any:
    """Return the ``pin.Model`` of a robot that `load` found to be one tree.

    Args:
        robot: the robot as written.
        floating_base: put a free-flyer above the root link.

    Raises:
        KinematicsError: the robot is not one tree, or a movable joint has no usable type or axis.
    """
    roots = robot.roots()
    if len(roots) != 1:
        names = ", ".join(f"`{link.name}`" for link in roots) or "none"
        raise KinematicsError(f"robot `{robot.name}` does not form a single tree of links; its roots: {names}")
    model = pin.Model()
    model.name = robot.name or ""
    joint, frame = 0, 0
    if floating_base:
        joint = model.addJoint(0, pin.JointModelFreeFlyer(), pin.SE3.Identity(), root_joint_name(robot))
        frame = model.addJointFrame(joint, 0)
    frame = _add_body(model, roots[0], joint, pin.SE3.Identity(), frame)
    # Depth first with a stack of our own: a chain may be longer than Python's recursion limit.
    stack = [(below, joint, pin.SE3.Identity(), frame) for below in _children(robot, roots[0])]
    while stack:
        written, joint, placement, frame = stack.pop()
        link = robot.link_by_name[written.child or ""]
        placement = placement * placement_of(written.origin)
        if written.is_movable:
            kind, turn = joint_model(written)
            joint = model.addJoint(joint, kind, placement * turn, written.name, *_bounds(written, kind))
            frame = model.addJointFrame(joint, frame)
            placement = turn.inverse()
        else:
            fixed = pin.Frame(written.name, joint, frame, placement, pin.FIXED_JOINT, pin.Inertia.Zero())
            frame = model.addFrame(fixed)
        frame = _add_body(model, link, joint, placement, frame)
        stack += [(below, joint, placement, frame) for below in _children(robot, link)]
    return model


def root_joint_name(robot: Robot) -> str:
    """Return the name of the free-flyer: Pinocchio's, unless a joint of the robot has it."""
    name = ROOT_JOINT
    while name in robot.joint_by_name:
        name += "_"
    return name


def placement_of(pose: Pose) -> Any:
    """Return an ``<origin>`` as ``pin.SE3``: fixed-axis roll, pitch, yaw, i.e. Rz(yaw)·Ry(pitch)·Rx(roll)."""
    return pin.SE3(pin.rpy.rpyToMatrix(*pose.rpy), np.array(pose.xyz))


def spatial_inertia(link: Link) -> Any:
    """Return a link's inertia in its own frame; zero where it is missing or Pinocchio refuses it.

    Viewing a robot needs no inertia; the simulator refuses such links by name.
    """
    inertial = link.inertial
    if inertial is None:
        return pin.Inertia.Zero()
    tensor = np.zeros((3, 3)) if inertial.inertia is None else np.array(inertial.inertia.rows)
    placement = placement_of(inertial.origin)
    R = placement.rotation
    try:
        return pin.Inertia(inertial.mass or 0.0, placement.translation, matmul(matmul(R, tensor), R.T))
    except RuntimeError:  # "The 3d inertia should be positive."
        return pin.Inertia(inertial.mass or 0.0, placement.translation, np.zeros((3, 3)))


def joint_model(joint: Joint) -> tuple[Any, Any]:
    """Return Pinocchio's joint model and the rotation from the joint's frame as written to the one it moves in.

    Raises:
        KinematicsError: the type is unknown or the axis is zero.
    """
    identity = pin.SE3.Identity()
    if joint.type == "floating":
        return pin.JointModelFreeFlyer(), identity
    axis = np.array(joint.axis, dtype=float)
    if not joint.has_axis:
        message = f"joint `{joint.name}` has the axis {axis[0]:g} {axis[1]:g} {axis[2]:g}; it must not be zero"
        raise KinematicsError(message, position=joint.element.origin.position)
    axis /= vector_norm(axis)
    if joint.type == "planar":
        turn = pin.Quaternion.FromTwoVectors(np.array([0.0, 0.0, 1.0]), axis)
        return pin.JointModelPlanar(), pin.SE3(turn.matrix(), np.zeros(3))
    aligned = {"revolute": "JointModelR{}", "continuous": "JointModelRUB{}", "prismatic": "JointModelP{}"}
    free = {
        "revolute": pin.JointModelRevoluteUnaligned,
        "continuous": _unbounded_unaligned,
        "prismatic": pin.JointModelPrismaticUnaligned,
    }
    if joint.type not in free:
        raise KinematicsError(
            f"joint `{joint.name}` has no usable type: {joint.type!r}", position=joint.element.origin.position
        )
    for letter, unit in zip("XYZ", np.eye(3), strict=True):
        if np.allclose(axis, unit, rtol=0.0, atol=1e-12):
            return getattr(pin, aligned[joint.type].format(letter))(), identity
    return free[joint.type](axis), identity


def _unbounded_unaligned(axis: Any) -> Any:
    """Return a continuous joint about any axis.

    Pinocchio's Python binding of JointModelRevoluteUnboundedUnaligned has no constructor with an axis (as of
    4.1), but its URDF reader has one: read a robot of one joint and return that joint.
    """
    x, y, z = (repr(float(number)) for number in axis)
    return pin.buildModelFromXML(
        '<robot name="_"><link name="a"/><link name="b"/><joint name="j" type="continuous">'
        f'<parent link="a"/><child link="b"/><axis xyz="{x} {y} {z}"/></joint></robot>'
    ).joints[1]


def _children(robot: Robot, link: Link) -> list[Joint]:
    """Return the joints below a link, last first: urdfdom keeps joints in a map, sorted by the bytes of their names."""
    below = [joint for joint in robot.children_of.get(link.name, []) if joint.child in robot.link_by_name]
    return sorted(below, key=lambda joint: joint.name.encode(), reverse=True)


def _add_body(model: Any, link: Link, joint: int, placement: Any, frame: int) -> int:
    model.appendBodyToJoint(joint, spatial_inertia(link), placement)
    return int(model.addBodyFrame(link.name, joint, placement, frame))


def _bounds(joint: Joint, kind: Any) -> tuple[Any, ...]:
    """Return effort, velocity and position bounds, dry friction and damping in the order of ``Model.addJoint``."""
    infinite = float("inf")
    lower, upper = position_limits(joint)
    effort = velocity = infinite
    if joint.limit is not None:
        # Pinocchio refuses negative values; so does the simulator, with their position.
        effort = infinite if joint.limit.effort is None else max(0.0, joint.limit.effort)
        velocity = infinite if joint.limit.velocity is None else max(0.0, joint.limit.velocity)
    friction = damping = 0.0
    if joint.dynamics is not None:
        friction, damping = max(0.0, joint.dynamics.friction), max(0.0, joint.dynamics.damping)
    v = np.ones(kind.nv)
    q = np.ones(kind.nq)
    if kind.nq != kind.nv:
        # Cosine and sine, or a quaternion, come last; as Pinocchio has it, bounded just outside the unit circle.
        numbers = {"continuous": 2, "planar": 2, "floating": 4}[joint.type or ""]
        lower, upper = -1.0, 1.0
        q[:-numbers], q[-numbers:] = np.inf, 1.01
    return (
        -effort * v,
        effort * v,
        -velocity * v,
        velocity * v,
        lower * q,
        upper * q,
        -friction * v,
        friction * v,
        damping * v,
    )


class ForwardKinematics:
    """Placements of the frames of a model with many joints, joint by joint, in memory linear in their number.

    ``pin.Data`` has tensors of nv³ entries: it takes 2 GB for 400 degrees of freedom, and 55 GB for 1,200. For small
    robots it is 20 times faster than this class.

    Args:
        model: ``pin.Model``.
    """

    def __init__(self, model: Any) -> None:
        above = [int(parent) for parent in model.parents]
        self._joints = [
            (joint, joint.createData(), parent, placement)
            for joint, parent, placement in zip(model.joints, above, model.jointPlacements, strict=True)
        ][1:]
        self._frames = [(int(frame.parentJoint), frame.placement) for frame in model.frames]

    def placements(self, q: Array) -> list[Any]:
        """Return the ``pin.SE3`` of every frame in the world; shape of q (nq,)."""
        joints = [pin.SE3.Identity()]
        for joint, data, parent, placement in self._joints:
            joint.calc(data, q)
            joints.append(joints[parent] * placement * data.M)
        return [joints[joint] * placement for joint, placement in self._frames]
