"""Mimic joints: the master joint of each, and the linear law that couples them."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

from urdfkit.defect_message import with_effect
from urdfkit.description.repair_positions import at_attributes
from urdfkit.description.urdf.repair_record import Repair
from urdfkit.description.urdf.robot import Joint, Robot
from urdfkit.errors import KinematicsError, did_you_mean

_SINGLE = ("revolute", "continuous", "prismatic")


@dataclass(frozen=True, slots=True)
class Coupling:
    """position(joint) = multiplier · position(master) + offset, with chains of mimics followed to the end.

    Attributes:
        joint: the joint that mimics.
        master: the joint that moves on its own; None when the chain ends at a fixed joint.
        multiplier: factor; [1], [m/rad] or [rad/m] where the two joints are of different kinds.
        offset: [rad] or [m].

    Examples:
        >>> from urdfkit.kinematics import Coupling
        >>> finger = Coupling("left_finger", "right_finger", multiplier=-1.0, offset=0.02)
        >>> finger.multiplier * 0.01 + finger.offset  # position of the left finger [m]
        0.01
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
    resolved: dict[str, Coupling] = {}
    mimics = [joint for joint in robot.joints if joint.mimic is not None and joint.is_movable]
    return {joint.name: _follow(robot.joint_by_name, joint, resolved) for joint in mimics}


def without_impossible_mimics(robot: Robot) -> Robot:
    """Return a robot without each <mimic> that `couplings` refuses, with a repair for each."""
    joints, repairs = dict(robot.joint_by_name), []
    resolved: dict[str, Coupling] = {}
    for joint in robot.joints:
        if joint.mimic is None or not joint.is_movable:
            continue
        try:
            _follow(joints, joint, resolved)
        except KinematicsError as error:
            joints[joint.name] = replace(joint, mimic=None)
            origin = joint.mimic.element.origin
            message = with_effect(error.message, f"joint `{joint.name}` moves by itself")
            repairs.append(Repair("structure", "J416", message, origin.position, joint=joint.name))
    if not repairs:
        return robot
    kept = tuple([joints[joint.name] for joint in robot.joints])
    return replace(robot, joints=kept, repairs=(*robot.repairs, *at_attributes(repairs)))


def _follow(joints: Mapping[str, Joint], joint: Joint, resolved: dict[str, Coupling]) -> Coupling:
    """Return the coupling of a joint; add those of all joints of its chain to `resolved`."""
    at = joint
    passed: dict[str, Joint] = {}  # in order
    while True:
        if at.name in resolved or not at.is_movable:
            end = resolved.get(at.name) or Coupling(at.name, None, 0.0, 0.0)
            break
        place = (at.mimic or joint.mimic).element.origin.position  # type: ignore[union-attr]
        if at.type not in _SINGLE:
            message = f"joint `{at.name}` is used in a <mimic> but is {at.type}: "
            message += "only revolute, continuous and prismatic joints support <mimic>"
            raise KinematicsError(message, position=place)
        if at.mimic is None:
            end = Coupling(at.name, at.name, 1.0, 0.0)
            break
        passed[at.name] = at
        if at.mimic.joint in passed:
            circle = " → ".join(f"`{name}`" for name in [*passed, at.mimic.joint])
            raise KinematicsError(f"mimic joints form a cycle: {circle}", position=place)
        master = joints.get(at.mimic.joint)
        if master is None:
            hint = did_you_mean(at.mimic.joint, [name for name in joints if name not in passed])
            raise KinematicsError(
                f"joint `{at.name}` mimics the unknown joint `{at.mimic.joint}`" + hint, position=place
            )
        at = master
    for each in reversed(passed.values()):
        factor, offset = each.mimic.multiplier, each.mimic.offset  # type: ignore[union-attr]
        end = Coupling(each.name, end.master, factor * end.multiplier, factor * end.offset + offset)
        resolved[each.name] = end
    return end
