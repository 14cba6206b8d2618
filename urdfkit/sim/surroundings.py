"""Everything there is to see and to touch around a robot, the robot included, and where it is now."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
from numpy.typing import NDArray

from urdfkit.description.world import World
from urdfkit.scene import MeshLoader, Role, Scene, Shape
from urdfkit.scene.image import Painter
from urdfkit.scene.lights import lighting_of
from urdfkit.scene.rays import RayTable, warmup
from urdfkit.scene.world import shapes_of_link
from urdfkit.sim.things import groups_of

Array = NDArray[np.float64]

BODY = "world/"
"""Goes before the names of the world's bodies: no link has a slash there."""


def world_scene(world: World) -> tuple[Scene, Array]:
    """Return the scene of a world's models, and the poses at which its bodies start; shape (bodies, 7).

    Args:
        world: as read; its bodies are called as `bodies_of` calls them, after `BODY`.

    Raises:
        ResourceError: a mesh is broken.
        SimulationError: something in it cannot be simulated, with its place.
    """
    import pinocchio as pin

    meshes = MeshLoader()
    names: list[str] = []
    shapes: list[Shape] = []
    poses: list[Array] = []
    for model in world.models:
        for name, _, links in groups_of(model):
            body, into = BODY + name, np.linalg.inv(links[0][1])
            names.append(body)
            poses.append(pin.SE3ToXYZQUAT(pin.SE3(links[0][1])))
            for link_name, pose, link in links:
                prefix = f"{link_name}/" if len(links) > 1 else ""
                shapes.extend(shapes_of_link(link, body, into @ pose, meshes=meshes, prefix=prefix))
    return Scene(tuple(names), tuple(shapes)), np.array(poses).reshape(-1, 7)


class Surroundings:
    """One scene of the robot and the world, for sensors; made when the first of them looks.

    Args:
        robot: its scene.
        world: what is around it.
        body_poses: says where the world's bodies are, by name; those it does not know stay where they started.
        note: tells the user something.
    """

    def __init__(
        self,
        robot: Scene,
        world: World,
        body_poses: Callable[[], Mapping[str, tuple[float, ...]]],
        note: Callable[[str], None],
    ) -> None:
        self._robot = robot
        self.world = world
        self._body_poses = body_poses
        self._note = note
        self._scene: Scene | None = None
        self._start = np.empty((0, 7))
        self._tables: dict[Role, RayTable] = {}
        self._painter: Painter | None = None

    @property
    def scene(self) -> Scene:
        """The robot's links, then the bodies of the world."""
        if self._scene is None:
            world, self._start = world_scene(self.world)
            self._rows = {name.removeprefix(BODY): row for row, name in enumerate(world.bodies)}
            self._scene = Scene((*self._robot.bodies, *world.bodies), (*self._robot.shapes, *world.shapes))
        return self._scene

    def poses(self, links: Array) -> Array:
        """Return where everything is now; shape (len(scene.bodies), 7).

        Args:
            links: poses of the robot's links, shape (links, 7).
        """
        count = len(links)
        found = np.empty((len(self.scene.bodies), 7))
        found[:count], found[count:] = links, self._start
        for name, pose in self._body_poses().items():
            if (row := self._rows.get(name)) is not None:
                found[count + row] = pose
        return found

    def painter(self) -> Painter:
        """Return what takes pictures of the visuals, by the lights of the world."""
        if self._painter is None:
            self._painter = Painter(self.table("visual"), lighting_of(self.world))
        return self._painter

    def table(self, role: Role) -> RayTable:
        """Return what rays meet: the visuals or the collisions."""
        if role not in self._tables:
            warmup(lambda count: None if count else self._note("compiling the ray kernels, once, about 25 s …"))
            self._tables[role] = RayTable(self.scene, self.scene.with_role(role))
        return self._tables[role]
