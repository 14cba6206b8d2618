"""Start the bridges of a simulation, and run what their peers send in the thread of the simulation."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING

from urdfkit.app.page import note
from urdfkit.app.simulation.bridging.controls import Controls
from urdfkit.app.simulation.bridging.description_text import DESCRIPTION, publish_description
from urdfkit.app.simulation.bridging.ros_connection import RosOptions, connect_to_ros
from urdfkit.app.simulation.bridging.services import simulation_services
from urdfkit.bridges.bridge import Bridges
from urdfkit.bridges.graph import Graph
from urdfkit.description.packages.resolver import Packages

if TYPE_CHECKING:
    from urdfkit.bridges.websocket.address import Address
    from urdfkit.bridges.websocket.server import WebSocketServer
    from urdfkit.sim.simulator import Simulator


@dataclass(frozen=True)
class BridgeOptions:
    """Which bridges to start.

    Attributes:
        rosbridge: address of the rosbridge server; None for no server.
        foxglove: address of the Foxglove server; None for no server.
        origins: origins of web pages that may connect, in addition to pages of this machine.
        ros: options of the connections with ROS; None for no connection.
    """

    rosbridge: Address | None = None
    foxglove: Address | None = None
    origins: Sequence[str] = ()
    ros: RosOptions | None = None

    def __bool__(self) -> bool:
        """Whether a bridge is started."""
        return any(each is not None for each in (self.rosbridge, self.foxglove, self.ros))


@contextmanager
def bridged(
    simulator: Simulator, options: BridgeOptions, controls: Controls, report: Callable[[str], None]
) -> Iterator[Bridges]:
    """Serve the bridges inside the context; yield them.

    Args:
        simulator: the simulation.
        options: which bridges.
        controls: what pauses and resets the simulation.
        report: receives a line about a message that was dropped.

    Raises:
        UsageError: a port is in use.
        ResourceError: a graph of ROS cannot be joined.
    """
    bridges = Bridges()
    if not options:
        yield bridges
        return
    from urdfkit.bridges.foxglove.bridge import FoxgloveServer
    from urdfkit.bridges.rosbridge.bridge import serve_rosbridge

    text = publish_description(simulator)
    services = simulation_services(simulator, controls)
    parameters = {DESCRIPTION: text, "/use_sim_time": True}

    def graph() -> Graph:
        return Graph(simulator.bus, bridges.calls, lambda: simulator.t, services, parameters)

    try:
        if options.rosbridge is not None:
            server = serve_rosbridge(graph(), options.rosbridge, origins=options.origins, report=report)
            bridges.add(server)
            _announce("rosbridge", server)
        if options.foxglove is not None:
            foxglove = FoxgloveServer(
                graph(), options.foxglove, _packages(simulator).find, origins=options.origins, report=report
            )
            bridges.add(foxglove)
            _announce("foxglove", foxglove)
        if options.ros is not None:
            connect_to_ros(simulator, options.ros, bridges, services, report)
        yield bridges
    finally:
        bridges.close()


def _packages(simulator: Simulator) -> Packages:
    return simulator.robot.packages or Packages()


def _announce(name: str, server: WebSocketServer) -> None:
    for url in server.urls:
        note(f"{name}: {url}")
    if server.needs_token:
        note(f"warning: everyone with this address can read and publish all topics of {name}; it is not encrypted")
