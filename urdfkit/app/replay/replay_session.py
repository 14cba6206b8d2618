"""Page of a recording: the robot as it was recorded, all topics, scans and images, and the controls of time."""

from __future__ import annotations

import math
import time
from collections import deque
from collections.abc import Callable, Iterator
from threading import Event
from typing import Any

from urdfkit.app.replay.recorded_robot import RecordedRobot
from urdfkit.app.replay.recorded_sensors import RecordedSensors
from urdfkit.app.simulation.clock_rate import FRAME
from urdfkit.app.simulation.features.feature import Done, Feature
from urdfkit.app.simulation.features.plots import Plots
from urdfkit.app.simulation.features.topic_panel import TopicPanel
from urdfkit.app.simulation.features.topic_stream import TopicStreams
from urdfkit.app.viewer.shown_robot import ShownRobot
from urdfkit.bridges.bag_file import BagFile, RecordedMessage
from urdfkit.bus import Bus
from urdfkit.errors import UrdfkitError
from urdfkit.sim.state.quaternion import yaw_of
from urdfkit.view.content.meshcat_objects import draw, link_path
from urdfkit.view.protocol.page_requests import Request, Schema, choice, number
from urdfkit.view.server.server import Server

STATUS = 0.1
"""Seconds between two status messages to the page."""
FASTEST = 20.0
"""Speed that the page's "max" stands for."""
FEATURES: tuple[type[Feature], ...] = (TopicPanel, TopicStreams, Plots)


