"""Mimic joints: the master joint of each, and the linear law that couples them."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

from urdfkit.description.urdf.repair_record import Repair
from urdfkit.description.urdf.robot import Joint, Robot
from urdfkit.errors import KinematicsError, did_you_mean, with_effect

_SINGLE = ("revolute", "continuous", "prismatic")


@dataclass(frozen=True, slots=True)
class Coupling:
    """position(joint) = multiplier · position(master) + offset, with chains of mimics followed to the end.

    Attributes:
        joint: the joint that mimics.
        master: the joint that moves on its own; None when the chain ends at a fixed joint.
        multiplier: factor; [1], [m/rad] or [rad/m] where the two joints are of different kinds.
        offset: [rad] or [m].
    """

    joint: str
    master: str | None
    multiplier: float
    offset: float


def couplings(robot: Robot) -> dict[str, Coupling]:
    """Return the coupling of every movable mimic joint, by name in document order.

    Raises:
        KinematicsError: a master does not exist, masters form a cycle, or a joint that takes part has more than one
            degree of freedom.
    """
    found: dict[str, Coupling] = {}
    for joint in robot.joints:
        if joint.mimic is not None and joint.is_movable:
            found.setdefault(joint.name, _follow(robot.joint_by_name, joint))
    return found


def without_impossible_mimics(robot: Robot) -> Robot:
    """Return a robot without each <mimic> that `couplings` refuses, with a repair for each."""
    joints, repairs = dict(robot.joint_by_name), []
    for joint in robot.joints:
        if joint.mimic is None or not joint.is_movable:
            continue
        try:
            _follow(joints, joint)
        except KinematicsError as error:
            joints[joint.name] = replace(joint, mimic=None)
            origin = joint.mimic.element.origin
            message = with_effect(error.message, f"joint `{joint.name}` moves by itself")
            repairs.append(Repair("structure", "J416", message, origin.position, joint=joint.name))
    if not repairs:
        return robot
    kept = tuple([joints[joint.name] for joint in robot.joints])
    return replace(robot, joints=kept, repairs=(*robot.repairs, *repairs))


def _follow(joints: Mapping[str, Joint], joint: Joint) -> Coupling:
    multiplier, offset = 1.0, 0.0
    at = joint
    passed: dict[str, None] = {}  # in order
    while at.is_movable:
        place = (at.mimic or joint.mimic).element.origin.position  # type: ignore[union-attr]
        if at.type not in _SINGLE:
            raise KinematicsError(
                f"joint `{at.name}` takes part in a <mimic> but is {at.type}: "
                "only revolute, continuous and prismatic joints can",
                position=place,
            )
        if at.mimic is None:
            return Coupling(joint.name, at.name, multiplier, offset)
        passed[at.name] = None
        if at.mimic.joint in passed:
            circle = " → ".join(f"`{name}`" for name in [*passed, at.mimic.joint])
            raise KinematicsError(f"mimic joints form a cycle: {circle}", position=place)
        offset += multiplier * at.mimic.offset
        multiplier *= at.mimic.multiplier
        master = joints.get(at.mimic.joint)
        if master is None:
            hint = did_you_mean(at.mimic.joint, joints)
            raise KinematicsError(
                f"joint `{at.name}` mimics the unknown joint `{at.mimic.joint}`{hint}", position=place
            )
        at = master
    return Coupling(joint.name, None, 0.0, offset)
