"""Gazebo's names of collisions, which contact sensors and contact messages use.

From URDF, Gazebo makes ``LINK_collision``, ``LINK_collision_1``, …, or ``NAME_collision`` if the collision has a name.
It merges links connected by fixed joints into one, and renames the collisions of a merged link to
``PARENT_fixed_joint_lump__LINK_collision_1`` (sdformat, parser_urdf.cc). urdfkit does not merge links, and resolves
each of these names to its collision. In SDF, collisions keep their names.
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass

from urdfkit.description.sdf import Plane, World
from urdfkit.description.urdf.robot import Robot
from urdfkit.scene import Scene
from urdfkit.sim.construction.rigid_bodies import parts_of, touchable
from urdfkit.sim.scene_view import Layout

_LUMP = "_fixed_joint_lump__"
_COUNTED = re.compile(r"_\d+$")


@dataclass(frozen=True, eq=False)
class Collision:
    """Collision of a robot.

    Attributes:
        link: its link.
        name: its name in Gazebo.
        number: its index among the collisions of its link.
        aliases: all names that resolve to it.
    """

    link: str
    name: str
    number: int
    aliases: frozenset[str]


def collisions_of(robot: Robot, scene: Scene) -> tuple[Collision, ...]:
    """Return the collisions of a robot."""
    found = []
    for link in scene.bodies:
        shapes = [shape for shape in scene.with_role("collision") if shape.body == link]
        written = robot.link_by_name[link].collisions if link in robot.link_by_name else ()
        for k, shape in enumerate(shapes):
            label = shape.name.split("/collision/", 1)[1]
            count = f"_{k}" if k else ""
            base = link if label.isdigit() else label
            name = f"{base}_collision{count}" if written else label
            aliases = {name, f"{link}_collision{count}"}
            if not label.isdigit():
                aliases |= {label, f"{label}_collision"}
            found.append(Collision(link, name, k, frozenset(aliases)))
    return tuple(found)


def find(wanted: str, collisions: Sequence[Collision], link: str) -> tuple[Collision, ...]:
    """Return the collisions with a name, only those of `link` if it has any; empty for an unknown name."""
    name = wanted.rpartition("::")[2].strip()
    lumped = _LUMP in name
    if lumped:
        name = name.rpartition(_LUMP)[2]
    means = [each for each in collisions if name in each.aliases]
    if lumped and not means:  # its number is an index in the merged link
        means = [each for each in collisions if _COUNTED.sub("", name) in each.aliases]
    return tuple([each for each in means if each.link == link] or means)


def scoped_name(name: str, layout: Layout, number: int) -> str:
    """Return Gazebo's scoped name of the collision of a contact.

    Args:
        name: name in the contact: a body of the world, a link of the first robot, or ``ROBOT::LINK`` of another robot.
        layout: layout of the scene at the contact.
        number: index of the collision among those of the body or link.
    """
    if (found := _of_world(name, layout.world, number)) is not None:
        return found
    for i, (robot, scene, _) in enumerate(layout.robots):
        link = name if i == 0 else name.removeprefix(f"{robot}::")
        if link not in scene.bodies or (i and link == name):
            continue
        labels = [shape.name for shape in scene.with_role("collision") if shape.body == link]
        label = labels[number].split("/collision/", 1)[1]
        if any(model.name == robot.partition("::")[0] for model in layout.world.models):  # from SDF
            return f"{robot}::{link}::{label}"
        return f"{robot}::{link}::{link if label.isdigit() else label}_collision" + (f"_{number}" if number else "")
    return name


def _of_world(name: str, world: World, number: int) -> str | None:
    ground = None if world.ground is None else world.ground.name
    for model in world.models:
        for part, _, links in parts_of(model):
            if part == name:
                shapes = [(link, shape) for link, _, written in links for shape in touchable(written)]
                # The ground plane does not count among the collisions of its body.
                is_plane = [model.name == ground and isinstance(shape.geometry, Plane) for _, shape in shapes]
                same = [each for each, plane in zip(shapes, is_plane, strict=True) if plane == (number < 0)]
                link, shape = same[max(number, 0)]
                return f"{model.name}::{link}::{shape.name}"
    return None
