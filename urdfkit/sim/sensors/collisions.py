"""What collisions are called, by those who listen to contacts: the names that Gazebo gives them.

From URDF, Gazebo makes ``LINK_collision``, ``LINK_collision_1``, …, or ``NAME_collision`` where the collision has a
name; of links that hang together by fixed joints it makes one, and calls the collisions that move there
``PARENT_fixed_joint_lump__LINK_collision_1`` (sdformat, parser_urdf.cc). Here links stay apart, and any of these names
finds its collision. In SDF a collision has the name that is written.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from urdfkit.description.robot import Box, Capsule, Cylinder, Sphere
from urdfkit.sim.things import parts_of

if TYPE_CHECKING:
    from urdfkit.description.robot import Robot
    from urdfkit.description.world import World
    from urdfkit.scene import Scene, Shape
    from urdfkit.sim.surroundings import Layout

Array = NDArray[np.float64]

_LUMP = "_fixed_joint_lump__"
_COUNTED = re.compile(r"_\d+$")


@dataclass(frozen=True, eq=False)
class Collision:
    """A collision of a robot.

    Attributes:
        link: that it is on.
        name: as Gazebo calls it.
        aliases: all names that find it.
        shape: its geometry and its place on the link.
    """

    link: str
    name: str
    aliases: frozenset[str]
    shape: Shape


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
            found.append(Collision(link, name, frozenset(aliases), shape))
    return tuple(found)


def find(wanted: str, collisions: Sequence[Collision], link: str) -> tuple[Collision, ...]:
    """Return the collisions that a name means; those of `link` before all others, none where none is called so."""
    name = wanted.rpartition("::")[2].strip()
    lumped = _LUMP in name
    if lumped:
        name = name.rpartition(_LUMP)[2]
    means = [each for each in collisions if name in each.aliases]
    if lumped and not means:  # its number counts the collisions of the link that it was moved to
        means = [each for each in collisions if _COUNTED.sub("", name) in each.aliases]
    return tuple([each for each in means if each.link == link] or means)


def nearest(collisions: Sequence[Collision], point: Array) -> Collision:
    """Return the collision whose surface is nearest to a point of its link [m]; shape (3,)."""
    return collisions[0] if len(collisions) == 1 else min(collisions, key=lambda one: _off(one.shape, point))


def _off(shape: Shape, point: Array) -> float:
    """Return how far a point is from a shape's surface [m]; from its box, for meshes."""
    x, y, z = (np.linalg.inv(shape.placement) @ np.append(point, 1.0))[:3]
    geometry = shape.geometry
    if isinstance(geometry, Sphere):
        return abs(float(np.linalg.norm((x, y, z))) - geometry.radius)
    if isinstance(geometry, Capsule):
        beyond = max(abs(z) - geometry.length / 2, 0.0)
        return abs(float(np.linalg.norm((x, y, beyond))) - geometry.radius)
    if isinstance(geometry, Cylinder):
        out = np.array([np.hypot(x, y) - geometry.radius, abs(z) - geometry.length / 2])
    elif isinstance(geometry, Box):
        out = np.abs((x, y, z)) - np.array(geometry.size) / 2
    elif shape.mesh is not None:
        low, high = shape.mesh.vertices.min(axis=0), shape.mesh.vertices.max(axis=0)
        out = np.abs(np.array([x, y, z]) - (low + high) / 2) - (high - low) / 2
    else:
        return 0.0
    return abs(float(np.linalg.norm(np.maximum(out, 0.0))) + min(float(out.max()), 0.0))


def scoped_name(name: str, layout: Layout, point: Array) -> str:
    """Return what Gazebo calls the collision of something that was touched at a point of the world.

    Args:
        name: as contacts call it: a body of the world, a link of the first robot, ``ROBOT::LINK`` of another.
        layout: what there was.
        point: [m]; shape (3,).
    """
    if (found := _of_world(name, layout.world)) is not None:
        return found
    for i, (robot, scene, _) in enumerate(layout.robots):
        link = name if i == 0 else name.removeprefix(f"{robot}::")
        if link not in scene.bodies or (i and link == name):
            continue
        shapes = [shape for shape in scene.with_role("collision") if shape.body == link]
        local = np.linalg.inv(layout.placement(robot, scene.bodies.index(link))) @ np.append(point, 1.0)
        k = min(range(len(shapes)), key=lambda k: _off(shapes[k], local[:3]), default=0)
        label = shapes[k].name.split("/collision/", 1)[1] if shapes else str(k)
        if any(model.name == robot.partition("::")[0] for model in layout.world.models):  # from SDF
            return f"{robot}::{link}::{label}"
        return f"{robot}::{link}::{link if label.isdigit() else label}_collision" + (f"_{k}" if k else "")
    return name


def _of_world(name: str, world: World) -> str | None:
    for model in world.models:
        for part, _, links in parts_of(model):
            if part == name:
                link, _, written = links[0]
                return f"{model.name}::{link}::{written.collisions[0].name if written.collisions else 'collision'}"
    return None
