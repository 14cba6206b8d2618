"""Entities of a world, models and robots, with the bodies and robots that the engine simulates."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from urdfkit.description.loading import load_repaired
from urdfkit.description.sdf import WorldModel, WorldRobot
from urdfkit.description.sdf.link_groups import groups_of
from urdfkit.description.urdf.geometry import IDENTITY, compose
from urdfkit.description.urdf.robot import Pose, Robot
from urdfkit.scene import MeshLoader, Scene
from urdfkit.sim.construction.repairs.collector import Repairs
from urdfkit.sim.construction.rigid_bodies import has_plugins, parts_of, scene_of_tree, surfaces_of_tree, trees_of
from urdfkit.sim.construction.start_pose import Spawn
from urdfkit.sim.engine import Body, Piece
from urdfkit.sim.state.poses import pose_from, seven
from urdfkit.sim.world.simulated_robot import SimulatedRobot


@dataclass
class WorldEntity:
    """A model or robot of the world.

    Attributes:
        source: its description; None for the simulation's own robot.
        robots: its parts that are simulated as robots.
        offsets: body or robot → pose of its frame in the model.
        static_bodies: bodies of a static robot.
        static_scene: scene of a static robot.
    """

    source: WorldModel | WorldRobot | None
    robots: tuple[SimulatedRobot, ...] = ()
    offsets: dict[str, Pose] = field(default_factory=dict)
    static_bodies: tuple[Body, ...] = ()
    static_scene: Scene | None = None


class EntityFactory:
    """Creates the entities of a world.

    Args:
        note: reports a warning to the user.
        package_path: folders that are searched first for packages.
        repairs: collects the repairs of robots.

    Attributes:
        meshes: cache of loaded meshes.
    """

    def __init__(self, note: Callable[[str], None], package_path: Sequence[str | Path], repairs: Repairs) -> None:
        self._note, self._package_path, self._repairs = note, tuple(package_path), repairs
        self.meshes = MeshLoader()

    def make(
        self,
        source: WorldModel | WorldRobot,
        robot: Robot | None,
        spawn: Spawn | None = None,
        *,
        ground: float | None = None,
        fixed_base: bool = False,
    ) -> WorldEntity:
        """Return the entity for a model or robot.

        Args:
            source: its description.
            robot: the loaded robot; None: loaded from its file.
            spawn: initial pose and velocity of a robot; None: at rest at the pose of `source`.
            ground: height of the ground below [m]; None without ground.
            fixed_base: whether a robot's root link is fixed to the world.

        Raises:
            UrdfkitError: the entity cannot be simulated; with the reason and the place.
        """
        if isinstance(source, WorldRobot):
            return self._robot_entry(
                source,
                robot or load_repaired(source.file, package_path=self._package_path),
                spawn,
                ground,
                fixed_base=fixed_base or source.static,
            )
        offsets = {name: links[0][1] for name, _, links in parts_of(source)}
        robots = []
        for tree in trees_of(source):
            start = _spawn_at(compose(source.pose, tree.root))
            robots.append(
                SimulatedRobot(
                    tree.robot,
                    name=tree.name,
                    spawn=start,
                    ground=None,
                    note=self._note,
                    fixed_base=tree.fixed_base,
                    scene=scene_of_tree(tree, self.meshes),
                    surfaces=surfaces_of_tree(tree, self._note),
                    self_collide=tree.self_collide,
                    weightless=tree.weightless,
                    is_robot=bool(tree.robot.gazebo),
                )
            )
            offsets[tree.name] = tree.root
        if source.static:
            self._warn_static(source)
        return WorldEntity(source, tuple(robots), offsets)

    def _robot_entry(
        self, source: WorldRobot, robot: Robot, spawn: Spawn | None, ground: float | None, *, fixed_base: bool
    ) -> WorldEntity:
        made = SimulatedRobot(
            robot,
            name=source.name,
            spawn=spawn or _spawn_at(source.pose),
            ground=ground,
            note=self._note,
            fixed_base=fixed_base,
            repairs=self._repairs,
        )
        if not source.static:
            return WorldEntity(source, (made,), {source.name: IDENTITY})
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
            pose = compose(source.pose, pose_from(poses[link]))
            bodies.append(Body(f"{source.name}::{link}", seven(pose), pieces, static=True))
        return WorldEntity(source, (), {}, tuple(bodies), made.scene)

    def _warn_static(self, model: WorldModel) -> None:
        if any(has_plugins(model, group) for group in groups_of(model)):
            self._note(f"{model.position}: model `{model.name}` is static: its plugins and sensors do not run")


def _spawn_at(pose: Pose) -> Spawn:
    return Spawn(*pose.xyz, *pose.rpy)
