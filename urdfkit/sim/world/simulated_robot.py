"""A robot in the simulation: its model, where it starts, its state and motors, and its plugins at work."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from urdfkit.description import Robot
from urdfkit.kinematics import Kinematics
from urdfkit.scene import Scene, scene_of
from urdfkit.sim.construction.link_options import self_colliding, weightless_links
from urdfkit.sim.construction.loading import require_masses
from urdfkit.sim.construction.missing_meshes import remark_left_out
from urdfkit.sim.construction.spawn import Spawn
from urdfkit.sim.construction.surface_parameters import surfaces_of
from urdfkit.sim.engine import Engine, Ground, Member, Surface
from urdfkit.sim.engine.articulation import Articulation
from urdfkit.sim.plugins.base import Sensor
from urdfkit.sim.plugins.controllers.controller_switching import Controllers
from urdfkit.sim.plugins.installer import Installed, install
from urdfkit.sim.plugins.namespaced_bus import OwnBus
from urdfkit.sim.plugins.publishers import Publication, Transforms, publish_fixed
from urdfkit.sim.plugins.setup import Setup
from urdfkit.sim.state.joint_commands import Motors, Servos
from urdfkit.sim.state.robot_state import State
from urdfkit.sim.state.ticks import NEVER, Ticks

Array = NDArray[np.float64]

SERVO_ARRAYS = (
    "position_target", "velocity_target", "kp", "kd", "servo_effort",
    "ki", "i_min", "i_max", "antiwindup", "feedforward", "integral",
)  # fmt: skip
"""The engine's arrays of `Servos`, in its order."""

APPROACH_RATE = 100.0
"""How often joints on their way to a position target are told how fast to go [Hz]."""


