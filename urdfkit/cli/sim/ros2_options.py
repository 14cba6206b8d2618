"""``--ros2`` and its options: the topics of a simulation on the graph of ROS 2."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from urdfkit.cli.sim import option_values
from urdfkit.errors import UsageError

if TYPE_CHECKING:
    from urdfkit.app.simulation.bridging.ros2_connection import Ros2Options


def add_ros2(parser: argparse.ArgumentParser) -> None:
    """Add the options."""
    group = parser.add_argument_group("ROS 2 (the simulation then runs in real time)")
    group.add_argument(
        "--ros2",
        action="store_true",
        help="publish all topics to nodes of ROS 2 and subscribe to their commands, by rclpy, else Cyclone "
        "DDS. Discovery stays on this machine unless ROS_AUTOMATIC_DISCOVERY_RANGE extends it",
    )
    group.add_argument("--ros-domain", type=int, metavar="N", help="ROS domain (default: ROS_DOMAIN_ID, else 0)")
    group.add_argument("--namespace", metavar="NS", help="namespace of the topics, except /clock, /tf and /tf_static")
    group.add_argument(
        "--clock-rate", type=option_values.positive, metavar="HZ", help="rate of /clock (default: 1000 Hz)"
    )


def ros2_options(arguments: argparse.Namespace) -> Ros2Options | None:
    """Return the options, checked before a robot is loaded; None without ``--ros2``.

    Raises:
        UsageError: options without ``--ros2``, or an invalid domain, namespace or variable of ROS.
        MissingDependencyError: neither rclpy nor Cyclone DDS is installed.
    """
    if not arguments.ros2:
        for option in ("ros_domain", "namespace", "clock_rate"):
            if getattr(arguments, option) is not None:
                raise UsageError(f"--{option.replace('_', '-')} is an option of the bridge to ROS 2: add --ros2")
        return None
    from urdfkit.app.simulation.bridging.ros2_connection import CLOCK_RATE, Ros2Options
    from urdfkit.bridges.ros2.environment import on_this_machine, ros_domain
    from urdfkit.bridges.ros2.node_selection import require_library
    from urdfkit.bridges.ros2.ros2_bridge import check_namespace

    namespace, domain = check_namespace(arguments.namespace or ""), ros_domain(arguments.ros_domain)
    on_this_machine()
    require_library()
    return Ros2Options(domain, namespace, arguments.clock_rate or CLOCK_RATE)
