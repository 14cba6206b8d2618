"""Connect a simulation with the graph of ROS 2."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from urdfkit.app.page import note
from urdfkit.bridges.bridge import Bridges
from urdfkit.sim.simulator import Simulator

CLOCK_RATE = 1000.0
"""Default rate of ``/clock`` [Hz], that of Gazebo; messages are built only for subscribers."""


@dataclass(frozen=True)
class Ros2Options:
    """Options of the connection.

    Attributes:
        domain: ROS domain; that of ``ROS_DOMAIN_ID`` when None.
        namespace: before the names of the topics, with a leading slash, or empty.
        clock_rate: rate of ``/clock`` [Hz].
    """

    domain: int | None = None
    namespace: str = ""
    clock_rate: float = CLOCK_RATE


def connect_to_ros2(
    simulator: Simulator, options: Ros2Options, bridges: Bridges, report: Callable[[str], None]
) -> None:
    """Open the connection and add it to the bridges, which close it.

    Raises:
        UrdfkitError: neither rclpy nor Cyclone DDS is installed, or the node cannot start.
    """
    from urdfkit.bridges.ros2.node_selection import open_node
    from urdfkit.bridges.ros2.ros2_bridge import Ros2Bridge

    node = open_node(options.domain, options.namespace)
    simulator.set_clock_rate(options.clock_rate)
    bridges.add(Ros2Bridge(simulator.bus, bridges.calls, node, namespace=options.namespace, report=report))
    note(f"ros2: topics are published by {node.description}; services are not available")
