"""Builder of a world: its entities, and the engine that simulates them."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

from urdfkit.description.sdf import World, WorldModel, WorldRobot, add_model, remove_model
from urdfkit.description.urdf.geometry import IDENTITY
from urdfkit.description.urdf.robot import Robot
from urdfkit.errors import SimulationError, UnknownNameError
from urdfkit.notice import Notice
from urdfkit.scene import Scene
from urdfkit.sim.construction.missing_meshes import without_broken
from urdfkit.sim.construction.rigid_bodies import bodies_of_model, require_no_joints
from urdfkit.sim.construction.start_pose import Spawn
from urdfkit.sim.engine import Body, Engine, FreeBody, Ground
from urdfkit.sim.engine.kernel_cache import announcement, warmup
from urdfkit.sim.state.arguments import nearest
from urdfkit.sim.world.simulated_robot import SimulatedRobot, ground_height
from urdfkit.sim.world.state_transfer import EngineLayout, transfer_state
from urdfkit.sim.world.world_entity import EntityFactory, WorldEntity


class WorldBuilder:
    """Entities of a world, and the engine built from them; built again after every spawn or removal.

    Args:
        first: the simulation's own robot.
        world: description of the world.
        dt: length of a step [s].
        sleep: whether bodies at rest may sleep.
        note: reports a warning to the user.
        package_path: folders that are searched first for packages.

    Raises:
        UrdfkitError: an entity cannot be simulated.

    Attributes:
        description: the loaded world, including spawned and excluding removed entities.
        engine: the engine.
        revision: number of builds after a change of the entities.
        static_poses: name → pose of the static bodies.
    """

    engine: Engine
    static_poses: dict[str, tuple[float, ...]]
    _robots: list[SimulatedRobot]
    _bodies: list[Body]
    _layout: EngineLayout

    def __init__(
        self,
        first: SimulatedRobot,
        world: World,
        *,
        dt: float,
        note: Callable[[str], None],
        package_path: Sequence[str | Path] = (),
        sleep: bool = True,
    ) -> None:
        require_no_joints(world)
        self.revision = 0
        self._dt, self._sleep, self._note = dt, sleep, note
        self._factory = EntityFactory(note, package_path, first.repairs)
        models = tuple([without_broken(model, self._factory.meshes, note) for model in world.models])
        self.description = world = replace(world, models=models)
        self.entities: dict[str, WorldEntity] = {first.name: WorldEntity(None, (first,), {first.name: IDENTITY})}
        sources: list[WorldModel | WorldRobot] = [*world.models, *world.robots]
        for source in sources:
            if source.name == first.name:
                message = f"the world already has a model `{source.name}`; use another name for the robot"
                raise SimulationError(message, position=source.position)
            self.entities[source.name] = self._make(source)
        self.build()

    @property
    def robots(self) -> dict[str, SimulatedRobot]:
        """Robots by name, the first one first."""
        return {robot.name: robot for entity in self.entities.values() for robot in entity.robots}

    @property
    def robot_list(self) -> Sequence[SimulatedRobot]:
        """The robots, the first one first."""
        return self._robots

    @property
    def static_robots(self) -> tuple[tuple[str, Scene], ...]:
        """Name and scene of each static robot; its links are bodies named ``NAME::LINK``."""
        return tuple(
            (name, entity.static_scene) for name, entity in self.entities.items() if entity.static_scene is not None
        )

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the models and robots, the simulation's own robot first."""
        return tuple(self.entities)

    @property
    def ground(self) -> Ground | None:
        """Ground plane of the engine; None without ground."""
        found = self.description.ground
        return None if found is None else Ground(found.height, found.mu, found.name)

    @property
    def free_bodies(self) -> dict[str, FreeBody]:
        """Free bodies by name."""
        return self.engine.bodies

    def body(self, name: str) -> Body:
        """Return the description of a body.

        Raises:
            SimulationError: unknown body.
        """
        found = next((body for body in self._bodies if body.name == name), None)
        if found is None:
            raise UnknownNameError(f"no body `{name}` in the world{nearest(name, self.body_names)}")
        return found

    @property
    def body_names(self) -> tuple[str, ...]:
        """Names of all bodies."""
        return tuple(body.name for body in self._bodies)

    def entity(self, name: str) -> WorldEntity:
        """Return a model or robot.

        Raises:
            SimulationError: unknown entity.
        """
        if name not in self.entities:
            hint = nearest(name, self.entities)
            raise UnknownNameError(f"no model or robot `{name}` in world `{self.description.name}`{hint}")
        return self.entities[name]

    def add(
        self,
        source: WorldModel | WorldRobot,
        robot: Robot | None = None,
        spawn: Spawn | None = None,
        *,
        fixed_base: bool = False,
    ) -> WorldEntity:
        """Add a model or robot at the pose of its description.

        Args:
            source: the entity; its name must be unused.
            robot: the loaded robot; None: loaded from the file of `source`.
            spawn: initial pose and velocity of a robot; None: at rest at the pose of `source`.
            fixed_base: whether a robot's root link is fixed to the world.

        Raises:
            UrdfkitError: the name is in use, or the entity cannot be simulated.
        """
        if source.name in self.entities:
            free = next(n for k in range(1, 10_000) if (n := f"{source.name}_{k}") not in self.entities)
            raise SimulationError(f"world `{self.description.name}` already has a `{source.name}`; use `{free}`")
        world = self.description
        if isinstance(source, WorldModel):
            source = without_broken(source, self._factory.meshes, self._note)
            self.description = add_model(world, source)
        else:
            self.description = replace(world, robots=(*world.robots, source))
        try:
            self.entities[source.name] = self._make(source, robot, spawn, fixed_base=fixed_base)
            self.build()
        except BaseException:
            self.description = world
            self.entities.pop(source.name, None)
            raise
        return self.entities[source.name]

    def remove(self, name: str) -> None:
        """Remove a model or robot.

        Raises:
            SimulationError: unknown entity, or the simulation's own robot.
        """
        entity = self.entity(name)
        if entity.source is None:
            raise SimulationError(f"`{name}` is the simulation's own robot; it cannot be removed")
        self.description = remove_model(self.description, name)
        del self.entities[name]
        for robot in entity.robots:
            robot.retire()
        self.build()

    def _make(
        self,
        source: WorldModel | WorldRobot,
        robot: Robot | None = None,
        spawn: Spawn | None = None,
        fixed_base: bool = False,
    ) -> WorldEntity:
        return self._factory.make(source, robot, spawn, ground=ground_height(self.ground), fixed_base=fixed_base)

    def rebuild(self) -> None:
        """Build the engine again after a change of properties."""
        revision = self.revision
        self.build()
        self.revision = revision  # the set of entities is the same

    def build(self) -> None:
        """Build the engine and transfer the state of the previous one."""
        ground = self.ground
        robots = [robot for entity in self.entities.values() for robot in entity.robots]
        bodies: list[Body] = []
        for entity in self.entities.values():
            bodies += entity.static_bodies
            if isinstance(entity.source, WorldModel):
                is_ground = ground is not None and entity.source.name == ground.name
                bodies += bodies_of_model(entity.source, self._factory.meshes, is_ground=is_ground)
        first = robots[0]
        together = bool(bodies or robots[1:] or first.self_collide)
        about = Notice(announcement(world=together), "progress")
        warmup(lambda count: None if count else self._note(about), world=together)
        engine = Engine(
            first.kinematics,
            first.shapes,
            dt=self._dt,
            gravity=self.description.gravity,
            ground=ground,
            surfaces=first.surfaces,
            base=first.base.tolist(),
            self_collide=first.self_collide,
            weightless=first.weightless,
            others=[robot.member for robot in robots[1:]],
            bodies=bodies,
            sleep=self._sleep,
        )
        free = [body.name for body in bodies if not body.static]
        names = [f"robot {robot.name}" for robot in robots]
        made = EngineLayout(
            [*names, *(f"body {name}" for name in free)], [*names, *(f"body {each.name}" for each in bodies)]
        )
        for robot, articulation in zip(robots, engine.robots, strict=True):
            is_new = not hasattr(robot, "articulation")
            robot.attach(engine, articulation)
            if is_new:
                articulation.put(*robot.start())
        if self.revision:
            transfer_state(self.engine, self._layout, engine, made)
        for robot in robots:
            robot.state.step = engine.steps
            robot.state.advance(0)
        self.engine, self._layout, self._bodies, self._robots = engine, made, bodies, robots
        self.static_poses = {body.name: tuple(body.pose) for body in bodies if body.static}
        self.revision += 1
