"""Assembly: everything in a simulation, and the engine made of it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

from urdfkit.description.sdf import World, WorldModel, WorldRobot, add_model, remove_model
from urdfkit.description.sdf.poses import IDENTITY
from urdfkit.description.urdf.robot import Robot
from urdfkit.errors import SimulationError, UnknownNameError
from urdfkit.scene import Scene
from urdfkit.sim.construction.missing_meshes import without_broken
from urdfkit.sim.construction.rigid_bodies import bodies_of_model, require_no_joints
from urdfkit.sim.construction.spawn import Spawn
from urdfkit.sim.engine import Body, Engine, Ground, Loose
from urdfkit.sim.engine.kernel_cache import announcement, warmup
from urdfkit.sim.state.arguments import nearest
from urdfkit.sim.world.included_models import Entries, Entry
from urdfkit.sim.world.simulated_robot import SimulatedRobot, ground_height
from urdfkit.sim.world.state_transfer import Made, carry_over


class Assembly:
    """The robots and bodies of a world, and the engine that is made of them; made anew when something comes or goes.

    Args:
        first: the robot that the simulation is about.
        world: where it is.
        dt: length of a step [s].
        sleep: whether what is at rest may sleep.
        note: tells the user something.
        package_path: folders to look for packages in.

    Raises:
        UrdfkitError: something in the world cannot be simulated.

    Attributes:
        world: as it was read, with what was added and without what was removed.
        engine: what moves everything.
        revision: how often it was made anew.
        still: body → pose, of those that do not move.
    """

    engine: Engine
    still: dict[str, tuple[float, ...]]
    _robots: list[SimulatedRobot]
    _bodies: list[Body]
    _made: Made

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
        self._make = Entries(note, package_path)
        models = tuple([without_broken(model, self._make.meshes, note) for model in world.models])
        self.world = world = replace(world, models=models)
        self._entries: dict[str, Entry] = {first.name: Entry(None, (first,), {first.name: IDENTITY})}
        things: list[WorldModel | WorldRobot] = [*world.models, *world.robots]
        for thing in things:
            if thing.name == first.name:
                raise SimulationError(
                    f"the world has a model `{thing.name}` already; give the robot another name",
                    position=thing.position,
                )
            self._entries[thing.name] = self._entry(thing)
        self._build()

    # What there is

    @property
    def robots(self) -> dict[str, SimulatedRobot]:
        """Robots by name, the first one first."""
        return {robot.name: robot for entry in self._entries.values() for robot in entry.robots}

    @property
    def everybody(self) -> Sequence[SimulatedRobot]:
        """The robots, the first one first."""
        return self._robots

    @property
    def statues(self) -> tuple[tuple[str, Scene], ...]:
        """Name and scene of each robot that does not move; its links are bodies called ``NAME::LINK``."""
        return tuple((name, entry.statue) for name, entry in self._entries.items() if entry.statue is not None)

    @property
    def names(self) -> tuple[str, ...]:
        """The models and robots, the first robot first."""
        return tuple(self._entries)

    @property
    def ground(self) -> Ground | None:
        """What the engine stands on."""
        found = self.world.ground
        return None if found is None else Ground(found.height, found.mu, found.name)

    @property
    def loose(self) -> dict[str, Loose]:
        """The bodies that are free to move."""
        return self.engine.bodies

    def body(self, name: str) -> Body:
        """Return a body as the engine was given it.

        Raises:
            SimulationError: there is none.
        """
        found = next((body for body in self._bodies if body.name == name), None)
        if found is None:
            raise UnknownNameError(f"no body `{name}` in the world{nearest(name, self.body_names)}")
        return found

    @property
    def body_names(self) -> tuple[str, ...]:
        """The bodies, free ones or not."""
        return tuple(body.name for body in self._bodies)

    def entry(self, name: str) -> Entry:
        """Return a model or robot.

        Raises:
            SimulationError: there is none.
        """
        if name not in self._entries:
            hint = nearest(name, self._entries)
            raise UnknownNameError(f"no model or robot `{name}` in world `{self.world.name}`{hint}")
        return self._entries[name]

    # Coming and going

    def add(
        self,
        thing: WorldModel | WorldRobot,
        robot: Robot | None = None,
        spawn: Spawn | None = None,
        *,
        bolted: bool = False,
    ) -> Entry:
        """Put a model or robot into the world, where it says.

        Args:
            thing: what to add; its name must be free.
            robot: as loaded; from the file of `thing` when None.
            spawn: how a robot starts; at rest where `thing` says when None.
            bolted: bolt a robot's root link to the world.

        Raises:
            UrdfkitError: the name is taken, or it cannot be simulated.
        """
        if thing.name in self._entries:
            free = next(n for k in range(1, 10_000) if (n := f"{thing.name}_{k}") not in self._entries)
            raise SimulationError(f"world `{self.world.name}` has a `{thing.name}` already; call it `{free}`")
        world = self.world
        if isinstance(thing, WorldModel):
            thing = without_broken(thing, self._make.meshes, self._note)
            self.world = add_model(world, thing)
        else:
            self.world = replace(world, robots=(*world.robots, thing))
        try:
            self._entries[thing.name] = self._entry(thing, robot, spawn, bolted=bolted)
            self._build()
        except BaseException:
            self.world = world
            self._entries.pop(thing.name, None)
            raise
        return self._entries[thing.name]

    def remove(self, name: str) -> None:
        """Take a model or robot out of the world.

        Raises:
            SimulationError: there is none, or it is the robot that the simulation is about.
        """
        entry = self.entry(name)
        if entry.thing is None:
            raise SimulationError(f"`{name}` is the robot that is simulated; it cannot be removed")
        self.world = remove_model(self.world, name)
        del self._entries[name]
        for robot in entry.robots:
            robot.retire()
        self._build()

    def _entry(
        self,
        thing: WorldModel | WorldRobot,
        robot: Robot | None = None,
        spawn: Spawn | None = None,
        bolted: bool = False,
    ) -> Entry:
        return self._make.entry(thing, robot, spawn, ground=ground_height(self.ground), bolted=bolted)

    def rebuild(self) -> None:
        """Make the engine anew of the same things, whose properties have changed."""
        revision = self.revision
        self._build()
        self.revision = revision  # nobody who looks has to look anew

    def _build(self) -> None:
        """Make the engine anew, and bring it to where the last one was."""
        ground = self.ground
        robots = [robot for entry in self._entries.values() for robot in entry.robots]
        bodies: list[Body] = []
        for entry in self._entries.values():
            bodies += entry.still
            if isinstance(entry.thing, WorldModel):
                is_ground = ground is not None and entry.thing.name == ground.name
                bodies += bodies_of_model(entry.thing, self._make.meshes, is_ground=is_ground)
        first = robots[0]
        together = bool(bodies or robots[1:] or first.self_collide)
        about = announcement(world=together)
        warmup(lambda count: None if count else self._note(about), world=together)
        engine = Engine(
            first.kinematics,
            first.shapes,
            dt=self._dt,
            gravity=self.world.gravity,
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
        made = Made([*names, *(f"body {name}" for name in free)], [*names, *(f"body {each.name}" for each in bodies)])
        for robot, part in zip(robots, engine.robots, strict=True):
            known = hasattr(robot, "part")
            robot.attach(engine, part)
            if not known:
                part.put(*robot.spawn.configuration(robot.kinematics, robot.base))
        if self.revision:
            carry_over(self.engine, self._made, engine, made)
        for robot in robots:
            robot.state.step = engine.steps
            robot.state.advance(0)
        self.engine, self._made, self._bodies, self._robots = engine, made, bodies, robots
        self.still = {body.name: tuple(body.pose) for body in bodies if body.static}
        self.revision += 1
