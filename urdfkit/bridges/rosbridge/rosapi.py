"""The services of ``rosapi`` that roslibjs and roslibpy call: topics, types, services, parameters, time.

https://github.com/RobotWebTools/rosbridge_suite/tree/ros2/rosapi_msgs
"""

import json
from collections.abc import Callable
from typing import Any

from urdfkit.bridges.actions import actions
from urdfkit.bridges.graph import Graph
from urdfkit.bridges.rosbridge.type_details import type_details
from urdfkit.bus import absolute, similar_topic
from urdfkit.errors import UsageError
from urdfkit.messages import full_type_name, typestore

PREFIX = "/rosapi/"
NODE = "/urdfkit"
"""Name of the only node: the simulation."""

Arguments = dict[str, Any]


class Rosapi:
    """Answers from the graph; used in the thread of the server.

    Args:
        graph: the topics and services of the simulation.
    """

    def __init__(self, graph: Graph) -> None:
        self._graph = graph
        self._calls: dict[str, Callable[[Arguments], dict[str, Any]]] = {
            "topics": lambda _: {"topics": list(graph.topics), "types": list(graph.topics.values())},
            "topics_for_type": lambda it: {"topics": _named(graph.topics, full_type_name(_text(it, "type")))},
            "topics_and_raw_types": lambda _: self._topics_with_definitions(),
            "topic_type": lambda it: {"type": graph.topics.get(absolute(_text(it, "topic")), "")},
            "services": lambda _: {"services": self._services},
            "services_for_type": lambda it: {"services": _named(self._service_types, _service_type(it))},
            "service_type": lambda it: {"type": self._service_types.get(absolute(_text(it, "service")), "")},
            "service_request_details": lambda it: {"typedefs": type_details(_service_type(it) + "_Request")},
            "service_response_details": lambda it: {"typedefs": type_details(_service_type(it) + "_Response")},
            "message_details": lambda it: {"typedefs": type_details(_text(it, "type"))},
            "nodes": lambda _: {"nodes": [NODE]},
            "node_details": lambda it: self._node(_text(it, "node")),
            "publishers": lambda it: {"publishers": [NODE] if _text(it, "topic") in graph.topics else []},
            "subscribers": lambda it: {"subscribers": [NODE] if _text(it, "topic") in self._subscribed else []},
            "action_servers": lambda _: {"action_servers": list(actions(graph.bus))},
            "action_type": lambda it: {"type": self._action_type(absolute(_text(it, "action")))},
            "get_param_names": lambda _: {"names": list(graph.parameters)},
            "has_param": lambda it: {"exists": _parameter(_text(it, "name")) in graph.parameters},
            "get_param": self._get_parameter,
            "get_time": lambda _: {"time": _time(graph.clock())},
            "get_ros_version": lambda _: {"version": 2, "distro": "humble"},
        }

    def has(self, service: str) -> bool:
        """Whether a service is one of rosapi."""
        return service.startswith(PREFIX)

    def call(self, service: str, arguments: Any) -> dict[str, Any]:
        """Return the response of a service.

        Raises:
            UsageError: the service is unknown, or an argument is missing.
        """
        call = self._calls.get(service.removeprefix(PREFIX))
        if call is None:
            near = similar_topic(service, self._services)
            raise UsageError(f"no service `{service}`{near}")
        return call(arguments if isinstance(arguments, dict) else {})

    @property
    def _services(self) -> list[str]:
        return [*self._graph.services, *(PREFIX + name for name in self._calls)]

    @property
    def _service_types(self) -> dict[str, str]:
        own = {PREFIX + name: f"rosapi_msgs/srv/{name.title().replace('_', '')}" for name in self._calls}
        return {name: service.type for name, service in self._graph.services.items()} | own

    @property
    def _subscribed(self) -> list[str]:
        return [topic.name for topic in self._graph.bus.topics if topic.subscribers and "/msg/" in topic.type]

    def _action_type(self, name: str) -> str:
        found = actions(self._graph.bus).get(name)
        return "" if found is None else found.type

    def _topics_with_definitions(self) -> dict[str, Any]:
        topics = self._graph.topics
        definitions = [typestore().generate_msgdef(type, ros_version=2)[0] for type in topics.values()]
        return {"topics": list(topics), "types": list(topics.values()), "typedefs_full_text": definitions}

    def _node(self, name: str) -> dict[str, Any]:
        if absolute(name) != NODE:
            return {"subscribing": [], "publishing": [], "services": []}
        subscribed = self._subscribed
        publishing = [name for name in self._graph.topics if name not in subscribed]
        return {"subscribing": subscribed, "publishing": publishing, "services": list(self._graph.services)}

    def _get_parameter(self, arguments: Arguments) -> dict[str, Any]:
        """Return a parameter as JSON; the default when it does not exist, as rosapi does."""
        name = _parameter(_text(arguments, "name"))
        if name in self._graph.parameters:
            return {"value": json.dumps(self._graph.parameters[name]), "successful": True, "reason": ""}
        reason = f"no parameter `{name}`{similar_topic(name, list(self._graph.parameters))}"
        return {"value": arguments.get("default") or '""', "successful": False, "reason": reason}


def _parameter(name: str) -> str:
    """Return the name without the node before a colon, ``/node:name`` in ROS 2."""
    return absolute(name.rpartition(":")[2])


def _named(types: dict[str, str], type: str) -> list[str]:
    return [name for name, each in types.items() if each == type]


def _text(arguments: Arguments, name: str) -> str:
    value = arguments.get(name)
    if not isinstance(value, str):
        raise UsageError(f"the argument `{name}` is missing; it is a string")
    return value


def _service_type(arguments: Arguments) -> str:
    return full_type_name(_text(arguments, "type"), "srv")


def _time(t: float) -> dict[str, int]:
    seconds, nanoseconds = divmod(round(t * 1e9), 10**9)
    return {"sec": seconds, "nanosec": nanoseconds, "secs": seconds, "nsecs": nanoseconds}
