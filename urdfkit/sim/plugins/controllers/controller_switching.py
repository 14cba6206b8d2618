"""Controllers: lists, loads, starts, stops and switches the controllers of all plugins."""

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

from urdfkit.errors import SimulationError, did_you_mean
from urdfkit.sim.plugins.builtin_publishers import Publication
from urdfkit.sim.plugins.controllers.control_loop import ControllerStatus, ControlLoop
from urdfkit.sim.plugins.odometry import Pose
from urdfkit.sim.state.robot_state import State


class Controllers:
    """The controllers of a simulation; implements the services of controller_manager.

    A controller is identified by its name, or by its namespace and name (``/rrbot/joint1_position_controller``).

    Args:
        loops: the control loops, one per plugin.
        invalidate: called when an update or a publication may be due earlier than before.

    Attributes:
        each_publications: per loop, the publications of its loaded controllers.
    """

    def __init__(self, loops: Sequence[ControlLoop], invalidate: Callable[[], None] = lambda: None) -> None:
        self._loops = tuple(loops)
        self._invalidate = invalidate
        self.each_publications: tuple[Sequence[Publication], ...] = tuple(loop.publications for loop in self._loops)

    @property
    def publications(self) -> list[Publication]:
        """The publications of the loaded controllers."""
        return [publication for publications in self.each_publications for publication in publications]

    @property
    def command_topics(self) -> dict[str, str]:
        """Topic → type, of the velocity commands that running controllers subscribe to."""
        controllers = [controller for loop in self._loops for controller in loop.running()]
        return {topic: kind for controller in controllers for topic, kind in controller.commands.items()}

    @property
    def services(self) -> dict[str, tuple[str, Callable[[Any], Any]]]:
        """Name of each service of the controller managers → type, and function from the request to the response."""

        def called(act: Callable[[Any], Any], request: Any) -> Any:
            self._invalidate()
            return act(request)

        services = {name: service for loop in self._loops for name, service in loop.services.items()}
        return {name: (type, partial(called, act)) for name, (type, act) in services.items()}

    def odometry(self, state: State) -> dict[str, Pose]:
        """Return odometry frame → pose, as estimated by the running controllers."""
        controllers = [controller for loop in self._loops for controller in loop.running()]
        return {frame: pose for controller in controllers for frame, pose in controller.estimate(state).items()}

    def list(self) -> tuple[ControllerStatus, ...]:
        """Return the state of each configured controller, loaded or not."""
        return tuple(status for loop in self._loops for status in loop.status())

    def load(self, name: str) -> None:
        """Load a controller.

        Raises:
            UrdfkitError: unknown controller, or a parameter is invalid.
        """
        loop, own = self._find(name)
        self._invalidate()
        if not loop.load(own):
            raise SimulationError(f"controller `{name}`: its type is not simulated")

    def unload(self, name: str) -> None:
        """Unload a stopped controller.

        Raises:
            SimulationError: unknown controller, or the controller is running.
        """
        loop, own = self._find(name)
        self._invalidate()
        loop.unload(own)

    def start(self, *names: str) -> None:
        """Start controllers; load them first if necessary.

        Raises:
            UrdfkitError: unknown controller, invalid parameter, or a joint that another controller has claimed.
        """
        self.switch(start=names)

    def stop(self, *names: str) -> None:
        """Stop controllers. Position interfaces hold their last command; velocity and effort commands become zero.

        Raises:
            SimulationError: unknown controller.
        """
        self.switch(stop=names)

    def switch(self, start: Sequence[str] = (), stop: Sequence[str] = ()) -> None:
        """Stop some controllers and start others in the same control period; atomic for each namespace.

        Raises:
            UrdfkitError: unknown controller, invalid parameter, or two controllers need the same joint; names both.
        """
        wanted: dict[int, tuple[set[str], set[str]]] = {}
        for side, names in enumerate((start, stop)):
            for name in names:
                loop, own = self._find(name)
                wanted.setdefault(self._loops.index(loop), (set(), set()))[side].add(own)
        self._invalidate()
        for number, (starting, stopping) in wanted.items():
            self._loops[number].switch(start=starting, stop=stopping)

    def _find(self, name: str) -> tuple[ControlLoop, str]:
        for loop in self._loops:
            prefix = loop.namespace.rstrip("/") + "/"
            own = name[len(prefix) :] if name.startswith(prefix) and len(prefix) > 1 else name.lstrip("/")
            if own in loop.configured:
                return loop, own
        names = [status.name for status in self.list()]
        if not names:
            raise SimulationError(f"no controller `{name}`: this robot has none")
        raise SimulationError(
            f"no controller `{name}`" + did_you_mean(name, names) + f" (available: {', '.join(names)})"
        )
