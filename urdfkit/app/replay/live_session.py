"""Page of a live robot: its state on a graph of ROS, and commands of the page to it."""

import math
import time
from collections.abc import Callable
from typing import Any

from urdfkit.app.replay.live_topics import LiveTopics
from urdfkit.app.replay.observed_robot import MOTION, ObservedRobot
from urdfkit.app.replay.observed_session import ObservedSession
from urdfkit.app.simulation.displays.displays import POSES, pose_message
from urdfkit.app.simulation.displays.interactive_markers import SERVICE
from urdfkit.app.simulation.features.feature import Done
from urdfkit.app.simulation.features.teleop import controls_of
from urdfkit.app.simulation.features.topic_panel import ECHO
from urdfkit.app.viewer.shown_robot import ShownRobot
from urdfkit.bridges.node.node import Node
from urdfkit.bus import Bus, absolute
from urdfkit.messages import TWIST, TWIST_STAMPED, from_fields, full_type_name
from urdfkit.teleop import STOP, Motion, Teleop
from urdfkit.view.protocol.page_requests import Request
from urdfkit.view.server.server import Server

GOAL_OF_ROS_1 = "/move_base_simple/goal"
"""Topic of goals of move_base; RViz of ROS 1 publishes on it."""
MATCH = 1.0
"""Longest time to wait for the subscribers of a new publisher [s]."""
COMMAND = "cmd_vel"
PERIOD = 0.05
"""Seconds between two velocity commands."""


class LiveSession(ObservedSession):
    """A live robot on the page.

    Args:
        node: on the graph.
        shown: the robot.
        robot: its motion.
        server: the page.
        report: receives lines about topics that cannot be received.
        clock: wall clock [s].
        sleep: function that waits for a number of seconds.
    """

    def __init__(
        self,
        node: Node,
        shown: ShownRobot,
        robot: ObservedRobot,
        server: Server,
        *,
        report: Callable[[str], None],
        clock: Callable[[], float] = time.monotonic,
        sleep: Callable[[float], None] = time.sleep,
    ) -> None:
        super().__init__(shown, robot, Bus(), server, clock=clock, sleep=sleep)
        self.topics = LiveTopics(node, self.bus, report, clock)
        self._begun = clock()
        self._followed = 0
        self._driven, self._due = False, 0.0
        self._stamp = 0.0
        self._goal = GOAL_OF_ROS_1 if node.ros == "ROS 1" else POSES["goal"][0]
        for name, publish in (("publish", self._publish), ("publish_pose", self._publish_pose)):
            self._takes[name] = self._takes[name][0], publish
        self.begin()
        for name, type in POSES.values():
            self.bus.advertise(name if type == POSES["estimate"][1] else self._goal, type)

    def drive_controls(self) -> dict[str, Any]:
        """Return the controls of the page: the robot can be driven."""
        return controls_of([{"name": self._shown.kinematics.robot.name or "robot", "drives": True}])

    def act(self, action: str) -> None:
        """Stop the robot with the button; the others have no effect on a live robot."""
        if action == "stop":
            self.server.drive_lock.release()
            self.server.broadcast("stop")
            self._command(STOP)

    def advance(self) -> None:
        """Publish the messages that have arrived, and the command of the driver."""
        self.t = self._clock() - self._begun
        keys = self.server.hub.subscribed_keys
        shown = {key.partition(":")[2] for key in keys if key.startswith((ECHO, "sensor:"))}
        self.topics.update(shown)
        if len(self.bus.topics) != self._followed:
            for topic in self.bus.topics[self._followed :]:
                if topic.type in MOTION:
                    self._observe(topic.name, topic.type)
            self._followed = len(self.bus.topics)
            self.sensors.find()
        self._drive()

    def request_markers(self, topic: str, take: Callable[[Any], None]) -> None:
        """Request all interactive markers of a server, which it publishes on a topic in ROS 1 only."""
        self.topics.call(f"{topic.rpartition('/')[0]}/get_interactive_markers", SERVICE, take)

    def close(self) -> None:
        """Stop a robot that is driven, and leave the graph."""
        if self._driven:
            self._command(STOP)
        self.topics.close()
        super().close()

    def _observe(self, name: str, type: str) -> None:
        def receive(message: Any) -> None:
            self._robot.add(name, type, message, self.t)
            if not name.endswith("static") and (dated := getattr(message, "transforms", [message])):
                stamp = dated[-1].header.stamp
                self._stamp = float(stamp.sec + 1e-9 * stamp.nanosec)

        self.bus.subscribe(name, type, receive)

    def _drive(self) -> None:
        held = self.server.drive_lock.axes
        if held is None:
            if self._driven:
                self._command(STOP)
            self._driven = False
        elif self._clock() >= self._due:
            self._due, self._driven = self._clock() + PERIOD, True
            x, y, z, turn = held.axes
            self._command(Teleop(speed=held.speed, turn=held.turn).axes(x, turn, y, z) or STOP)

    def _command(self, motion: Motion) -> None:
        linear, angular = (dict(zip("xyz", part, strict=True)) for part in motion)
        fields = {"linear": linear, "angular": angular}
        topic, type = self._command_topic()
        message = from_fields(type, {"twist": fields} if type == TWIST_STAMPED else fields)
        self.topics.publish(topic, type, message)

    def _command_topic(self) -> tuple[str, str]:
        """Return the first topic of velocity commands whose name ends with `COMMAND`."""
        found = [each for each in self.bus.topics if each.type in (TWIST, TWIST_STAMPED)]
        named = [each for each in found if each.name.rpartition("/")[2] == COMMAND]
        return (named[0].name, named[0].type) if named else (f"/{COMMAND}", TWIST)

    def _publish_pose(self, request: Request) -> Done:
        """Publish a goal or an initial pose in the fixed frame, at the time of the robot's last motion."""
        (x, y), yaw = request.values["position"], request.values["yaw"]
        topic, type = POSES[request.values["as"]]
        topic = self._goal if request.values["as"] == "goal" else topic
        frame, pose = self._robot.fixed_frame, (x, y, 0.0, 0.0, 0.0, math.sin(yaw / 2), math.cos(yaw / 2))
        self.topics.publish(topic, type, pose_message(type, pose, frame, self._stamp), wait=MATCH)
        return {"topic": topic, "frame": frame}

    def _publish(self, request: Request) -> Done:
        name, type = absolute(request.values["topic"]), full_type_name(request.values["type"])
        self.bus.advertise(name, type)
        self.topics.publish(name, type, from_fields(type, request.values["message"]), wait=MATCH)
        return None
