"""Messages that are built beside the simulation: order, omission, errors, and the same bytes for peers."""

from __future__ import annotations

import sys
from functools import partial
from threading import Event

from tests.bridges.conftest import Simulated
from tests.time_limit import PATIENCE
from urdfkit.bridges.graph import Graph
from urdfkit.bridges.message_builder import MessageBuilder
from urdfkit.messages import from_fields

IMAGE = "sensor_msgs/msg/Image"


def test_a_slow_topic_omits_its_oldest_messages_for_all_bridges_alike() -> None:
    builder, started, go, done, found, same = MessageBuilder(print), Event(), Event(), Event(), [], []
    interval = sys.getswitchinterval()

    def slow() -> int:
        started.set()
        assert go.wait(PATIENCE)
        return 0

    builder.add("slow", slow, found.append)
    assert started.wait(PATIENCE)
    for number in range(1, 10):
        build = partial(int, number)
        builder.add("slow", build, found.append)
        builder.add("slow", build, same.append)
    builder.add("other", lambda: "other", found.append)
    builder.add("other", done.set, lambda _: None)
    go.set()
    assert done.wait(PATIENCE)
    builder.close()
    builder.close()
    assert found == [0, 8, "other", 9]  # the topics take turns
    assert same == [8, 9]
    assert sys.getswitchinterval() == interval


def test_an_error_is_reported_once_and_later_messages_follow() -> None:
    lines: list[str] = []
    builder, done = MessageBuilder(lines.append), Event()
    for _ in range(2):
        builder.add("a", lambda: {}["camera"], print)
    builder.add("b", lambda: None, lambda _: done.set())
    assert done.wait(PATIENCE)
    builder.close()
    assert lines == ["a message is not sent: 'camera'"]


def test_peers_get_it_encoded_with_the_time_at_which_it_was_published(simulated: Simulated) -> None:
    builder = MessageBuilder(print)
    graph = Graph(simulated.bus, simulated.calls, lambda: simulated.t, {}, builder=builder)
    topic, go = simulated.bus.advertise("/image", IMAGE), Event()
    received, prepared = [], []
    end = graph.subscribe("/image", IMAGE, received.append, prepared.append)
    simulated.calls.take()

    def build():
        assert go.wait(PATIENCE)
        return from_fields(IMAGE, {"height": 1, "width": 2, "data": [1, 2]})

    topic.offer_later(build)
    assert not received  # the simulation does not wait
    simulated.t = 3.0
    go.set()
    sample = simulated.until(lambda: received)[0]
    assert (sample.t, sample.message.width, prepared) == (2.5, 2, [sample])
    end()
    simulated.calls.take()
    assert not topic.subscribers
    builder.close()
