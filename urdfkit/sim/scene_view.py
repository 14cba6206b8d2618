"""Everything there is to see and to touch in a simulation, robots included, and where it was at a moment."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
from numpy.typing import NDArray

from urdfkit.description.sdf import World
from urdfkit.description.urdf.geometry import compose
from urdfkit.linear_algebra import inverse_placement, matmul
from urdfkit.scene import MeshLoader, Role, Scene, Shape
from urdfkit.scene.lights import lighting_of
from urdfkit.scene.placement import pose_matrices, pose_matrix
from urdfkit.scene.rays import RayTable, announcement, warmup
from urdfkit.scene.renderer import TakesPictures, check, painter_of
from urdfkit.scene.segmentation_labels import label_of
from urdfkit.scene.world_shapes import shapes_of_link
from urdfkit.sim.construction.rigid_bodies import parts_of
from urdfkit.sim.state.poses import seven

if TYPE_CHECKING:
    from urdfkit.kinematics import Kinematics
    from urdfkit.sim.state.robot_state import Snapshot, State

Array = NDArray[np.float64]

BODY = "world/"
"""Goes before the names of the world's bodies: no link has a slash there."""


class SensedRobot(Protocol):
    """The properties of a robot that sensors need, see `SimulatedRobot`."""

    @property
    def kinematics(self) -> Kinematics:
        """Its model."""
        ...

    @property
    def scene(self) -> Scene:
        """Its shapes."""
        ...

    @property
    def state(self) -> State:
        """Where it is."""
        ...


class SensedWorld(Protocol):
    """The properties of a world that sensors need, see `LiveWorld`."""

    @property
    def description(self) -> World:
        """The world as it is at present."""
        ...

    @property
    def revision(self) -> int:
        """Changes whenever something comes or goes."""
        ...

    @property
    def robots(self) -> Mapping[str, SensedRobot]:
        """By name."""
        ...

    @property
    def static_robots(self) -> tuple[tuple[str, Scene], ...]:
        """Name and scene of the robots that do not move."""
        ...

    def keep_body_poses(self) -> Callable[[], dict[str, tuple[float, ...]]]:
        """Return what tells where bodies are now, by name, also later."""
        ...

    def pushes_on(self, robot: str, links: Sequence[str]) -> tuple[tuple[Array, Array, Array], ...]:
        """Force [N], torque [N·m] and point of attack [m], in the world, of what pushes links of a robot."""
        ...


@dataclass(frozen=True, eq=False)
class Layout:
    """What there was at a moment, and where: kept cheaply, and worked out when somebody looks.

    Attributes:
        revision: of the world.
        world: its bodies.
        robots: name, scene and configuration of each robot.
        kept: returns where the world's bodies were.
        static_robots: name and scene of robots that do not move; their links are among the bodies, as ``NAME::LINK``.
    """

    revision: int
    world: World
    robots: tuple[tuple[str, Scene, Snapshot], ...]
    kept: Callable[[], Mapping[str, Sequence[float]]]
    static_robots: tuple[tuple[str, Scene], ...] = ()

    @cached_property
    def bodies(self) -> Mapping[str, Sequence[float]]:
        """Name → x y z [m] and quaternion x y z w of the world's bodies."""
        return self.kept()

    def placement(self, robot: str, link: int) -> Array:
        """Return where a link was; shape (4, 4)."""
        poses = next(moment.link_poses() for name, _, moment in self.robots if name == robot)
        found: Array = pose_matrices(poses[link])[0]
        return found


def world_scene(world: World, note: Callable[[str], None] | None = None) -> tuple[Scene, Array]:
    """Return the scene of a world's bodies, and the poses at which they start; shape (bodies, 7).

    Args:
        world: as read; its bodies are called as `bodies_of` calls them, after `BODY`.
        note: tells the user of visuals whose mesh is broken, which are left out then.

    Raises:
        ResourceError: a mesh is broken.
    """
    meshes = MeshLoader()
    names: list[str] = []
    shapes: list[Shape] = []
    poses: list[Any] = []
    for model in world.models:
        for name, _, links in parts_of(model):
            body, into = BODY + name, inverse_placement(pose_matrix(links[0][1]))
            names.append(body)
            poses.append(seven(compose(model.pose, links[0][1])))
            for link_name, pose, link in links:
                prefix = f"{link_name}/" if len(links) > 1 else ""
                placed = matmul(into, pose_matrix(pose))
                label = label_of(model.plugins)
                shapes += shapes_of_link(link, body, placed, meshes=meshes, prefix=prefix, label=label, note=note)
    return Scene(tuple(names), tuple(shapes)), np.array(poses, dtype=float).reshape(-1, 7)


