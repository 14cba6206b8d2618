"""Simulator: load, step, run, pause, reset; the whole loop on one screen."""

from __future__ import annotations

import heapq
import logging
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from urdfkit.bus import Bus, Subscription
from urdfkit.description import Robot
from urdfkit.description.world import World, load_world
from urdfkit.errors import SimulationError
from urdfkit.kinematics import Kinematics
from urdfkit.messages import TWIST, TWIST_STAMPED, header, message_type, twist
from urdfkit.scene import Scene, scene_of
from urdfkit.sim.controllers.switching import Controllers
from urdfkit.sim.distro import Distro
from urdfkit.sim.engine import Engine, Ground, Loose, warmup
from urdfkit.sim.engine.engine import Provider
from urdfkit.sim.installed import install
from urdfkit.sim.loading import load_robot, require_masses
from urdfkit.sim.motors import Motors, Servos
from urdfkit.sim.plugin import Setup
from urdfkit.sim.publications import Clock, Publication, Transforms, publish_fixed
from urdfkit.sim.schedule import Ticks
from urdfkit.sim.spawn import Spawn
from urdfkit.sim.state import State
from urdfkit.sim.surfaces import surfaces_of
from urdfkit.sim.things import bodies_of

Array = NDArray[np.float64]

SERVO_ARRAYS = ("position_target", "velocity_target", "kp", "kd", "servo_effort")
"""The engine's arrays of `Servos`, in its order."""

LOG = logging.getLogger("urdfkit.sim")


