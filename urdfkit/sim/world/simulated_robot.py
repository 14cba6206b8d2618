"""Robot in the simulation: its model, initial pose, state, motors and plugins."""

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import replace
from typing import Any

from urdfkit.description import Robot
from urdfkit.kinematics import Kinematics
from urdfkit.linear_algebra import Array
from urdfkit.scene import Scene
from urdfkit.sim.construction.link_options import self_colliding, weightless_links
from urdfkit.sim.construction.loading import require_masses
from urdfkit.sim.construction.missing_meshes import report_omitted_shapes
from urdfkit.sim.construction.repairs.collector import Repairs
from urdfkit.sim.construction.repairs.robot_repairs import repaired
from urdfkit.sim.construction.start_pose import Spawn, raised_joints
from urdfkit.sim.construction.surface_parameters import surfaces_of
from urdfkit.sim.engine import Engine, Ground, Member, Surface
from urdfkit.sim.engine.articulation import Articulation
from urdfkit.sim.plugins.base import DriveReads
from urdfkit.sim.plugins.builtin_publishers import Transforms, publish_fixed
from urdfkit.sim.plugins.controllers.controller_switching import Controllers
from urdfkit.sim.plugins.installer import Installed, install
from urdfkit.sim.plugins.live_objects import LiveObjects
from urdfkit.sim.plugins.namespaced_bus import OwnBus
from urdfkit.sim.plugins.periodic import Periodic, Publisher
from urdfkit.sim.plugins.setup import Setup
from urdfkit.sim.state.joint_commands import Motors, Servos
from urdfkit.sim.state.robot_state import State

SERVO_ARRAYS = (
    "position_target", "velocity_target", "kp", "kd", "servo_effort",
    "ki", "i_min", "i_max", "antiwindup", "feedforward", "integral",
    "approach_rate", "fastest", "acceleration", "deceleration",
)  # fmt: skip
"""Arrays of the engine for `Servos`, in the order of its fields."""


