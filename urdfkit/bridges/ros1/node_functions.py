"""Functions of a ROS 1 node that the master and other nodes call; each returns a code, a message and a value.

https://wiki.ros.org/ROS/Slave_API
"""

import os
from collections.abc import Callable, Sequence
from typing import Any, Protocol

Answer = tuple[int, str, Any]


class Announced(Protocol):
    """State of a node that others can request.

    Attributes:
        name: of the node.
        uri: address of the master.
        report: receives lines for the user.
    """

    name: str
    uri: str
    report: Callable[[str], None]

    def follow_publishers(self, topic: str, publishers: list[str]) -> None:
        """Connect to the publishers of a topic."""

    def publishes(self, topic: str) -> bool:
        """Return whether the node publishes a topic."""


class NodeFunctions:
    """Dispatcher of the calls.

    Args:
        node: whose functions are called.
        host: name of this machine for other nodes.
        port: for connections by TCPROS.
    """

    def __init__(self, node: Announced, host: str, port: int) -> None:
        self._node, self._address = node, ["TCPROS", host, port]
        self._functions: dict[str, Callable[..., Answer]] = {
            "publisherUpdate": self._publisher_update,
            "requestTopic": self._request_topic,
            "paramUpdate": lambda caller, name, value: (1, "", 0),
            "getPid": lambda caller: (1, "", os.getpid()),
            "getMasterUri": lambda caller: (1, "", node.uri),
            "getBusStats": lambda caller: (1, "", [[], [], []]),
            "getBusInfo": lambda caller: (1, "", []),
            "shutdown": self._shutdown,
        }

    def _dispatch(self, function: str, arguments: Sequence[Any]) -> Answer:
        """Call a function by its name, as SimpleXMLRPCServer requires."""
        if function not in self._functions:
            return -1, f"no function {function}", 0
        return self._functions[function](*arguments)

    def _publisher_update(self, _caller: str, topic: str, publishers: list[str]) -> Answer:
        self._node.follow_publishers(topic, publishers)
        return 1, "", 0

    def _request_topic(self, _caller: str, topic: str, protocols: list[Any]) -> Answer:
        if not self._node.publishes(topic):
            return 0, f"not a publisher of {topic}", 0
        if not any(each and each[0] == "TCPROS" for each in protocols):
            return 0, "only TCPROS is supported", 0
        return 1, "", self._address

    def _shutdown(self, _caller: str, reason: str = "") -> Answer:
        name = self._node.name
        if "same name" in reason:  # as the ROS 1 master words it
            self._node.report(
                f"warning: ros1: another node has taken the name {name}, so other nodes no longer find the topics of "
                "this simulation; start each simulation with a different --namespace"
            )
        else:
            self._node.report(f"ros1: ignored a request to shut down {name} ({reason})")
        return 1, "", 0
