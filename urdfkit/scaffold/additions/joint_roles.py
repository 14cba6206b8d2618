"""Purpose of each joint of a robot: wheel, arm, finger, or not driven."""

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from urdfkit.description.urdf.geometry import link_poses, rotate, rotation_of
from urdfkit.description.urdf.robot import Cylinder, Joint, Link, Robot, Sphere
from urdfkit.scaffold.additions.existing_hardware import KINDS, ExistingHardware, hardware

_FINGER = re.compile(r"finger|jaw|claw", re.IGNORECASE)
_GRIPPER = re.compile(r"grip", re.IGNORECASE)
_CASTER = re.compile(r"cast[eo]r", re.IGNORECASE)
_MOVED = ("revolute", "continuous", "prismatic")
_TOLERANCE = 1e-3
"""Tolerance for wheels on one axle to be mirror images [m]."""


@dataclass(frozen=True, slots=True)
class WheelJoints:
    """Driven wheels of a differential drive.

    Attributes:
        left: joints of the left wheels.
        right: joints of the right wheels.
        separation: distance between left and right wheels [m].
        radius: radius of each wheel [m].
    """

    left: tuple[str, ...]
    right: tuple[str, ...]
    separation: float
    radius: float


@dataclass(frozen=True, slots=True)
class Roles:
    """Joints by purpose.

    Attributes:
        wheels: the wheels of a differential drive; None without such a drive.
        arms: joints of each chain, starting at its base.
        fingers: joints of grippers; chains and fingers include mimic joints that need commands of their own.
        notes: joints without a controller and the reason, one line each.
        interfaces: command interface of each joint with a transmission or in ``<ros2_control>``.
    """

    wheels: WheelJoints | None
    arms: tuple[tuple[str, ...], ...]
    fingers: tuple[str, ...]
    notes: tuple[str, ...]
    interfaces: Mapping[str, str] = field(default_factory=dict)


def roles(robot: Robot, existing: ExistingHardware | None = None, *, follow: bool = True) -> Roles:
    """Return the purpose of each joint, by its type, axis, position and name, in the zero position.

    Args:
        robot: a robot whose joints form a tree.
        existing: command interfaces and drivers of joints; None: as declared in the robot's elements.
        follow: whether the simulator supports ``<mimic>``; Gazebo Classic ignores it.
    """
    notes: list[str] = []
    existing = existing or hardware(robot)
    parents = {joint.child: joint for joint in robot.joints}
    left_over: list[Joint] = []
    followers: list[Joint] = []
    for joint in robot.joints:
        if joint.type not in _MOVED:
            continue
        chain = [joint, *_above(joint, parents)]
        if joint.name in existing.drivers:
            notes.append(f"`{joint.name}` is already driven by {existing.drivers[joint.name]}")
        elif joint.mimic is not None:
            followers.append(joint)
        elif any(_CASTER.search(f"{each.name} {each.child}") for each in chain):
            notes.append(f"`{joint.name}` turns freely because it belongs to a caster")
        elif existing.interfaces.get(joint.name) == "":
            notes.append(f"`{joint.name}` has none of the command interfaces {', '.join(KINDS)}")
        else:
            left_over.append(joint)
    fingers = [joint for joint in left_over if _is_finger(joint)]
    rolling = [joint for joint in left_over if joint not in fingers and _rolls(joint, robot, parents)]
    wheels = _wheels(rolling, robot)
    other = {
        joint.name: kind for joint in rolling if (kind := existing.interfaces.get(joint.name, "velocity")) != "velocity"
    }
    if wheels is not None and other:
        notes += [f"`{name}` has the command interface {kind}; wheels need velocity" for name, kind in other.items()]
        wheels = None
    elif wheels is None:
        notes += [f"`{joint.name}` has the shape of a wheel, but no mirrored counterpart" for joint in rolling]
    arms: dict[str, list[str]] = {}
    for joint in left_over:
        if joint not in fingers and joint not in rolling:
            base = [each for each in (joint, *_above(joint, parents)) if each in left_over and each not in fingers][-1]
            arms.setdefault(base.name, []).append(joint.name)
    names = [joint.name for joint in fingers]
    notes += _mimic_notes(followers, [names, *arms.values()], existing, follow=follow)
    used = {
        joint.name: existing.interfaces[joint.name]
        for joint in (*left_over, *followers)
        if joint.name in existing.interfaces
    }
    chains = tuple(map(tuple, arms.values()))
    return Roles(wheels, chains, tuple(names), tuple(notes), used)


