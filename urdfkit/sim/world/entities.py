"""What is in a simulation besides its robot: looked at, spawned, removed, placed, pushed and saved while it runs."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from zlib import crc32

import numpy as np
from numpy.typing import NDArray

from urdfkit.description.sdf import World, WorldModel
from urdfkit.description.urdf.robot import Pose, Robot
from urdfkit.errors import SimulationError, UnknownNameError
from urdfkit.scene import Scene, Shape
from urdfkit.sim.construction.initial_overlap import note_overlaps
from urdfkit.sim.construction.rigid_bodies import looks_of, parts_of
from urdfkit.sim.construction.spawn import Spawn
from urdfkit.sim.plugins.setup import Setup
from urdfkit.sim.state.arguments import Named, nearest
from urdfkit.sim.state.poses import pose_of, seven
from urdfkit.sim.world.body import Thing
from urdfkit.sim.world.external_forces import Target, steps_of
from urdfkit.sim.world.live_world import AT_REST, Stage
from urdfkit.sim.world.scheduler import Agenda
from urdfkit.sim.world.simulated_robot import SimulatedRobot
from urdfkit.sim.world.snapshot import as_it_is
from urdfkit.sim.world.spawn_requests import Arrival, arrival

Array = NDArray[np.float64]
ZERO = (0.0, 0.0, 0.0)


class Population:
    """The world of a simulation, its robots and bodies."""

    _stage: Stage
    _agenda: Agenda
    _setup: Setup
    _seed: int
    _package_path: tuple[str | Path, ...]
    dt: float
    note: Callable[[str], None]

    @property
    def world(self) -> World:
        """The world as it was read, with what was spawned and without what was removed."""
        return self._stage.world

    @property
    def revision(self) -> int:
        """Changes whenever something is spawned or removed, or something static is moved."""
        return self._stage.revision

    @property
    def robots(self) -> Mapping[str, SimulatedRobot]:
        """Robots by name, the simulation's own first, and whatever else of the world has joints that move."""
        return Named("robot", self._stage.robots)

    @property
    def bodies(self) -> Mapping[str, Thing]:
        """The world's rigid bodies by name: look where they are, place them, push them."""
        return Named("body", {name: Thing(self, name) for name in self._stage.body_names})

    def body_poses(self) -> dict[str, tuple[float, ...]]:
        """Return name → x y z [m] and quaternion x y z w of everything in the world but its robot and the ground.

        Links of other robots, and of models with joints, are called ``NAME::LINK``.
        """
        return self.keep_body_poses()()

    def keep_body_poses(self) -> Callable[[], dict[str, tuple[float, ...]]]:
        """Return what tells the `body_poses` of this moment, also later."""
        stage = self._stage
        still, loose = stage.still, {name: body.pose for name, body in stage.loose.items()}
        robots = [(robot, robot.state.snapshot()) for robot in stage.everybody[1:]]

        def build() -> dict[str, tuple[float, ...]]:
            found = {**still, **loose}
            for robot, moment in robots:
                poses, names = moment.link_poses().tolist(), robot.kinematics.link_names
                found |= {f"{robot.name}::{link}": tuple(pose) for link, pose in zip(names, poses, strict=True)}
            return found

        return build

    @property
    def statues(self) -> tuple[tuple[str, Scene], ...]:
        """Name and scene of each robot of the world that does not move."""
        return self._stage.statues

    def looks(self) -> tuple[Shape, ...]:
        """Return what everything looks like that `body_poses` names, each shape on the body of that name."""
        found = list(looks_of(self.world))
        scenes = [*((robot.name, robot.scene) for robot in self._stage.everybody[1:]), *self.statues]
        for name, scene in scenes:
            for shape in scene.shapes:
                found.append(replace(shape, body=f"{name}::{shape.body}", name=f"{name}::{shape.name}"))
        return tuple(found)

    # Coming and going

    def spawn(
        self,
        model: str | Path | WorldModel | Robot | Arrival,
        pose: Pose | Spawn | Sequence[float] | None = None,
        *,
        name: str | None = None,
        bolted: bool = False,
    ) -> str:
        """Put a model or a robot into the world; what is there goes on as if nothing had happened.

        Args:
            model: a model or robot we ship by name, ``model://NAME``, an SDF, URDF or xacro file, or a loaded one.
            pose: x y z [m]; or x y z yaw, x y z roll pitch yaw or x y z and a quaternion x y z w; of the model's frame
                or of a robot's root link. Where the model itself says when None; a robot is set on the ground then.
            name: what to call it; its own name when None, with a number where that is taken.
            bolted: bolt a robot's root link to the world.

        Returns:
            What it is called.

        Raises:
            UrdfkitError: there is no such model, its name is taken, or it cannot be simulated.
        """
        found = arrival(model, self._package_path)
        start = pose if isinstance(pose, Spawn) else None
        placed = None if pose is None or isinstance(pose, Spawn) else pose_of(pose)
        thing, robot = found.thing, found.robot
        thing = replace(thing, name=name or self._free(thing.name))
        if robot is None:
            if start is not None:
                raise SimulationError(f"`{thing.name}` is a model: place it by its pose, not by a Spawn")
            thing = replace(thing, pose=thing.pose if placed is None else placed)
        else:
            if placed is not None:
                start = Spawn(*placed.xyz, *placed.rpy)
            start = start or Spawn()
        entry = self._stage.add(thing, robot, start, bolted=bolted)
        for each in entry.robots:
            self._install(each)
            each.begin()
            each.publish_fixed()
        self._agenda.stir()
        engine = self._stage.engine
        engine._evaluate()
        links = [f"{each.name}::{link}" for each in entry.robots for link in each.kinematics.link_names]
        note_overlaps(engine, {*links, *entry.offsets}, self.note, newcomer=thing.name)
        return thing.name

    def remove(self, name: str) -> None:
        """Take a model or a robot out of the world; its topics fall silent.

        Raises:
            SimulationError: there is none of that name, or it is the simulation's own robot.
        """
        self._stage.remove(name)

    def place(self, name: str, pose: Pose | Sequence[float], twist: Sequence[float] = AT_REST) -> None:
        """Put a model, robot or body somewhere, its joints as they are.

        Args:
            name: what.
            pose: see `spawn`.
            twist: velocity [m/s] and angular velocity [rad/s] it has there, along the world's axes.

        Raises:
            SimulationError: there is none, or it cannot be put elsewhere or be given a velocity.
        """
        self._stage.move(name, pose_of(pose), twist)

    def pose(self, name: str) -> tuple[float, ...]:
        """Return x y z [m] and quaternion x y z w of a model's frame or a robot's root link in the world.

        Raises:
            SimulationError: there is none of that name.
        """
        return seven(self._stage.pose_of(name))

    # Pushing

    def push(
        self,
        name: str,
        force: Sequence[float] = ZERO,
        torque: Sequence[float] = ZERO,
        *,
        at: Sequence[float] = ZERO,
        for_seconds: float | None = None,
    ) -> None:
        """Push a body or a link from now on; pushes add up.

        Args:
            name: a body, a link of the robot, ``ROBOT::LINK``, or a robot (its root link).
            force: [N], along the world's axes.
            torque: [N·m], along the world's axes.
            at: where the force acts, in the frame of the body or link [m]: its origin where nothing is said.
            for_seconds: how long [s], at least a step; until `release` when None.

        Raises:
            SimulationError: there is none, it cannot move, or a number makes no sense.
        """
        target, steps = self._target(name), steps_of(for_seconds, self.dt)
        self._stage.pushes.add(target, force, torque, at, step=self._stage.engine.steps, steps=steps)

    def release(self, name: str) -> None:
        """End all pushes on a body or link.

        Raises:
            SimulationError: there is none of that name.
        """
        wanted = self._target(name)
        self._stage.pushes.forget(lambda target: target[0] is wanted[0] and target[1] == wanted[1])

    # Saving

    def save_world(self, path: str | Path) -> None:
        """Write the world as it is now to an SDF file, without the simulation's own robot.

        Raises:
            DescriptionError: something in it cannot be written in SDF.
            OSError: the file cannot be written.
        """
        from urdfkit.description.sdf import save_world

        save_world(as_it_is(self._stage, self.note), path)

    # Inside

    def pushes_on(self, robot: str, links: Sequence[str]) -> tuple[tuple[Array, Array, Array], ...]:
        """Return force [N], torque [N·m] and point of attack [m], in the world, of what pushes links of a robot."""
        return self._stage.pushes.on(self.robots[robot], links)

    def _install(self, robot: SimulatedRobot) -> None:
        stir = robot.motors.stir = self._agenda.stir
        if robot is self._stage.everybody[0]:
            robot.install(self._setup, seed=self._seed, stir=stir)
            return
        if not robot.has_plugins:
            return
        seed = crc32(robot.name.encode(), self._seed & 0xFFFFFFFF)
        random = np.random.default_rng(seed)
        setup = replace(
            self._setup,
            kinematics=robot.kinematics,
            model=robot.name,
            random=random,
            parameter_files=(),
            namespace=f"/{robot.name}",
        )
        robot.install(setup, seed=seed, stir=stir)

    def _free(self, name: str) -> str:
        taken = {*self._stage.robots, *self._stage.names}
        if name not in taken:
            return name
        return next(free for k in range(1, len(taken) + 2) if (free := f"{name}_{k}") not in taken)

    def _target(self, name: str) -> Target:
        stage = self._stage
        if name in stage.loose:
            return None, name
        robots = stage.robots
        first = stage.everybody[0]
        if name in first.kinematics.link_names:
            return first, name
        if name in robots:
            return robots[name], robots[name].kinematics.root
        for robot in robots.values():
            link = name.removeprefix(f"{robot.name}::")
            if link != name and link in robot.kinematics.link_names:
                return robot, link
        body = self._body_of(name)
        if body in stage.loose:
            return None, body
        if name in stage.still or body in stage.still:
            raise SimulationError(f"body `{name}` does not move; nothing can push it")
        known = [*stage.loose, *first.kinematics.link_names]
        known += [f"{each.name}::{link}" for each in robots.values() for link in each.kinematics.link_names]
        raise UnknownNameError(f"no body or link `{name}` in the simulation{nearest(name, known)}")

    def _body_of(self, scoped: str) -> str:
        """Return the body that a link of a model in the world, ``MODEL::LINK``, is part of; "" if there is none."""
        name, _, link = scoped.partition("::")
        for model in self._stage.world.models:
            if link and model.name == name:
                for body, _, links in parts_of(model):
                    if any(link == each[0] for each in links):
                        return body
        return ""
