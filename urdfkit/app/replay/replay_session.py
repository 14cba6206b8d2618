"""Page of a recording: the robot as it was recorded, all topics, scans and images, and the controls of time."""

import time
from collections.abc import Callable, Iterator
from threading import Event
from typing import Any

from urdfkit.app.replay.observed_session import ObservedSession
from urdfkit.app.replay.recorded_robot import RecordedRobot
from urdfkit.app.simulation.bridging.bridges import BridgeOptions
from urdfkit.app.simulation.features.feature import Done
from urdfkit.app.viewer.shown_robot import ShownRobot
from urdfkit.bridges.bag_file import BagFile, RecordedMessage
from urdfkit.bus import Bus
from urdfkit.messages import CLOCK, from_fields
from urdfkit.view.protocol.page_requests import Request, Schema, choice, number
from urdfkit.view.server.server import Server

FASTEST = 20.0
"""Speed that the page's "max" stands for."""


class ReplaySession(ObservedSession):
    """A recording on the page.

    Args:
        bag: the recording.
        shown: the robot.
        robot: its motion.
        server: the page.
        loop: start again at the end of the recording.
        clock: wall clock [s].
        sleep: function that waits for a number of seconds.

    Attributes:
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
        bus = Bus()
        for topic in bag.topics:
            bus.advertise(topic.name, topic.type)
        super().__init__(shown, robot, bus, server, clock=clock, sleep=sleep)
        self._bag, self._loop = bag, loop
        self.speed, self.running, self._publishes_clock = 1.0, True, False
        self.duration = bag.end - bag.begin
        self._from = self._clock(), 0.0
        del self._takes["publish"], self._takes["publish_pose"]
        self._takes["replay"] = (
            Schema({"action": choice("show", "play", "pause", "end")}, {"at": number(0), "speed": number(0.05, 200)}),
            self._control,
        )
        self._takes["speed"] = Schema({}, {"factor": number(0.01, 1000)}), self._set_speed
        self.begin()
        self._messages: Iterator[RecordedMessage] = iter(())
        self._next: RecordedMessage | None = None
        self._seek(0.0)

    def show(self) -> None:
        """Show the robot and the controls."""
        super().show()
        self.server.publish_latched("recorder", **self._state())

    def run(self, stop: Event | None = None) -> None:
        """Replay until an exception is raised.

        Args:
            stop: ends the replay when it is set.
        """
        self._from = self._clock(), self.t
        super().run(stop)

    def advance(self) -> None:
        """Advance the time, and publish the messages until then."""
        if self.running:
            begun, at = self._from
            self.t = at + (self._clock() - begun) * self.speed
            if self.t >= self.duration:
                self._at_end()
        self._publish_until(self.t)
        if self._publishes_clock:
            time = from_fields(CLOCK, {"clock": self.time_of_poses()})
            self.bus.publish("/clock", CLOCK, time)

    def open_bridges(self, options: BridgeOptions, report: Callable[[str], None]) -> None:
        """Publish the topics on graphs and servers; and the time, if the recording has no ``/clock``."""
        self._publishes_clock = all(topic.name != "/clock" for topic in self.bus.topics)
        if self._publishes_clock:
            self.bus.advertise("/clock", CLOCK)
        super().open_bridges(options, report)

    def time_of_poses(self) -> float:
        """Return the time of the poses on the clock of the recording [s]."""
        return self._bag.begin + self.t

    def report(self) -> None:
        """Send the status and the state of the controls to the page."""
        super().report()
        self.server.broadcast("recorder", **self._state())

    def _at_end(self) -> None:
        if self._loop and self.duration > 0.0:
            self._seek(0.0)
        else:
            self.t, self.running = self.duration, False

    def act(self, action: str) -> None:
        """Execute a button of the page."""
        if action == "reset":
            self._seek(0.0)
        elif action == "play":
            self._play()
        elif action == "pause":
            self.running = False

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

    def status(self) -> dict[str, Any]:
        """Return the status."""
        return {**super().status(), "paused": not self.running, "real_time_factor": self.speed, "factor": self.speed}
