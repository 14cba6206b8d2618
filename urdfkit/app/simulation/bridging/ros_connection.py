"""Connect a simulation with the graph of ROS 1 or ROS 2."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from urdfkit.app.page import note
from urdfkit.app.simulation.bridging.description_text import DESCRIPTION
from urdfkit.bridges.bridge import Bridges
from urdfkit.bridges.service import Service
from urdfkit.bus import Bus

CLOCK_RATE = 1000.0
"""Default rate of ``/clock`` [Hz], that of Gazebo; messages are built only for subscribers."""


@dataclass(frozen=True)
class RosOptions:
    """Options of the connections.

    Attributes:
        ros1: whether to connect with ROS 1, at the master of ``ROS_MASTER_URI``.
        ros2: whether to connect with ROS 2.
        domain: domain of ROS 2; that of ``ROS_DOMAIN_ID`` when None.
        namespace: before the names of the topics, with a leading slash, or empty.
        clock_rate: rate of ``/clock`` [Hz].
    """

    ros1: bool = False
    ros2: bool = False
    domain: int | None = None
    namespace: str = ""
    clock_rate: float = CLOCK_RATE

    def __bool__(self) -> bool:
        """Whether a connection is opened."""
        return self.ros1 or self.ros2


def connect_to_ros(
    bus: Bus, options: RosOptions, bridges: Bridges, services: Mapping[str, Service], report: Callable[[str], None]
) -> None:
    """Open the connections and add them to the bridges, which close them.

    Args:
        bus: the topics.
        options: which connections.
        bridges: of the simulation or recording.
        services: that nodes can call.
        report: receives lines about topics and messages that cannot be used.

    Raises:
        UrdfkitError: no library for ROS 2 is installed, no ROS 1 master runs, or the node cannot start.
    """
    from urdfkit.bridges.node.node import Node
    from urdfkit.bridges.node.node_bridge import NodeBridge

    def add(node: Node, name: str) -> None:
        bridge = NodeBridge(
            bus,
            bridges.calls,
            node,
            services=services,
            namespace=options.namespace,
            builder=bridges.builder,
            report=report,
        )
        bridges.add(bridge)
        served = f"{bridge.served} services" if bridge.served else "services are not available"
        more = f"; {len(bridge.actions)} actions" if bridge.actions else ""
        note(f"{name}: topics are published by {node.description}; {served}{more}")

    if options.ros1:
        from urdfkit.bridges.ros1.ros1_node import NAME, Ros1Node

        ros1 = Ros1Node(name=options.namespace + NAME, report=report)
        ros1.set_parameter("/use_sim_time", True)
        if (description := bus.latest(DESCRIPTION)) is not None:
            ros1.set_parameter(options.namespace + DESCRIPTION, description.data)
        add(ros1, "ros1")
    if options.ros2:
        from urdfkit.bridges.ros2.node_selection import open_node

        add(open_node(options.domain, options.namespace, report), "ros2")
