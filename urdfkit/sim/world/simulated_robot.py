"""A robot in the simulation: its model, where it starts, its state and motors, and its plugins at work."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
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
from urdfkit.sim.plugins.controllers.controller_switching import Controllers
from urdfkit.sim.plugins.installer import Installed, install
from urdfkit.sim.plugins.namespaced_bus import OwnBus
from urdfkit.sim.plugins.periodic import Periodic, Publisher, Timed
from urdfkit.sim.plugins.publishers import Transforms, publish_fixed
from urdfkit.sim.plugins.setup import Setup
from urdfkit.sim.state.joint_commands import Motors, Servos
from urdfkit.sim.state.robot_state import State
from urdfkit.sim.state.ticks import Ticks

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
        writes: work before a step: drives, controllers, joints on their way to a position.
        reads: work after a step: drives, sensors, publishers; then the publishers of each control loop.
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
        self._own_publishers: list[Publisher] = []
        self._drive_reads: list[Timed] = []
        self.writes: list[Periodic] = []
        self.reads: tuple[Sequence[Periodic], ...] = ()

    def __repr__(self) -> str:
        """Return name and state."""
        return f"<SimulatedRobot {self.name}: {self.state!r}>"

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
            motors, ticks = self.motors, Ticks(APPROACH_RATE, engine.dt)
            self.writes = [Timed(ticks, lambda state: motors.approach(state.position), lambda: not motors.has_goals)]

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
        self.controllers = Controllers([c.loop for c in self.plugins.controllers if c.loop is not None], invalidate)
        for controller in self.plugins.controllers:
            if controller.initial_positions:
                joints = {**controller.initial_positions, **self.spawn.joints}
                self.spawn = replace(self.spawn, joints=joints)
        drives, motors = self.plugins.drives, self.motors
        for drive in drives:
            drive.schedule(setup.dt, motors)
        for controller in self.plugins.controllers:
            controller.schedule(setup.dt, motors)
        self.writes = [*drives, *self.plugins.controllers, *self.writes]
        transforms = Transforms(bus, setup.dt, self.kinematics, setup.namespace)
        self._own_publishers = [*self.plugins.sensors, *self.plugins.joint_states, transforms]
        self._drive_reads = [Timed(Ticks(drive.read_rate, setup.dt), drive.read) for drive in drives]
        self.reads = ([*self._drive_reads, *self._own_publishers], *self.controllers.each_publications)
        for publisher in self._publishers:
            publisher.schedule(setup.dt, self.state.step)

    @property
    def _publishers(self) -> Sequence[Publisher]:
        return [*self._own_publishers, *self.controllers.publications]

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

    def reset(self) -> None:
        """Forget commands, targets and odometry; `begin` puts it back."""
        self.motors.release_all()
        for drive in self.plugins.drives:
            drive.reset()
        for timed in self._drive_reads:
            timed.reset()
        for publisher in self._publishers:
            publisher.reset()

    def retire(self) -> None:
        """Stop listening: it is removed from the world."""
        if self._bus is not None:
            self._bus.close()


def ground_height(ground: Ground | None) -> float | None:
    """Return the height of a ground [m]; None where there is none."""
    return None if ground is None else ground.height
