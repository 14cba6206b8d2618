"""Page of a robot that is observed, in a recording or live: the robot, all topics, scans and images."""

import math
import time
from collections.abc import Callable, Mapping
from threading import Event
from typing import Any

import numpy as np
from numpy.typing import NDArray

from urdfkit.app.replay.observed_robot import ObservedRobot
from urdfkit.app.replay.recorded_sensors import RecordedSensors
from urdfkit.app.simulation.bridging.bridges import BridgeOptions, open_bridges
from urdfkit.app.simulation.bridging.description_text import DESCRIPTION, STRING, description_text
from urdfkit.app.simulation.clock_rate import FRAME
from urdfkit.app.simulation.displays.displays import Displays
from urdfkit.app.simulation.features.feature import Done, Feature
from urdfkit.app.simulation.features.plots import Plots
from urdfkit.app.simulation.features.robot_panels import RobotPanels
from urdfkit.app.simulation.features.topic_panel import TopicPanel
from urdfkit.app.simulation.features.topic_stream import TopicStreams
from urdfkit.app.viewer.shown_robot import ShownRobot
from urdfkit.bridges.bridge import Bridges
from urdfkit.bus import Bus
from urdfkit.description.packages.resolver import Packages
from urdfkit.errors import UrdfkitError
from urdfkit.linear_algebra import Array
from urdfkit.messages import from_fields
from urdfkit.sim.state.quaternion import yaw_of
from urdfkit.view.content.joint_panel import joint_rows
from urdfkit.view.content.meshcat_objects import draw, link_path
from urdfkit.view.protocol.page_requests import Request, Schema
from urdfkit.view.server.server import Server

STATUS = 0.1
"""Seconds between two status messages to the page."""


class ObservedDisplays(Displays):
    """Displays in the frames of an observed robot."""

    def pose(self, frame: str, links: Mapping[str, Array]) -> Array | None:
        """Return the pose of a frame in the fixed frame, shape (4, 4); None for an unknown frame."""
        session: Any = self.simulator
        found: Array | None = session.frame_pose(frame)
        return found

    def request_markers(self, topic: str, take: Callable[[Any], None]) -> None:
        """Request all interactive markers of a server for `take`."""
        session: Any = self.simulator
        session.request_markers(topic, take)


class ObservedPanels(RobotPanels):
    """Properties and joint positions of an observed robot."""

    def positions(self) -> Mapping[str, float]:
        """Return joint → position on the page [rad or m]."""
        session: Any = self.simulator
        found: Mapping[str, float] = session.joint_positions()
        return found


FEATURES: tuple[type[Feature], ...] = (ObservedPanels, TopicPanel, TopicStreams, Plots, ObservedDisplays)


