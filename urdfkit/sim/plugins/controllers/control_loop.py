"""ControlLoop: loads, starts and stops the controllers of one robot and updates them in every control period."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from math import ceil, inf
from typing import Any

from urdfkit.description.control import Settings
from urdfkit.description.control.controller_parameters import unknown_parameters
from urdfkit.description.control.controller_types import NOT_SIMULATED
from urdfkit.description.urdf.repair_record import Repair
from urdfkit.errors import SimulationError, UrdfkitError, did_you_mean
from urdfkit.sim.plugins.builtin_publishers import Publication
from urdfkit.sim.plugins.controllers.command_output import Output
from urdfkit.sim.plugins.controllers.controller import LEFT_OUT, Hardware, RosController
from urdfkit.sim.plugins.controllers.controller_types import load_ros_controller
from urdfkit.sim.plugins.controllers.joint_handle import JointPid
from urdfkit.sim.state.joint_commands import Motors
from urdfkit.sim.state.periodic_steps import NEVER, PeriodicSteps
from urdfkit.sim.state.robot_state import State

STATES = {1: ("running", "stopped"), 2: ("active", "inactive")}
"""ROS version → names of the states of a running and of a loaded, stopped controller."""


@dataclass(frozen=True)
class ControllerStatus:
    """State of one controller, as ``list_controllers`` reports it.

    Attributes:
        name: name of the controller without its namespace.
        namespace: namespace of its controller manager.
        type: type of the controller.
        state: ``running`` or ``stopped`` (ROS 1), ``active`` or ``inactive`` (ROS 2), ``unloaded``.
        claims: ``joint/interface`` of each claimed command interface.
    """

    name: str
    namespace: str
    type: str
    state: str
    claims: tuple[str, ...]


class ControlLoop:
    """Controller manager of one robot.

    Args:
        namespace: namespace of the controller manager.
        configured: name → parameters of each configured controller.
        hardware: joints and command interfaces of the robot.
        hold: hold the position of joints that no controller commands; otherwise these joints move freely.

    Attributes:
        changed: called with each controller that was loaded or unloaded.
        services: name of each service of the controller manager → type, and function from the request to the response.
    """

    def __init__(
        self, namespace: str, configured: dict[str, Settings], hardware: Hardware, *, hold: bool = True
    ) -> None:
        self.namespace = namespace
        self.configured = configured
        self.hardware = hardware
        self.controllers: dict[str, RosController] = {}
        self.publications: list[Publication] = []
        self.services: dict[str, tuple[str, Callable[[Any], Any]]] = {}
        self.halted = False
        self.changed: Callable[[RosController], None] = lambda controller: None
        self._hold = hold
        self._state: State | None = None
        self._ticks = PeriodicSteps(1.0 / hardware.period, hardware.setup.dt)
        self._wake = 0
        self._first: dict[str, Output] = {}
        for (joint, _), output in hardware.outputs.items():
            self._first.setdefault(joint, output)

    # Time

    def next(self, step: int) -> int:
        """Return the first step at or after `step` at which a control period begins and an update is due."""
        return NEVER if self._wake >= NEVER else self._ticks.next(max(step, self._wake))

    def wake(self) -> None:
        """Request an update in the next control period."""
        self._wake = 0

    def joint_pids(self) -> Iterator[tuple[str, JointPid]]:
        """Yield each PID with its path: ``CONTROLLER/JOINT``, or ``hardware/JOINT`` for a PID of the hardware."""
        for controller in self.controllers.values():
            for joint_pid in controller.joint_pids:
                yield f"{controller.name}/{joint_pid.handle.name}", joint_pid
        for output in self.hardware.outputs.values():
            if output.joint_pid is not None:
                yield f"hardware/{output.joint_pid.handle.name}", output.joint_pid

    def begin(self, state: State) -> None:
        """Start from the present state, and restart the running controllers."""
        self._state = state
        self.halted = False
        for output in self.hardware.outputs.values():
            output.handle.reset()
            output.start(state)
        for controller in self.running():
            controller.start(state)
        self.wake()

    def update(self, state: State, motors: Motors) -> None:
        """Update the running controllers, and hold or release the joints that no controller commands."""
        rest = inf
        free = dict(self._first)
        if not self.halted:
            for controller in self.running():
                rest = min(rest, controller.update(state, motors))
                for output in controller.outputs:
                    free.pop(output.handle.name, None)
        for output in free.values():
            if self._hold or self.halted:
                rest = min(rest, output.keep(state, motors))
            else:
                output.handle.release(motors)
        dt = self.hardware.setup.dt
        self._wake = NEVER if rest == inf else state.step + max(1, ceil(rest / dt - 1e-6))

    def halt(self, halted: bool) -> None:
        """Suspend all controllers and hold the joints (emergency stop), or resume."""
        if halted and not self.halted and self._state is not None:
            for output in self.hardware.outputs.values():
                output.start(self._state)
        self.halted = halted
        self.wake()

    def running(self) -> list[RosController]:
        """Return the running controllers."""
        return [controller for controller in self.controllers.values() if controller.running]

    # The controller manager's services

    def status(self) -> tuple[ControllerStatus, ...]:
        """Return the state of each configured controller."""
        found = []
        running, stopped = STATES[self.hardware.ros]
        for name, settings in self.configured.items():
            controller = self.controllers.get(name)
            state = "unloaded" if controller is None else running if controller.running else stopped
            claims = () if controller is None else tuple("/".join(output.claim) for output in controller.outputs)
            found.append(ControllerStatus(name, self.namespace, settings.text("type", ""), state, claims))
        return tuple(found)

    def load(self, name: str) -> bool:
        """Load a controller; return False if its type is not simulated.

        Raises:
            SimulationError: unknown controller.
            DescriptionError: a parameter is invalid, with its position.
        """
        if name not in self.configured:
            raise SimulationError(
                f"no controller `{name}` in {self.namespace or '/'}" + did_you_mean(name, self.configured)
            )
        if name in self.controllers:
            return True
        controller = load_ros_controller(name, self.configured[name], self.hardware)
        if controller is None:
            kind, place = self.configured[name].text("type", ""), self.configured[name].group("type").position
            message = f"controller `{name}`: {kind} is not simulated; the controller is ignored"
            code = "Z833" if kind in NOT_SIMULATED else "K962"
            self.hardware.setup.repairs.add(Repair("controller", code, message, place))
            return False
        if unknown := unknown_parameters(self.configured[name]):
            names = ", ".join(f"`{each.name}`" for each in unknown)
            self.hardware.setup.note(f"{unknown[0].place}: controller `{name}` ignores the unknown parameters {names}")
        self.controllers[name] = controller
        self.publications += controller.publications
        self.changed(controller)
        return True

    def unload(self, name: str) -> None:
        """Unload a stopped controller.

        Raises:
            SimulationError: the controller is running, unknown or not loaded.
        """
        controller = self._loaded(name)
        if controller.running:
            raise SimulationError(f"controller `{name}` runs; stop it before it is unloaded")
        for publication in controller.publications:
            self.publications.remove(publication)
        del self.controllers[name]
        self.changed(controller)

    def switch(self, start: Iterable[str] = (), stop: Iterable[str] = ()) -> None:
        """Stop some controllers and start others; after an error, all controllers are as before.

        Raises:
            SimulationError: unknown controller, or two controllers need the same joint; the message names both.
        """
        stopping = [self._loaded(name) for name in stop]
        starting = [self._loaded(name) for name in start if self.load(name)]
        after = [controller for controller in self.running() if controller not in stopping]
        after += [controller for controller in starting if controller not in after]
        owners: dict[str, RosController] = {}
        for controller in after:
            for output in controller.outputs:
                joint = output.handle.name
                owner = owners.setdefault(joint, controller)
                if owner is not controller:
                    raise SimulationError(
                        f"controller `{controller.name}` needs joint `{joint}`, "
                        f"which `{owner.name}` controls; stop one of the two"
                    )
        for controller in stopping:
            controller.stop()
            controller.running = False
            for output in controller.outputs:
                if output.interface != "position" and self._state is not None:
                    output.start(self._state)
        for controller in starting:
            if not controller.running:
                controller.running = True
                if self._state is not None:
                    controller.start(self._state)
        self.wake()

    def start_all(self) -> None:
        """Start all configured controllers in order.

        On a conflict of joints, warn and leave the later one loaded. Leave out controllers with a wrong parameter.

        Raises:
            UrdfkitError: a parameter is wrong, and robots that need a repair are refused; with its position.
        """
        for name in self.configured:
            self.start(name)

    def start(self, name: str) -> None:
        """Start a controller as the simulation begins; see `start_all`."""
        try:
            self.switch(start=[name])
        except UrdfkitError as error:
            if name not in self.controllers:
                effect = f"controller `{name}` is ignored"
                if error.code == LEFT_OUT:
                    self.hardware.setup.note(f"{error.position}: {error.message}; {effect}")
                else:
                    if error.code == "K963":
                        error.position = self.configured[name].group("type").position
                    self.hardware.setup.repairs.leave_out(error, effect, "controller", "K971")
            elif isinstance(error, SimulationError):
                self.hardware.setup.note(f"{self.configured[name].place}: not started: {error}")
            else:
                raise

    def _loaded(self, name: str) -> RosController:
        if name not in self.controllers:
            if name in self.configured:
                raise SimulationError(f"controller `{name}` is not loaded")
            raise SimulationError(
                f"no controller `{name}` in {self.namespace or '/'}" + did_you_mean(name, self.configured)
            )
        return self.controllers[name]
