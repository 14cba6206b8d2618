"""JointPositionController and JointController of gz sim.

Sources: gz-sim main, src/systems/joint_position_controller/JointPositionController.cc and
src/systems/joint_controller/JointController.cc; gz-math PID.
"""

from collections.abc import Iterator
from math import inf
from typing import Any

from urdfkit.description.plugins import PluginSpec
from urdfkit.description.urdf.robot import Plugin
from urdfkit.errors import SimulationError
from urdfkit.messages import FLOAT
from urdfkit.sim.plugins.base import Controller
from urdfkit.sim.plugins.controllers.joint_handle import JointHandle, JointPid
from urdfkit.sim.plugins.parameters import Parameters
from urdfkit.sim.plugins.setup import LARGEST, Setup, is_command
from urdfkit.sim.plugins.topic_names import Topics
from urdfkit.sim.state.joint_commands import Motors
from urdfkit.sim.state.periodic_steps import NEVER
from urdfkit.sim.state.pid import Gains
from urdfkit.sim.state.robot_state import State


class _GzJoint:
    """Parameters common to both controllers: joints, topic, PID gains and limits of the command."""

    def __init__(self, plugin: Plugin, spec: PluginSpec, setup: Setup) -> None:
        read = self.read = Parameters(plugin, spec, setup.names)
        self.setup = setup
        names = read.texts("joints")
        if not names:
            message = f"<{read.tag('joints')}> is missing: it names the joint to control"
            raise SimulationError(message, position=read.place("joints"), code="Z831")
        place = read.place("joints")
        joints = setup.kinematics.robot.joint_by_name
        self.handles = [JointHandle(setup.kinematics, joints[setup.joint(name, place)]) for name in names]
        for meaning in ("use_actuator_message",):
            if read.flag(meaning):
                setup.note(f"{read.place(meaning)}: <{read.tag(meaning)}> is not simulated: commands are numbers")
        gains = Gains(
            read.number("p_gain"), read.number("i_gain"), read.number("d_gain"),
            read.number("i_min"), read.number("i_max"), True,
        )  # fmt: skip
        self.joint_pids = [JointPid(handle, gains) for handle in self.handles]
        self.least, self.most = read.number("min_command"), read.number("max_command")
        self.offset = read.number("command_offset")
        if self.most < self.least:
            raise SimulationError(
                f"<{read.tag('min_command')}> is {self.least:g} and <{read.tag('max_command')}> is {self.most:g}; "
                "the minimum must not exceed the maximum",
                position=read.place("max_command") if read.is_written("max_command") else read.place("min_command"),
                code="Z832",
            )
        topics = Topics(plugin, spec)
        topic = read.text("command_topic").replace("{joint}", names[0])
        if sub := read.text("command_subtopic"):
            topic = f"/model/{setup.model}/{sub}"
        self.topic = topics.resolve(topic)

    def listen(self, take: Any) -> None:
        """Subscribe, and pass every command that is finite and not too large to `take`."""

        def receive(message: Any) -> None:
            if is_command([message.data]):
                take(float(message.data))
            else:
                self.setup.note(f"dropped a command on {self.topic} that is not finite, or above {LARGEST:g}")

        self.setup.bus.subscribe(self.topic, FLOAT, receive)

    def bounds(self, handle: JointHandle) -> tuple[float, float]:
        """Return the centre and the half-width of the effort range of a joint [N·m] or [N]."""
        least, most = max(self.least, -handle.limit), min(self.most, handle.limit)
        return (least + most) / 2, max(0.0, (most - least) / 2)


class _Servo(Controller):
    """Base of plugins that command joints without a controller manager; updated only after a new command."""

    _joint: _GzJoint
    _by_effort: bool
    _initial: float

    def _start(self, setup: Setup, initial: str) -> None:
        """Read the common parameters and the initial position or velocity, and subscribe."""
        self._joint = _GzJoint(self.plugin, self.spec, setup)
        self._dt, self._wake = setup.dt, 0
        self._initial = self._wanted = self._joint.read.number(initial)
        self._joint.listen(self._take)

    def _take(self, value: float) -> None:
        self._wanted, self._wake = value, 0

    def begin(self, state: State) -> None:
        """Return to the initial command."""
        self._wanted, self._wake = self._initial, 0
        for joint_pid in self._joint.joint_pids:
            joint_pid.integral.reset()

    def joint_pids(self) -> Iterator[tuple[str, JointPid]]:
        """Yield each PID with its path: ``joint_position_controller/JOINT``, ``joint_controller/JOINT``."""
        if self._by_effort:
            for joint_pid in self._joint.joint_pids:
                yield f"{self.kind}/{joint_pid.handle.name}", joint_pid

    def wake(self) -> None:
        """Request an update in the next step."""
        self._wake = 0

    def next(self, step: int) -> int:
        """Return the first step at or after `step` before which `write` is due."""
        return max(step, self._wake)


class JointPositionController(_Servo):
    """A PID on position whose output is an effort, or a velocity with ``use_velocity_commands``."""

    kind = "joint_position_controller"

    def configure(self, setup: Setup) -> None:
        """Read the parameters and subscribe.

        Raises:
            SimulationError: a parameter is invalid, with its position.
        """
        self._start(setup, "initial_position")
        self._by_effort = not self._joint.read.flag("use_velocity_commands")

    def write(self, state: State, motors: Motors) -> None:
        """Write the commands of the joints."""
        joint = self._joint
        if not self._by_effort:
            # Move at the greatest command, and over the remaining error in one step.
            for handle in joint.handles:
                error = self._wanted - state.position(handle.name)
                handle.turn(motors, min(joint.most, max(-joint.most, error / self._dt)))
            self._wake = state.step + 1
            return
        for joint_pid in joint.joint_pids:
            # The bounds of the command need not be symmetric about zero.
            middle, half = joint.bounds(joint_pid.handle)
            joint_pid.follow(state, motors, self._wanted, feedforward=joint.offset - middle, limit=half)
            if middle:
                motors.exert(joint_pid.handle.name, middle)
        self._wake = NEVER


class JointController(_Servo):
    """Velocity commands, followed by the joint's motor, or by a PID with effort output (``use_force_commands``)."""

    kind = "joint_controller"

    def configure(self, setup: Setup) -> None:
        """Read the parameters and subscribe.

        Raises:
            SimulationError: a parameter is invalid, with its position.
        """
        self._start(setup, "initial_velocity")
        self._by_effort = self._joint.read.flag("use_force_commands")

    def write(self, state: State, motors: Motors) -> None:
        """Write the commands of the joints."""
        joint = self._joint
        rest = inf
        for joint_pid in joint.joint_pids:
            if not self._by_effort:
                joint_pid.handle.turn(motors, self._wanted)
                continue
            joint_pid.chase(state, motors, self._wanted, self._dt, limit=joint.most)
            rest = min(rest, 0.0 if joint_pid.gains.d else joint_pid.rest())
        self._wake = NEVER if rest == inf else state.step + max(1, round(rest / self._dt))
