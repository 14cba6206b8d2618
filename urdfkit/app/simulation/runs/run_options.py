"""Options of a simulation: the start, the step, the plugins, and the commands of a run without a page."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from urdfkit.app.simulation.runs.commands import TopicMessage, publish_at, ramp, require_free
from urdfkit.description import Robot
from urdfkit.description.sdf import World
from urdfkit.scene import Scene
from urdfkit.sim import Simulator, Spawn


@dataclass(frozen=True)
class RunOptions:
    """Options of a run.

    Attributes:
        dt: length of a step [s]; the world's when None.
        seed: seed of all random numbers.
        spawn: start pose, velocity and joints of the robot.
        gravity: [m/s²]; the world's when None.
        fixed_base: fix the root link to the world.
        ros_distro: see `Simulator`.
        controllers: see `Simulator`.
        renderer: see `Simulator`.
        strict: see `Simulator`.
        density: see `Simulator` [kg/m³].
        command: velocity command VX, VY [m/s], WZ [rad/s] from the start on; None without one.
        ramp: time in which the command increases linearly from zero [s].
        joint_targets: joint → position to move to and hold [rad] or [m].
        trajectory: CSV file of a trajectory that joints move along.
        messages: messages to publish at given times.
    """

    dt: float | None = None
    seed: int = 0
    spawn: Spawn | None = None
    gravity: tuple[float, ...] | None = None
    fixed_base: bool = False
    ros_distro: str | None = None
    controllers: tuple[str | Path, ...] = ()
    renderer: str = "ray"
    strict: bool = False
    density: float = 1000.0
    command: tuple[float, float, float] | None = None
    ramp: float = 0.0
    joint_targets: Mapping[str, float] = field(default_factory=dict)
    trajectory: Path | None = None
    messages: tuple[TopicMessage, ...] = ()

    def build(
        self, robot: Robot, world: World, note: Callable[[str], None] | None, *, scene: Scene | None = None
    ) -> Simulator:
        """Return a simulator in the initial state; `scene` has the shapes of the robot if they have been loaded.

        Raises:
            UrdfkitError: robot or world cannot be simulated.
        """
        return Simulator(
            robot,
            world=world,
            dt=self.dt,
            seed=self.seed,
            spawn=self.spawn,
            gravity=self.gravity,
            fixed_base=self.fixed_base,
            ros_distro=self.ros_distro,
            controllers=self.controllers,
            renderer=self.renderer,
            strict=self.strict,
            density=self.density,
            scene=scene,
            note=note,
        )

    def schedule(self, simulator: Simulator, *, others_may_subscribe: bool = False) -> None:
        """Schedule the commands of the run.

        Args:
            simulator: not yet advanced.
            others_may_subscribe: see `publish_at`.

        Raises:
            UrdfkitError: a topic, type, field or joint is unknown.
        """
        from urdfkit.app.simulation.trajectory import follow, read_trajectory

        if self.command is not None:
            ramp(simulator, self.command, self.ramp)
        for joint, target in self.joint_targets.items():
            require_free(simulator, joint)
            simulator.motors.hold(joint, target)
        if self.trajectory is not None:
            follow(simulator, read_trajectory(self.trajectory))
        for message in self.messages:
            publish_at(simulator, message, others_may_subscribe=others_may_subscribe)
