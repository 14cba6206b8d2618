"""Scene of a simulation, with all robots and bodies, and their poses at a moment."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from threading import Lock
from typing import Any, Protocol

import numpy as np

from urdfkit.description.sdf import World
from urdfkit.description.urdf.geometry import compose
from urdfkit.kinematics import Kinematics
from urdfkit.linear_algebra import Array, inverse_placement, matmul
from urdfkit.notice import Notice
from urdfkit.scene import MeshLoader, Role, Scene, Shape
from urdfkit.scene.lights import lighting_of
from urdfkit.scene.placeholders import textures
from urdfkit.scene.pose_matrices import pose_matrices, pose_matrix
from urdfkit.scene.rays import RayTable, announcement, warmup
from urdfkit.scene.renderer import ImageRenderer, check, renderer_of
from urdfkit.scene.segmentation_labels import label_of
from urdfkit.scene.world_shapes import shapes_of_link
from urdfkit.sim.construction.rigid_bodies import parts_of
from urdfkit.sim.state.configuration_snapshot import Snapshot
from urdfkit.sim.state.poses import seven
from urdfkit.sim.state.robot_state import State

BODY = "world/"
"""Prefix for the names of the world's bodies; names of links contain no slash."""


class SensedRobot(Protocol):
    """The properties of a robot that sensors need, see `SimulatedRobot`."""

    @property
    def kinematics(self) -> Kinematics:
        """Kinematic model."""
        ...

    @property
    def scene(self) -> Scene:
        """Shapes."""
        ...

    @property
    def state(self) -> State:
        """Positions and velocities."""
        ...


class SensedWorld(Protocol):
    """The properties of a world that sensors need, see `LiveWorld`."""

    @property
    def description(self) -> World:
        """Present description of the world."""
        ...

    @property
    def revision(self) -> int:
        """Number that changes when an entity is spawned or removed."""
        ...

    @property
    def robots(self) -> Mapping[str, SensedRobot]:
        """Robots by name."""
        ...

    @property
    def static_robots(self) -> tuple[tuple[str, Scene], ...]:
        """Name and scene of each static robot."""
        ...

    def keep_body_poses(self) -> Callable[[], dict[str, tuple[float, ...]]]:
        """Return a function that returns the poses of bodies at this moment, also later."""
        ...

    def pushes_on(self, robot: str, links: Sequence[str]) -> tuple[tuple[Array, Array, Array], ...]:
        """Force [N], torque [N·m] and point of attack [m], in world axes, of each push on links of a robot."""
        ...


@dataclass(frozen=True, eq=False)
class Layout:
    """Entities at a moment and their poses, which are computed when they are needed.

    Attributes:
        revision: revision of the world.
        world: description of the world, with its bodies.
        robots: name, scene and configuration of each robot.
        kept: returns the poses of the world's bodies.
        static_robots: name and scene of static robots; their links are bodies named ``NAME::LINK``.
    """

    revision: int
    world: World
    robots: tuple[tuple[str, Scene, Snapshot], ...]
    kept: Callable[[], Mapping[str, Sequence[float]]]
    static_robots: tuple[tuple[str, Scene], ...] = ()

    @cached_property
    def bodies(self) -> Mapping[str, Sequence[float]]:
        """Name → x y z [m] and quaternion x y z w of each body."""
        return self.kept()

    def compute(self) -> None:
        """Compute the poses now, in the thread of the simulation, so that other threads can use the layout."""
        for _, _, moment in self.robots:
            moment.link_poses()
        _ = self.bodies

    def placement(self, robot: str, link: int) -> Array:
        """Return the pose of a link; shape (4, 4)."""
        poses = next(moment.link_poses() for name, _, moment in self.robots if name == robot)
        found: Array = pose_matrices(poses[link])[0]
        return found


def world_scene(world: World, note: Callable[[str], None] | None = None) -> tuple[Scene, Array]:
    """Return the scene of a world's bodies, and their initial poses; shape (bodies, 7).

    Args:
        world: the loaded world; its bodies have their names in the simulation, after `BODY`.
        note: reports visuals with an invalid mesh, which are omitted.

    Raises:
        ResourceError: a mesh is invalid and cannot be omitted.
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
    """Scene of all entities for rays and pictures; created once per revision of the world.

    Args:
        layout: the entities.
        note: reports a warning to the user.
        renderer: one of `RENDERERS`.
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
        self._image_renderer: ImageRenderer | None = None

    def poses(self, layout: Layout) -> Array:
        """Return the poses of all bodies; shape (len(scene.bodies), 7)."""
        rows = [layout.bodies.get(name, start) for name, start in zip(self._names, self._start.tolist(), strict=True)]
        links = (moment.link_poses() for _, _, moment in layout.robots)
        return np.vstack([*links, np.array(rows, dtype=float).reshape(-1, 7)])

    def table(self, role: Role, layout: Layout) -> RayTable:
        """Return the table for rays against the visuals or the collisions, at their poses in a layout."""
        if role not in self._tables:
            warmup(lambda count: None if count else self._note(Notice(announcement(), "progress")))
            self._tables[role] = RayTable(self.scene, self.scene.with_role(role))
        table = self._tables[role]
        table.place(self.poses(layout))
        return table

    def renderer(self, layout: Layout) -> ImageRenderer:
        """Return the renderer of the visuals, at their poses in a layout, with the lights of the world."""
        table = self.table("visual", layout)
        if self._image_renderer is None:
            for repair in textures(self.scene):
                self._note(str(repair))
            self._image_renderer = renderer_of(table, self._lighting, self._renderer, self._note)
        return self._image_renderer


class Surroundings:
    """Scene of a simulation for its sensors.

    Args:
        world: its entities.
        note: reports a warning to the user.
        renderer: one of `RENDERERS`.

    Raises:
        SimulationError: the renderer is not available.

    Attributes:
        lock: held while a thread uses a view.
    """

    def __init__(self, world: SensedWorld, note: Callable[[str], None], renderer: str = "ray") -> None:
        check(renderer, note=note)
        self._renderer = renderer
        self._world = world
        self._note = note
        self._view: tuple[int, View] | None = None
        self.lock = Lock()

    @property
    def world(self) -> World:
        """Present description of the world."""
        return self._world.description

    @property
    def robots(self) -> Mapping[str, SensedRobot]:
        """The robots by name."""
        return self._world.robots

    def pushes_on(self, robot: str, links: Sequence[str]) -> tuple[tuple[Array, Array, Array], ...]:
        """Return force [N], torque [N·m] and point of attack [m], in world axes, of each push on links of a robot."""
        return self._world.pushes_on(robot, links)

    @property
    def is_used(self) -> bool:
        """Whether a view was created."""
        return self._view is not None

    def layout(self) -> Layout:
        """Return the present layout."""
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
