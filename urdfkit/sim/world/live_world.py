"""The world of a running simulation: its entities are read, spawned, removed, placed, pushed and saved."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from zlib import crc32

import numpy as np

from urdfkit.description.sdf import World, WorldModel
from urdfkit.description.urdf.robot import Pose, Robot
from urdfkit.errors import SimulationError
from urdfkit.linear_algebra import Array
from urdfkit.scene import Scene, Shape
from urdfkit.sim.construction.initial_overlap import note_overlaps
from urdfkit.sim.construction.rigid_bodies import visuals_of
from urdfkit.sim.construction.start_pose import Spawn
from urdfkit.sim.plugins.setup import Setup
from urdfkit.sim.state.arguments import ByName
from urdfkit.sim.state.poses import pose_of, seven
from urdfkit.sim.world import entity_poses
from urdfkit.sim.world.body import RigidBody
from urdfkit.sim.world.current_description import current_description
from urdfkit.sim.world.entity_poses import AT_REST
from urdfkit.sim.world.external_forces import ZERO, ExternalForces, target_of
from urdfkit.sim.world.scheduler import Scheduler
from urdfkit.sim.world.simulated_robot import SimulatedRobot
from urdfkit.sim.world.spawn_requests import SpawnRequest, spawn_request
from urdfkit.sim.world.world_builder import WorldBuilder

SpawnCall = tuple[SpawnRequest, Spawn | None, bool]
"""Spawned entity with its name and pose; the start of a robot, and whether its base is fixed."""


class LiveWorld:
    """World of a running simulation, its robots and bodies.

    Args:
        builder: the entities and their engine.
        scheduler: of the simulation.
        note: reports a warning to the user.
        seed: of the random numbers of plugins.
        package_path: folders that are searched first for packages.

    Attributes:
        builder: the entities and their engine.
        scheduler: of the simulation.
        package_path: folders that are searched first for packages.
        forces: the forces that act on bodies and links.
        removed: names of the entities of the initial world that were removed.
        spawned: name → arguments, of the entities that were spawned and not removed.
    """

    def __init__(
        self,
        builder: WorldBuilder,
        scheduler: Scheduler,
        *,
        note: Callable[[str], None],
        seed: int = 0,
        package_path: Sequence[str | Path] = (),
    ) -> None:
        self.builder, self.scheduler, self.package_path = builder, scheduler, tuple(package_path)
        self._note, self._seed = note, seed
        self._setup: Setup | None = None
        self.forces = ExternalForces(builder)
        self.removed: tuple[str, ...] = ()
        self.spawned: dict[str, SpawnCall] = {}

    def __repr__(self) -> str:
        """Return the name of the world and its entities."""
        return f"<LiveWorld {self.name}: {', '.join(self.names)}>"

    @property
    def description(self) -> World:
        """The loaded world, including spawned and excluding removed entities."""
        return self.builder.description

    @property
    def name(self) -> str:
        """Name of the world."""
        return self.description.name

    @property
    def revision(self) -> int:
        """Number that changes whenever an entity is spawned or removed, or a static one is moved."""
        return self.builder.revision

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the models and robots, the simulation's own robot first."""
        return self.builder.names

    @property
    def robots(self) -> Mapping[str, SimulatedRobot]:
        """Robots by name, the simulation's own first, and the models with joints."""
        return ByName("robot", self.builder.robots)

    @property
    def bodies(self) -> Mapping[str, RigidBody]:
        """Rigid bodies by name."""
        return ByName("body", {name: RigidBody(self.builder, self.forces, name) for name in self.builder.body_names})

    def body_poses(self) -> dict[str, tuple[float, ...]]:
        """Return name → x y z [m] and quaternion x y z w of all bodies but the simulation's own robot and the ground.

        Links of other robots, and of models with joints, are called ``NAME::LINK``.
        """
        return self.keep_body_poses()()

    def keep_body_poses(self) -> Callable[[], dict[str, tuple[float, ...]]]:
        """Return a function that returns the `body_poses` of this moment, also later."""
        builder = self.builder
        static, free = builder.static_poses, {name: body.pose for name, body in builder.free_bodies.items()}
        robots = [(robot, robot.state.snapshot()) for robot in builder.robot_list[1:]]

        def build() -> dict[str, tuple[float, ...]]:
            poses = {**static, **free}
            for robot, moment in robots:
                rows, names = moment.link_poses().tolist(), robot.kinematics.link_names
                poses |= {f"{robot.name}::{link}": tuple(pose) for link, pose in zip(names, rows, strict=True)}
            return poses

        return build

    @property
    def static_robots(self) -> tuple[tuple[str, Scene], ...]:
        """Name and scene of each robot that does not move."""
        return self.builder.static_robots

    def body_shapes(self) -> tuple[Shape, ...]:
        """Return the visual shapes of all bodies that `body_poses` names, each on the body of that name."""
        shapes = list(visuals_of(self.description))
        scenes = [*((robot.name, robot.scene) for robot in self.builder.robot_list[1:]), *self.static_robots]
        for name, scene in scenes:
            for shape in scene.shapes:
                shapes.append(replace(shape, body=f"{name}::{shape.body}", name=f"{name}::{shape.name}"))
        return tuple(shapes)

    def is_static(self, name: str) -> bool:
        """Whether no part of a model or robot can move.

        Raises:
            UnknownNameError: unknown name.
        """
        return entity_poses.is_static(self.builder, self.builder.entity(name))

    def free_name(self, name: str) -> str:
        """Return a name that no entity has: `name`, or `name` with a number."""
        taken = {*self.builder.robots, *self.names}
        if name not in taken:
            return name
        return next(free for k in range(1, len(taken) + 2) if (free := f"{name}_{k}") not in taken)

    # Spawning and removing

    def spawn(
        self,
        model: str | Path | WorldModel | Robot | SpawnRequest,
        pose: Pose | Spawn | Sequence[float] | None = None,
        *,
        name: str | None = None,
        fixed_base: bool = False,
    ) -> str:
        """Spawn a model or a robot; the rest of the simulation is not disturbed.

        Args:
            model: a bundled model or robot by name, ``model://NAME``, an SDF, URDF or xacro file, or a loaded one.
            pose: x y z [m]; or x y z yaw, x y z roll pitch yaw or x y z and a quaternion x y z w; of the model's frame
                or of a robot's root link. When None, the model's own pose, and the ground for a robot.
            name: in the world; its own name when None, with a number if the world has that name already.
            fixed_base: fix a robot's root link to the world.

        Returns:
            Its name in the world.

        Raises:
            UrdfkitError: unknown model, its name is used already, or it cannot be simulated.
        """
        request = spawn_request(model, self.package_path)
        start = pose if isinstance(pose, Spawn) else None
        placed = None if pose is None or isinstance(pose, Spawn) else pose_of(pose)
        source, robot = request.source, request.robot
        source = replace(source, name=name or self.free_name(source.name))
        if robot is None:
            if start is not None:
                raise SimulationError(f"`{source.name}` is a model: place it by its pose, not by a Spawn")
            source = replace(source, pose=source.pose if placed is None else placed)
        else:
            if placed is not None:
                start = Spawn(*placed.xyz, *placed.rpy)
            start = start or Spawn()
        entity = self.builder.add(source, robot, start, fixed_base=fixed_base)
        self.spawned[source.name] = SpawnRequest(source, robot), start, fixed_base
        for each in entity.robots:
            self._install(each)
            each.begin()
            each.publish_fixed()
        self.scheduler.invalidate()
        engine = self.builder.engine
        engine.evaluate()
        links = [f"{each.name}::{link}" for each in entity.robots for link in each.kinematics.link_names]
        note_overlaps(engine, {*links, *entity.offsets}, self._note, newcomer=source.name)
        return source.name

    def remove(self, name: str) -> None:
        """Remove a model or a robot, and the topics of its plugins with it.

        Raises:
            SimulationError: unknown name, or the simulation's own robot.
        """
        entity = self.builder.entity(name)
        self.builder.remove(name)
        self.forces.forget(entity)
        if self.spawned.pop(name, None) is None:
            self.removed = (*self.removed, name)

    def install(self, setup: Setup) -> None:
        """Install the plugins of all robots, and from now on those of spawned robots."""
        self._setup = setup
        for robot in self.builder.robot_list:
            self._install(robot)

    def _install(self, robot: SimulatedRobot) -> None:
        invalidate = self.scheduler.invalidate
        assert self._setup is not None
        if robot is self.builder.robot_list[0]:
            robot.install(self._setup, seed=self._seed, invalidate=invalidate)
            return
        if not robot.has_plugins:
            robot.register()
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
        robot.install(setup, seed=seed, invalidate=invalidate)

    # Poses

    def place(self, name: str, pose: Pose | Sequence[float], twist: Sequence[float] = AT_REST) -> None:
        """Place a model, robot or body; its joints stay as they are.

        Args:
            name: of the model, robot or body.
            pose: see `spawn`.
            twist: velocity [m/s] and angular velocity [rad/s] that it has there, along the world's axes.

        Raises:
            SimulationError: unknown name, or the entity cannot be moved or have a velocity.
        """
        entity_poses.move(self.builder, name, pose_of(pose), twist)

    def pose(self, name: str) -> tuple[float, ...]:
        """Return x y z [m] and quaternion x y z w of a model's frame or a robot's root link in the world.

        Raises:
            UnknownNameError: unknown name.
        """
        return seven(entity_poses.pose_of(self.builder, name))

    def twist(self, name: str) -> tuple[float, ...]:
        """Return velocity [m/s] and angular velocity [rad/s] of the frame of `pose`, along the world's axes.

        Raises:
            UnknownNameError: unknown name.
        """
        return entity_poses.twist_of(self.builder, name)

    def link_pose(self, name: str) -> tuple[float, ...]:
        """Return x y z [m] and quaternion x y z w of a body or link, named as for `push`.

        Raises:
            SimulationError: unknown name, or the body does not move.
        """
        robot, link = target_of(self.builder, name)
        if robot is None:
            return self.bodies[link].pose
        row = robot.kinematics.link_names.index(link)
        return tuple(robot.state.link_poses()[row].tolist())

    # Forces

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
            at: where the force acts, in the frame of the body or link [m]; its origin by default.
            for_seconds: duration [s], at least a step; until `release` when None.

        Raises:
            SimulationError: unknown name, the body cannot move, or a number is invalid.
        """
        self.forces.push(name, force, torque, at=at, for_seconds=for_seconds)

    def release(self, name: str) -> None:
        """End all pushes on a body or link.

        Raises:
            UnknownNameError: unknown name.
        """
        self.forces.release(name)

    def pushes_on(self, robot: str, links: Sequence[str]) -> tuple[tuple[Array, Array, Array], ...]:
        """Return force [N], torque [N·m] and point of attack [m], in the world, of each push on links of a robot."""
        return self.forces.on(self.robots[robot], links)

    # Time

    def advance(self, steps: int) -> None:
        """Advance by a number of steps, in the state of every robot too.

        Raises:
            SimulationError: the simulation diverged.
        """
        left, engine = steps, self.builder.engine
        while left > 0 and self.forces.acting:
            self.forces.step(engine)
            left -= 1
        if left:
            engine.step(left)
        for robot in self.builder.robot_list:
            robot.state.advance(steps)

    def reset(self) -> None:
        """Put everything where it started, at t = 0, without pushes."""
        self.forces.acting = []
        self.builder.engine.reset(*self.builder.robot_list[0].start())
        for robot in self.builder.robot_list:
            robot.state.advance(-robot.state.step)
            robot.begin()

    def restore_gravity(self) -> None:
        """Set the gravity of the description to that of the engine."""
        x, y, z = self.builder.engine.arrays["gravity"].tolist()
        if (x, y, z) != tuple(self.description.gravity):
            self.builder.description = replace(self.description, gravity=(x, y, z))

    # Saving

    def save(self, path: str | Path) -> None:
        """Write the world as it is now to an SDF file, without the simulation's own robot.

        Raises:
            DescriptionError: an entity cannot be written in SDF.
            OSError: the file cannot be written.
        """
        from urdfkit.description.sdf import save_world

        save_world(current_description(self.builder, self._note), path)
