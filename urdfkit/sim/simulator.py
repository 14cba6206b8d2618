"""Simulator: load, step, run, pause, reset; the whole loop on one screen."""

import logging
from collections.abc import Callable, Mapping, Sequence
from math import isfinite
from pathlib import Path
from typing import Any

import numpy as np

from urdfkit.bus import Bus, Subscription, absolute, similar_topic
from urdfkit.description import Robot
from urdfkit.description.loading import load, load_repaired
from urdfkit.description.sdf import Physics, World
from urdfkit.description.urdf.repair_record import Repair
from urdfkit.errors import SimulationError, UnknownNameError
from urdfkit.linear_algebra import Array
from urdfkit.messages import TWIST, TWIST_STAMPED, header, message_type, require_message_types, twist
from urdfkit.messages.field_values import as_message
from urdfkit.scene import Scene
from urdfkit.sim.construction.initial_overlap import note_overlaps
from urdfkit.sim.construction.loading import require_valid_arguments, world_with_gravity
from urdfkit.sim.construction.repairs.collector import DENSITY, Repairs
from urdfkit.sim.construction.start_pose import Spawn
from urdfkit.sim.plugins.base import Drive
from urdfkit.sim.plugins.builtin_publishers import Clock
from urdfkit.sim.plugins.ros_distro import Distro
from urdfkit.sim.plugins.setup import Setup
from urdfkit.sim.scene_view import Surroundings
from urdfkit.sim.snapshots.copying import Copyable
from urdfkit.sim.snapshots.snapshot import Snapshots
from urdfkit.sim.state.arguments import number, vector
from urdfkit.sim.state.notes import Notes
from urdfkit.sim.state.periodic_steps import PeriodicSteps
from urdfkit.sim.world.gazebo_services import ModelStates, listen
from urdfkit.sim.world.live_world import LiveWorld
from urdfkit.sim.world.scheduler import Scheduler
from urdfkit.sim.world.simulated_robot import SimulatedRobot
from urdfkit.sim.world.world_builder import WorldBuilder

LOG = logging.getLogger("urdfkit.sim")


