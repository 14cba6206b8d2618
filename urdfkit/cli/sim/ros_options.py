"""``--ros1``, ``--ros2`` and their options: the topics of a simulation on the graph of ROS."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from urdfkit.cli.sim import option_values
from urdfkit.errors import UsageError

if TYPE_CHECKING:
    from urdfkit.app.simulation.bridging.ros_connection import RosOptions


def add_ros(parser: argparse.ArgumentParser, *, note: str = "") -> None:
    """Add the options; `note` follows the title of their group."""
    group = parser.add_argument_group(f"ROS{note}")
    group.add_argument(
        "--ros2",
        action="store_true",
        help="publish all topics to ROS 2 nodes and subscribe to their commands, with rclpy or, without it, Cyclone "
        "DDS. Discovery stays on this machine unless ROS_AUTOMATIC_DISCOVERY_RANGE extends it",
    )
    group.add_argument(
        "--ros1",
        action="store_true",
        help="publish all topics to ROS 1 nodes, subscribe to their commands and serve services, with the master in "
        "ROS_MASTER_URI; only nodes of this machine connect "
        "unless ROS_IP or ROS_HOSTNAME is set",
    )
    group.add_argument("--ros-domain", type=int, metavar="N", help="domain of ROS 2 (default: ROS_DOMAIN_ID, else 0)")
    group.add_argument("--namespace", metavar="NS", help="namespace of the topics, except /clock, /tf and /tf_static")
    group.add_argument(
        "--clock-rate", type=option_values.positive, metavar="HZ", help="rate of /clock (default: 1000 Hz)"
    )


def ros_options(arguments: argparse.Namespace) -> RosOptions | None:
    """Return the options, checked before a robot is loaded; None without ``--ros1`` and ``--ros2``.

    Raises:
        UsageError: options without ``--ros2`` or ``--ros1``, or an invalid domain, namespace or variable of ROS.
        MissingDependencyError: neither rclpy nor Cyclone DDS is installed.
    """
    for option, is_open, needed in (
        ("ros_domain", arguments.ros2, "--ros2"),
        ("namespace", arguments.ros2 or arguments.ros1, "--ros2 or --ros1"),
        ("clock_rate", arguments.ros2 or arguments.ros1, "--ros2 or --ros1"),
    ):
        if getattr(arguments, option) is not None and not is_open:
            raise UsageError(f"--{option.replace('_', '-')} is an option of the bridge to ROS: add {needed}")
    if not (arguments.ros1 or arguments.ros2):
        return None
    from urdfkit.app.simulation.bridging.ros_connection import CLOCK_RATE, RosOptions
    from urdfkit.bridges.node.node_bridge import check_namespace
    from urdfkit.bridges.ros1.environment import master_uri
    from urdfkit.bridges.ros2.environment import on_this_machine, ros_domain
    from urdfkit.bridges.ros2.node_selection import require_library

    namespace = check_namespace(arguments.namespace or "")
    if arguments.ros1:
        master_uri()
    domain = None
    if arguments.ros2:
        domain = ros_domain(arguments.ros_domain)
        on_this_machine()
        require_library()
    return RosOptions(arguments.ros1, arguments.ros2, domain, namespace, arguments.clock_rate or CLOCK_RATE)