class ReplaySession:
    """A recording on the page.

    Args:
        bag: the recording.
        shown: the robot.
        robot: its motion.
        server: the page.
        loop: begin again at the end.
        clock: wall clock [s].
        sleep: function that waits for a number of seconds.

    Attributes:
        bus: publishes the messages of the recording.
        t: time since the first message [s].
        speed: recorded seconds per second.
        running: whether time advances.
    """

    def __init__(
        self,
        bag: BagFile,
        shown: ShownRobot,
        robot: RecordedRobot,
        server: Server,
        *,
        loop: bool = False,
        clock: Callable[[], float] = time.monotonic,
        sleep: Callable[[float], None] = time.sleep,
    ) -> None:
        self._bag, self._shown, self._robot, self.server = bag, shown, robot, server
        self._loop, self._clock, self._sleep = loop, clock, sleep
        self.bus, self.t, self.speed, self.running = Bus(), 0.0, 1.0, True
        self.duration = bag.end - bag.begin
        self._from = self._clock(), 0.0
        self._reported = -math.inf
        self._requests: deque[Request] = deque()
        for topic in bag.topics:
            self.bus.advertise(topic.name, topic.type)
        simulation: Any = self  # these features use its bus and its time only
        self._features = tuple(part(simulation, server, clock) for part in FEATURES)
        self._sensors = RecordedSensors(self.bus, robot, server, clock)
        self._takes: dict[str, tuple[Schema, Callable[[Request], Done]]] = {
            "replay": (
                Schema(
                    {"action": choice("show", "play", "pause", "end")}, {"at": number(0), "speed": number(0.05, 20)}
                ),
                self._control,
            ),
            "speed": (Schema({}, {"factor": number(0.01, 1000)}), self._set_speed),
        }
        for feature in self._features:
            self._takes.update({name: take for name, take in feature.takes.items() if name != "publish"})
        server.requests.update({name: schema for name, (schema, _) in self._takes.items()})
        self._messages: Iterator[RecordedMessage] = iter(())
        self._next: RecordedMessage | None = None
        self._seek(0.0)

    def show(self) -> None:
        """Show the robot and the controls."""
        kinematics, scene = self._shown.kinematics, self._shown.scene
        self.server.show(
            name=kinematics.robot.name or self._bag.path.stem,
            nodes=[link_path(name) for name in kinematics.link_names],
            root=kinematics.link_names.index(kinematics.root),
            draw=lambda server: draw(scene, server, server.geometries),
        )
        self.server.publish_latched("teleop", drives=False, robots=[], moves={}, factors={}, speed=0.5, turn=1.0)
        self.server.publish_latched("findings", findings=[], rules={}, fault=None)
        self._sensors.show()
        for feature in self._features:
            feature.show()
        self.server.publish_latched("recorder", **self._state())

    def run(self, stop: Event | None = None) -> None:
        """Replay until an exception is raised.

        Args:
            stop: ends the replay when it is set.
        """
        stop = stop or Event()
        self._from = self._clock(), self.t
        while not stop.is_set():
            self.tick()
            self._sleep(FRAME)

    def tick(self) -> None:
        """Run one iteration: requests, time, messages, poses."""
        inputs = self.server.inbox.take()
        for action in inputs.actions:
            self._act(action)
        for request in inputs.requests:
            self._do(request)
        if self.running:
            begun, at = self._from
            self.t = at + (self._clock() - begun) * self.speed
            if self.t >= self.duration:
                self._at_end()
        self._publish_until(self.t)
        self.server.publish(self.t, self._robot.link_poses(self._bag.begin + self.t))
        self._sensors.tick(self._bag.begin + self.t)
        for feature in self._features:
            feature.tick()
        if (now := self._clock()) - self._reported >= STATUS:
            self._reported = now
            self.server.broadcast("status", **self._status())
            self.server.broadcast("recorder", **self._state())

    def _at_end(self) -> None:
        if self._loop and self.duration > 0.0:
            self._seek(0.0)
        else:
            self.t, self.running = self.duration, False

    def _act(self, action: str) -> None:
        if action == "reset":
            self._seek(0.0)
        elif action == "play":
            self._play()
        elif action == "pause":
            self.running = False

    def _do(self, request: Request) -> None:
        try:
            values = self._takes[request.name][1](request)
        except UrdfkitError as error:
            self.server.answer(request, str(error))
        else:
            self.server.answer(request, **(values or {}))

    def _control(self, request: Request) -> Done:
        action, values = request.values["action"], request.values
        if "at" in values:
            self._seek(values["at"])
        self.speed = values.get("speed", self.speed)
        if action == "play":
            self._play()
        elif action in ("pause", "end"):
            self.running = False
        self._from = self._clock(), self.t
        return None

    def _set_speed(self, request: Request) -> Done:
        self.speed = request.values.get("factor", FASTEST)
        self._from = self._clock(), self.t
        return None

    def _play(self) -> None:
        if self.t >= self.duration:
            self._seek(0.0)
        self.running = True
        self._from = self._clock(), self.t

    def _seek(self, t: float) -> None:
        """Continue at another time [s]: topics have no last message until the next one."""
        self.t = min(max(t, 0.0), self.duration)
        self._from = self._clock(), self.t
        self._messages = self._bag.messages(begin=self._bag.begin + self.t)
        self._next = next(self._messages, None)
        for topic in self.bus.topics:
            topic.restore(0)

    def _publish_until(self, t: float) -> None:
        """Publish the recorded messages up to a time; a message is made from its bytes only for subscribers."""
        while self._next is not None and self._next.time <= self._bag.begin + t:
            recorded, self._next = self._next, next(self._messages, None)
            topic = self.bus.advertise(recorded.topic.name, recorded.topic.type)
            topic.offer(lambda recorded=recorded: self._bag.message(recorded))  # type: ignore[misc]

    def _state(self) -> dict[str, Any]:
        return {
            "recording": False,
            "topics": False,
            "begin": 0.0,
            "end": self.duration,
            "frames": self._bag.count,
            "playing": True,
            "running": self.running,
            "at": self.t,
            "file": self._bag.path.name,
        }

    def _status(self) -> dict[str, Any]:
        kinematics = self._shown.kinematics
        pose = self._robot.link_poses(self._bag.begin + self.t)[kinematics.link_names.index(kinematics.root)]
        return {
            "time": self.t,
            "paused": not self.running,
            "real_time_factor": self.speed,
            "factor": self.speed,
            "dt": FRAME,
            "pose": {"x": float(pose[0]), "y": float(pose[1]), "yaw": yaw_of(pose[3:])},
            "speed": 0.0,
            "turn": 0.0,
            "fixed": False,
            "tip": kinematics.root,
            "robots": {},
            "odometry": {},
            "driver": None,
            "watchers": self.server.hub.watchers,
        }
