"""State of the objects of plugins as bytes, and back into the same objects of this or another process.

Registered objects keep their identity: only their state is saved and replaced. All other objects are saved by value.
"""

import io
import pickle
from collections import deque
from collections.abc import Callable, Mapping
from types import FunctionType, MethodType
from typing import Any

import numpy as np

from urdfkit.errors import SimulationError
from urdfkit.messages import message_type
from urdfkit.sim.plugins.live_objects import ATOMS, LiveObjects, attributes

NUMPY = {"_reconstruct", "_frombuffer", "ndarray", "dtype", "scalar"}
"""Names of NumPy that states refer to."""
BUILTINS = {"set", "frozenset", "complex", "bytearray", "slice", "range"}

FUNCTIONS = (FunctionType, MethodType)


class Registry:
    """The registered objects of all robots of a simulation.

    Args:
        robots: name → objects of the robot.

    Attributes:
        packages: packages whose classes a state may contain.
        names: `id` of a registered object → its robot, and the name under which it is registered.
    """

    def __init__(self, robots: Mapping[str, LiveObjects]) -> None:
        self.robots = robots
        self.packages = {"urdfkit", *(package for live in robots.values() for package in live.packages)}
        self.names: dict[int, tuple[str, str]] = {}
        for robot, live in robots.items():
            for key, name in live.names.items():
                self.names.setdefault(key, (robot, name))

    def find(self, name: tuple[str, str]) -> Any:
        """Return a registered object.

        Raises:
            SimulationError: no such object.
        """
        robot, key = name
        live = self.robots.get(robot)
        if live is None or key not in live.objects:
            raise SimulationError(f"the snapshot has `{key}` of robot `{robot}`, which this simulation does not have")
        return live.objects[key]

    def states(self) -> dict[str, dict[str, Any]]:
        """Return robot → name → state, of all objects that hold state."""
        return {
            robot: {name: self._state(live, instance) for name, instance in live.stateful.items()}
            for robot, live in self.robots.items()
        }

    def _state(self, live: LiveObjects, instance: Any) -> Any:
        if isinstance(instance, (list, set, deque)):
            return list(instance)
        if isinstance(instance, dict):
            return dict(instance)
        if isinstance(instance, np.ndarray):
            return instance.copy()
        if isinstance(instance, np.random.Generator):
            return instance.bit_generator.state
        return {name: each for name, each in attributes(instance).items() if self._is_saved(live, each)}

    def _is_saved(self, live: LiveObjects, value: Any) -> bool:
        """Return whether an attribute is part of a state; functions that are set later are not."""
        if type(value) in ATOMS or id(value) in self.names:
            return True
        return not isinstance(value, FUNCTIONS) and not live.is_wiring(value)

    def restore(self, states: Mapping[str, Mapping[str, Any]]) -> None:
        """Give all objects their saved states."""
        for robot, found in states.items():
            for name, state in found.items():
                self._apply(self.robots[robot], self.find((robot, name)), state)

    def _apply(self, live: LiveObjects, instance: Any, state: Any) -> None:
        if isinstance(instance, list):
            instance[:] = state
        elif isinstance(instance, (set, dict, deque)):
            instance.clear()
            (instance.extend if isinstance(instance, deque) else instance.update)(state)
        elif isinstance(instance, np.ndarray):
            instance[...] = state
        elif isinstance(instance, np.random.Generator):
            instance.bit_generator.state = state
        else:
            for name, each in attributes(instance).items():
                if name not in state and self._is_saved(live, each):
                    delattr(instance, name)
            for name, each in state.items():
                setattr(instance, name, each)


def dumps(content: Any, registry: Registry) -> bytes:
    """Return an object as bytes, with references to the registered objects.

    Raises:
        SimulationError: the state of a plugin contains an object that cannot be saved.
    """
    file = io.BytesIO()
    try:
        _Pickler(file, registry).dump(content)
    except (pickle.PicklingError, TypeError, AttributeError) as error:
        raise SimulationError(f"the state of a plugin cannot be saved: {error}") from error
    return file.getvalue()


def loads(content: bytes, registry: Registry) -> Any:
    """Return the object that `dumps` saved, with references to the objects of this registry.

    Raises:
        SimulationError: the bytes are damaged, or refer to an object that does not exist.
    """
    try:
        return _Unpickler(io.BytesIO(content), registry).load()
    except SimulationError:
        raise
    except Exception as error:  # damaged bytes raise errors of any type
        raise SimulationError(f"the snapshot is damaged: {error}") from error


class _Pickler(pickle.Pickler):
    def __init__(self, file: io.BytesIO, registry: Registry) -> None:
        super().__init__(file, protocol=5)
        self._names = registry.names

    def persistent_id(self, instance: Any) -> Any:
        """Return the name of a registered object. It is called for each value, so it must be short."""
        return self._names.get(id(instance))

    def reducer_override(self, instance: Any) -> Any:
        """Save a message by its type and values."""
        kind = getattr(type(instance), "__msgtype__", None)
        return NotImplemented if kind is None else (_message, (kind, tuple(vars(instance).values())))


class _Unpickler(pickle.Unpickler):
    def __init__(self, file: io.BytesIO, registry: Registry) -> None:
        super().__init__(file)
        self._registry = registry

    def persistent_load(self, name: tuple[str, str]) -> Any:
        """Return a registered object."""
        return self._registry.find(name)

    def find_class(self, module: str, name: str) -> Any:
        """Return a class of a plugin's package, or one of the few functions that arrays and messages need.

        Raises:
            SimulationError: another name.
        """
        package = module.partition(".")[0]
        if (module, name) == (__name__, _message.__name__):
            return _message
        allowed = name in NUMPY if package == "numpy" else name in BUILTINS if package == "builtins" else False
        if allowed or (module, name) == ("collections", "deque"):
            return super().find_class(module, name)
        if package in self._registry.packages and isinstance(found := super().find_class(module, name), type):
            return found
        raise SimulationError(f"a snapshot does not contain `{module}.{name}`")


def _message(kind: str, values: tuple[Any, ...]) -> Any:
    make: Callable[..., Any] = message_type(kind)
    return make(*values)
