"""ROS 2 node by rclpy, of a sourced ROS or of the ``ros-rclpy`` wheel."""

from __future__ import annotations

import time
from collections.abc import Callable
from contextlib import suppress
from importlib.util import find_spec
from queue import Queue
from threading import Event, Thread
from typing import TYPE_CHECKING, Any

from urdfkit.bridges.actions import ActionServer
from urdfkit.bridges.json_messages import json_values
from urdfkit.bridges.node.node import RESPONSE, Begin, Done, End, Quality, UnknownTypeError, Writer
from urdfkit.bridges.ros2.rclpy_actions import serve_action
from urdfkit.bridges.ros2.rclpy_messages import rclpy_type
from urdfkit.bridges.service import Service
from urdfkit.errors import MissingDependencyError, ResourceError
from urdfkit.messages import from_fields
from urdfkit.messages.conversion import decode_cdr, encode_cdr

if TYPE_CHECKING:
    from urdfkit.bridges.ros2.cyclonedds_node import CycloneddsNode

NAME = "urdfkit"
DISCOVERY = 8.0
"""Longest time until a node of the graph is discovered, on a busy machine [s]."""
DDS = ("rmw_fastrtps_cpp", "rmw_fastrtps_dynamic_cpp", "rmw_cyclonedds_cpp")
"""Middlewares whose nodes match topics of Cyclone DDS."""


