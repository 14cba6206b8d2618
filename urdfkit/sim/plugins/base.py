"""Drive, Sensor, Controller: what a plugin of the simulator is, and what it is given.

Three phases. `configure` once: read parameters, look up joints, advertise and subscribe. ``write``, before the engine
advances: set motor targets. ``read``/``measure``, after it: look at the state, which nobody can change, and publish.
A plugin class is named in `DRIVES`, `SENSORS` or `CONTROLLERS` and chosen by the ``kind`` of its `PluginSpec`.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator
from typing import TYPE_CHECKING, ClassVar

from urdfkit.sim.state.ticks import NEVER, Ticks

if TYPE_CHECKING:
    from urdfkit.bus import Topic
    from urdfkit.description.plugins import PluginSpec
    from urdfkit.description.urdf.robot import Plugin
    from urdfkit.sim.plugins.controllers.control_loop import ControlLoop
    from urdfkit.sim.plugins.controllers.joint_handle import Follower
    from urdfkit.sim.plugins.odometry import Pose
    from urdfkit.sim.plugins.setup import Setup
    from urdfkit.sim.state.joint_commands import Motors
    from urdfkit.sim.state.robot_state import State


class Drive(ABC):
    """Turns velocity commands into wheel motion, and wheel motion into odometry.

    Attributes:
        kind: the ``kind`` of the tables it answers to.
        specs: tables it brings itself, for plugins that `urdfkit.description.plugins` does not know.
        write_rate: how often `write` is due [Hz]; zero means every step.
        read_rate: how often `read` is due [Hz]; zero means every step.
        resting: `write` has nothing to do until something changes; the simulator then leaves it out.
        commands: topics of type Twist it listens to.
    """

    kind: ClassVar[str]
    specs: ClassVar[tuple[PluginSpec, ...]] = ()
    write_rate: float = 0.0
    read_rate: float = 0.0
    resting: bool = False
    commands: tuple[str, ...] = ()

    def __init__(self, plugin: Plugin, spec: PluginSpec) -> None:
        self.plugin = plugin
        self.spec = spec

    @abstractmethod
    def configure(self, setup: Setup) -> None:
        """Read the parameters, advertise and subscribe.

        Raises:
            SimulationError: a parameter makes no sense, with its place.
        """

    @abstractmethod
    def write(self, state: State, motors: Motors) -> None:
        """Set motor targets for the time until the next call."""

    @abstractmethod
    def read(self, state: State) -> None:
        """Publish what was measured."""

    @abstractmethod
    def reset(self) -> None:
        """Forget commands and odometry."""

    def estimate(self, state: State) -> dict[str, Pose]:
        """Return odometry frame → pose in it; empty for a drive without odometry."""
        return {}


class Sensor(ABC):
    """Measures and publishes.

    Publications that fell due while nobody listened are counted together at the next stop, as in `publishers`; so
    what a sensor tells may depend on the number of a publication (`done`), never on how often it was asked.

    Attributes:
        kind: the ``kind`` of the tables it answers to.
        specs: tables it brings itself, for plugins that `urdfkit.description.plugins` does not know.
        rate: how often `measure` is due [Hz]; zero means every step.
        name: what the description calls it; empty where it does not.
        topics: where it publishes. The simulation stops for it while somebody listens there, always if there is none.
        done: publications so far.
        due: the step of the next publication; before it there is nothing to catch up with, but for classes that have a
            `catch_up` of their own.
    """

    kind: ClassVar[str]
    specs: ClassVar[tuple[PluginSpec, ...]] = ()
    rate: float = 0.0
    name: str = ""
    topics: tuple[Topic, ...] = ()
    done: int = 0
    due: int = 0

    def __init__(self, plugin: Plugin, spec: PluginSpec) -> None:
        self.plugin = plugin
        self.spec = spec

    @abstractmethod
    def configure(self, setup: Setup) -> None:
        """Read the parameters and advertise.

        Raises:
            SimulationError: a parameter makes no sense, with its place.
        """

    def schedule(self, dt: float, step: int = 0) -> None:
        """Take note of the simulation's step [s], after `configure`, and of how many there have been."""
        self._ticks = Ticks(self.rate, dt)
        self.done = self._ticks.until(step)
        self.due = self._ticks.after(step)

    def next_stop(self, step: int) -> int:
        """Return the step at which the simulation has to stop for it; `NEVER` while nobody listens."""
        for topic in self.topics:
            if topic.subscribers:
                return self._ticks.after(step)
        return NEVER if self.topics else self._ticks.after(step)

    def look_due(self, step: int) -> int:
        """Return the first step from `step` on after which it wants to look, whether anybody listens or not."""
        return self.due if type(self).catch_up is Sensor.catch_up else step

    def catch_up(self, state: State) -> None:
        """Measure what has fallen due."""
        if state.step < self.due:
            return
        fallen = self._ticks.until(state.step) - self.done
        self.done += fallen
        self.due = self._ticks.after(state.step)
        self.measure(state, fallen)

    def reset(self) -> None:
        """Start again at step 0."""
        self.done = 0
        self.due = self._ticks.after(0)

    @abstractmethod
    def measure(self, state: State, count: int) -> None:
        """Publish a measurement of this state, which stands for so many publications."""


class Controller(ABC):
    """Moves joints to commanded positions, velocities or efforts.

    Attributes:
        kind: the ``kind`` of the tables it answers to.
        specs: tables it brings itself, for plugins that `urdfkit.description.plugins` does not know.
        rate: how often `write` and `read` are due [Hz]; zero means every step.
        loop: the control loop of controllers that can be listed, started and stopped; None where there are none.
        initial_positions: joint → where it starts [rad] or [m], where the user does not say.
    """

    kind: ClassVar[str]
    specs: ClassVar[tuple[PluginSpec, ...]] = ()
    rate: float = 0.0
    loop: ControlLoop | None = None

    def __init__(self, plugin: Plugin, spec: PluginSpec) -> None:
        self.plugin = plugin
        self.spec = spec
        self.initial_positions: dict[str, float] = {}

    def schedule(self, dt: float) -> None:
        """Take note of the simulation's step [s], after `configure`."""
        self._ticks = Ticks(self.rate, dt)

    def due(self, step: int) -> bool:
        """Whether `write` is due before a step, and `read` after it."""
        return self._ticks.falls_on(step)

    def after(self, step: int) -> int:
        """Return the first step after `step` at which it is."""
        return self._ticks.after(step)

    def followers(self) -> Iterator[tuple[str, Follower]]:
        """Yield whatever obeys by PID, with a path below the robot to tell it by."""
        if self.loop is not None:
            yield from self.loop.followers()

    def wake(self) -> None:
        """Look at the commands anew: a gain has changed."""
        if self.loop is not None:
            self.loop.wake()

    def begin(self, state: State) -> None:  # noqa: B027 - most have nothing to forget
        """Forget the past: the robot stands where it starts."""

    @abstractmethod
    def configure(self, setup: Setup) -> None:
        """Read the parameters, advertise and subscribe.

        Raises:
            SimulationError: a parameter makes no sense, with its place.
        """

    @abstractmethod
    def write(self, state: State, motors: Motors) -> None:
        """Set motor targets for the time until the next call."""

    @abstractmethod
    def read(self, state: State) -> None:
        """Publish what was measured."""
