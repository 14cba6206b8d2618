"""Start the page of a live robot."""

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from urllib.parse import urlsplit

from urdfkit.app.page import Page
from urdfkit.app.replay.live_session import LiveSession
from urdfkit.app.viewer.shown_robot import ShownRobot
from urdfkit.bridges.node.node import Node
from urdfkit.errors import UsageError

SOURCES = "ros1, ros2 or rosbridge://HOST:PORT"


def open_source(source: str, report: Callable[[str], None]) -> Node:
    """Return a node on the graph that a source names.

    Args:
        source: one of `SOURCES`.
        report: receives lines about the connection.

    Raises:
        UrdfkitError: the source is unknown, or cannot be reached.
    """
    if source == "ros2":
        from urdfkit.bridges.ros2.node_selection import open_node

        return open_node(None, "", report)
    if source == "ros1":
        import os

        from urdfkit.bridges.ros1.ros1_node import Ros1Node

        return Ros1Node(name=f"/urdfkit_{os.getpid()}", report=report)
    if urlsplit(source).scheme == "rosbridge":
        from urdfkit.bridges.rosbridge.rosbridge_node import RosbridgeNode

        return RosbridgeNode(source, report)
    raise UsageError(f"`{source}` is not a source of live topics; use {SOURCES}")


@contextmanager
def following(
    page: Page, shown: ShownRobot, source: str, report: Callable[[str], None], *, fixed_frame: str | None = None
) -> Iterator[LiveSession]:
    """Serve the page of a live robot inside the context; yield its session, ready to run.

    Args:
        page: the page, not opened yet.
        shown: the robot.
        source: one of `SOURCES`.
        report: receives lines about the connection.
        fixed_frame: frame in which everything is shown; None for world, map or odom.

    Raises:
        UrdfkitError: the source is unknown or cannot be reached.
    """
    from urdfkit.app.replay.observed_robot import ObservedRobot

    server = page.server
    node = open_source(source, report)
    session = None
    try:
        robot = ObservedRobot(shown.kinematics, fixed_frame=fixed_frame, length=1)
        session = LiveSession(node, shown, robot, server, report=report, clock=time.monotonic)
        page.open()
        session.show()
        yield session
    finally:
        if session is not None:
            session.close()
        else:
            node.close()
        server.stop()