class View:
    """One scene of everything, ready for rays and pictures; made once for as long as nothing comes or goes.

    Args:
        layout: what there is.
        note: tells the user something.
        renderer: who takes pictures.
    """

    def __init__(self, layout: Layout, note: Callable[[str], None], renderer: str = "ray") -> None:
        world, self._start = world_scene(layout.world, note)
        self._names = [name.removeprefix(BODY) for name in world.bodies]
        bodies: list[str] = []
        shapes: list[Shape] = []
        for robot, scene, _ in layout.robots:
            bodies += [f"{robot}::{link}" for link in scene.bodies]
            shapes += [_of(robot, shape) for shape in scene.shapes]
        links = [f"{name}::{link}" for name, scene in layout.static_robots for link in scene.bodies]
        self._names += links
        self._start = np.vstack([self._start, np.tile([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0], (len(links), 1))])
        shapes += [_of(BODY + name, shape) for name, scene in layout.static_robots for shape in scene.shapes]
        still = (BODY + link for link in links)
        self.scene = Scene((*bodies, *world.bodies, *still), (*shapes, *world.shapes))
        self._lighting = lighting_of(layout.world)
        self._note = note
        self._tables: dict[Role, RayTable] = {}
        self._renderer = renderer
        self._painter: TakesPictures | None = None

    def poses(self, layout: Layout) -> Array:
        """Return where everything was; shape (len(scene.bodies), 7)."""
        rows = [layout.bodies.get(name, start) for name, start in zip(self._names, self._start.tolist(), strict=True)]
        links = (moment.link_poses() for _, _, moment in layout.robots)
        return np.vstack([*links, np.array(rows, dtype=float).reshape(-1, 7)])

    def table(self, role: Role, layout: Layout) -> RayTable:
        """Return what rays meet, the visuals or the collisions, where it was."""
        if role not in self._tables:
            warmup(lambda count: None if count else self._note(announcement()))
            self._tables[role] = RayTable(self.scene, self.scene.with_role(role))
        table = self._tables[role]
        table.place(self.poses(layout))
        return table

    def painter(self, layout: Layout) -> TakesPictures:
        """Return what takes pictures of the visuals where they were, by the lights of the world."""
        table = self.table("visual", layout)
        if self._painter is None:
            for shape in self.scene.with_role("visual"):
                for name in shape.mesh.missing if shape.mesh is not None and not shape.has_color else ():
                    place = f"{shape.position}: " if shape.position else ""
                    broken = shape.mesh is not None and name in shape.mesh.broken
                    why = "is no picture that can be read" if broken else "is not there"
                    self._note(f"{place}`{shape.name}` is seen without its texture: `{name}` {why}")
            self._painter = painter_of(table, self._lighting, self._renderer, self._note)
        return self._painter


class Surroundings:
    """Scene of a simulation for its sensors.

    Args:
        world: its entities.
        note: tells the user something.
        renderer: who takes pictures, one of `RENDERERS`.

    Raises:
        SimulationError: there is no such renderer here.
    """

    def __init__(self, world: SensedWorld, note: Callable[[str], None], renderer: str = "ray") -> None:
        check(renderer, note=note)
        self._renderer = renderer
        self._world = world
        self._note = note
        self._view: tuple[int, View] | None = None

    @property
    def world(self) -> World:
        """The world as it is at present."""
        return self._world.description

    @property
    def robots(self) -> Mapping[str, SensedRobot]:
        """The robots by name."""
        return self._world.robots

    def pushes_on(self, robot: str, links: Sequence[str]) -> tuple[tuple[Array, Array, Array], ...]:
        """Return force [N], torque [N·m] and point of attack [m], in the world, of what pushes links of a robot."""
        return self._world.pushes_on(robot, links)

    @property
    def was_looked_at(self) -> bool:
        """Whether anybody has looked so far."""
        return self._view is not None

    def layout(self) -> Layout:
        """Return what there is now, and where."""
        here = self._world
        robots = tuple((name, each.scene, each.state.snapshot()) for name, each in here.robots.items())
        return Layout(here.revision, here.description, robots, here.keep_body_poses(), here.static_robots)

    def view(self, layout: Layout) -> View:
        """Return the scene of a layout."""
        if self._view is None or self._view[0] != layout.revision:
            self._view = layout.revision, View(layout, self._note, self._renderer)
        return self._view[1]


def _of(robot: str, shape: Shape) -> Shape:
    return replace(shape, name=f"{robot}::{shape.name}", body=f"{robot}::{shape.body}")