class RclpyNode:
    """A node with an executor in a thread of its own.

    Types that rclpy lacks, such as tf2_msgs without a ROS, are published by Cyclone DDS if that is installed.

    Args:
        domain: the ROS domain.
        namespace: of the node.
        report: receives lines about services that failed.

    Raises:
        MissingDependencyError: rclpy cannot be imported.
        ResourceError: it cannot start.
    """

    ros, option = "ROS 2", "--ros2"

    def __init__(self, domain: int, namespace: str, report: Callable[[str], None] = lambda line: None) -> None:
        try:
            import rclpy
            from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
            from rclpy.signals import SignalHandlerOptions
        except ImportError as error:
            reason = str(error).splitlines()[0]
            raise MissingDependencyError(
                f"this Python cannot import rclpy ({reason}); use the Python of ROS"
            ) from error
        self._report = report
        self._context = rclpy.Context()
        try:
            rclpy.init(args=[], context=self._context, domain_id=domain, signal_handler_options=SignalHandlerOptions.NO)
            self._node = rclpy.create_node(
                NAME,
                context=self._context,
                namespace=namespace,
                use_global_arguments=False,
                enable_rosout=False,
                start_parameter_services=False,
            )
        except Exception as error:  # of the middleware, by several classes
            self._context.try_shutdown()
            raise ResourceError(f"rclpy cannot start: {str(error).splitlines()[0]}") from error
        middleware = rclpy.get_rmw_implementation_identifier()
        self.description = f"rclpy, {middleware}"
        self._domain, self._is_dds = domain, middleware in DDS
        self._other: CycloneddsNode | None = None
        self._executor = SingleThreadedExecutor(context=self._context)
        self._executor.add_node(self._node)

        def spin() -> None:
            with suppress(ExternalShutdownException):
                self._executor.spin()

        self._thread = Thread(target=spin, name="rclpy", daemon=True)
        self._thread.start()

    def writer(self, topic: str, type: str, quality: Quality) -> Writer:
        """Create a publisher."""
        kind = rclpy_type(type)
        if kind is None:
            return self._fallback(type).writer(topic, type, quality)
        return _RclpyWriter(self._node.create_publisher(kind, topic, _profile(quality)))

    def subscribe(self, topic: str, type: str, quality: Quality, receive: Callable[[bytes], None]) -> End:
        """Call `receive`, in the thread of the executor, with each message in CDR."""
        kind = rclpy_type(type)
        if kind is None:
            return self._fallback(type).subscribe(topic, type, quality, receive)
        made = self._node.create_subscription(kind, topic, receive, _profile(quality), raw=True)
        self._executor.wake()

        def end() -> None:
            self._node.destroy_subscription(made)

        return end

    def topics(self) -> dict[str, str]:
        """Return topic → type of the graph."""
        found = {name: kinds[0] for name, kinds in self._node.get_topic_names_and_types() if kinds}
        return found | ({} if self._other is None else self._other.topics())

    def types(self) -> dict[str, set[str]]:
        """Return topic → types of its publishers and subscribers."""
        found = {name: set(kinds) for name, kinds in self._node.get_topic_names_and_types()}
        for name, kinds in ({} if self._other is None else self._other.types()).items():
            found.setdefault(name, set()).update(kinds)
        return found

    def serve(self, service: Service, call: Callable[[Any, Done], None]) -> None:
        """Serve a service, if its type is installed."""
        from rclpy.serialization import deserialize_message, serialize_message

        kind = rclpy_type(service.type)
        if kind is None:
            raise UnknownTypeError(f"rclpy lacks {service.type}")

        def answer(request: Any, response: Any) -> Any:
            """Wait for the thread of the simulation."""
            answers: Queue[tuple[Any, str | None]] = Queue()
            call(decode_cdr(serialize_message(request), service.request), lambda *each: answers.put(each))
            found, reason = answers.get()
            if reason is not None:  # a ROS 2 service has no other way to report a failure than its response
                self._report(f"{service.name}: {reason}")
                if hasattr(response, "status_message"):
                    response.status_message = reason
                return response
            return deserialize_message(encode_cdr(found, service.response), type(response))

        self._node.create_service(kind, service.name, answer)
        self._executor.wake()

    def serve_action(self, name: str, action: ActionServer, begin: Begin) -> None:
        """Serve an action, if its type is installed."""
        if (kind := rclpy_type(action.type)) is None:
            raise UnknownTypeError(f"rclpy lacks {action.type}: source its ROS package, or send goals over --rosbridge")
        serve_action(self._node, kind, name, action, begin, self._report)
        self._executor.wake()

    def actions(self) -> dict[str, str]:
        """Return action → type of the graph."""
        from rclpy.action import get_action_names_and_types

        return {name: kinds[0] for name, kinds in sorted(get_action_names_and_types(self._node)) if kinds}

    def action_client(self, kind: Any, name: str) -> Any:
        """Return a client of an action, whose callbacks run in the thread of the executor."""
        from rclpy.action import ActionClient

        client = ActionClient(self._node, kind, name)
        self._executor.wake()
        return client

    def repeat(self, period: float, call: Callable[[], None]) -> End:
        """Call a function in the thread of the executor, again and again; return what ends that.

        Args:
            period: time between two calls [s].
            call: the function.
        """
        timer = self._node.create_timer(period, call)
        self._executor.wake()
        return lambda: self._node.destroy_timer(timer)

    def services(self) -> list[str]:
        """Return the names of the services of the graph."""
        return sorted(dict(self._node.get_service_names_and_types()))

    def service_type(self, service: str) -> str:
        """Return the type of a service; wait until it is discovered."""
        end = time.monotonic() + DISCOVERY
        while not (types := dict(self._node.get_service_names_and_types()).get(service)) and time.monotonic() < end:
            time.sleep(0.05)
        return str(types[0]) if types else ""

    def call(self, service: str, type: str, fields: Any) -> Any:
        """Call a service, if its type is installed, and return the fields of its response."""
        from rclpy.serialization import deserialize_message, serialize_message

        if (kind := rclpy_type(type)) is None:
            raise UnknownTypeError(f"rclpy lacks {type}: install its ROS package")
        data = encode_cdr(from_fields(f"{type}_Request", fields), f"{type}_Request")
        client = self._node.create_client(kind, service)
        try:
            done = Event()
            if not client.wait_for_service(timeout_sec=RESPONSE):
                raise ResourceError(f"{service} has no server")
            future = client.call_async(deserialize_message(data, kind.Request))
            future.add_done_callback(lambda _: done.set())
            self._executor.wake()
            if not done.wait(RESPONSE):
                raise ResourceError(f"{service} does not respond within {RESPONSE:g} s")
            return json_values(decode_cdr(serialize_message(future.result()), f"{type}_Response"))
        finally:
            self._node.destroy_client(client)

    encode, decode = staticmethod(encode_cdr), staticmethod(decode_cdr)

    def close(self) -> None:
        """Leave the graph."""
        if self._other is not None:
            self._other.close()
        self._executor.shutdown(timeout_sec=1.0)
        self._thread.join(1.0)
        self._node.destroy_node()
        self._context.try_shutdown()

    def _fallback(self, type: str) -> CycloneddsNode:
        if self._other is None:
            if not (self._is_dds and find_spec("cyclonedds") is not None):
                raise UnknownTypeError(f"rclpy lacks {type}: install its ROS package, or pip install cyclonedds")
            from urdfkit.bridges.ros2.cyclonedds_node import CycloneddsNode

            self._other = CycloneddsNode(self._domain)
        return self._other


class _RclpyWriter:
    def __init__(self, publisher: Any) -> None:
        self._publisher = publisher

    def publish(self, data: bytes) -> None:
        """Publish a message."""
        self._publisher.publish(data)

    def is_matched(self) -> bool:
        """Return whether there is a subscriber."""
        return bool(self._publisher.get_subscription_count())


def _profile(quality: Quality) -> Any:
    from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy

    return QoSProfile(
        history=HistoryPolicy.KEEP_LAST,
        depth=quality.depth,
        reliability=ReliabilityPolicy.RELIABLE if quality.reliable else ReliabilityPolicy.BEST_EFFORT,
        durability=DurabilityPolicy.TRANSIENT_LOCAL if quality.latched else DurabilityPolicy.VOLATILE,
    )
