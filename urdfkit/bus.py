"""Bus: named, typed topics inside one process. No threads of its own: callbacks run in the publisher's thread."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from threading import Lock
from typing import Any

from urdfkit.defect_message import Suggestion
from urdfkit.errors import UsageError, nearest

Build = Callable[[], Any]
"""Makes a message."""


@dataclass(slots=True)
class Topic:
    """One topic: its name, type, message count and subscribers.

    Attributes:
        name: absolute, e.g. ``/simpleton/cmd_vel``.
        type: ROS type name, e.g. ``geometry_msgs/msg/Twist``.
        count: messages published so far.
        is_input: whether a subscriber created it, as those of commands are; other topics are published.
    """

    name: str
    type: str
    count: int = 0
    is_input: bool = False
    subscribers: list[Callable[[Any], None]] = field(default_factory=list, repr=False)
    _latest: Any = field(default=None, repr=False)
    _build: Build | None = field(default=None, repr=False)
    _defer: dict[Callable[[Any], None], Callable[[Build], None]] = field(default_factory=dict, repr=False)

    @property
    def latest(self) -> Any:
        """The last message; None before the first. A message without subscribers is built here, on first access."""
        if self._build is not None:
            self._latest, self._build = self._build(), None
        return self._latest

    def restore(self, count: int) -> None:
        """Set the message count; unless it is the same, there is no last message until the next one."""
        if count != self.count:
            self.count, self._latest, self._build = count, None, None

    def publish(self, message: Any) -> None:
        """Hand a message to every subscriber, in the order they subscribed."""
        self.count += 1
        self._latest, self._build = message, None
        for callback in tuple(self.subscribers):
            callback(message)

    def offer(self, build: Build, *, count: int = 1) -> None:
        """Publish the message that `build` makes; build it only for a subscriber or a reader of `latest`.

        Args:
            build: makes the message; must keep the current values, because it may be called later.
            count: number of publications this call stands for (those without subscribers are not built).
        """
        if self.subscribers:
            self.count += count - 1
            self.publish(build())
        else:
            self.count += count
            self._build = build

    def offer_later(self, build: Build, *, count: int = 1) -> None:
        """Publish a message that takes long to build, see `offer`; subscribers with `defer` build it themselves.

        Args:
            build: makes the message, once, in any thread; must keep the current values.
            count: number of publications this call stands for.
        """
        if not self._defer:
            self.offer(build, count=count)
            return
        build = _Once(build)
        self.count += count
        self._latest, self._build = None, build
        for callback in tuple(self.subscribers):
            if callback in self._defer:
                self._defer[callback](build)
            else:
                callback(self.latest)


class _Once:
    """Makes a message once, for all threads that call it."""

    def __init__(self, build: Build) -> None:
        self._build: Build | None = build
        self._lock, self._made = Lock(), None

    def __call__(self) -> Any:
        with self._lock:
            if self._build is not None:
                self._made, self._build = self._build(), None
            return self._made


class Subscription:
    """A running subscription; `close` ends it."""

    def __init__(self, topic: Topic, callback: Callable[[Any], None], defer: Callable[[Build], None] | None) -> None:
        self._topic = topic
        self._callback = callback
        topic.subscribers.append(callback)
        if defer is not None:
            topic._defer[callback] = defer

    def __repr__(self) -> str:
        """Return topic and type, and whether the subscription is closed."""
        state = "" if self._callback in self._topic.subscribers else ", closed"
        return f"<Subscription to {self._topic.name} [{self._topic.type}]{state}>"

    def close(self) -> None:
        """Stop receiving; closing twice is harmless."""
        if self._callback in self._topic.subscribers:
            self._topic.subscribers.remove(self._callback)
            self._topic._defer.pop(self._callback, None)


class Bus:
    """Publish, subscribe, latest."""

    def __init__(self) -> None:
        self._topics: dict[str, Topic] = {}

    def advertise(self, name: str, type: str) -> Topic:
        """Declare a topic and return it; publishing or subscribing does so too.

        Args:
            name: of the topic.
            type: of its messages, ``nav_msgs/msg/Odometry`` or, as in ROS 1, ``nav_msgs/Odometry``.

        Raises:
            UsageError: the topic exists with another type.
        """
        name, type = absolute(name), type if type.count("/") > 1 else type.replace("/", "/msg/")
        topic = self._topics.get(name)
        if topic is None:
            topic = self._topics[name] = Topic(name, type)
        elif topic.type != type:
            raise UsageError(f"topic `{name}` has type {topic.type}, not {type}")
        return topic

    def publish(self, name: str, type: str, message: Any) -> None:
        """Hand a message to every subscriber, in the order they subscribed.

        Raises:
            UsageError: the topic exists with another type, or the message is of another type.
        """
        topic = self.advertise(name, type)
        if (kind := getattr(message, "__msgtype__", topic.type)) != topic.type:
            raise UsageError(f"topic `{topic.name}` has type {topic.type}, not {kind}")
        topic.publish(message)

    def subscribe(
        self, name: str, type: str, callback: Callable[[Any], None], *, defer: Callable[[Build], None] | None = None
    ) -> Subscription:
        """Call `callback` with every message published from now on.

        Args:
            name: of the topic.
            type: of its messages.
            callback: receives each message, in the publisher's thread.
            defer: receives, instead of a message that takes long to build, the function that builds it, in any thread.

        Raises:
            UsageError: the topic has another type, or `callback` cannot be called.
        """
        if not callable(callback):
            raise UsageError(f"the callback of topic `{name}` is {callback!r}; pass a function of one message")
        is_new = absolute(name) not in self._topics
        topic = self.advertise(name, type)
        topic.is_input = topic.is_input or is_new
        return Subscription(topic, callback, defer)

    def latest(self, name: str) -> Any:
        """Return the last message of a topic; None before the first."""
        topic = self._topics.get(absolute(name))
        return None if topic is None else topic.latest

    def has_subscribers(self, name: str) -> bool:
        """Whether a topic has subscribers: sensors compute nothing without them."""
        topic = self._topics.get(absolute(name))
        return topic is not None and bool(topic.subscribers)

    @property
    def topics(self) -> tuple[Topic, ...]:
        """All topics in order of their first mention."""
        return tuple(self._topics.values())


def absolute(name: str) -> str:
    """Return a topic name with exactly one leading slash and none doubled or trailing."""
    return "/" + "/".join(part for part in name.split("/") if part)


def similar_topic(name: str, topics: Sequence[str]) -> str:
    """Suggest the topic with the nearest name, or with the nearest last part of its name; empty if none is similar."""
    if near := nearest(name, topics):
        return Suggestion(near, name)
    by_end = {topic.rpartition("/")[2]: topic for topic in reversed(topics)}
    end = nearest(name.rpartition("/")[2], by_end)
    return Suggestion(None if end is None else by_end[end], name)