class Simulator:
    """A robot in a world, advanced in simulated time by whoever holds it. One thread, no clock of its own.

    Same seed, same calls: the same numbers to the last bit. Several simulators may run in several threads.

    Args:
        robot: a loaded robot, a file, or the name of a robot we ship.
        world: a world, the name of one we ship (``empty``, ``void``, ``house``, …) or an SDF file.
        dt: length of a step [s].
        seed: of everything random.
        spawn: where and how the robot starts.
        bus: where to publish; a new one when None.
        name: what the robot is spawned as, for topics; its own name when None.
        gravity: [m/s²]; the world's when None.
        fixed_base: bolt the root link to the world. A root link called ``world`` always is.
        engine: who computes the dynamics: the compiled kernel or Pinocchio (the reference, slow).
        ros_distro: the ROS distribution whose behaviour plugins are to have, such as ``kinetic``; the newest when None.
        controllers: parameter files of controllers, in place of those the robot's packages load.
        package_path: folders to look for packages in, when `robot` is a file or a name.
        note: receives remarks for the user, once each; the log ``urdfkit.sim`` when None.

    Raises:
        UrdfkitError: the robot or the world cannot be loaded or simulated; says why and where.

    Attributes:
        robot: the robot as written.
        world: the world.
        kinematics: the robot's model.
        scene: its shapes.
        bus: where it publishes and listens.
        state: the present, read only.
        motors: velocity and position targets by joint name.
        controllers: the robot's controllers, to list, load, start, stop and switch.
        paused: `run` does not move while set; `step` does.
    """

    def __init__(
        self,
        robot: Robot | str | Path,
        *,
        world: World | str | Path = "empty",
        dt: float = 0.001,
        seed: int = 0,
        spawn: Spawn | None = None,
        bus: Bus | None = None,
        name: str | None = None,
        gravity: Sequence[float] | None = None,
        fixed_base: bool = False,
        engine: Provider = "compiled",
        ros_distro: str | None = None,
        controllers: Sequence[str | Path] = (),
        package_path: Sequence[str | Path] = (),
        note: Callable[[str], None] | None = None,
    ) -> None:
        if not 1e-6 <= dt <= 0.1:
            raise SimulationError(f"a step of {dt:g} s makes no sense; try 0.001")
        distro = Distro(ros_distro)
        self.robot = robot if isinstance(robot, Robot) else load_robot(robot, package_path)
        self.world = _with_gravity(
            world if isinstance(world, World) else load_world(world, package_path=package_path), gravity
        )
        self.dt = dt
        self.bus = Bus() if bus is None else bus
        self.paused = False
        self._note = note or LOG.warning
        self._noted: set[str] = set()
        things = bodies_of(self.world)
        for line in self.world.notes:
            self.note(line)
        bolted = fixed_base or self.robot.roots()[0].name == "world"
        self.kinematics = Kinematics(self.robot, floating_base=not bolted)
        self.scene: Scene = scene_of(self.robot)
        self._spawn = spawn or Spawn(z=0.0 if self.robot.roots()[0].name == "world" else None)
        if engine == "compiled":
            about = "for worlds that hold bodies, once, about 60 s …" if things else "once, about 20 s …"
            warmup(
                lambda count: None if count else self.note(f"compiling the physics kernel, {about}"), world=bool(things)
            )
        ground = self.world.ground
        self._base = self._spawn.place(self.kinematics, self.scene, None if ground is None else ground.height)
        require_masses(self.kinematics, self._spawn.configuration(self.kinematics, self._base)[0], self.note)
        self._engine = Engine(
            self.kinematics,
            self.scene.with_role("collision"),
            dt=dt,
            gravity=self.world.gravity,
            ground=None if ground is None else Ground(ground.height, ground.mu, ground.name),
            surfaces=surfaces_of(self.robot),
            base=self._base.tolist(),
            provider=engine,
            bodies=things,
        )
        self._still = {thing.name: tuple(thing.pose) for thing in things if thing.static}
        self.state = State(self.kinematics, self._engine, self._base if bolted else None)
        self.motors = Motors(
            self.kinematics,
            self._engine.motor_velocity,
            self._engine.motor_effort,
            self._engine.applied,
            Servos(*(getattr(self._engine, name) for name in SERVO_ARRAYS)),
            self._engine.set_base_velocity,
        )
        self.name = name or self.robot.name or "robot"
        message_type(TWIST)  # loads the types now, or says that they are missing
        setup = Setup(
            self.bus, self.kinematics, self.name, self.world.name, dt, np.random.default_rng(seed), self.note, distro,
            tuple(Path(file) for file in controllers),
        )  # fmt: skip
        self._plugins = install(self.robot, setup, seed=seed)
        self._drives = [(d, Ticks(d.write_rate, dt), Ticks(d.read_rate, dt)) for d in self._plugins.drives]
        loops = [c.loop for c in self._plugins.controllers if c.loop is not None]
        self.controllers = Controllers(loops)
        for controller in self._plugins.controllers:
            controller.schedule(dt)
            if controller.initial_positions:
                joints = {**controller.initial_positions, **self._spawn.joints}
                self._spawn = replace(self._spawn, joints=joints)
        self._sensors = [(s, Ticks(s.rate, dt)) for s in self._plugins.sensors]
        self._publications: list[Publication] = [
            *self._plugins.joint_states,
            Transforms(self.bus, dt, self.kinematics),
            Clock(self.bus, dt),
        ]
        self._approach = Ticks(100.0, dt)
        self._calls: list[tuple[int, int, float, Callable[[], None]]] = []
        self._call_number = 0
        self._start()
        publish_fixed(self.bus, self.state, self.kinematics)

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
        if not 0 <= seconds < 1e9:
            raise SimulationError(f"cannot run for {seconds:g} s; it must be a number of seconds, zero or more")
        if not self.paused:
            self.step(round(seconds / self.dt))

    def step(self, n: int = 1) -> None:
        """Advance by `n` steps.

        Raises:
            SimulationError: the simulation diverged.
        """
        end = self.state.step + n
        while self.state.step < end:
            self._write()  # 1 drives and controllers write targets
            steps = min(self._next_stop(), end) - self.state.step
            self._engine.step(steps)  # 2 the engine advances
            self.state.advance(steps)  # 3 frames: computed when somebody asks
            self._read()  # 4 sensors that are due measure; 5 joint states, transforms, clock

    def _write(self) -> None:
        step = self.state.step
        while self._calls and self._calls[0][0] <= step:
            due, number, period, call = heapq.heappop(self._calls)
            call()
            if period > 0:
                again = max(step + 1, due + max(1, round(period / self.dt)))
                heapq.heappush(self._calls, (again, number, period, call))
        for drive, writes, _ in self._drives:
            if not drive.resting and writes.falls_on(step):
                drive.write(self.state, self.motors)
        for controller in self._plugins.controllers:
            if controller.due(step):
                controller.write(self.state, self.motors)
        if self.motors.has_goals and self._approach.falls_on(step):
            self.motors.approach(self.state.position)

    def _next_stop(self) -> int:
        step = self.state.step
        stops = [publication.next_stop(step) for publication in (*self._publications, *self.controllers.publications)]
        for drive, writes, reads in self._drives:
            stops.append(reads.after(step))
            if not drive.resting:
                stops.append(writes.after(step))
        stops.extend(controller.after(step) for controller in self._plugins.controllers)
        stops.extend(ticks.after(step) for _, ticks in self._sensors)
        if self.motors.has_goals:
            stops.append(self._approach.after(step))
        if self._calls:
            stops.append(max(step + 1, self._calls[0][0]))
        return min(stops)

    def _read(self) -> None:
        step = self.state.step
        for drive, _, reads in self._drives:
            if reads.falls_on(step):
                drive.read(self.state)
        for controller in self._plugins.controllers:
            if controller.due(step):
                controller.read(self.state)
        for sensor, ticks in self._sensors:
            if ticks.falls_on(step):
                sensor.measure(self.state)
        for publication in (*self._publications, *self.controllers.publications):
            publication.catch_up(self.state)

    def reset(self) -> None:
        """Start again: robot, drives and time; subscriptions and message counts stay, scheduled calls are dropped."""
        self._calls.clear()
        self.motors.release_all()
        for drive, _, _ in self._drives:
            drive.reset()
        for publication in (*self._publications, *self.controllers.publications):
            publication.reset()
        self._start()

    def _start(self) -> None:
        self._engine.reset(*self._spawn.configuration(self.kinematics, self._base))
        self.state.advance(-self.state.step)
        for controller in self._plugins.controllers:
            controller.begin(self.state)

    # Doing things at a time

    def at(self, t: float, call: Callable[[], None]) -> None:
        """Call `call` before the first step at or after simulated time `t` [s]."""
        self._schedule(t, 0.0, call)

    def every(self, period: float, call: Callable[[], None], *, start: float = 0.0) -> None:
        """Call `call` every `period` [s], from `start` [s] on, before the step that begins then."""
        self._schedule(start, period, call)

    def _schedule(self, t: float, period: float, call: Callable[[], None]) -> None:
        step = max(self.state.step, int(np.ceil(t / self.dt - 1e-6)))
        self._call_number += 1
        heapq.heappush(self._calls, (step, self._call_number, period, call))

    # Commands and looks

    @property
    def command_topics(self) -> tuple[str, ...]:
        """The topics of type Twist (or TwistStamped) that the robot's drives and running controllers listen to."""
        topics = [topic for drive in self._plugins.drives for topic in drive.commands]
        return tuple(dict.fromkeys((*topics, *self.controllers.command_topics)))

    @property
    def command_period(self) -> float:
        """How often the drives look at commands [s]; the step where they always do, or where there is none."""
        return max((writes.period for _, writes, _ in self._drives), default=self.dt)

    def command(self, linear: Sequence[float], angular: Sequence[float]) -> None:
        """Publish a velocity command [m/s, rad/s] to every drive of the robot.

        Raises:
            SimulationError: the robot has no drive.
        """
        if not self.command_topics:
            raise SimulationError(f"robot `{self.name}` has no drive that takes velocity commands")
        for topic in self.command_topics:
            if self.controllers.command_topics.get(topic) == TWIST_STAMPED:
                stamped = message_type(TWIST_STAMPED)(header(self.t, ""), twist(linear, angular))
                self.bus.publish(topic, TWIST_STAMPED, stamped)
            else:
                self.bus.publish(topic, TWIST, twist(linear, angular))

    def subscribe(self, topic: str, type: str, callback: Callable[[Any], None]) -> Subscription:
        """Call `callback` with every message on a topic, while the simulation advances, in its thread."""
        return self.bus.subscribe(topic, type, callback)

    def link_poses(self) -> Array:
        """Return x y z [m] and quaternion x y z w of every link in the world; shape (n_links, 7)."""
        return self.state.link_poses()

    @property
    def bodies(self) -> Mapping[str, Loose]:
        """The world's bodies that are free to move, by name: look where they are, place them, push them."""
        return self._engine.bodies

    def body_poses(self) -> dict[str, tuple[float, ...]]:
        """Return name → x y z [m] and quaternion x y z w of everything in the world but robots and ground."""
        return {**self._still, **{name: body.pose for name, body in self._engine.bodies.items()}}

    def odometry(self) -> Mapping[str, tuple[tuple[float, ...], tuple[float, ...]]]:
        """Return odometry frame → position [m] and quaternion x y z w at which the drives believe the robot to be."""
        found: dict[str, tuple[tuple[float, ...], tuple[float, ...]]] = {}
        for drive in self._plugins.drives:
            for frame, pose in drive.estimate(self.state).items():
                found.setdefault(frame, pose)
        return found

    def note(self, text: str) -> None:
        """Tell the user something; the same text only once."""
        if text not in self._noted:
            self._noted.add(text)
            self._note(text)


def _with_gravity(world: World, gravity: Sequence[float] | None) -> World:
    if gravity is None:
        return world
    if len(gravity) != 3 or not np.isfinite(gravity).all():
        raise SimulationError(f"gravity {tuple(gravity)} must be three finite numbers [m/s²]")
    return replace(world, gravity=(float(gravity[0]), float(gravity[1]), float(gravity[2])))
