"""A simulation and its restored copy, compared by the bytes of all messages and of the state."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from urdfkit.messages import BOOL, FLOAT, FLOATS, TWIST, TWIST_STAMPED, from_fields, typestore
from urdfkit.sim import Simulator

VALUES: dict[str, Any] = {
    TWIST: {"linear": {"x": 0.3, "y": 0.1}, "angular": {"z": 0.4}},
    TWIST_STAMPED: {"twist": {"linear": {"x": 0.3, "y": 0.1}, "angular": {"z": 0.4}}},
    FLOAT: {"data": 0.2},
    FLOATS: {"data": [0.2]},
    BOOL: {"data": True},
}
"""Type → values of the command on each topic of this type that has a subscriber."""


def record(simulator: Simulator) -> list[tuple[str, bytes]]:
    """Subscribe to all topics; return the list that receives the names and bytes of the messages."""
    found: list[tuple[str, bytes]] = []
    types = typestore()
    for topic in sorted(simulator.bus.topics, key=lambda each: each.name):
        if "_Request" not in topic.type and "_Response" not in topic.type:

            def receive(message: Any, name: str = topic.name, kind: str = topic.type) -> None:
                found.append((name, bytes(types.serialize_cdr(message, kind))))

            simulator.bus.subscribe(topic.name, topic.type, receive)
    return found


def command(simulator: Simulator, *, skipped: tuple[str, ...] = ("estop", "/halt")) -> None:
    """Publish a command on every topic that plugins subscribe to."""
    for topic in simulator.bus.topics:
        if topic.subscribers and topic.type in VALUES and not topic.name.endswith(skipped):
            simulator.bus.publish(topic.name, topic.type, from_fields(topic.type, VALUES[topic.type]))


def state(simulator: Simulator) -> tuple[Any, ...]:
    """Return the time, the configurations and velocities as bytes, and the counts of topics."""
    robots = simulator.world.robots.values()
    moving = [(each.state.q.tobytes(), each.state.v.tobytes()) for each in robots]
    return simulator.t, moving, simulator.world.body_poses(), {each.name: each.count for each in simulator.bus.topics}


def differences(make: Callable[[], Simulator], seconds: float = 0.2, act: Callable[[Simulator], None] = command) -> Any:
    """Return what differs after restoring in the same and in another simulator; empty if nothing does."""
    simulator, other = make(), make()
    act(simulator)
    messages = record(simulator)
    simulator.run(seconds)
    snapshot = simulator.snapshot()
    first = len(messages)
    simulator.run(seconds)
    unbroken = messages[first:], state(simulator)
    assert unbroken[0], "no messages"
    found = []
    for name, each in (("the same", simulator), ("another", other)):
        received = messages if each is simulator else record(each)
        each.restore(snapshot)
        first = len(received)
        each.run(seconds)
        restored = received[first:], state(each)
        found += [(name, a[0], b[0]) for a, b in zip(unbroken[0], restored[0], strict=False) if a != b][:1]
        if len(unbroken[0]) != len(restored[0]) or unbroken[1] != restored[1]:
            found.append((name, "count of messages or state", len(restored[0])))
    return found
