"""Law: a controller of ros_control or ros2_control, and the hardware it is given."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from math import inf
from typing import TYPE_CHECKING, Any, ClassVar

from urdfkit.errors import DescriptionError, did_you_mean
from urdfkit.sim.plugins.controllers.command_output import Output
from urdfkit.sim.plugins.publishers import Publication
from urdfkit.sim.state.ticks import NEVER

if TYPE_CHECKING:
    from urdfkit.bus import Topic
    from urdfkit.description.control import Settings
    from urdfkit.sim.plugins.controllers.joint_handle import Follower
    from urdfkit.sim.plugins.odometry import Pose
    from urdfkit.sim.plugins.setup import Setup
    from urdfkit.sim.state.joint_commands import Motors
    from urdfkit.sim.state.robot_state import State


@dataclass
class Hardware:
    """The joints of one robot as its controllers see them.

    Attributes:
        setup: the plugin's.
        resolve: turns a topic name, relative to the controller manager's namespace, into an absolute one.
        ros: 1 or 2.
        period: of the control loop [s].
        outputs: (joint, interface) → what obeys, in the order they are written.
        joints: the joints whose state is known, in the order they are reported.
        wake: asks for an update in the next control period.
        source: what to name when a joint is missing, e.g. ``<transmission>``.
    """

    setup: Setup
    resolve: Callable[[str], str]
    ros: int
    period: float
    outputs: dict[tuple[str, str], Output]
    joints: tuple[str, ...]
    wake: Callable[[], None]
    source: str = "<transmission>"

    def output(self, entry: Settings, interface: str) -> Output:
        """Return the output of a joint named in a parameter.

        Raises:
            DescriptionError: no such joint, or not that interface, at the place where it is named.
        """
        joint = entry.value or ""
        found = self.outputs.get((joint, interface))
        if found is not None:
            return found
        known = list(dict.fromkeys(name for name, _ in self.outputs))
        robot = self.setup.kinematics.robot
        if joint in known:
            others = " or ".join(kind for name, kind in self.outputs if name == joint)
            message = f"joint `{joint}` takes {others}, not {interface}; look at its {self.source}"
        elif joint in robot.joint_by_name:
            message = f"joint `{joint}` has no {self.source} with an interface for {interface}"
        else:
            message = f"no joint `{joint}` in robot `{robot.name}`{did_you_mean(joint, robot.joint_by_name)}"
        raise DescriptionError(message, position=entry.position)


class Law(ABC):
    """A controller: configured when it is loaded, at work between `start` and `stop`.

    Args:
        name: its own.
        settings: its parameters.
        hardware: what it may command.

    Raises:
        DescriptionError: a parameter is missing or makes no sense, with its place.

    Attributes:
        types: the names of its types, each with what tells it from the others.
        outputs: what it commands; nobody else may while it runs.
        publications: what it publishes while it runs.
        commands: topics of type Twist or TwistStamped it listens to.
        running: whether it is at work.
    """

    types: ClassVar[dict[str, str]] = {}

    def __init__(self, name: str, settings: Settings, hardware: Hardware) -> None:
        self.name = name
        self.type = settings.text("type", "")
        self.settings = settings
        self.hardware = hardware
        self.outputs: tuple[Output, ...] = ()
        self.publications: list[Publication] = []
        self.commands: dict[str, str] = {}
        self.running = False
        self.configure()

    @property
    def followers(self) -> tuple[Follower, ...]:
        """What of it obeys by PID."""
        return ()

    @abstractmethod
    def configure(self) -> None:
        """Read the parameters, advertise and subscribe.

        Raises:
            DescriptionError: a parameter is missing or makes no sense, with its place.
        """

    def start(self, state: State) -> None:
        """Begin where the robot is."""
        for output in self.outputs:
            output.start(state)

    def stop(self) -> None:  # noqa: B027 - most have nobody to tell
        """End, and tell whoever waits for something."""

    def update(self, state: State, motors: Motors) -> float:
        """Command the outputs; return how long that needs no attention [s]: 0 is until the next control period."""
        return inf

    def estimate(self, state: State) -> dict[str, Pose]:
        """Return odometry frame → pose in it; empty for a controller without odometry."""
        return {}

    # For the laws

    def topic(self, name: str) -> str:
        """Return the absolute name of a topic of this controller."""
        return self.hardware.resolve(f"{self.name}/{name}")

    def listen(self, topic: str, type: str, callback: Callable[[Any], None]) -> None:
        """Subscribe; messages are dropped while the controller is stopped, as a controller of ros_control does."""

        def receive(message: Any) -> None:
            if self.running:
                callback(message)
                self.hardware.wake()

        self.hardware.setup.bus.subscribe(topic, type, receive)

    def report(self, topic: Topic, rate: float, build: Callable[[State], Callable[[], Any]]) -> None:
        """Publish what `build` makes of the state at a rate [Hz] while the controller runs."""
        self.publications.append(Report(topic, rate, self.hardware.setup.dt, lambda: self.running, build))

    def note(self, text: str) -> None:
        """Tell the user something about this controller."""
        self.hardware.setup.note(f"controller `{self.name}`: {text}")


class Report(Publication):
    """A topic that is filled while a controller runs.

    Args:
        topic: where to.
        rate: [Hz]; zero or less means every step.
        dt: the simulation's step [s].
        running: whether the controller runs.
        build: returns what builds the message of this moment, also later.
    """

    def __init__(
        self,
        topic: Topic,
        rate: float,
        dt: float,
        running: Callable[[], bool],
        build: Callable[[State], Callable[[], Any]],
    ) -> None:
        super().__init__(topic, rate, dt)
        self._running = running
        self._build = build

    def stop(self, step: int) -> int:
        """Return the step at which the simulation has to stop for it."""
        return super().stop(step) if self._running() else NEVER

    def act(self, state: State) -> None:
        """Publish the messages that are due, except those of the time the controller was stopped."""
        if self._running():
            super().act(state)
        else:
            self.reset(state.step)

    def message(self, state: State) -> Callable[[], Any]:
        """Return a function that builds the message of this state, also later."""
        return self._build(state)
