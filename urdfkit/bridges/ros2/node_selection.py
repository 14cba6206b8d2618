"""Choice of the library of a node: rclpy, of a sourced ROS or from PyPI, else Cyclone DDS."""

from collections.abc import Callable
from importlib.util import find_spec

from urdfkit.bridges.node.node import Node
from urdfkit.bridges.ros2.environment import keep_on_this_machine, ros_domain, share_long_messages
from urdfkit.errors import MissingDependencyError

INSTALL = "--ros2 needs rclpy or Cyclone DDS: source a ROS 2 workspace, or pip install 'urdfkit[ros2]'"


def open_node(domain: int | None, namespace: str, report: Callable[[str], None] = lambda line: None) -> Node:
    """Return a node of the first library that is installed.

    Raises:
        MissingDependencyError: none is, or rclpy cannot be imported.
        UsageError: the domain or the discovery range is not valid.
    """
    number = ros_domain(domain)
    keep_on_this_machine()
    if find_spec("rclpy") is not None:
        share_long_messages()
        from urdfkit.bridges.ros2.rclpy_node import RclpyNode

        return RclpyNode(number, namespace, report)
    if find_spec("cyclonedds") is not None:
        from urdfkit.bridges.ros2.cyclonedds_node import CycloneddsNode

        return CycloneddsNode(number)
    raise MissingDependencyError(INSTALL)


def require_library() -> None:
    """Check that a library is installed, without importing it.

    Raises:
        MissingDependencyError: none is.
    """
    if find_spec("rclpy") is None and find_spec("cyclonedds") is None:
        raise MissingDependencyError(INSTALL)
