"""The services of simulation_interfaces 2.1, by which programs control any simulator that has them.

https://github.com/ros-simulation/simulation_interfaces; a response contains a result code instead of an error.
"""

import re
from collections.abc import Callable, Sequence
from typing import Any, Protocol

from urdfkit.bridges.service import Service, response
from urdfkit.description.sdf.model_library import world_names
from urdfkit.errors import UrdfkitError
from urdfkit.sim.simulator import Simulator
from urdfkit.sim.state.poses import pose_from
from urdfkit.sim.state.quaternion import rotate
from urdfkit.sim.world.pose_messages import composed, seven_of, six_of
from urdfkit.sim.world.spawn_requests import spawn_request, spawn_request_of_text


class Controls(Protocol):
    """What pauses and resets a running simulation."""

    def reset(self) -> None:
        """Reset the simulation."""

    def pause(self, paused: bool) -> None:
        """Pause or continue."""


UNSUPPORTED, OK, NOT_FOUND, INCORRECT_STATE, FAILED = range(5)
NAME_NOT_UNIQUE, NAME_INVALID, NO_RESOURCE, NAMESPACE_INVALID, PARSE_ERROR, INVALID_POSE = 101, 102, 104, 105, 106, 109
ALREADY_IN_STATE = 101
STOPPED, PLAYING, PAUSED = range(3)
ROBOT, DYNAMIC_OBJECT, STATIC_OBJECT = 2, 4, 5
FEATURES = (0, 1, 8, 9, 10, 11, 12, 20, 23, 24, 25, 26, 31, 32, 44, 45)
"""Spawning, deleting, categories, spawning from text, entity states and info, reset of all and of spawned entities,
states and pause of the simulation, single and multiple steps, the current world and the available ones."""
ALL, SPAWNED = (0, 3, 7, 255), 4
"""Scopes of a reset: time and state together, with or without spawned entities; spawned entities alone."""
MOST_STEPS = 1_000_000
PREFIX = "simulation_interfaces/srv/"
WORLD_FRAMES = ("", "world", "map")


class _ResultError(Exception):
    """A request has another result than OK: its code and the reason."""

    def __init__(self, code: int, reason: str = "") -> None:
        super().__init__(reason)
        self.code = code


def standard_services(simulator: Simulator, controls: Controls) -> list[Service]:
    """Return the services, e.g. ``/step_simulation``."""
    made = _StandardServices(simulator, controls)
    calls: dict[str, Callable[[Any], dict[str, Any]]] = {
        "GetSimulatorFeatures": made.features,
        "GetEntities": made.entities,
        "GetEntitiesStates": made.states,
        "GetEntityInfo": made.info,
        "GetEntityState": made.state,
        "SetEntityState": made.set_state,
        "SpawnEntity": made.spawn,
        "DeleteEntity": made.delete,
        "ResetSimulation": made.reset,
        "GetSimulationState": made.simulation_state,
        "SetSimulationState": made.set_simulation_state,
        "StepSimulation": made.step,
        "GetCurrentWorld": made.world,
        "GetAvailableWorlds": made.worlds,
    }
    return [
        Service("/" + re.sub(r"(?<=[a-z])(?=[A-Z])", "_", name).lower(), PREFIX + name, _answering(PREFIX + name, call))
        for name, call in calls.items()
    ]


def _answering(type: str, call: Callable[[Any], dict[str, Any]]) -> Callable[[Any], Any]:
    """Return a function whose response contains the result code of `call`."""

    def answer(request: Any) -> Any:
        try:
            values, code, reason = call(request), OK, ""
        except _ResultError as error:
            values, code, reason = {}, error.code, str(error)
        except UrdfkitError as error:
            values, code, reason = {}, FAILED, str(error)
        if not type.endswith("Features"):
            values["result"] = {"result": code, "error_message": reason}
        return response(type, **values)

    return answer