def _mimic_notes(
    followers: list[Joint], chains: list[list[str]], existing: ExistingHardware, *, follow: bool
) -> Iterator[str]:
    """Yield notes on mimic joints; mimic joints that need commands of their own are inserted into the chains."""
    for joint, mimic in ((each, each.mimic) for each in followers if each.mimic is not None):
        chain = next((names for names in chains if mimic.joint in names), None)
        if follow or chain is None or existing.interfaces.get(joint.name) == "":
            yield f"`{joint.name}` mimics `{mimic.joint}`"
            continue
        chain.insert(chain.index(mimic.joint) + 1, joint.name)
        law = f"{mimic.multiplier:g} × `{mimic.joint}`{f' {mimic.offset:+g}' if mimic.offset else ''}"
        yield f"`{joint.name}` is {law}, but Gazebo Classic ignores <mimic>: send commands to both joints accordingly"


def _is_finger(joint: Joint) -> bool:
    names = f"{joint.name} {joint.child}"
    return bool(_FINGER.search(names) or (joint.type == "prismatic" and _GRIPPER.search(names)))


def _above(joint: Joint, parents: dict[str | None, Joint]) -> list[Joint]:
    """Return the movable joints between a joint and the root, nearest first."""
    movable = []
    above = parents.get(joint.parent)
    while above is not None:
        if above.type in _MOVED:
            movable.append(above)
        above = parents.get(above.parent)
    return movable


def _rolls(joint: Joint, robot: Robot, parents: dict[str | None, Joint]) -> bool:
    """Return whether a joint is a wheel on the base: continuous, about a lateral axis, without a movable child."""
    if joint.type != "continuous" or _above(joint, parents):
        return False
    if any(joint in _above(other, parents) for other in robot.joints if other.type in _MOVED):
        return False
    across = rotate(rotation_of(link_poses(robot)[joint.child or ""].rpy), joint.axis)[1]
    length = sum(axis * axis for axis in joint.axis) ** 0.5
    return bool(length > 0 and abs(across) / length > 0.99)


def _wheels(joints: list[Joint], robot: Robot) -> WheelJoints | None:
    """Return the differential drive of some wheels: as many left as right, mirrored, with equal radii."""
    if len(joints) < 2 or len(joints) % 2:
        return None
    poses = link_poses(robot)
    places = {joint.name: poses[joint.child or ""].xyz for joint in joints}
    radii = [_radius(robot.link_by_name.get(joint.child or "")) for joint in joints]
    middle = sum(place[1] for place in places.values()) / len(places)
    left = sorted((name for name in places if places[name][1] > middle), key=lambda name: places[name][0])
    right = sorted((name for name in places if places[name][1] < middle), key=lambda name: places[name][0])
    if len(left) != len(right) or None in radii:
        return None
    sizes = [radius for radius in radii if radius is not None]
    spans = [places[a][1] - places[b][1] for a, b in zip(left, right, strict=True)]
    mirrored = all(
        abs(places[a][0] - places[b][0]) < _TOLERANCE and abs(places[a][2] - places[b][2]) < _TOLERANCE
        for a, b in zip(left, right, strict=True)
    )
    if not mirrored or max(spans) - min(spans) > _TOLERANCE or max(sizes) - min(sizes) > _TOLERANCE:
        return None
    return WheelJoints(tuple(left), tuple(right), round(spans[0], 6), sizes[0])


def _radius(link: Link | None) -> float | None:
    shapes = [shape.geometry for shape in link.collisions] if link is not None else []
    shapes += [shape.geometry for shape in link.visuals] if link is not None else []
    return next((shape.radius for shape in shapes if isinstance(shape, Cylinder | Sphere)), None)
