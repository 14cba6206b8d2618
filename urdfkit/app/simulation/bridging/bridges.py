"""Start the bridges of a simulation, and run what their peers send in the thread of the simulation."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from urdfkit.app.page import note
from urdfkit.app.simulation.bridging.description_text import DESCRIPTION, publish_description
from urdfkit.app.simulation.bridging.ros_connection import RosOptions, connect_to_ros
from urdfkit.app.simulation.bridging.services import simulation_services
from urdfkit.app.simulation.bridging.simulation_interfaces import Controls
from urdfkit.bridges.bridge import Bridges
from urdfkit.bridges.graph import Graph
from urdfkit.bridges.service import Service
from urdfkit.bus import Bus
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
    simulator: Simulator,
    options: BridgeOptions,
    controls: Controls,
    report: Callable[[str], None],
    *,
    services: Mapping[str, Service] | None = None,
) -> Iterator[Bridges]:
    """Serve the bridges inside the context; yield them.

    Args:
        simulator: the simulation.
        options: which bridges.
        controls: what pauses and resets the simulation.
        report: receives a line about a message that was dropped.
        services: that peers can call; None for those of the simulation with these controls.

    Raises:
        UsageError: a port is in use.
        ResourceError: a graph of ROS cannot be joined.
    """
    bridges = Bridges(report)
    if not options:
        yield bridges
        return
    text = publish_description(simulator)
    if options.ros is not None:
        simulator.set_clock_rate(options.ros.clock_rate)
    services = simulation_services(simulator, controls) if services is None else services
    try:
        open_bridges(
            bridges, options, simulator.bus, lambda: simulator.t, services, text, _packages(simulator).find, report
        )
        yield bridges
    finally:
        bridges.close()


def open_bridges(
    bridges: Bridges,
    options: BridgeOptions,
    bus: Bus,
    clock: Callable[[], float],
    services: Mapping[str, Service],
    description: str,
    find_package: Callable[[str], Path],
    report: Callable[[str], None],
) -> None:
    """Open bridges and add them to `bridges`, which closes them.

    Args:
        bridges: of the simulation or recording.
        options: which bridges.
        bus: the topics.
        clock: returns the time of messages [s].
        services: that peers can call.
        description: the robot as URDF.
        find_package: returns the folder of a package, for its meshes.
        report: receives a line about a message that was dropped.

    Raises:
        UrdfkitError: a port is in use, or a graph of ROS cannot be joined.
    """
    from urdfkit.bridges.foxglove.bridge import FoxgloveServer
    from urdfkit.bridges.rosbridge.peer import serve_rosbridge

    parameters = {DESCRIPTION: description, "/use_sim_time": True}

    def graph() -> Graph:
        return Graph(bus, bridges.calls, clock, services, parameters, bridges.builder)

    if options.rosbridge is not None:
        server = serve_rosbridge(graph(), options.rosbridge, origins=options.origins, report=report)
        bridges.add(server)
        _announce("rosbridge", server)
    if options.foxglove is not None:
        foxglove = FoxgloveServer(graph(), options.foxglove, find_package, origins=options.origins, report=report)
        bridges.add(foxglove)
        _announce("foxglove", foxglove)
    if options.ros is not None:
        connect_to_ros(bus, options.ros, bridges, services, report)


def _packages(simulator: Simulator) -> Packages:
    return simulator.robot.packages or Packages()


def _announce(name: str, server: WebSocketServer) -> None:
    for url in server.urls:
        note(f"{name}: {url}")
    if server.needs_token:
        note(
            f"warning: everyone with this address can read and publish all topics of {name}; "
            "the connection is not encrypted"
        )
