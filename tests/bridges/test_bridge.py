"""The queue of calls from other threads, and the topics of bridges."""

from __future__ import annotations

import pytest

from urdfkit.bridges import bridge
from urdfkit.bridges.bridge import Bridges, CallQueue, is_latched, message_topics, publish_received
from urdfkit.bus import Bus
from urdfkit.messages import TWIST, twist


def test_calls_run_in_their_order_and_those_that_they_add_run_the_next_time() -> None:
    calls, done = CallQueue(), list[str]()
    assert not calls.wait(0.0)
    assert calls.add(lambda: done.append("first"))
    assert calls.add(lambda: calls.add(lambda: done.append("later")))
    assert calls.wait(0.0)
    calls.take()
    assert done == ["first"]
    assert calls.wait(-1.0)
    calls.take()
    assert done == ["first", "later"]
    assert not calls.wait(0.0)
    assert calls.dropped == 0


def test_a_call_without_room_is_dropped(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(bridge, "CAPACITY", 3)
    calls, done = CallQueue(), list[int]()
    assert [calls.add(lambda: done.append(1)) for _ in range(5)] == [True, True, True, False, False]
    assert calls.dropped == 2
    calls.take()
    assert len(done) == 3
    assert calls.add(lambda: None)


def test_messages_without_room_are_dropped_unless_they_are_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(bridge, "MOST_BYTES", 100)
    calls = CallQueue()
    assert [calls.add(lambda: None, size) for size in (60, 41, 40, 0, 1)] == [True, False, True, True, False]
    assert calls.dropped == 2
    calls.take()
    assert [calls.add(lambda: None, size) for size in (101, 1)] == [True, False]
    calls.take()
    assert calls.add(lambda: None, 100)


def test_bridges_are_updated_before_calls_and_closed_in_reverse_order() -> None:
    done: list[str] = []

    class RecordedBridge:
        def __init__(self, name: str) -> None:
            self.name = name

        def update(self) -> None:
            done.append(f"update {self.name}")

        def close(self) -> None:
            done.append(f"close {self.name}")

    bridges = Bridges()
    assert not bridges
    for name in ("a", "b"):
        bridges.add(RecordedBridge(name))
    assert bridges
    bridges.calls.add(lambda: done.append("call"))
    bridges.take()
    bridges.close()
    bridges.close()
    assert done == ["update a", "update b", "call", "close b", "close a"]
    assert not bridges


def test_topics_with_messages_and_latched_topics() -> None:
    bus = Bus()
    bus.advertise("/n/cmd_vel", TWIST)
    bus.advertise("/reset", "std_srvs/srv/Empty_Request")
    assert [topic.name for topic in message_topics(bus)] == ["/n/cmd_vel"]
    topics = ("/tf_static", "/n/robot_description", "/tf", "/tf_static/n")
    assert [is_latched(topic) for topic in topics] == [True, True, False, False]


def test_a_message_that_a_subscriber_does_not_accept_is_reported() -> None:
    bus, received, lines = Bus(), list[object](), list[str]()

    def refuse(message: object) -> None:
        raise ValueError("too fast")

    publish_received(bus, "/cmd_vel", twist((0.0, 0.0, 0.0), (0.0, 0.0, 0.0)), lines.append)
    assert bus.latest("/cmd_vel").linear.x == 0.0
    bus.subscribe("/cmd_vel", TWIST, received.append)
    bus.subscribe("/cmd_vel", TWIST, refuse)
    publish_received(bus, "/cmd_vel", twist((0.0, 0.0, 0.0), (0.0, 0.0, 0.0)), lines.append)
    assert len(received) == 1
    assert lines == ["`/cmd_vel` does not accept this message: too fast"]