class SimulatedRobot:
    """Robot in the simulation.

    Args:
        robot: the loaded robot.
        name: name in the simulation.
        spawn: initial pose and velocity.
        ground: height of the ground below [m]; None without ground.
        note: reports a warning to the user.
        fixed_base: whether the root link is fixed to the world; a root link named ``world`` always is.
        scene: its shapes; None: those of the description.
        surfaces: friction of its links; None: as in the description.
        self_collide: links that collide with other links of the robot; None: as in the description.
        weightless: links without gravity; None: as in the description.
        repairs: collects the repairs of the robot; None: a robot that needs a repair is refused.
        is_robot: whether it publishes joint states and transforms, unlike a model with joints such as a door.

    Raises:
        UrdfkitError: the robot cannot be simulated; with the reason and the place.

    Attributes:
        robot: the robot as described.
        name: name in the simulation.
        repairs: collects the repairs of the robot.
        kinematics: kinematic model of the repaired robot.
        scene: its shapes.
        state: positions and velocities, read-only; after `attach`.
        motors: velocity and position targets by joint; after `attach`.
        plugins: its drives, sensors and controllers; after `install`.
        live: the objects of its plugins that hold state; after `install`.
        controllers: lists, loads, starts, stops and switches controllers; after `install`.
        articulation: the engine's handle of the robot; after `attach`.
        writes: work before a step: drives, controllers.
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
        repairs: Repairs | None = None,
        is_robot: bool = True,
    ) -> None:
        self.robot, self.name = robot, name
        self.repairs = repairs = repairs or Repairs(note, strict=True)
        self._is_robot = is_robot
        self._setup: Setup | None = None
        on_world = robot.roots()[0].name == "world"
        floating = not (fixed_base or on_world)
        robot, self.scene = repaired(robot, scene, repairs, floating=floating)
        self.kinematics = Kinematics(robot, floating_base=floating)
        report_omitted_shapes(robot, self.scene, repairs)
        self.spawn = spawn or Spawn(z=0.0 if on_world else None)
        self.base = self.spawn.place(self.kinematics, self.scene, ground)
        self._raised = raised_joints(self.kinematics, self.scene, self.base, ground) if spawn is None else {}
        require_masses(self.kinematics, self.start()[0], note)
        self.surfaces = surfaces_of(robot) if surfaces is None else surfaces
        self.self_collide = self_colliding(robot) if self_collide is None else self_collide
        self.weightless = weightless_links(robot) if weightless is None else weightless
        self.plugins = Installed()
        self.live = LiveObjects()
        self.controllers = Controllers([])
        self._bus: OwnBus | None = None
        self._own_publishers: list[Publisher] = []
        self._drive_reads: list[DriveReads] = []
        self.writes: list[Periodic] = []
        self.reads: tuple[Sequence[Periodic], ...] = ()

    def __repr__(self) -> str:
        """Return name and state."""
        return f"<SimulatedRobot {self.name}: {self.state!r}>"

    @property
    def has_plugins(self) -> bool:
        """Whether it has plugins or sensors or was spawned as a robot, unlike a model with joints."""
        return self._is_robot

    @property
    def shapes(self) -> tuple[Any, ...]:
        """Collision shapes."""
        return self.scene.with_role("collision")

    @property
    def member(self) -> Member:
        """Description of the robot for the engine."""
        base = self.base.tolist()
        return Member(self.kinematics, self.shapes, self.surfaces, base, self.self_collide, self.name, self.weightless)

    def attach(self, engine: Engine, articulation: Articulation) -> None:
        """Connect the robot to an engine."""
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

    def install(self, setup: Setup, *, seed: int, invalidate: Callable[[], None]) -> None:
        """Install its plugins, and the publications that every robot has.

        Args:
            setup: interfaces for plugins.
            seed: seed of random numbers.
            invalidate: called when work may become due earlier than reported.

        Raises:
            SimulationError: a parameter is invalid; with its place.
        """
        bus = self._bus = OwnBus(setup.bus, invalidate)
        setup = self._setup = replace(setup, bus=bus, repairs=self.repairs)
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
        self.writes = [*drives, *self.plugins.controllers]
        transforms = Transforms(bus, setup.dt, self.kinematics, setup.namespace)
        self._own_publishers = [*self.plugins.sensors, *self.plugins.joint_states, transforms]
        self._drive_reads = [DriveReads(drive) for drive in drives]
        self.reads = ([*self._drive_reads, *self._own_publishers], *self.controllers.each_publications)
        for publisher in self._publishers:
            publisher.schedule(setup.dt, self.state.step)
        self.register()

    def register(self) -> None:
        """Register all objects that hold state; those of each controller under its own name."""
        live = self.live
        live.add("robot", self)
        live.add("state", self.state)
        live.add("kinematics", self.kinematics)
        live.follow("motors", self.motors)
        loops = [each.loop for each in self.plugins.controllers if each.loop is not None]
        for loop in loops:
            live.follow_loop(loop)
        installed = self.plugins
        live.follow_plugins([*installed.drives, *installed.sensors, *installed.controllers])
        live.follow("publishers", [*self._own_publishers, *self._drive_reads, *self.writes])

    @property
    def _publishers(self) -> Sequence[Publisher]:
        return [*self._drive_reads, *self._own_publishers, *self.controllers.publications]

    def start(self) -> tuple[Array, Array]:
        """Return the initial q and v."""
        return self.spawn.configuration(self.kinematics, self.base, self._raised)

    def begin(self) -> None:
        """Set the initial pose and velocity, at the present step of the engine."""
        self.articulation.put(*self.start())
        self.state.advance(0)
        for controller in self.plugins.controllers:
            controller.begin(self.state)

    def place_joints(self, positions: Mapping[str, float]) -> None:
        """Set positions of joints [rad or m]; the robot is at rest then, and its controllers hold them.

        Raises:
            KinematicsError: an unknown name, a mimic joint, or a position that is not finite.
        """
        kinematics = self.kinematics
        now = self.articulation.q
        values = {name: at for name, at in kinematics.positions(now).items() if name not in kinematics.couplings}
        base = now[:7] if kinematics.floating_base else None
        self.articulation.put(kinematics.configuration({**values, **positions}, base=base))
        self.state.advance(0)
        for controller in self.plugins.controllers:
            controller.begin(self.state)

    def publish_fixed(self) -> None:
        """Publish the transforms of fixed joints, once."""
        if self._setup is not None:
            publish_fixed(self._setup.bus, self.state, self.kinematics, self._setup.namespace)

    def reset(self) -> None:
        """Discard commands, targets and odometry; `begin` restores the initial state."""
        self.motors.release_all()
        for drive in self.plugins.drives:
            drive.reset()
        for publisher in self._publishers:
            publisher.reset()

    def retire(self) -> None:
        """Close its subscriptions, because it is removed from the world."""
        if self._bus is not None:
            self._bus.close()


def ground_height(ground: Ground | None) -> float | None:
    """Return the height of the ground [m]; None without ground."""
    return None if ground is None else ground.height
