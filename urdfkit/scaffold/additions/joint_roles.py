"""What the joints of a robot are for: wheels, arms, fingers, and those that nothing drives."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from urdfkit.description.urdf.geometry import compose, rotate, rotation_of
from urdfkit.description.urdf.robot import Cylinder, Joint, Link, Pose, Robot, Sphere
from urdfkit.scaffold.additions.existing_hardware import KINDS, Hardware, hardware

_FINGER = re.compile(r"finger|jaw|claw", re.IGNORECASE)
_GRIPPER = re.compile(r"grip", re.IGNORECASE)
_CASTER = re.compile(r"cast[eo]r", re.IGNORECASE)
_MOVED = ("revolute", "continuous", "prismatic")
_ALIKE = 1e-3
"""How far wheels of one axle may be from being mirror images [m]."""


@dataclass(frozen=True, slots=True)
class Wheels:
    """The driven wheels of a robot that turns by their difference.

    Attributes:
        left: joints.
        right: joints.
        separation: from the left to the right [m].
        radius: of each [m].
    """

    left: tuple[str, ...]
    right: tuple[str, ...]
    separation: float
    radius: float


@dataclass(frozen=True, slots=True)
class Roles:
    """The joints by what they are for.

    Attributes:
        wheels: None where there are none that make a differential drive.
        arms: joints of each chain, from its base on.
        fingers: of grippers. With joints go those that follow them and are told what to do like them.
        notes: joints that no controller is for, and why, a line each.
        interfaces: what those of them can be told that have a transmission or are in ``<ros2_control>``.
    """

    wheels: Wheels | None
    arms: tuple[tuple[str, ...], ...]
    fingers: tuple[str, ...]
    notes: tuple[str, ...]
    interfaces: Mapping[str, str] = field(default_factory=dict)


def roles(robot: Robot, there: Hardware | None = None, *, follow: bool = True) -> Roles:
    """Tell what the joints are for, by their type, axis, place and name, in the zero position.

    Args:
        robot: a tree.
        there: what joints can be told, and what tells them; None: as the robot's elements have it.
        follow: whether the simulator has joints follow others; Gazebo Classic passes over ``<mimic>``.
    """
    notes: list[str] = []
    there = there or hardware(robot)
    parents = {joint.child: joint for joint in robot.joints}
    left_over: list[Joint] = []
    followers: list[Joint] = []
    for joint in robot.joints:
        if joint.type not in _MOVED:
            continue
        chain = [joint, *_above(joint, parents)]
        if joint.name in there.drivers:
            notes.append(f"`{joint.name}` is driven already, by {there.drivers[joint.name]}")
        elif joint.mimic is not None:
            followers.append(joint)
        elif any(_CASTER.search(f"{each.name} {each.child}") for each in chain):
            notes.append(f"`{joint.name}` turns freely, as a caster")
        elif there.interfaces.get(joint.name) == "":
            notes.append(f"`{joint.name}` can be told none of {', '.join(KINDS)}")
        else:
            left_over.append(joint)
    fingers = [joint for joint in left_over if _is_finger(joint)]
    rolling = [joint for joint in left_over if joint not in fingers and _rolls(joint, robot, parents)]
    wheels = _wheels(rolling, robot, parents)
    other = {
        joint.name: kind for joint in rolling if (kind := there.interfaces.get(joint.name, "velocity")) != "velocity"
    }
    if wheels is not None and other:
        notes += [f"`{name}` can be told its {kind}, not its velocity as wheels are" for name, kind in other.items()]
        wheels = None
    elif wheels is None:
        notes += [f"`{joint.name}` looks like a wheel, but not like one of a pair" for joint in rolling]
    arms: dict[str, list[str]] = {}
    for joint in left_over:
        if joint not in fingers and joint not in rolling:
            base = [each for each in (joint, *_above(joint, parents)) if each in left_over and each not in fingers][-1]
            arms.setdefault(base.name, []).append(joint.name)
    names = [joint.name for joint in fingers]
    notes += _followed(followers, [names, *arms.values()], there, follow=follow)
    used = {
        joint.name: there.interfaces[joint.name] for joint in (*left_over, *followers) if joint.name in there.interfaces
    }
    chains = tuple(map(tuple, arms.values()))
    return Roles(wheels, chains, tuple(names), tuple(notes), used)


def _followed(followers: list[Joint], chains: list[list[str]], there: Hardware, *, follow: bool) -> Iterator[str]:
    """Yield what is told of joints that follow others; add to the chains those that are told what to do, too."""
    for joint, mimic in ((each, each.mimic) for each in followers if each.mimic is not None):
        chain = next((names for names in chains if mimic.joint in names), None)
        if follow or chain is None or there.interfaces.get(joint.name) == "":
            yield f"`{joint.name}` follows `{mimic.joint}`"
            continue
        chain.insert(chain.index(mimic.joint) + 1, joint.name)
        law = f"{mimic.multiplier:g} × `{mimic.joint}`{f' {mimic.offset:+g}' if mimic.offset else ''}"
        yield f"`{joint.name}` is {law}, which Gazebo Classic passes over: both are told, so tell it that"


def _is_finger(joint: Joint) -> bool:
    names = f"{joint.name} {joint.child}"
    return bool(_FINGER.search(names) or (joint.type == "prismatic" and _GRIPPER.search(names)))


def _above(joint: Joint, parents: dict[str | None, Joint]) -> list[Joint]:
    """Return the joints that move between a joint and the root, the nearest first."""
    found = []
    above = parents.get(joint.parent)
    while above is not None:
        if above.type in _MOVED:
            found.append(above)
        above = parents.get(above.parent)
    return found


def _rolls(joint: Joint, robot: Robot, parents: dict[str | None, Joint]) -> bool:
    """Whether it is a wheel on the base: it turns without end about an axis across, and carries nothing that moves."""
    if joint.type != "continuous" or _above(joint, parents):
        return False
    if any(joint in _above(other, parents) for other in robot.joints if other.type in _MOVED):
        return False
    across = rotate(rotation_of(_placement(joint, parents).rpy), joint.axis)[1]
    length = sum(axis * axis for axis in joint.axis) ** 0.5
    return bool(length > 0 and abs(across) / length > 0.99)


def _wheels(joints: list[Joint], robot: Robot, parents: dict[str | None, Joint]) -> Wheels | None:
    """Return the differential drive that wheels make: as many left as right, mirrored, all of one radius."""
    if len(joints) < 2 or len(joints) % 2:
        return None
    places = {joint.name: _placement(joint, parents).xyz for joint in joints}
    radii = [_radius(robot.link_by_name.get(joint.child or "")) for joint in joints]
    middle = sum(place[1] for place in places.values()) / len(places)
    left = sorted((name for name in places if places[name][1] > middle), key=lambda name: places[name][0])
    right = sorted((name for name in places if places[name][1] < middle), key=lambda name: places[name][0])
    if len(left) != len(right) or None in radii:
        return None
    known = [radius for radius in radii if radius is not None]
    spans = [places[a][1] - places[b][1] for a, b in zip(left, right, strict=True)]
    mirrored = all(
        abs(places[a][0] - places[b][0]) < _ALIKE and abs(places[a][2] - places[b][2]) < _ALIKE
        for a, b in zip(left, right, strict=True)
    )
    if not mirrored or max(spans) - min(spans) > _ALIKE or max(known) - min(known) > _ALIKE:
        return None
    return Wheels(tuple(left), tuple(right), round(spans[0], 6), known[0])


def _radius(link: Link | None) -> float | None:
    shapes = [shape.geometry for shape in link.collisions] if link is not None else []
    shapes += [shape.geometry for shape in link.visuals] if link is not None else []
    return next((shape.radius for shape in shapes if isinstance(shape, Cylinder | Sphere)), None)


def _placement(joint: Joint, parents: dict[str | None, Joint]) -> Pose:
    """Return the frame of a joint in that of the root."""
    chain = [joint]
    while (above := parents.get(chain[-1].parent)) is not None:
        chain.append(above)
    pose = Pose()
    for each in reversed(chain):
        pose = compose(pose, each.origin)
    return pose
