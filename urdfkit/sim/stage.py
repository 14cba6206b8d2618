"""Stage: everything in the simulation and the engine that moves it, made anew when something comes or goes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from urdfkit.description.robot import Pose, Robot
from urdfkit.description.world import World, WorldModel, WorldRobot, add_model, remove_model
from urdfkit.description.world.poses import IDENTITY, compose, inverse
from urdfkit.errors import SimulationError, UnknownNameError
from urdfkit.sim.carry import Made, carry_over
from urdfkit.sim.engine import Body, Engine, Ground, Loose
from urdfkit.sim.engine.engine import Provider
from urdfkit.sim.engine.warmup import announcement, warmup
from urdfkit.sim.entries import Entries, Entry
from urdfkit.sim.given import nearest, vector
from urdfkit.sim.placing import pose_from, seven
from urdfkit.sim.pushes import Pushes
from urdfkit.sim.simulated import SimulatedRobot, ground_height
from urdfkit.sim.spawn import Spawn
from urdfkit.sim.things import bodies_of_model, require_no_joints

AT_REST = (0.0,) * 6


class Stage:
    """The robots and bodies of a world, and the engine.

    Args:
        first: the robot that the simulation is about.
        world: where it is.
        dt: length of a step [s].
        provider: who computes the dynamics.
        sleep: whether what is at rest may sleep.
        note: tells the user something.
        package_path: folders to look for packages in.

    Raises:
        UrdfkitError: something in the world cannot be simulated.

    Attributes:
        world: as it was read, with what was added and without what was removed.
        engine: what moves everything.
        robots: name → robot, `first` first; trees of links and joints of models too.
        pushes: what pushes at present.
        revision: how often the stage was made anew.
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
        provider: Provider,
        note: Callable[[str], None],
        package_path: Sequence[str | Path] = (),
        sleep: bool = True,
    ) -> None:
        require_no_joints(world)
        self.world = world
        self.pushes = Pushes()
        self.revision = 0
        self._dt, self._provider, self._sleep, self._note = dt, provider, sleep, note
        self._make = Entries(note, package_path)
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
        gone = {id(robot) for robot in entry.robots}
        self.pushes.forget(lambda target: (id(target[0]) in gone) if target[0] else target[1] in entry.offsets)
        self.world = remove_model(self.world, name)
        del self._entries[name]
        for robot in entry.robots:
            robot.retire()
        self._build()

    def move(self, name: str, pose: Pose, twist: Sequence[float] = AT_REST) -> None:
        """Put a model or robot somewhere, its parts as they are to each other, moving as one.

        Args:
            name: of a model, robot or body.
            pose: of the model's frame, or of a robot's root link.
            twist: velocity of that frame's origin [m/s] and angular velocity [rad/s], along the world's axes.

        Raises:
            SimulationError: there is none, or a robot that is bolted down is to move.
        """
        speed = np.array(vector(twist, 6, "the velocity", "m/s, rad/s"))
        if name not in self._entries and name in self.body_names:
            self.move_body(name, pose, twist)
            return
        entry = self.entry(name)
        shift = compose(pose, inverse(self.pose_of(name)))
        if self._stands(entry):
            if speed.any():
                raise SimulationError(f"`{name}` is static: it can be put elsewhere, but not be given a velocity")
            self._move_still(name, entry, pose, shift)
            return
        for part in entry.offsets:
            self._put(entry, part, compose(shift, self._part_pose(entry, part)), pose, speed)

    def move_body(self, name: str, pose: Pose, twist: Sequence[float] = AT_REST) -> None:
        """Put one body somewhere.

        Args:
            name: of the body.
            pose: in the world.
            twist: see `move`.

        Raises:
            SimulationError: there is none, or it is part of a model that does not move.
        """
        self.body(name)
        if name in self.loose:
            self.loose[name].place(seven(pose), vector(twist, 6, "the velocity", "m/s, rad/s"))
        elif name in self._entries:
            self.move(name, compose(pose, inverse(self._entries[name].offsets[name])), twist)
        else:
            raise SimulationError(f"body `{name}` does not move; place the model that it belongs to")

    def pose_of(self, name: str) -> Pose:
        """Return where the frame of a model, or the root link of a robot, is in the world."""
        entry = self.entry(name)
        if self._stands(entry):
            assert entry.thing is not None
            return entry.thing.pose
        part, offset = next(iter(entry.offsets.items()))
        return compose(self._part_pose(entry, part), inverse(offset))

    @property
    def names(self) -> tuple[str, ...]:
        """The models and robots, the first robot first."""
        return tuple(self._entries)

    def twist_of(self, name: str) -> tuple[float, ...]:
        """Return velocity [m/s] of the origin of a model's frame, or a robot's root link, and angular velocity [rad/s].

        They are along the world's axes.
        """
        entry = self.entry(name)
        if self._stands(entry):
            return AT_REST
        part, offset = next(iter(entry.offsets.items()))
        robot = next((each for each in entry.robots if each.name == part), None)
        found = np.array(
            robot.state.base_velocity if robot else self.loose[part].twist if part in self.loose else AT_REST
        )
        if offset != IDENTITY:
            back = np.array(self.pose_of(name).xyz) - np.array(self._part_pose(entry, part).xyz)
            found[:3] += np.cross(found[3:], back)
        return tuple(found.tolist())

    def advance(self, steps: int) -> None:
        """Advance by so many steps, and take note in every robot's state.

        Raises:
            SimulationError: the simulation diverged.
        """
        left = steps
        while left > 0 and self.pushes:
            self.pushes.step(self.engine)
            left -= 1
        if left:
            self.engine.step(left)
        for robot in self._robots:
            robot.state.advance(steps)

    def reset(self) -> None:
        """Put everything where it started, at t = 0, with nothing that pushes it."""
        self.pushes = Pushes()
        first = self._robots[0]
        self.engine.reset(*first.spawn.configuration(first.kinematics, first.base))
        for robot in self._robots:
            robot.state.advance(-robot.state.step)
            robot.begin()

    # How it is made

    def _entry(
        self,
        thing: WorldModel | WorldRobot,
        robot: Robot | None = None,
        spawn: Spawn | None = None,
        bolted: bool = False,
    ) -> Entry:
        return self._make.entry(thing, robot, spawn, ground=ground_height(self.ground), bolted=bolted)

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
        together = bool(bodies or robots[1:])
        if self._provider == "compiled":
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
            provider=self._provider,
            self_collide=first.self_collide,
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

    # Where things are

    def _stands(self, entry: Entry) -> bool:
        """Whether a model is made of nothing but what does not move."""
        return not entry.robots and not any(part in self.loose for part in entry.offsets)

    def _part_pose(self, entry: Entry, part: str) -> Pose:
        robot = next((each for each in entry.robots if each.name == part), None)
        if robot is not None:
            return pose_from(robot.state.base_pose)
        return pose_from(self.loose[part].pose if part in self.loose else self.still[part])

    def _put(self, entry: Entry, part: str, pose: Pose, around: Pose, speed: NDArray[np.float64]) -> None:
        offset = np.array(pose.xyz) - np.array(around.xyz)
        moving = np.concatenate([speed[:3] + np.cross(speed[3:], offset), speed[3:]])
        robot = next((each for each in entry.robots if each.name == part), None)
        if robot is None:
            if part in self.loose:
                self.loose[part].place(seven(pose), moving.tolist())
            return
        if not robot.kinematics.floating_base:
            raise SimulationError(f"robot `{part}` is bolted down; it cannot be put elsewhere")
        q, v = robot.part.q, robot.part.v.copy()
        q[:7] = seven(pose)
        R = _matrix(q[3:7])
        v[:3], v[3:6] = R.T @ moving[:3], R.T @ moving[3:]
        robot.part.put(q, v)
        robot.state.advance(0)

    def _move_still(self, name: str, entry: Entry, pose: Pose, shift: Pose) -> None:
        assert entry.thing is not None
        entry.thing = replace(entry.thing, pose=pose)
        entry.still = tuple(replace(body, pose=seven(compose(shift, pose_from(body.pose)))) for body in entry.still)
        world = self.world
        models = tuple(entry.thing if each.name == name else each for each in world.models)
        robots = tuple(entry.thing if each.name == name else each for each in world.robots)
        self.world = replace(world, models=models, robots=robots)  # type: ignore[arg-type]
        self._build()


def _matrix(quaternion: NDArray[np.float64]) -> NDArray[np.float64]:
    import pinocchio as pin

    return np.array(pin.Quaternion(np.array(quaternion)).matrix())
