"""ControlLoop: loads, starts and stops the controllers of one robot and updates them in every control period."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from math import ceil, inf

from urdfkit.description.control import Settings
from urdfkit.errors import SimulationError, did_you_mean
from urdfkit.sim.plugins.builtin_publishers import Publication
from urdfkit.sim.plugins.controllers.command_output import Output
from urdfkit.sim.plugins.controllers.controller import Hardware, Law
from urdfkit.sim.plugins.controllers.controller_types import load_law
from urdfkit.sim.plugins.controllers.joint_handle import Follower
from urdfkit.sim.state.joint_commands import Motors
from urdfkit.sim.state.robot_state import State
from urdfkit.sim.state.ticks import NEVER, Ticks

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
        known: name → parameters of each configured controller.
        hardware: joints and command interfaces of the robot.
        hold: hold the position of joints that no controller commands; otherwise these joints move freely.
    """

    def __init__(self, namespace: str, known: dict[str, Settings], hardware: Hardware, *, hold: bool = True) -> None:
        self.namespace = namespace
        self.known = known
        self.hardware = hardware
        self.laws: dict[str, Law] = {}
        self.publications: list[Publication] = []
        self.halted = False
        self._hold = hold
        self._state: State | None = None
        self._ticks = Ticks(1.0 / hardware.period, hardware.setup.dt)
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

    def followers(self) -> Iterator[tuple[str, Follower]]:
        """Yield each PID with its path: ``CONTROLLER/JOINT``, or ``hardware/JOINT`` for a PID of the hardware."""
        for law in self.laws.values():
            for follower in law.followers:
                yield f"{law.name}/{follower.handle.name}", follower
        for output in self.hardware.outputs.values():
            if output.follower is not None:
                yield f"hardware/{output.follower.handle.name}", output.follower

    def begin(self, state: State) -> None:
        """Start from the present state, and restart the running controllers."""
        self._state = state
        self.halted = False
        for output in self.hardware.outputs.values():
            output.handle.reset()
            output.start(state)
        for law in self._running():
            law.start(state)
        self.wake()

    def update(self, state: State, motors: Motors) -> None:
        """Update the running controllers, and hold or release the joints that no controller commands."""
        rest = inf
        free = dict(self._first)
        if not self.halted:
            for law in self._running():
                rest = min(rest, law.update(state, motors))
                for output in law.outputs:
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

    def _running(self) -> list[Law]:
        return [law for law in self.laws.values() if law.running]

    # The controller manager's services

    def status(self) -> tuple[ControllerStatus, ...]:
        """Return the state of each configured controller."""
        found = []
        running, stopped = STATES[self.hardware.ros]
        for name, settings in self.known.items():
            law = self.laws.get(name)
            state = "unloaded" if law is None else running if law.running else stopped
            claims = () if law is None else tuple("/".join(output.claim) for output in law.outputs)
            found.append(ControllerStatus(name, self.namespace, settings.text("type", ""), state, claims))
        return tuple(found)

    def load(self, name: str) -> bool:
        """Load a controller; return False if its type is not simulated.

        Raises:
            SimulationError: unknown controller.
            DescriptionError: a parameter is invalid, with its position.
        """
        if name not in self.known:
            raise SimulationError(f"no controller `{name}` in {self.namespace or '/'}{did_you_mean(name, self.known)}")
        if name in self.laws:
            return True
        law = load_law(name, self.known[name], self.hardware)
        if law is None:
            kind = self.known[name].text("type", "")
            place = self.known[name].group("type").position
            self.hardware.setup.note(f"{place}: controller `{name}`: {kind} is not simulated")
            return False
        self.laws[name] = law
        self.publications += law.publications
        return True

    def unload(self, name: str) -> None:
        """Unload a stopped controller.

        Raises:
            SimulationError: the controller is running, unknown or not loaded.
        """
        law = self._loaded(name)
        if law.running:
            raise SimulationError(f"controller `{name}` runs; stop it before it is unloaded")
        for publication in law.publications:
            self.publications.remove(publication)
        del self.laws[name]

    def switch(self, start: Iterable[str] = (), stop: Iterable[str] = ()) -> None:
        """Stop some controllers and start others; after an error, all controllers are as before.

        Raises:
            SimulationError: unknown controller, or two controllers need the same joint; the message names both.
        """
        stopping = [self._loaded(name) for name in stop]
        starting = [self._loaded(name) for name in start if self.load(name)]
        after = [law for law in self._running() if law not in stopping]
        after += [law for law in starting if law not in after]
        owners: dict[str, Law] = {}
        for law in after:
            for output in law.outputs:
                joint = output.handle.name
                owner = owners.setdefault(joint, law)
                if owner is not law:
                    raise SimulationError(
                        f"controller `{law.name}` needs joint `{joint}`, which `{owner.name}` has; stop one of them"
                    )
        for law in stopping:
            law.stop()
            law.running = False
            for output in law.outputs:
                if output.interface != "position" and self._state is not None:
                    output.start(self._state)
        for law in starting:
            if not law.running:
                law.running = True
                if self._state is not None:
                    law.start(self._state)
        self.wake()

    def start_all(self) -> None:
        """Start all configured controllers in order; on a conflict of joints, warn and leave the later one loaded."""
        for name in self.known:
            try:
                self.switch(start=[name])
            except SimulationError as error:
                if name not in self.laws:
                    raise
                self.hardware.setup.note(f"not started: {error}")

    def _loaded(self, name: str) -> Law:
        if name not in self.laws:
            if name in self.known:
                raise SimulationError(f"controller `{name}` is not loaded")
            raise SimulationError(f"no controller `{name}` in {self.namespace or '/'}{did_you_mean(name, self.known)}")
        return self.laws[name]
