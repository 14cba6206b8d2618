"""Limits of the motion of joints: from the robot, from MoveIt's joint_limits.yaml, and chosen ones."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from urdfkit.description.control import Settings, read_settings
from urdfkit.description.packages.related_files import around, package_of
from urdfkit.description.urdf.robot import Joint, Robot
from urdfkit.errors import KinematicsError, UrdfkitError, did_you_mean
from urdfkit.kinematics.joint_limits import UNITS, position_limits
from urdfkit.linear_algebra import Array

MOVEIT_FILE = "joint_limits.yaml"
"""Name of the file with limits in packages of MoveIt's setup assistant."""

_POWERS = {"velocity": "", "acceleration": "²", "jerk": "³"}


@dataclass(frozen=True)
class MotionLimits:
    """Limits of the motion of joints, each of the shape (n,).

    Attributes:
        joints: names of the joints.
        lower: lowest position [rad] or [m]; infinite without a limit, like `upper`.
        upper: highest position [rad] or [m].
        velocity: [rad/s] or [m/s].
        acceleration: [rad/s²] or [m/s²], of decelerations too.
        jerk: [rad/s³] or [m/s³]; None if jerk is not limited.
    """

    joints: tuple[str, ...]
    lower: Array
    upper: Array
    velocity: Array
    acceleration: Array
    jerk: Array | None

    def scaled(self, velocity: float, acceleration: float) -> "MotionLimits":
        """Return parts of these limits of velocity and acceleration, each factor above 0 and at most 1."""
        return replace(self, velocity=self.velocity * velocity, acceleration=self.acceleration * acceleration)


def motion_limits(
    robot: Robot,
    joints: Sequence[str],
    *,
    acceleration: Mapping[str, float] | None = None,
    jerk: Mapping[str, float] | None = None,
    file: Path | None = None,
) -> MotionLimits:
    """Return the limits of some joints.

    Args:
        robot: its ``<limit>`` elements give velocities and, since URDF 1.2, accelerations and jerks.
        joints: names of movable joints with one degree of freedom, no mimic joints.
        acceleration: joint → limit that replaces all others; the name "" is for every joint without its own.
        jerk: as for `acceleration`. Jerk is limited if this, the robot or the file limits that of each joint.
        file: MoveIt's joint_limits.yaml; its limits replace those of the robot.

    Raises:
        KinematicsError: a joint is unknown, has several degrees of freedom or no limit, a limit is not positive, or the
            file has none of the joints.
        DescriptionError: the file cannot be read, or a value in it is not of its type.
    """
    chosen = {"acceleration": acceleration or {}, "jerk": jerk or {}}
    for kind, limits in chosen.items():
        unknown = next((name for name in limits if name and name not in joints), None)
        if unknown is not None:
            hint = did_you_mean(unknown, joints)
            raise KinematicsError(f"{kind} limit of `{unknown}`: the path has no joint of this name{hint}")
    moveit = _joint_limits(file) if file is not None else {}
    if file is not None and not moveit.keys() & set(joints):
        there = ", ".join(f"`{name}`" for name in moveit) or "no joints"
        raise KinematicsError(f"{file} limits no joint of the path: it has {there} under `joint_limits`")
    movable = [_movable(robot, name) for name in joints]
    lower, upper = np.array([_positions(joint, moveit.get(joint.name)) for joint in movable]).reshape(-1, 2).T
    rates: dict[str, list[float | None]] = {
        kind: [_rate(joint, kind, moveit.get(joint.name), chosen.get(kind, {})) for joint in movable]
        for kind in _POWERS
    }
    for kind in _POWERS:
        without = [name for name, value in zip(joints, rates[kind], strict=True) if value is None]
        if without and (kind != "jerk" or chosen["jerk"]):
            unit = f"{UNITS[movable[joints.index(without[0])].type or '']}/s{_POWERS[kind]}"
            hint = f"; give one with --{kind}" if kind in chosen else ""
            raise KinematicsError(
                f"joint `{without[0]}` has no {kind} limit [{unit}] in its <limit> or a {MOVEIT_FILE}{hint}"
            )
    return MotionLimits(
        tuple(joints),
        lower,
        upper,
        np.array(rates["velocity"], float),
        np.array(rates["acceleration"], float),
        None if None in rates["jerk"] else np.array(rates["jerk"], float),
    )


def find_joint_limits(robot: Robot, joints: Sequence[str]) -> Path | None:
    """Return the joint_limits.yaml of the robot's package, or of a package that uses it, that has all the joints."""
    package = package_of(Path(robot.files[0])) if robot.files else None
    for file in around(package) if package is not None else ():
        try:
            if file.name == MOVEIT_FILE and set(joints) <= _joint_limits(file).keys():
                return file
        except UrdfkitError:  # lint reports it
            continue
    return None


def _joint_limits(file: Path) -> dict[str, Settings]:
    """Return joint → its settings in a joint_limits.yaml, below the names that some loaders put around them."""
    found = read_settings(file)
    for path in ("joint_limits", "robot_description_planning/joint_limits"):
        for root in (found, *(group for name, group in found.walk() if name.endswith("ros__parameters"))):
            if (group := root.find(path)) is not None:
                return group.children
    return {}


def _movable(robot: Robot, name: str) -> Joint:
    joint = robot.joint_by_name.get(name)
    if joint is None:
        raise KinematicsError(f"robot `{robot.name}` has no joint `{name}`{did_you_mean(name, robot.joint_by_name)}")
    if joint.mimic is not None:
        raise KinematicsError(f"joint `{name}` mimics `{joint.mimic.joint}`; move that joint instead")
    if joint.type not in UNITS:
        raise KinematicsError(
            f"joint `{name}` is {joint.type}; only joints with one degree of freedom have such limits"
        )
    return joint


def _positions(joint: Joint, moveit: Settings | None) -> tuple[float, float]:
    lower, upper = position_limits(joint)
    if moveit is not None and moveit.flag("has_position_limits", default=False):
        return max(lower, moveit.number("min_position", lower)), min(upper, moveit.number("max_position", upper))
    return lower, upper


def _rate(joint: Joint, kind: str, moveit: Settings | None, chosen: Mapping[str, float]) -> float | None:
    """Return the limit of velocity, acceleration or jerk of a joint; None without one."""
    value = chosen.get(joint.name, chosen.get(""))
    if value is None and moveit is not None and moveit.flag(f"has_{kind}_limits", default=False):
        value = moveit.number(f"max_{kind}")
    if value is None and joint.limit is not None:
        value = getattr(joint.limit, kind)
        if kind == "acceleration" and value is not None and joint.limit.deceleration is not None:
            value = min(value, joint.limit.deceleration)
    if value is not None and not 0.0 < value < np.inf:
        unit = f"{UNITS[joint.type or '']}/s{_POWERS[kind]}"
        raise KinematicsError(f"joint `{joint.name}`: the {kind} limit is {value:g} {unit}; it must be positive")
    return value
