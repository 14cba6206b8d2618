"""Names of a robot's independent variables and frames, and the errors for any other name."""

from collections.abc import Collection, Mapping

from urdfkit.defect_message import Suggestion
from urdfkit.description.urdf.robot import Robot
from urdfkit.errors import KinematicsError, did_you_mean
from urdfkit.kinematics.mimic import Coupling

PARTS = {
    "planar": ("x", "y", "theta"),
    "floating": ("trans_x", "trans_y", "trans_z", "rot_x", "rot_y", "rot_z", "rot_w"),
}
"""Joint type → names of its variables where it has more than one (MoveIt: planar_joint_model.cpp and
floating_joint_model.cpp)."""


def variable_names(robot: Robot) -> list[str]:
    """Return the variables of all movable joints that mimic no other, in document order."""
    names: list[str] = []
    for joint in robot.joints:
        if joint.is_movable and joint.mimic is None:
            parts = PARTS.get(joint.type or "")
            names += [f"{joint.name}/{part}" for part in parts] if parts else [joint.name]
    return names


def require_independent(robot: Robot, couplings: Mapping[str, Coupling], names: Collection[str], name: str) -> str:
    """Return the name of a variable that moves on its own.

    Args:
        robot: the robot.
        couplings: its mimic joints.
        names: its variables.
        name: the name to check.

    Raises:
        KinematicsError: another name, or a mimic joint; the message has the nearest name or the joint to set.
    """
    if (coupling := couplings.get(name)) is not None:
        if coupling.master is None:
            raise KinematicsError(f"joint `{name}` mimics a fixed joint: it stays at {coupling.offset:g}")
        law = f"{coupling.multiplier:g} · {coupling.master} + {coupling.offset:g}"
        raise KinematicsError(f"joint `{name}` mimics another joint ({law}); set `{coupling.master}` instead")
    if name not in names:
        raise KinematicsError(unknown_variable(robot, couplings, names, name))
    return name


def unknown_variable(robot: Robot, couplings: Mapping[str, Coupling], names: Collection[str], name: str) -> str:
    """Return the message for a name that is no variable; ``JOINT/trans_x`` is the hint for ``JOINT/x``."""
    joint = robot.joint_by_name.get(name)
    if joint is None:
        owner, _, part = name.rpartition("/")
        moved = f"{owner}/trans_{part}"
        independent = [each for each in names if each not in couplings]
        hint = Suggestion(moved) if moved in names else _nearest_or_some(name, independent, "movable joints")
        return f"no movable joint `{name}` in robot `{robot.name}`" + hint
    if joint.type in PARTS:
        parts = ", ".join(f"`{name}/{part}`" for part in PARTS[joint.type])
        return f"joint `{name}` is {joint.type} and has more than one position: {parts}"
    return f"joint `{name}` is {joint.type or 'without a type'}: it does not move"


def unknown_frame(robot: Robot, name: str) -> str:
    """Return the message for a name that is no link."""
    hint = _nearest_or_some(name, robot.link_by_name, "frames")
    if (joint := robot.joint_by_name.get(name)) is not None:
        hint = f"; `{name}` is a joint, its frame is that of its child link `{joint.child}`"
    return f"no frame `{name}` in robot `{robot.name}`" + hint


def _nearest_or_some(name: str, names: Collection[str], what: str) -> str:
    """Return the hint for a name that is not one of `names`: the nearest, or the first ones."""
    some = [*list(names)[:8], *("…" for _ in list(names)[8:9])]
    return did_you_mean(name, names) or (f"; its {what} are {', '.join(some)}" if some else "")
