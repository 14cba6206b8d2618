"""Models and robots of a world, as they are simulated: bodies, and robots."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from urdfkit.description.sdf import WorldModel, WorldRobot
from urdfkit.description.sdf.model_as_robot import groups_of
from urdfkit.description.sdf.poses import IDENTITY, compose
from urdfkit.description.urdf.robot import Pose, Robot
from urdfkit.scene import MeshLoader, Scene
from urdfkit.sim.construction.loading import load_robot
from urdfkit.sim.construction.rigid_bodies import has_plugins, parts_of, scene_of_tree, surfaces_of_tree, trees_of
from urdfkit.sim.construction.spawn import Spawn
from urdfkit.sim.engine import Body, Piece
from urdfkit.sim.state.poses import pose_from, seven
from urdfkit.sim.world.simulated_robot import SimulatedRobot


@dataclass
class Entry:
    """A model or robot of the world.

    Attributes:
        thing: as written; None for the robot that the simulation is about.
        robots: what of it is simulated as robots are.
        offsets: body or robot → pose of its frame in the model.
        still: shapes of a robot that does not move, as bodies.
        statue: the scene of a robot that does not move.
    """

    thing: WorldModel | WorldRobot | None
    robots: tuple[SimulatedRobot, ...] = ()
    offsets: dict[str, Pose] = field(default_factory=dict)
    still: tuple[Body, ...] = ()
    statue: Scene | None = None


class Entries:
    """Makes them.

    Args:
        note: tells the user something.
        package_path: folders to look for packages in.

    Attributes:
        meshes: what has been read so far.
    """

    def __init__(self, note: Callable[[str], None], package_path: Sequence[str | Path]) -> None:
        self._note, self._package_path = note, tuple(package_path)
        self.meshes = MeshLoader()

    def entry(
        self,
        thing: WorldModel | WorldRobot,
        robot: Robot | None,
        spawn: Spawn | None = None,
        *,
        ground: float | None = None,
        bolted: bool = False,
    ) -> Entry:
        """Return what a model or robot of the world is simulated as.

        Args:
            thing: as written.
            robot: as loaded; from its file when None.
            spawn: how a robot starts; at rest where `thing` says when None.
            ground: height of what is below it [m]; None for nothing.
            bolted: bolt a robot's root link to the world.

        Raises:
            UrdfkitError: it cannot be simulated; says why and where.
        """
        if isinstance(thing, WorldRobot):
            return self._robot_entry(
                thing, robot or load_robot(thing.file, self._package_path), spawn, ground, bolted=bolted or thing.static
            )
        offsets = {name: links[0][1] for name, _, links in parts_of(thing)}
        robots = []
        for tree in trees_of(thing):
            start = _spawn_at(compose(thing.pose, tree.root))
            robots.append(
                SimulatedRobot(
                    tree.robot,
                    name=tree.name,
                    spawn=start,
                    ground=None,
                    note=self._note,
                    bolted=tree.bolted,
                    scene=scene_of_tree(tree, self.meshes),
                    surfaces=surfaces_of_tree(tree, self._note),
                    self_collide=tree.self_collide,
                    weightless=tree.weightless,
                    is_robot=bool(tree.robot.gazebo),
                )
            )
            offsets[tree.name] = tree.root
        if thing.static:
            self._remark_still(thing)
        return Entry(thing, tuple(robots), offsets)

    def _robot_entry(
        self, thing: WorldRobot, robot: Robot, spawn: Spawn | None, ground: float | None, *, bolted: bool
    ) -> Entry:
        made = SimulatedRobot(
            robot,
            name=thing.name,
            spawn=spawn or _spawn_at(thing.pose),
            ground=ground,
            note=self._note,
            bolted=bolted,
        )
        if not thing.static:
            return Entry(thing, (made,), {thing.name: IDENTITY})
        poses = dict(
            zip(made.kinematics.link_names, made.kinematics.link_poses(made.kinematics.neutral()), strict=True)
        )
        bodies = []
        for link in made.scene.bodies:
            pieces = tuple(
                Piece(shape, made.surfaces.get(link, Piece(shape).surface))
                for shape in made.shapes
                if shape.body == link
            )
            pose = compose(thing.pose, pose_from(poses[link]))
            bodies.append(Body(f"{thing.name}::{link}", seven(pose), pieces, static=True))
        return Entry(thing, (), {}, tuple(bodies), made.scene)

    def _remark_still(self, model: WorldModel) -> None:
        if any(has_plugins(model, group) for group in groups_of(model)):
            self._note(f"{model.position}: model `{model.name}` is static: its plugins and sensors do not run")


def _spawn_at(pose: Pose) -> Spawn:
    return Spawn(*pose.xyz, *pose.rpy)
