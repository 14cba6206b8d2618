"""Drive, Sensor, Controller: the base classes of plugins.

Three phases. `configure` once: read parameters, look up joints, advertise and subscribe. ``write``, before the engine
advances: set motor targets. ``read``/``measure``, after it: read the state, which is read-only, and publish.
A plugin class is listed in `DRIVES`, `SENSORS` or `CONTROLLERS` and chosen by the ``kind`` of its `PluginSpec`.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterator
from typing import TYPE_CHECKING, ClassVar

from urdfkit.sim.plugins.parameters import Parameters
from urdfkit.sim.plugins.periodic import Periodic, Publisher
from urdfkit.sim.plugins.topic_names import Topics
from urdfkit.sim.state.periodic_steps import NEVER, PeriodicSteps

if TYPE_CHECKING:
    from urdfkit.bus import Topic
    from urdfkit.description.plugins import PluginSpec
    from urdfkit.description.urdf.robot import Plugin
    from urdfkit.sim.plugins.controllers.control_loop import ControlLoop
    from urdfkit.sim.plugins.controllers.joint_handle import JointPid
    from urdfkit.sim.plugins.odometry import Pose
    from urdfkit.sim.plugins.setup import Setup
    from urdfkit.sim.state.joint_commands import Motors
    from urdfkit.sim.state.robot_state import State


class SimulatedPlugin(Periodic):
    """Object that simulates one plugin element of a description.

    Args:
        plugin: the element.
        spec: the table of its parameters.
    """

    kind: ClassVar[str]
    specs: ClassVar[tuple[PluginSpec, ...]] = ()

    def __init__(self, plugin: Plugin, spec: PluginSpec) -> None:
        self.plugin = plugin
        self.spec = spec

    @abstractmethod
    def configure(self, setup: Setup) -> None:
        """Read the parameters, advertise and subscribe.

        Raises:
            SimulationError: a parameter is wrong, with its position.
        """

    def parameters(self, setup: Setup, **names: str) -> Parameters:
        """Return the parameters of the element.

        Args:
            setup: the one of `configure`.
            names: further values of the placeholders in defaults.
        """
        return Parameters(self.plugin, self.spec, setup.names | names)

    def topic_names(self, namespace: str = "") -> Topics:
        """Return the topic names of the element.

        Args:
            namespace: namespace in ROS 1 without ``<robotNamespace>``.
        """
        return Topics(self.plugin, self.spec, namespace=namespace)


class Commanding(SimulatedPlugin):
    """A plugin that writes joint commands; its work before a step is `write`."""

    motors: Motors

    @abstractmethod
    def write(self, state: State, motors: Motors) -> None:
        """Set motor targets for the time until the next call."""

    def act(self, state: State) -> None:
        """Write to the motors of the robot."""
        self.write(state, self.motors)


class Drive(Commanding):
    """Turns velocity commands into wheel motion, and wheel motion into odometry.

    Attributes:
        kind: the ``kind`` of its `PluginSpec` tables.
        specs: its own tables, for plugins that `urdfkit.description.plugins` does not support.
        write_rate: rate of `write` [Hz]; zero means every step.
        read_rate: rate of `read` [Hz]; zero means every step.
        resting: `write` has nothing to do until something changes; the simulator then skips it.
        commands: topics of type Twist that it subscribes to.

    Examples:
        >>> from urdfkit.sim import Drive
        >>> class Conveyor(Drive):
        ...     kind = "conveyor"  # of a `PluginSpec` table, for example in `specs`
        ...     write_rate = 50.0
        ...     published = ()  # no odometry
        ...
        ...     def configure(self, setup):
        ...         self.joint = setup.joint("belt_joint", self.plugin.position)
        ...
        ...     def write(self, state, motors):
        ...         motors.set_velocity(self.joint, 1.0, effort=5.0)
        ...
        ...     def read(self, state): ...
        ...
        ...     def reset(self): ...
        >>> drive = Conveyor(plugin=None, spec=None)  # a simulation passes the element and its table
        >>> drive.schedule(dt=0.001, motors=None)
        >>> drive.next(1)  # step before which `write` is due
        20
        >>> drive.estimate(state=None)
        {}
    """

    write_rate: float = 0.0
    read_rate: float = 0.0
    resting: bool = False
    commands: tuple[str, ...] = ()

    def schedule(self, dt: float, motors: Motors) -> None:
        """Set the simulation's step [s] and the motors of the robot, after `configure`."""
        self._ticks, self.motors = PeriodicSteps(self.write_rate, dt), motors

    def next(self, step: int) -> int:
        """Return the first step from `step` on before which `write` is due."""
        return NEVER if self.resting else self._ticks.next(step)

    @property
    def published(self) -> tuple[Topic, ...] | None:
        """The topics for which `read` is called; None if it has to be called at every due step."""
        return None

    @abstractmethod
    def read(self, state: State) -> None:
        """Measure and publish."""

    @abstractmethod
    def reset(self) -> None:
        """Clear commands and odometry."""

    def estimate(self, state: State) -> dict[str, Pose]:
        """Return odometry frame → pose in it; empty for a drive without odometry."""
        return {}


