"""ROS 1 node: publishers, subscribers and services that a master announces."""

import socket
from collections.abc import Callable, Mapping
from contextlib import suppress
from threading import Event, Thread
from typing import Any, TypeVar
from xmlrpc.client import Error

from urdfkit.bridges.json_messages import json_values
from urdfkit.bridges.node.node import Done, End, Quality, UnknownTypeError
from urdfkit.bridges.ros1.environment import bind_host, is_remote, master_uri, own_host
from urdfkit.bridges.ros1.node_functions import NodeFunctions
from urdfkit.bridges.ros1.ros1_types import (
    ANY,
    decode,
    definition,
    encode,
    full_name,
    register,
    ros1_name,
    service_checksum,
)
from urdfkit.bridges.ros1.service_client import call_service, service_type
from urdfkit.bridges.ros1.service_server import ServiceServer
from urdfkit.bridges.ros1.tcpros import TIMEOUT, TcprosError, read_header, write_header
from urdfkit.bridges.ros1.topic_publisher import TopicPublisher
from urdfkit.bridges.ros1.topic_subscriber import TopicSubscriber
from urdfkit.bridges.ros1.xml_rpc import NodeServer, call
from urdfkit.bridges.service import Service
from urdfkit.errors import ResourceError, UsageError
from urdfkit.messages import from_fields

NAME = "/urdfkit"
WATCH = 1.0
"""Seconds between two checks whether the master runs."""
Value = TypeVar("Value")


