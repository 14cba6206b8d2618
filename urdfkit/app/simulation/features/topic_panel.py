"""Topics panel: the list with rates, the last message of a topic, and publishing."""

import re
import struct
from collections import deque
from collections.abc import Callable, Sequence

from urdfkit.app.simulation.features.feature import Done, Feature, Takes
from urdfkit.app.simulation.features.message_values import as_json, numbers_in
from urdfkit.errors import UsageError, did_you_mean
from urdfkit.sim.simulator import Simulator
from urdfkit.view.protocol.page_requests import Request, Schema, text, tree
from urdfkit.view.server.server import Server

LIST, ECHO = "topics", "echo:"
"""Keys of the streams of the list, and of the last message of a topic."""
PERIOD = 0.5
"""Seconds between two lists."""
OFTEN = 0.2
"""Minimum seconds between two messages of one topic."""
SHARE = 0.1
"""Maximum share of the time for these messages: reading the last message of a camera renders it."""
NAME = re.compile(r"(/[A-Za-z_][A-Za-z0-9_]*)+", re.ASCII)
"""Names of topics that ROS 1 and 2 accept; https://design.ros2.org/articles/topic_and_service_names.html."""
SPAN = 6
"""Number of lists over which rates are measured."""


class TopicPanel(Feature):
    """The list, and the messages that pages show."""

    def __init__(self, simulator: Simulator, server: Server, clock: Callable[[], float]) -> None:
        super().__init__(simulator, server, clock)
        self._counts: deque[tuple[float, dict[str, int]]] = deque(maxlen=SPAN)
        self._echoes: dict[str, tuple[float, int]] = {}

    @property
    def takes(self) -> Takes:
        """The supported requests."""
        return {
            "form": (Schema({"topic": text(), "type": text()}, changes=False), self._form),
            "publish": (Schema({"topic": text(), "type": text(), "message": tree}), self._publish),
        }

    def forget(self) -> None:
        """Restart the measurement of rates."""
        self._counts.clear()

    def tick(self) -> None:
        """Send the list and the messages that pages show."""
        wanted = self.server.hub.subscribed_keys
        if LIST in wanted and self.is_due(PERIOD):
            self._list()
        now = self.clock()
        echoed = {key for key in wanted if key.startswith(ECHO)}
        self._echoes = {key: kept for key, kept in self._echoes.items() if key in echoed}
        for key in echoed:
            due, shown = self._echoes.get(key, (0.0, -1))
            if now >= due:
                shown = self._echo(key, shown)
                self._echoes[key] = now + max(OFTEN, (self.clock() - now) / SHARE), shown

    def _list(self) -> None:
        t, topics = self.simulator.t, self.simulator.bus.topics
        if self._counts and t < self._counts[-1][0]:
            self._counts.clear()
        self._counts.append((t, {topic.name: topic.count for topic in topics}))
        begun, before = self._counts[0]
        rows = []
        for topic in topics:
            if "/msg/" not in topic.type:
                continue  # a service's request
            rate = (topic.count - before.get(topic.name, topic.count)) / (t - begun) if t > begun else 0.0
            rows.append([topic.name, topic.type, topic.count, round(max(0.0, rate), 2), len(topic.subscribers)])
        self.server.send_to_subscribers(LIST, "topics", rows=rows)

    def _echo(self, key: str, shown: int) -> int:
        name = key.removeprefix(ECHO)
        topic = next((each for each in self.simulator.bus.topics if each.name == name), None)
        if topic is None or topic.count == shown:
            return shown
        message = topic.latest
        self.server.send_to_subscribers(
            key, "echo", topic=name, count=topic.count, message=None if message is None else as_json(message)
        )
        return topic.count

    def _form(self, request: Request) -> Done:
        """Respond with an empty message of a topic's type, and the paths of the numbers in its last message."""
        from urdfkit.messages import from_fields, full_type_name

        name, kind = request.values["topic"], full_type_name(request.values["type"])
        self._require_message(name, kind)
        empty = from_fields(kind, None)
        topic = next((each for each in self.simulator.bus.topics if each.name == name), None)
        latest = None if topic is None or not topic.count else topic.latest
        return {"message": as_json(empty), "numbers": list(numbers_in(empty if latest is None else latest))[:500]}

    def _publish(self, request: Request) -> Done:
        from urdfkit.bus import absolute
        from urdfkit.messages import from_fields, full_type_name

        name, kind = request.values["topic"], full_type_name(request.values["type"])
        if len(absolute(name)) < 2:
            raise UsageError("the name of the topic is missing; enter a name such as /cmd_vel")
        _require_name(name, [topic.name for topic in self.simulator.bus.topics])
        self._require_message(absolute(name), kind)
        try:
            self.simulator.bus.publish(name, kind, from_fields(kind, request.values["message"]))
        except (ArithmeticError, LookupError, TypeError, ValueError, struct.error) as error:
            # A value that a field cannot hold or a subscriber cannot use must not stop the simulation.
            raise UsageError(f"`{name}` does not accept this message: {error}") from error
        return None

    def _require_message(self, name: str, kind: str) -> None:
        if "/msg/" not in kind:
            raise UsageError(f"`{kind}` is not a message type, such as geometry_msgs/msg/Twist")
        types = {topic.name: topic.type for topic in self.simulator.bus.topics}
        if name in types and types[name] != kind:
            raise UsageError(f"topic `{name}` carries {types[name]}, not {kind}{did_you_mean(kind, [types[name]])}")


def _require_name(name: str, existing: Sequence[str]) -> None:
    """Reject a new topic with a name that is invalid in ROS; existing topics keep their names."""
    from urdfkit.bus import absolute

    if absolute(name) not in existing and not NAME.fullmatch(absolute(name)):
        near = did_you_mean(absolute(name.replace(" ", "")), existing)
        raise UsageError(f"`{name}` is not a topic name: use letters, digits and _, separated by /{near}")