class ObservedSession:
    """A robot on the page, whose motion and topics come from elsewhere.

    Args:
        shown: the robot.
        robot: its motion.
        bus: its topics.
        server: the page.
        clock: wall clock [s].
        sleep: function that waits for a number of seconds.

    Attributes:
        kinematics: the robot.
        bus: the topics.
        t: time on the page [s].
        bridges: bridges whose peers are served in each iteration.
    """

    def __init__(
        self,
        shown: ShownRobot,
        robot: ObservedRobot,
        bus: Bus,
        server: Server,
        *,
        clock: Callable[[], float] = time.monotonic,
        sleep: Callable[[float], None] = time.sleep,
    ) -> None:
        self._shown, self._robot, self.bus, self.server = shown, robot, bus, server
        self.kinematics = shown.kinematics
        self._clock, self._sleep = clock, sleep
        self.t, self.bridges = 0.0, Bridges()
        self._reported = -math.inf
        simulation: Any = self  # these features use its bus, its time and the poses of its links only
        self._features = tuple(part(simulation, server, clock) for part in FEATURES)
        self.sensors = RecordedSensors(self.bus, robot, server, clock)
        self._takes: dict[str, tuple[Schema, Callable[[Request], Done]]] = {}
        for feature in self._features:
            self._takes.update(feature.takes)

    def begin(self) -> None:
        """Accept the requests of the session."""
        self.server.requests.update({name: schema for name, (schema, _) in self._takes.items()})

    def open_bridges(self, options: BridgeOptions, report: Callable[[str], None]) -> None:
        """Publish the topics on graphs and servers, until `close`.

        Raises:
            UrdfkitError: a port is in use, or a graph of ROS cannot be joined.
        """
        robot = self._shown.kinematics.robot
        if self.bus.latest(DESCRIPTION) is None:
            self.bus.publish(DESCRIPTION, STRING, from_fields(STRING, {"data": description_text(robot)}))
        find_package = (robot.packages or Packages()).find
        open_bridges(self.bridges, options, self.bus, lambda: self.t, {}, description_text(robot), find_package, report)

    def link_poses(self) -> NDArray[np.float64]:
        """Return x y z [m] and quaternion x y z w of every link; shape (links, 7)."""
        return self._robot.link_poses(self.time_of_poses())

    def joint_positions(self) -> dict[str, float]:
        """Return the positions of all joints on the page [rad or m]; zero where none is known."""
        configuration = self.kinematics.configuration(self._robot.positions(self.time_of_poses()))
        return self.kinematics.positions(configuration)

    def frame_pose(self, frame: str) -> Array | None:
        """Return the pose of a frame on the page, shape (4, 4); None for an unknown frame."""
        return self._robot.frame_pose(frame, self.time_of_poses())

    def request_markers(self, topic: str, take: Callable[[Any], None]) -> None:
        """Request all interactive markers of a server: nothing answers."""

    def close(self) -> None:
        """Close the bridges."""
        self.bridges.close()

    def show(self) -> None:
        """Show the robot and the controls."""
        kinematics, scene = self._shown.kinematics, self._shown.scene
        self.server.show(
            name=kinematics.robot.name or "robot",
            nodes=[link_path(name) for name in kinematics.link_names],
            root=kinematics.link_names.index(kinematics.root),
            joints=joint_rows(kinematics, self.joint_positions()),
            draw=lambda server: draw(scene, server, server.geometries),
        )
        self.server.publish_latched("accepts", requests=sorted(self._takes))
        self.server.publish_latched("teleop", **self.drive_controls())
        self.server.publish_latched("findings", findings=[], rules={}, fault=None)
        self.sensors.show()
        for feature in self._features:
            feature.show()

    def drive_controls(self) -> dict[str, Any]:
        """Return the controls of the page for driving: nothing can be driven."""
        return {"drives": False, "robots": [], "moves": {}, "factors": {}, "speed": 0.5, "turn": 1.0}

    def run(self, stop: Event | None = None) -> None:
        """Show until an exception is raised.

        Args:
            stop: ends the session when it is set.
        """
        stop = stop or Event()
        while not stop.is_set():
            self.tick()
            self._sleep(FRAME)

    def tick(self) -> None:
        """Run one iteration: requests, time, messages, poses."""
        self.bridges.take()
        inputs = self.server.inbox.take()
        for action in inputs.actions:
            self.act(action)
        for request in inputs.requests:
            self._do(request)
        self.advance()
        time = self.time_of_poses()
        self.server.publish(self.t, self._robot.link_poses(time))
        self.sensors.tick(time)
        for feature in self._features:
            feature.tick()
        if (now := self._clock()) - self._reported >= STATUS:
            self._reported = now
            self.report()

    def act(self, action: str) -> None:
        """Execute a button of the page."""

    def advance(self) -> None:
        """Advance the time, and publish the messages until then."""

    def time_of_poses(self) -> float:
        """Return the time of the poses to show, on the clock of the robot [s]."""
        return self.t

    def report(self) -> None:
        """Send the status to the page."""
        self.server.broadcast("status", **self.status())

    def status(self) -> dict[str, Any]:
        """Return the status."""
        kinematics = self._shown.kinematics
        pose = self._robot.link_poses(self.time_of_poses())[kinematics.link_names.index(kinematics.root)]
        return {
            "time": self.t,
            "paused": False,
            "real_time_factor": 1.0,
            "factor": 1.0,
            "dt": FRAME,
            "pose": {"x": float(pose[0]), "y": float(pose[1]), "yaw": yaw_of(pose[3:])},
            "speed": 0.0,
            "turn": 0.0,
            "fixed": False,
            "tip": kinematics.root,
            "robots": {},
            "odometry": {},
            "driver": self.server.drive_lock.holder,
            "watchers": self.server.hub.watchers,
        }

    def _do(self, request: Request) -> None:
        try:
            values = self._takes[request.name][1](request)
        except UrdfkitError as error:
            self.server.answer(request, str(error))
        else:
            self.server.answer(request, **(values or {}))
