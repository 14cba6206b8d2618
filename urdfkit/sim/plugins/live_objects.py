"""Objects of a robot's plugins that hold state, by names that are the same in every process.

The objects are found by following attributes, so a plugin takes part in snapshots without code of its own. They are
registered when the plugins have been installed, or a controller has been loaded. An object that a plugin creates later
is part of the state of the object that refers to it.
"""

from collections import deque
from functools import cache, partial
from types import FunctionType, MethodType
from typing import Any

import numpy as np

from urdfkit.bus import Topic
from urdfkit.sim.plugins.controllers.control_loop import ControlLoop
from urdfkit.sim.plugins.controllers.controller import RosController
from urdfkit.sim.plugins.namespaced_bus import OwnBus
from urdfkit.sim.plugins.setup import Setup
from urdfkit.sim.state.joint_commands import Servos
from urdfkit.sim.state.periodic_steps import PeriodicSteps

ATOMS = frozenset((int, float, str, bytes, bool, complex, type(None), type))
"""Types of values without references."""

STATEFUL = ("urdfkit.sim.plugins", "urdfkit.sim.state.joint_commands", "urdfkit.sim.state.pid")
"""Modules with classes whose instances hold state; those of plugins of other packages are added."""

ENGINE = "urdfkit.sim.engine"

CONSTANT = (Setup, OwnBus, PeriodicSteps)
"""Classes of these modules whose instances do not change."""

LARGEST = 1 << 16
"""Size of an array [bytes] above which it is a constant table, such as the directions of a camera's pixels."""


class LiveObjects:
    """Objects by name, and those of them that hold state.

    Attributes:
        objects: name → object, of all objects that a state may refer to.
        names: identity of an object → its name.
        stateful: name → object, of the objects that hold state.
        packages: other packages whose plugins are registered.
    """

    def __init__(self) -> None:
        self.objects: dict[str, Any] = {}
        self.names: dict[int, str] = {}
        self.stateful: dict[str, Any] = {}
        self.packages: set[str] = set()

    def add(self, name: str, instance: Any, *, stateful: bool = False) -> None:
        """Register one object, without the objects that it refers to."""
        if id(instance) not in self.names:
            while name in self.objects:  # keys of a dict may have the same text
                name += "'"
            self.names[id(instance)] = name
            self.objects[name] = instance
            if stateful:
                self.stateful[name] = instance

    def follow(self, name: str, instance: Any) -> None:
        """Register an object and all objects that it refers to."""
        kind = type(instance)
        if kind in ATOMS or id(instance) in self.names or self.is_wiring(instance):
            return
        if isinstance(instance, Topic):
            self.add(f"topic {instance.name}", instance)
        elif isinstance(instance, (tuple, frozenset)):
            for k, each in enumerate(instance):
                self.follow(f"{name}/{k}", each)
        elif isinstance(instance, (list, deque)):
            self.add(name, instance, stateful=True)
            for k, each in enumerate(instance):
                self.follow(f"{name}/{k}", each)
        elif isinstance(instance, dict):
            self.add(name, instance, stateful=True)
            for key, each in instance.items():
                self.follow(f"{name}/{key}", each)
        elif isinstance(instance, set):
            self.add(name, instance, stateful=True)
        elif isinstance(instance, np.ndarray):
            self.add(name, instance, stateful=instance.flags.writeable and instance.nbytes <= LARGEST)
        elif isinstance(instance, np.random.Generator):
            self.add(name, instance, stateful=True)
        else:
            self.add(name, instance, stateful=self._holds_state(instance))
            for part, each in self._references(instance):
                self.follow(f"{name}.{part}", each)

    def is_wiring(self, instance: Any) -> bool:
        """Return whether an object belongs to the engine, which is replaced when entities change."""
        if isinstance(instance, MethodType):
            return type(instance.__self__).__module__.startswith(ENGINE)
        return isinstance(instance, (memoryview, Servos))

    def follow_plugins(self, plugins: list[Any]) -> None:
        """Register plugins and all objects that they refer to."""
        self.packages |= {type(each).__module__.partition(".")[0] for each in plugins} - {"urdfkit"}
        self.follow("plugins", plugins)

    def follow_loop(self, loop: ControlLoop) -> None:
        """Register a control loop, and its controllers whenever they are loaded, under names of their own."""
        name = f"loop {loop.namespace}"
        self.add(name, loop, stateful=True)
        for part, each in (("controllers", loop.controllers), ("publications", loop.publications)):
            self.add(f"{name}.{part}", each, stateful=True)

        def changed(controller: RosController) -> None:
            path = f"{name}/{controller.name}"
            self._forget(path)
            if controller.name in loop.controllers:
                self.follow(path, controller)

        loop.changed = changed
        for part, each in vars(loop).items():
            self.follow(f"{name}.{part}", each)
        for controller in loop.controllers.values():
            changed(controller)

    def _forget(self, path: str) -> None:
        """Forget an object and all objects registered below it."""
        for name in [name for name in self.objects if name == path or name.startswith((f"{path}.", f"{path}/"))]:
            del self.names[id(self.objects.pop(name))]
            self.stateful.pop(name, None)

    def _holds_state(self, instance: Any) -> bool:
        parameters = getattr(type(instance), "__dataclass_params__", None)
        return self._is_followed(instance) and not (parameters is not None and parameters.frozen)

    def _is_followed(self, instance: Any) -> bool:
        module = type(instance).__module__
        inside = module.startswith(STATEFUL) or module.partition(".")[0] in self.packages
        return inside and not isinstance(instance, (LiveObjects, *CONSTANT))

    def _references(self, instance: Any) -> list[tuple[str, Any]]:
        """Return the objects that an object refers to, with the names of the references."""
        if isinstance(instance, MethodType):
            return [("self", instance.__self__)]
        if isinstance(instance, partial):
            return [("func", instance.func), ("args", instance.args), ("keywords", tuple(instance.keywords.values()))]
        if isinstance(instance, FunctionType):
            cells = zip(instance.__code__.co_freevars, instance.__closure__ or (), strict=True)
            return [(variable, _contents(cell)) for variable, cell in cells]
        if isinstance(instance, Setup):
            return [("random", instance.random)]
        return list(attributes(instance).items()) if self._is_followed(instance) else []


def attributes(instance: Any) -> dict[str, Any]:
    """Return the attributes of an object, also those in slots."""
    kind: Any = type(instance)
    slots = {name: getattr(instance, name) for name in _slots(kind) if hasattr(instance, name)}
    return {**slots, **getattr(instance, "__dict__", {})}


@cache
def _slots(kind: Any) -> tuple[str, ...]:
    """Return the names of the slots of a class."""
    found: list[str] = []
    for each in getattr(kind, "__mro__", ()):
        own = each.__dict__.get("__slots__", ())
        found += [own] if isinstance(own, str) else own
    return tuple(name for name in found if name not in ("__dict__", "__weakref__"))


def _contents(cell: Any) -> Any:
    """Return the value of a variable of a function; None for a variable without a value."""
    try:
        return cell.cell_contents
    except ValueError:
        return None