class Ros1Node:
    """A node; it registers again, and sets its parameters again, when a master that was gone is back.

    Args:
        name: of the node.
        report: receives lines about the master and about peers that cannot be used.

    Raises:
        UsageError: the address is invalid.
        ResourceError: no master runs there.
    """

    ros, option = "ROS 1", "--ros1"

    def __init__(self, *, name: str = NAME, report: Callable[[str], None] = lambda line: None) -> None:
        self.name, self.report = name, report
        self.uri = master_uri()
        self._closed = Event()
        self._publications: dict[str, TopicPublisher] = {}
        self._subscriptions: dict[str, TopicSubscriber] = {}
        self._services: dict[str, ServiceServer] = {}
        self._parameters: dict[str, Any] = {}
        self._master_process = self._call_master("getPid")  # before anything is opened
        host = bind_host()
        self._socket = socket.create_server((host, 0))
        self._server = NodeServer(host)
        self._server.register_instance(NodeFunctions(self, own_host(), self._socket.getsockname()[1]))
        self._api = f"http://{own_host()}:{self._server.server_address[1]}/"
        self._rpc = f"rosrpc://{own_host()}:{self._socket.getsockname()[1]}"
        self.description = f"the master at {self.uri}"
        for target in (self._server.serve_forever, self._accept, self._watch):
            Thread(target=target, name=f"ros1{target.__name__}", daemon=True).start()
        if is_remote(self.uri) and host == "127.0.0.1":
            report(f"warning: the master is on another machine: set ROS_IP so that nodes there reach {name}")
        elif host != "127.0.0.1":
            report(
                "warning: everyone on the network can read and publish all ROS 1 topics; "
                "the connection is not encrypted"
            )

    def writer(self, topic: str, type: str, quality: Quality) -> TopicPublisher:
        """Create a publisher."""
        made = self._publications[topic] = TopicPublisher(self.name, topic, definition(type), quality)
        self._call_master("registerPublisher", topic, ros1_name(type), self._api)
        return made

    def subscribe(self, topic: str, type: str, quality: Quality, receive: Callable[[bytes], None]) -> End:
        """Call `receive` with each message; an unknown type is learned from its publisher."""
        try:
            expected = definition(type)[::2]
        except UnknownTypeError:
            expected = ros1_name(type), ANY

        def connected(header: dict[str, str]) -> None:
            if expected[1] == ANY:
                try:
                    register(type, header.get("message_definition", ""))
                except UsageError as error:
                    raise TcprosError(str(error)) from error

        made = TopicSubscriber(self.name, topic, expected, receive, connected, self.report)
        self._subscriptions[topic] = made
        made.follow(self._call_master("registerSubscriber", topic, expected[0], self._api))

        def end() -> None:
            self._subscriptions.pop(topic, None)
            made.close()
            with suppress(ResourceError):
                self._call_master("unregisterSubscriber", topic, self._api)

        return end

    encode, decode = staticmethod(encode), staticmethod(decode)

    def topics(self) -> dict[str, str]:
        """Return topic → type of the topics of the master."""
        return {name: full_name(type) for name, type in sorted(self._call_master("getTopicTypes"))}

    def serve(self, service: Service, call: Callable[[Any, Done], None]) -> None:
        """Serve a service."""
        self._services[service.name] = ServiceServer(self.name, service, call)
        self._call_master("registerService", service.name, self._rpc, self._api)

    def services(self) -> list[str]:
        """Return the names of the services of the master."""
        return sorted(name for name, _ in self._call_master("getSystemState")[2])

    def service_type(self, service: str) -> str:
        """Return the type of a service, by its server."""
        if service not in self.services():
            return ""
        return service_type(self.name, service, self._call_master("lookupService", service))

    def call(self, service: str, type: str, fields: Any) -> Any:
        """Call a service and return the fields of its response."""
        checksum = service_checksum(type)
        request = encode(from_fields(f"{type}_Request", fields), f"{type}_Request")
        address = self._call_master("lookupService", service)
        content = call_service(self.name, service, address, checksum, request)
        return json_values(decode(content, f"{type}_Response"))

    def set_parameter(self, name: str, value: Any) -> None:
        """Set a parameter of the master, and again when the master has been restarted."""
        self._parameters[name] = value
        self._call_master("setParam", name, value)

    def close(self) -> None:
        """Leave the graph; a master that is gone does not matter."""
        self._closed.set()
        with suppress(ResourceError):
            for name in self._services:
                self._call_master("unregisterService", name, self._rpc)
            for name in self._publications:
                self._call_master("unregisterPublisher", name, self._api)
            for name in self._subscriptions:
                self._call_master("unregisterSubscriber", name, self._api)
        for publication in self._publications.values():
            publication.close()
        for subscription in self._subscriptions.values():
            subscription.close()
        with suppress(OSError):
            self._socket.shutdown(socket.SHUT_RDWR)
        self._socket.close()
        self._server.shutdown()
        self._server.server_close()

    def follow_publishers(self, topic: str, publishers: list[str]) -> None:
        """Follow the publishers of a topic, as the master reports them."""
        if topic in self._subscriptions:
            self._subscriptions[topic].follow(publishers)

    def publishes(self, topic: str) -> bool:
        """Return whether this node publishes a topic."""
        return topic in self._publications

    def _call_master(self, function: str, *arguments: Any) -> Any:
        try:
            return call(self.uri, function, self.name, *arguments)
        except (OSError, Error) as error:
            raise ResourceError(
                f"no ROS master at {self.uri}: start roscore, or set ROS_MASTER_URI ({error})"
            ) from error

    def _accept(self) -> None:
        while not self._closed.is_set():
            try:
                connection, _ = self._socket.accept()
            except OSError:
                return
            Thread(target=self._greet, args=(connection,), name="ros1-peer", daemon=True).start()

    def _greet(self, connection: socket.socket) -> None:
        """Read the header of a peer and connect it with a publication or a service."""
        try:
            connection.settimeout(TIMEOUT)
            connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            header = read_header(connection)
            connection.settimeout(None)
            if (service := header.get("service")) is not None:
                with connection:
                    _named(self._services, service, "service").connect(connection, header)
            else:
                _named(self._publications, header.get("topic", ""), "topic").connect(connection, header)
        except (TcprosError, OSError) as error:
            with suppress(OSError), connection:
                write_header(connection, {"error": str(error)})

    def _watch(self) -> None:
        """Report that the master is gone, and register again when it is back."""
        gone = False
        while not self._closed.wait(WATCH):
            try:
                process = self._call_master("getPid")
                if gone or process != self._master_process:
                    self._register_again()
                    self._master_process = process
                    self.report("ros1: the master runs again")
                gone = False
            except ResourceError:
                if not gone:
                    self.report(f"ros1: the master at {self.uri} has stopped; urdfkit continues")
                gone = True

    def _register_again(self) -> None:
        for name, value in self._parameters.items():
            self._call_master("setParam", name, value)
        for name, publication in self._publications.items():
            self._call_master("registerPublisher", name, publication.definition.name, self._api)
        for name, subscription in self._subscriptions.items():
            subscription.follow(self._call_master("registerSubscriber", name, subscription.type[0], self._api))
        for name in self._services:
            self._call_master("registerService", name, self._rpc, self._api)


def _named(items: Mapping[str, Value], name: str, kind: str) -> Value:
    if name not in items:
        raise TcprosError(f"no {kind} {name}")
    return items[name]