class DriveReads(Publisher):
    """The calls of a drive's `read`; while its topics have no subscribers, the simulation does not stop for them.

    Args:
        drive: the drive.
    """

    def __init__(self, drive: Drive) -> None:
        self.drive, self.rate = drive, drive.read_rate

    def stop(self, step: int) -> int:
        """Return the next step at which the simulation has to stop."""
        topics = self.drive.published
        self.topics = topics or ()
        return NEVER if topics == () else super().stop(step)

    def measure(self, state: State, count: int) -> None:
        """Let the drive publish, and count the messages that were due."""
        self.drive.read(state)
        for topic in self.drive.published or ():
            topic.count += count - 1


class Sensor(SimulatedPlugin, Publisher):
    """Measures the state of the robot or the scene, and publishes messages.

    Attributes:
        kind: the ``kind`` of its `PluginSpec` tables.
        specs: its own tables, for plugins that `urdfkit.description.plugins` does not support.
        rate: rate of `measure` [Hz]; zero means every step.
        name: its name in the description; may be empty.

    Examples:
        >>> from urdfkit.messages import from_fields
        >>> from urdfkit.sim import Sensor
        >>> class Tachometer(Sensor):
        ...     kind = "tachometer"  # of a `PluginSpec` table, for example in `specs`
        ...     rate = 50.0
        ...
        ...     def configure(self, setup):
        ...         self.joint = setup.joint("wheel_joint", self.plugin.position)
        ...         self.topics = (setup.bus.advertise("/speed", "std_msgs/msg/Float64"),)
        ...
        ...     def measure(self, state, count):
        ...         self.topics[0].publish(from_fields("std_msgs/msg/Float64", [state.velocity(self.joint)]))
    """

    name: str = ""


class Controller(Commanding):
    """Moves joints to commanded positions, velocities or efforts.

    Attributes:
        kind: the ``kind`` of its `PluginSpec` tables.
        specs: its own tables, for plugins that `urdfkit.description.plugins` does not support.
        rate: rate of `write` [Hz]; zero means every step.
        loop: control loop of controllers that can be listed, started and stopped; None for a plugin without one.
        initial_positions: joint → initial position [rad] or [m], unless the user sets it.

    Examples:
        >>> from urdfkit.sim import Controller
        >>> class Lock(Controller):
        ...     kind = "lock"  # of a `PluginSpec` table, for example in `specs`
        ...     rate = 50.0
        ...
        ...     def configure(self, setup):
        ...         self.joint = setup.joint("door_joint", self.plugin.position)
        ...
        ...     def begin(self, state):
        ...         self.closed = state.position(self.joint)
        ...
        ...     def write(self, state, motors):
        ...         motors.exert(self.joint, 100.0 * (self.closed - state.position(self.joint)))
        >>> lock = Lock(plugin=None, spec=None)  # a simulation passes the element and its table
        >>> lock.schedule(dt=0.001, motors=None)
        >>> lock.next(1)  # step before which `write` is due
        20
    """

    rate: float = 0.0
    loop: ControlLoop | None = None

    def __init__(self, plugin: Plugin, spec: PluginSpec) -> None:
        super().__init__(plugin, spec)
        self.initial_positions: dict[str, float] = {}

    def schedule(self, dt: float, motors: Motors) -> None:
        """Set the simulation's step [s] and the motors of the robot, after `configure`."""
        self._ticks, self.motors = PeriodicSteps(self.rate, dt), motors

    def next(self, step: int) -> int:
        """Return the first step from `step` on before which `write` is due."""
        return self._ticks.next(step)

    def joint_pids(self) -> Iterator[tuple[str, JointPid]]:
        """Yield each joint with a PID controller, with its path below the robot.

        Examples:
            >>> import urdfkit
            >>> controller = urdfkit.Simulator("rrbot").world.builder.robot_list[0].plugins.controllers[0]
            >>> {path: pid.gains.p for path, pid in controller.joint_pids()}
            {'joint1_position_controller/joint1': 100.0, 'joint2_position_controller/joint2': 100.0}
        """
        if self.loop is not None:
            yield from self.loop.joint_pids()

    def wake(self) -> None:
        """Call `write` at the next opportunity, because a gain has changed.

        Examples:
            >>> from dataclasses import replace
            >>> import urdfkit
            >>> controller = urdfkit.Simulator("rrbot").world.builder.robot_list[0].plugins.controllers[0]
            >>> joint, pid = next(controller.joint_pids())
            >>> pid.gains = replace(pid.gains, p=50.0)
            >>> controller.wake()
        """
        if self.loop is not None:
            self.loop.wake()

    def begin(self, state: State) -> None:
        """Start from the initial state."""
