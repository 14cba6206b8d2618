"""Base class of the controllers of ros_control and ros2_control, and the hardware interfaces that they command."""

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass, field
from math import inf
from typing import Any, ClassVar

from urdfkit.bus import Topic
from urdfkit.description.control import Settings
from urdfkit.description.xml.source import Position
from urdfkit.errors import DescriptionError, did_you_mean
from urdfkit.sim.plugins.builtin_publishers import Publication
from urdfkit.sim.plugins.controllers.command_output import Output
from urdfkit.sim.plugins.controllers.joint_handle import JointPid
from urdfkit.sim.plugins.odometry import Pose
from urdfkit.sim.plugins.setup import Setup
from urdfkit.sim.state.joint_commands import Motors
from urdfkit.sim.state.periodic_steps import NEVER
from urdfkit.sim.state.robot_state import State

LEFT_OUT = "left-out"
"""Code of errors about joints whose hardware is ignored; a repair reports the hardware."""


@dataclass
class Hardware:
    """Joints and command interfaces of one robot.

    Attributes:
        setup: setup of the plugin.
        resolve: returns the absolute name of a topic, which may be relative to the controller manager's namespace.
        ros: version of ROS, 1 or 2.
        period: period of the control loop [s].
        outputs: (joint, interface) → output, in the order of the description.
        joints: joints whose states are available, in the order of the description.
        wake: requests an update in the next control period.
        left_out: joint → hardware that the simulation left out.
        source: element that error messages name if a joint has no interface, e.g. ``<transmission>``.
    """

    setup: Setup
    resolve: Callable[[str], str]
    ros: int
    period: float
    outputs: dict[tuple[str, str], Output]
    joints: tuple[str, ...]
    wake: Callable[[], None]
    source: str = "<transmission>"
    left_out: dict[str, str] = field(default_factory=dict)

    def output(self, entry: Settings, interface: str, place: Position | None = None) -> Output:
        """Return the output of a joint named in a parameter.

        Args:
            entry: the parameter that names the joint.
            interface: the command interface.
            place: source position of the name of the interface; None if only the type of the controller names it.

        Raises:
            DescriptionError: unknown joint, or the joint lacks the interface; with the position of the parameter.
        """
        joint = entry.value or ""
        found = self.outputs.get((joint, interface))
        if found is not None:
            return found
        joints = list(dict.fromkeys(name for name, _ in self.outputs))
        robot = self.setup.kinematics.robot
        code = "K965" if self.ros == 2 else "K963"
        if joint in self.left_out:
            message, code = f"joint `{joint}` is not controlled: its {self.left_out[joint]} is ignored", LEFT_OUT
        elif joint in joints:
            others = " or ".join(kind for name, kind in self.outputs if name == joint)
            message = f"joint `{joint}` accepts {others}, not {interface}; check its {self.source}"
        elif joint in robot.joint_by_name:
            message = f"joint `{joint}` has no {self.source} with an interface for {interface}"
        else:
            message = f"no joint `{joint}` in robot `{robot.name}`" + did_you_mean(joint, robot.joint_by_name)
            code, place = "K959", None
        raise DescriptionError(message, position=place or entry.position, code=code)


class RosController(ABC):
    """A controller, configured when it is loaded, and updated between `start` and `stop`.

    Args:
        name: name of the controller.
        settings: parameters of the controller.
        hardware: joints and command interfaces of the robot.

    Raises:
        DescriptionError: a parameter is missing or invalid, with its position.

    Attributes:
        types: type names that the class implements → variant of each type.
        outputs: command interfaces, claimed exclusively while the controller runs.
        publications: publications while the controller runs.
        commands: topic → type, of the Twist and TwistStamped topics it subscribes to.
        running: whether the controller is started.
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
    def joint_pids(self) -> tuple[JointPid, ...]:
        """The controller's PIDs, one per joint."""
        return ()

    @abstractmethod
    def configure(self) -> None:
        """Read the parameters, advertise and subscribe.

        Raises:
            DescriptionError: a parameter is missing or invalid, with its position.
        """

    def start(self, state: State) -> None:
        """Start from the present state."""
        for output in self.outputs:
            output.start(state)

    def stop(self) -> None:  # noqa: B027 - most controllers have nothing to cancel
        """Stop, and cancel the action goal if there is one."""

    def update(self, state: State, motors: Motors) -> float:
        """Write the commands; return the time until the next update is needed [s]; 0 means the next control period."""
        return inf

    def estimate(self, state: State) -> dict[str, Pose]:
        """Return odometry frame → pose of the base in that frame; empty for a controller without odometry."""
        return {}

    # For subclasses

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
        """Publish the messages that `build` makes from states, at a rate [Hz], while the controller runs."""
        self.publications.append(Report(topic, rate, self.hardware.setup.dt, lambda: self.running, build))

    def note(self, text: str) -> None:
        """Report a warning about this controller to the user."""
        self.hardware.setup.note(f"controller `{self.name}`: {text}")


class Report(Publication):
    """Periodic publication of a topic while a controller runs.

    Args:
        topic: topic of the messages.
        rate: rate [Hz]; zero or less means every step.
        dt: time step of the simulation [s].
        running: returns whether the controller runs.
        build: returns a function that builds the message of a state; it may be called after later steps.
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
        """Return the next step at which a message is due; `NEVER` while the controller is stopped."""
        return super().stop(step) if self._running() else NEVER

    def act(self, state: State) -> None:
        """Publish the messages that are due; skip those due while the controller was stopped."""
        if self._running():
            super().act(state)
        else:
            self.reset(state.step)

    def message(self, state: State) -> Callable[[], Any]:
        """Return a function that builds the message of this state; it may be called after later steps."""
        return self._build(state)