class _StandardServices:
    def __init__(self, simulator: Simulator, controls: Controls) -> None:
        self._simulator, self._controls = simulator, controls
        self._stopped = False

    def features(self, _request: Any) -> dict[str, Any]:
        info = "https://github.com/ros-simulation/simulation_interfaces 2.1"
        return {"features": {"features": list(FEATURES), "spawn_formats": ["urdf", "sdf"], "custom_info": info}}

    def entities(self, request: Any) -> dict[str, Any]:
        return {"entities": self._filtered(request.filters)}

    def states(self, request: Any) -> dict[str, Any]:
        names = self._filtered(request.filters)
        return {"entities": names, "states": [self._state_of(name) for name in names]}

    def info(self, request: Any) -> dict[str, Any]:
        return {"info": {"category": {"category": self._category(self._existing(request.entity))}}}

    def state(self, request: Any) -> dict[str, Any]:
        return {"state": self._state_of(self._existing(request.entity))}

    def set_state(self, request: Any) -> dict[str, Any]:
        """Place an entity; without `set_pose` or `set_twist`, pose or twist are kept."""
        name, world = self._existing(request.entity), self._simulator.world
        if request.set_acceleration:
            raise _ResultError(UNSUPPORTED, "accelerations cannot be set")
        frame = request.state.header.frame_id
        pose, twist = world.pose(name), world.twist(name)
        if request.set_pose:
            pose = self._in_world(request.state.pose, frame)
        if request.set_twist:
            turn = self._frame(frame)[3:]
            velocity = six_of(request.state.twist)
            twist = (*rotate(turn, velocity[:3]), *rotate(turn, velocity[3:]))
        world.place(name, pose_from(pose), twist)
        return {}

    def spawn(self, request: Any) -> dict[str, Any]:
        world, name = self._simulator.world, request.name
        resource = request.entity_resource
        if not (name or request.allow_renaming):
            raise _ResultError(NAME_INVALID, "`name` is empty and `allow_renaming` is false")
        if name in world.names and not request.allow_renaming:
            raise _ResultError(NAME_NOT_UNIQUE, f"entity `{name}` already exists")
        if not (resource.uri or resource.resource_string):
            raise _ResultError(NO_RESOURCE, "`uri` and `resource_string` are empty")
        if request.entity_namespace.strip("/") not in ("", name):
            raise _ResultError(NAMESPACE_INVALID, "topics of an entity begin with its name: leave the namespace empty")
        try:
            if resource.uri:
                source = spawn_request(resource.uri.removeprefix("file://"), world.package_path)
            else:
                source = spawn_request_of_text(resource.resource_string, world.package_path)
        except UrdfkitError as error:
            raise _ResultError(PARSE_ERROR, str(error)) from error
        pose = self._in_world(request.initial_pose.pose, request.initial_pose.header.frame_id)
        name = world.free_name(name or source.source.name)
        return {"entity_name": world.spawn(source, pose_from(pose), name=name)}

    def delete(self, request: Any) -> dict[str, Any]:
        self._simulator.world.remove(self._existing(request.entity))
        return {}

    def reset(self, request: Any) -> dict[str, Any]:
        """Reset; a paused simulation stays paused."""
        if request.scope not in (*ALL, SPAWNED):
            raise _ResultError(
                UNSUPPORTED, f"scope {request.scope} is not supported, because time and state are reset together"
            )
        if request.scope != 3:
            for name in tuple(self._simulator.world.spawned):
                self._simulator.world.remove(name)
        if request.scope in ALL:
            paused = bool(self._simulator.paused)
            self._controls.reset()
            self._controls.pause(paused)
        return {}

    def simulation_state(self, _request: Any) -> dict[str, Any]:
        return {"state": {"state": self._simulation_state()}}

    def set_simulation_state(self, request: Any) -> dict[str, Any]:
        wanted = request.state.state
        if wanted not in (STOPPED, PLAYING, PAUSED):
            raise _ResultError(UNSUPPORTED, f"state {wanted} is not supported; use 0 stopped, 1 playing or 2 paused")
        if wanted == self._simulation_state():
            raise _ResultError(ALREADY_IN_STATE, "the simulation is already in this state")
        if wanted == STOPPED:
            self._controls.reset()
        self._controls.pause(wanted != PLAYING)
        self._stopped = wanted == STOPPED
        return {}

    def step(self, request: Any) -> dict[str, Any]:
        """Advance a paused simulation by a number of steps."""
        if not self._simulator.paused:
            raise _ResultError(FAILED, "the simulation is not paused")
        if request.steps > MOST_STEPS:
            raise _ResultError(FAILED, f"{request.steps} steps are requested; request at most {MOST_STEPS} at once")
        self._simulator.step(int(request.steps))
        self._stopped = False
        return {}

    def world(self, _request: Any) -> dict[str, Any]:
        name = self._simulator.world.name
        return {"world": {"name": name, "world_resource": {"uri": name}}}

    def worlds(self, _request: Any) -> dict[str, Any]:
        return {"worlds": [{"name": name, "world_resource": {"uri": name}} for name in world_names()]}

    def _simulation_state(self) -> int:
        if not self._simulator.paused:
            return PLAYING
        return STOPPED if self._stopped and self._simulator.t == 0.0 else PAUSED

    def _existing(self, name: str) -> str:
        if name not in self._simulator.world.names:
            raise _ResultError(NOT_FOUND, f"no entity `{name}`")
        return name

    def _filtered(self, filters: Any) -> list[str]:
        if filters.tags.tags:
            raise _ResultError(UNSUPPORTED, "entities have no tags")
        if filters.bounds.points:
            raise _ResultError(UNSUPPORTED, "filters by bounds are not supported")
        try:
            pattern = re.compile(filters.filter)
        except re.error as error:
            raise _ResultError(FAILED, f"`{filters.filter}` is not a regular expression: {error}") from error
        categories = [each.category for each in filters.categories]
        return [
            name
            for name in self._simulator.world.names
            if pattern.search(name) and (not categories or self._category(name) in categories)
        ]

    def _category(self, name: str) -> int:
        world = self._simulator.world
        if name in world.robots:
            return ROBOT
        return STATIC_OBJECT if world.is_static(name) else DYNAMIC_OBJECT

    def _state_of(self, name: str) -> dict[str, Any]:
        world = self._simulator.world
        pose, twist = world.pose(name), world.twist(name)
        return {
            "header": {"frame_id": "world", "stamp": float(self._simulator.t)},
            "pose": {"position": _fields(pose[:3]), "orientation": _fields(pose[3:])},
            "twist": {"linear": _fields(twist[:3]), "angular": _fields(twist[3:])},
        }

    def _frame(self, name: str) -> Sequence[float]:
        if name in WORLD_FRAMES:
            return 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0
        if name not in self._simulator.world.names:
            raise _ResultError(INVALID_POSE, f"no frame `{name}`; use `world` or an entity")
        return self._simulator.world.pose(name)

    def _in_world(self, pose: Any, frame: str) -> tuple[float, ...]:
        return composed(self._frame(frame), seven_of(pose))


def _fields(values: Sequence[float]) -> dict[str, float]:
    return dict(zip("xyzw", map(float, values), strict=False))