class SimulatedRobot:
    """A robot in the simulation.

    Args:
        robot: as written.
        name: what it is called here.
        spawn: where and how it starts.
        ground: height of what is below it [m]; None for nothing.
        note: tells the user something.
        fixed_base: its root link is fixed to the world. A root link called ``world`` always is.
        scene: its shapes; those written when None.
        surfaces: how its links rub; as written when None.
        self_collide: names of its links that touch its others; as written when None.
        weightless: names of its links that gravity does not pull; as written when None.
        is_robot: whether it publishes joint states and transforms; a door does not.

    Raises:
        UrdfkitError: it cannot be simulated; says why and where.

    Attributes:
        robot: as written.
        name: what it is called here.
        kinematics: its model.
        scene: its shapes.
        state: where it is and how it moves, read only; from `attach` on.
        motors: velocity and position targets by joint name; from `attach` on.
        plugins: its drives, sensors and controllers; from `install` on.
        controllers: to list, load, start, stop and switch; from `install` on.
        articulation: which of the engine's robots it is; from `attach` on.
    """

    state: State
    motors: Motors
    articulation: Articulation

    def __init__(
        self,
        robot: Robot,
        *,
        name: str,
        spawn: Spawn | None,
        ground: float | None,
        note: Callable[[str], None],
        fixed_base: bool = False,
        scene: Scene | None = None,
        surfaces: Mapping[str, Surface] | None = None,
        self_collide: Collection[str] | None = None,
        weightless: Collection[str] | None = None,
        is_robot: bool = True,
    ) -> None:
        self.robot, self.name = robot, name
        self._is_robot = is_robot
        self._setup: Setup | None = None
        on_world = robot.roots()[0].name == "world"
        self.kinematics = Kinematics(robot, floating_base=not (fixed_base or on_world))
        self.scene = scene_of(robot, strict=False) if scene is None else scene
        remark_left_out(self.scene, note)
        self.spawn = spawn or Spawn(z=0.0 if on_world else None)
        self.base = self.spawn.place(self.kinematics, self.scene, ground)
        require_masses(self.kinematics, self.spawn.configuration(self.kinematics, self.base)[0], note)
        self.surfaces = surfaces_of(robot) if surfaces is None else surfaces
        self.self_collide = self_colliding(robot) if self_collide is None else self_collide
        self.weightless = weightless_links(robot) if weightless is None else weightless
        self.plugins = Installed()
        self.controllers = Controllers([])
        self._bus: OwnBus | None = None
        self._publications: list[Publication] = []
        self._drives: list[tuple[Any, Ticks, Ticks]] = []
        self._sensors: list[tuple[Sensor, bool]] = []

    @property
    def has_plugins(self) -> bool:
        """Whether it is a robot rather than a thing with joints: it has plugins or sensors, or came as a robot."""
        return self._is_robot

    @property
    def shapes(self) -> tuple[Any, ...]:
        """Its collision shapes."""
        return self.scene.with_role("collision")

    @property
    def member(self) -> Member:
        """What the engine makes one of its robots of."""
        base = self.base.tolist()
        return Member(self.kinematics, self.shapes, self.surfaces, base, self.self_collide, self.name, self.weightless)

    def attach(self, engine: Engine, articulation: Articulation) -> None:
        """Be one of an engine's robots from now on."""
        self.articulation = articulation
        floats = self.kinematics.floating_base
        handles = (
            articulation.motor_velocity,
            articulation.motor_effort,
            articulation.applied,
            Servos(*(getattr(articulation, name) for name in SERVO_ARRAYS)),
            articulation.set_base_velocity,
        )
        if hasattr(self, "state"):
            self.state.attach(engine, articulation)
            self.motors.attach(*handles)
        else:
            self.state = State(self.kinematics, engine, None if floats else self.base, articulation)
            self.state.step = engine.steps
            self.motors = Motors(self.kinematics, *handles)
        self._approach = Ticks(APPROACH_RATE, engine.dt)

    def install(self, setup: Setup, *, seed: int, invalidate: Callable[[], None]) -> None:
        """Set its plugins to work, and publish what nobody has to ask for.

        Args:
            setup: what they may use.
            seed: of what is random.
            invalidate: called when something of it may be due sooner than it has said.

        Raises:
            SimulationError: a parameter makes no sense, with its place.
        """
        bus = self._bus = OwnBus(setup.bus, invalidate)
        setup = self._setup = replace(setup, bus=bus)
        self.plugins = install(self.robot, setup, seed=seed)
        self._drives = [(d, Ticks(d.write_rate, setup.dt), Ticks(d.read_rate, setup.dt)) for d in self.plugins.drives]
        for sensor in self.plugins.sensors:
            sensor.schedule(setup.dt, self.state.step)
        self._sensors = [(sensor, type(sensor).catch_up is Sensor.catch_up) for sensor in self.plugins.sensors]
        self.controllers = Controllers([c.loop for c in self.plugins.controllers if c.loop is not None], invalidate)
        for controller in self.plugins.controllers:
            controller.schedule(setup.dt)
            if controller.initial_positions:
                joints = {**controller.initial_positions, **self.spawn.joints}
                self.spawn = replace(self.spawn, joints=joints)
        self._publications = [
            *self.plugins.joint_states,
            Transforms(bus, setup.dt, self.kinematics, setup.namespace),
        ]
        for publication in (*self._publications, *self.controllers.publications):
            publication.start_at(self.state.step)

    # The loop

    def begin(self) -> None:
        """Stand where it starts, at the engine's present step."""
        self.articulation.put(*self.spawn.configuration(self.kinematics, self.base))
        self.state.advance(0)
        for controller in self.plugins.controllers:
            controller.begin(self.state)

    def publish_fixed(self) -> None:
        """Publish the transforms of links that are fixed to each other, once."""
        if self._setup is not None:
            publish_fixed(self._setup.bus, self.state, self.kinematics, self._setup.namespace)

    def write(self, step: int) -> None:
        """Let drives and controllers write targets for the time until the next call."""
        for drive, writes, _ in self._drives:
            if not drive.resting and writes.falls_on(step):
                drive.write(self.state, self.motors)
        for controller in self.plugins.controllers:
            if controller.due(step):
                controller.write(self.state, self.motors)
        if self.motors.has_goals and self._approach.falls_on(step):
            self.motors.approach(self.state.position)

    def write_due(self, step: int) -> int:
        """Return the first step from `step` on before which it may have something to write."""
        nearest = self._approach.after(step - 1) if self.motors.has_goals else NEVER
        for drive, writes, _ in self._drives:
            if not drive.resting:
                nearest = min(nearest, writes.after(step - 1))
        for controller in self.plugins.controllers:
            nearest = min(nearest, controller.after(step - 1))
        return nearest

    def read_due(self, step: int) -> int:
        """Return the first step from `step` on after which it has something to publish, heard by somebody or not."""
        nearest = NEVER
        for _, _, reads in self._drives:
            nearest = min(nearest, reads.after(step - 1))
        for controller in self.plugins.controllers:
            nearest = min(nearest, controller.after(step - 1))
        if nearest <= step:  # nothing else can be due before
            return nearest
        for sensor in self.plugins.sensors:
            nearest = min(nearest, sensor.look_due(step))
        for publications in (self._publications, *self.controllers.each_publications):
            for publication in publications:
                if publication.due < nearest:
                    nearest = publication.due
        return nearest

    def next_stop(self, step: int) -> int:
        """Return the first step after `step` at which something of it is due; `NEVER` for what has no plugins."""
        nearest = NEVER
        for drive, writes, reads in self._drives:
            nearest = min(nearest, reads.after(step))
            if not drive.resting:
                nearest = min(nearest, writes.after(step))
        for controller in self.plugins.controllers:
            nearest = min(nearest, controller.after(step))
        if self.motors.has_goals:
            nearest = min(nearest, self._approach.after(step))
        if nearest <= step + 1:  # nothing else can be due before
            return nearest
        for sensor in self.plugins.sensors:
            nearest = min(nearest, sensor.next_stop(step))
        for publications in (self._publications, *self.controllers.each_publications):
            for publication in publications:
                if publication.due < nearest:
                    nearest = min(nearest, publication.next_stop(step))
        return nearest

    def read(self, step: int) -> None:
        """Let drives, controllers and sensors publish what they measure."""
        for drive, _, reads in self._drives:
            if reads.falls_on(step):
                drive.read(self.state)
        for controller in self.plugins.controllers:
            if controller.due(step):
                controller.read(self.state)
        for sensor, waits in self._sensors:
            if not waits or sensor.due <= step:
                sensor.catch_up(self.state)
        for publications in (self._publications, *self.controllers.each_publications):
            for publication in tuple(publications):  # whoever hears of one may load or unload a controller
                if publication.due <= step:
                    publication.catch_up(self.state)

    def reset(self) -> None:
        """Forget commands, targets and odometry; `begin` puts it back."""
        self.motors.release_all()
        for drive, _, _ in self._drives:
            drive.reset()
        for publication in (*self._publications, *self.controllers.publications):
            publication.reset()
        for sensor in self.plugins.sensors:
            sensor.reset()

    def retire(self) -> None:
        """Stop listening: it is removed from the world."""
        if self._bus is not None:
            self._bus.close()


def ground_height(ground: Ground | None) -> float | None:
    """Return the height of a ground [m]; None where there is none."""
    return None if ground is None else ground.height