class Simulator(Copyable):
    """Simulation of a robot in a world; simulated time advances only in calls of `run` and `step`.

    Its `world` spawns, removes, places, pushes and saves entities.
    The same seed and the same calls give bit-identical results. A simulator uses the thread of its caller; several
    simulators may run in several threads.

    Args:
        robot: a loaded robot, a file, a package folder or the name of a bundled robot; see `urdfkit.load`.
        world: a world, the name of a bundled world (``empty``, ``void``, ``house``, …) or an SDF file.
        dt: length of a step [s]; the world's ``<max_step_size>`` when None.
        seed: seed of all random numbers.
        spawn: initial pose, velocity and joint positions of the robot.
        bus: message bus to publish on; a new one when None.
        name: name of the robot in the world and in its topics; the name in the description when None.
        gravity: [m/s²]; the world's when None.
        fixed_base: fix the root link to the world. A root link named ``world`` is always fixed.
        sleep: let bodies and robots at rest sleep until an external event, such as a contact or push, wakes them.
        ros_distro: the ROS distribution that plugins behave like, such as ``kinetic``; the newest when None.
        controllers: parameter files of controllers, replacing the files that the robot's packages load.
        package_path: folders to search for packages, when `robot` is a file or a name.
        renderer: camera renderer: ``ray`` casts rays, ``gl`` uses OpenGL, ``auto`` selects the faster one.
        scene: the robot's shapes, if they have been loaded already.
        note: called with each warning for the user, once per text; the log ``urdfkit.sim`` when None.
        strict: refuse robots that need a repair, such as an estimated mass.
        density: density for the mass of moving links without one [kg/m³].

    Raises:
        UrdfkitError: the robot or the world cannot be loaded or simulated; with the reason and the source position.

    Attributes:
        surroundings: the scene that the sensors measure.
        world: the simulated world with all robots and bodies.
        robot: the robot as described in its files.
        kinematics: the kinematic model of the robot, with its repairs.
        scene: the shapes of the robot.
        bus: the message bus of all topics.
        state: the current state, read-only.
        motors: velocity and position targets by joint name.
        controllers: the robot's controllers, to list, load, start, stop and switch.
        note: reports a warning to the user, each text once.
        paused: `run` does not move while set; `step` does.
        requests: topic of a service → function that executes a request and raises its error.

    Examples:
        >>> import urdfkit
        >>> simulator = urdfkit.Simulator("simpleton")
        >>> simulator.repairs, simulator.command_topics, simulator.command_period
        ((), ('/simpleton/cmd_vel',), 0.01)
        >>> received = []
        >>> odometry = simulator.subscribe("/simpleton/odom", "nav_msgs/msg/Odometry", received.append)
        >>> simulator.set_clock_rate(100.0)
        >>> simulator.at(1.0, lambda: simulator.command(linear=(0.5, 0.0, 0.0)))
        >>> simulator.every(1.0, lambda: print(simulator.t))
        >>> simulator.run(2.0)
        0.0
        1.0
        >>> simulator.t, len(received)
        (2.0, 200)
        >>> before = simulator.snapshot()
        >>> simulator.step(500)
        2.0
        >>> simulator.restore(before)
        >>> x, y, z = simulator.odometry()["odom"][0]
        >>> round(x, 2), simulator.link_poses().shape
        (0.46, (7, 7))
        >>> simulator.reset()
    """

    def __init__(
        self,
        robot: Robot | str | Path,
        *,
        world: World | str | Path = "empty",
        dt: float | None = None,
        seed: int = 0,
        spawn: Spawn | None = None,
        bus: Bus | None = None,
        name: str | None = None,
        gravity: Sequence[float] | None = None,
        fixed_base: bool = False,
        sleep: bool = True,
        ros_distro: str | None = None,
        controllers: Sequence[str | Path] = (),
        package_path: Sequence[str | Path] = (),
        renderer: str = "ray",
        scene: Scene | None = None,
        note: Callable[[str], None] | None = None,
        strict: bool = False,
        density: float = DENSITY,
    ) -> None:
        distro = Distro(ros_distro)
        require_valid_arguments(seed, spawn)
        read = load if strict else load_repaired
        self.robot = robot if isinstance(robot, Robot) else read(robot, package_path=package_path)
        found = world_with_gravity(world, gravity, package_path)
        self._arguments: dict[str, Any] = {
            "robot": self.robot, "world": found, "dt": dt, "seed": seed, "spawn": spawn, "name": name,
            "fixed_base": fixed_base, "sleep": sleep, "ros_distro": ros_distro, "controllers": tuple(controllers),
            "package_path": tuple(package_path), "renderer": renderer, "strict": strict, "density": density,
        }  # fmt: skip
        self.dt = dt = found.physics.max_step_size if dt is None else number(dt, "the step", "s")
        if not 1e-6 <= dt <= 0.1:
            raise SimulationError(f"the time step is {dt:g} s; it must be from 1e-6 to 0.1 s, such as 0.001")
        self.bus = Bus() if bus is None else bus
        self.paused = False
        self.note = Notes(note or LOG.warning)
        if not number(density, "the density", "kg/m³") > 0:
            raise SimulationError(f"the density is {density:g} kg/m³; it must be greater than zero")
        self._repairs = Repairs(self.note, strict=strict, density=density)
        for line in found.notes:
            self.note(line)
        if (requested := found.physics.max_step_size) not in (dt, Physics().max_step_size):
            self.note(
                f"world `{found.name}` sets a step of {requested:g} s; the requested step of {dt:g} s is used instead"
            )
        self.name = name or self.robot.name or "robot"
        first = SimulatedRobot(
            self.robot,
            name=self.name,
            spawn=spawn,
            ground=None if found.ground is None else found.ground.height,
            note=self.note,
            fixed_base=fixed_base,
            scene=scene,
            repairs=self._repairs,
        )
        self.kinematics, self.scene, self._scene = first.kinematics, first.scene, scene
        builder = WorldBuilder(first, found, dt=dt, note=self.note, package_path=package_path, sleep=sleep)
        self.state, self.motors = first.state, first.motors
        self._scheduler = Scheduler(builder, self.state, dt)
        require_message_types()
        self.world = LiveWorld(builder, self._scheduler, note=self.note, seed=seed, package_path=package_path)
        self.surroundings = Surroundings(self.world, self.note, renderer)
        setup = Setup(
            self.bus, self.kinematics, self.name, found.name, dt, np.random.default_rng(seed), self.note, distro,
            tuple(Path(file) for file in controllers), surroundings=self.surroundings,
        )  # fmt: skip
        self.world.install(setup)
        self.controllers = first.controllers
        if controllers and not any(each.plugins.controllers for each in builder.robot_list if each.has_plugins):
            self.note(f"robot `{self.name}` has no plugin that runs controllers: {controllers[0]} has no effect")
        self._scheduler.publications = Clock(self.bus, dt), ModelStates(self.bus, dt, self.world)
        self.world.reset()
        self._snapshots = Snapshots(self.world, self.bus)
        for each in builder.robot_list:
            each.publish_fixed()
        self.requests = listen(self.bus, self.world, self.at, self.note)
        note_overlaps(
            builder.engine, self.kinematics.link_names, self.note, models={model.name for model in found.models}
        )

    def __repr__(self) -> str:
        """Return the names of robot and world, and the simulated time."""
        return f"<Simulator of {self.name} in world {self.world.name} at t = {self.t:g} s>"

    @property
    def repairs(self) -> tuple[Repair, ...]:
        """The repairs of all robots, also of robots that were removed."""
        return tuple(self._repairs.found)

    # Time

    @property
    def t(self) -> float:
        """Simulated time [s]."""
        return self.state.t

    def run(self, seconds: float) -> None:
        """Advance by `seconds` of simulated time, rounded to whole steps. Does nothing while paused.

        Raises:
            SimulationError: the simulation diverged, or `seconds` is negative or not finite.
        """
        if not 0 <= (seconds := number(seconds, "the time to run for", "s")) < 1e9:
            raise SimulationError(f"the duration is {seconds:g} s; it must be zero or more, and less than 1e9 s")
        if not self.paused:
            self.step(round(seconds / self.dt))

    def step(self, n: int = 1) -> None:
        """Advance by `n` steps.

        Raises:
            SimulationError: the simulation diverged, or `n` is not a valid number of steps.
        """
        if not isinstance(n, int) or n < 0:
            raise SimulationError(
                f"invalid number of steps `{n}`: use an integer, zero or greater; for seconds, use `run`"
            )
        state, scheduler, world = self.state, self._scheduler, self.world
        end = state.step + n
        while (step := state.step) < end:
            if step >= scheduler.write_due:
                scheduler.write()  # 1 drives and controllers write targets
            stop = end
            if scheduler.write_due < end or scheduler.read_due < end:
                stop = min(end, scheduler.next_stop())
            world.advance(stop - step)  # 2 the engine advances; 3 frames: computed on first access
            if stop >= scheduler.read_due:
                scheduler.read()  # 4 sensors that are due measure; 5 joint states, transforms, clock

    # Snapshots

    def snapshot(self) -> bytes:
        """Return the state of the whole simulation, for `restore` in this or another process.

        It contains robots, bodies, the memory of the contact solver, drives, controllers, sensors with their noise,
        and the times of scheduled calls. It does not contain subscriptions and functions.

        Raises:
            SimulationError: the state of a plugin cannot be saved.
        """
        return self._snapshots.take()

    def restore(self, snapshot: bytes) -> None:
        """Restore a state; the same calls then give the same bytes as after `snapshot`.

        Args:
            snapshot: from a simulator of the same robots in the same world, with the same step. Calls scheduled with
                `at` and `every` must be scheduled here in the same order.

        Raises:
            SimulationError: the bytes are not such a snapshot.
        """
        self._snapshots.restore(snapshot)

    def reset(self) -> None:
        """Reset robots, bodies and time; subscriptions and message counts are kept, scheduled calls are dropped.

        Spawned entities return to their spawn poses; removed entities stay removed.
        """
        for robot in self.world.builder.robot_list:
            robot.reset()
        self._scheduler.reset()
        self.world.reset()

    # Scheduled calls

    def at(self, t: float, call: Callable[[], None]) -> None:
        """Call `call` before the first step at or after simulated time `t` [s].

        Raises:
            SimulationError: `t` is not a finite number.
        """
        self._schedule(t, 0.0, call)

    def every(self, period: float, call: Callable[[], None], *, start: float = 0.0) -> None:
        """Call `call` every `period` [s] of simulated time, first at `start` [s], before the step that begins then.

        Raises:
            SimulationError: the period is not greater than zero, or a number is not finite.
        """
        if not number(period, "the period", "s") > 0:
            raise SimulationError(f"the period is {period:g} s; it must be greater than zero")
        self._schedule(start, period, call)

    def set_clock_rate(self, rate: float) -> None:
        """Set the rate of ``/clock`` [Hz] from now on; zero or less means every step."""
        clock = self._scheduler.publications[0]
        clock.rate = rate
        clock.schedule(self.dt, self.state.step)
        self._scheduler.invalidate()

    def _schedule(self, t: float, period: float, call: Callable[[], None]) -> None:
        if not isfinite(number(t, "the time of a call", "s")):
            raise SimulationError(f"the time of a call is {t:g} s; it must be finite")
        self._scheduler.schedule(max(self.state.step, int(np.ceil(t / self.dt - 1e-6))), period, call)

    # Commands, topics and state

    @property
    def _drives(self) -> list[Drive]:
        return self.world.builder.robot_list[0].plugins.drives

    @property
    def command_topics(self) -> tuple[str, ...]:
        """The topics of type Twist (or TwistStamped) that the robot's drives and running controllers subscribe to."""
        topics = [topic for drive in self._drives for topic in drive.commands]
        return tuple(dict.fromkeys((*topics, *self.controllers.command_topics)))

    @property
    def command_period(self) -> float:
        """Period at which the drives read commands [s]; the time step if they read every step or none exists."""
        return max((PeriodicSteps(drive.write_rate, self.dt).period for drive in self._drives), default=self.dt)

    def command(self, linear: Sequence[float] = (0.0,) * 3, angular: Sequence[float] = (0.0,) * 3) -> None:
        """Publish a velocity command [m/s, rad/s] to every drive of the robot.

        Raises:
            SimulationError: the robot has no drive, or a velocity is not three numbers.
        """
        linear = vector(linear, 3, "the linear velocity", "m/s", finite=False)
        angular = vector(angular, 3, "the angular velocity", "rad/s", finite=False)
        if not self.command_topics:
            raise SimulationError(f"robot `{self.name}` has no drive that accepts velocity commands")
        for topic in self.command_topics:
            if self.controllers.command_topics.get(topic) == TWIST_STAMPED:
                stamped = message_type(TWIST_STAMPED)(header(self.t, ""), twist(linear, angular))
                self.bus.publish(topic, TWIST_STAMPED, stamped)
            else:
                self.bus.publish(topic, TWIST, twist(linear, angular))

    def subscribe(self, topic: str, type: str, callback: Callable[[Any], None], *, wait: bool = False) -> Subscription:
        """Call `callback` with every message on a topic, in the thread that advances the simulation.

        Args:
            topic: name of the topic.
            type: type of its messages, such as ``nav_msgs/msg/Odometry``.
            callback: receives the messages.
            wait: accept a topic that does not exist yet.

        Raises:
            UnknownNameError: the topic is unknown, and `wait` is false.
            UsageError: the topic has another type, or `callback` is no function.
        """
        names = [each.name for each in self.bus.topics]
        if not wait and (name := absolute(topic)) not in names:
            hint = similar_topic(name, names) or "; wait=True accepts topics that are published later"
            raise UnknownNameError(f"no topic `{name}` in the simulation{hint}")
        return self.bus.subscribe(topic, type, callback)

    def publish(self, topic: str, type: str, message: Any) -> None:
        """Publish a message to the subscribers of a topic. Topics of your own are published with `bus.publish`.

        Args:
            topic: its name.
            type: type of the message, e.g. ``std_msgs/msg/Float64``.
            message: a message, or its fields as a dictionary; missing fields are zero or empty.

        Raises:
            UnknownNameError: the topic has no subscribers.
            UsageError: the topic or the message has another type, or no such field.

        Examples:
            >>> import urdfkit
            >>> simulator = urdfkit.Simulator("simpleton")
            >>> simulator.publish("/simpleton/cmd_vel", "geometry_msgs/msg/Twist", {"angular": {"z": 1.0}})
            >>> simulator.run(1.0)
            >>> round(simulator.state.base_twist[5], 2)  # [rad/s]
            1.0
        """
        subscribed = [each.name for each in self.bus.topics if each.subscribers]
        if (name := absolute(topic)) not in subscribed:
            raise UnknownNameError(f"topic `{name}` has no subscribers{similar_topic(name, subscribed)}")
        self.bus.publish(topic, type, as_message(type, message))

    def link_poses(self) -> Array:
        """Return x y z [m] and quaternion x y z w of every link in the world; shape (n_links, 7)."""
        return self.state.link_poses()

    def odometry(self) -> Mapping[str, tuple[tuple[float, ...], tuple[float, ...]]]:
        """Return odometry frame → position [m] and quaternion x y z w that drives and controllers estimate."""
        found: dict[str, tuple[tuple[float, ...], tuple[float, ...]]] = {}
        for estimate in (*(drive.estimate for drive in self._drives), self.controllers.odometry):
            for frame, pose in estimate(self.state).items():
                found.setdefault(frame, pose)
        return found
