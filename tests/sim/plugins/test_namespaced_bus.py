"""The bus of a robot's plugins: topics of the simulation, own subscriptions."""

from __future__ import annotations

from typing import Any

from urdfkit.bus import Bus
from urdfkit.messages import TWIST, twist
from urdfkit.sim.plugins.namespaced_bus import OwnBus

STOP = twist((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))


def test_messages_are_announced_and_subscriptions_end_one_by_one_or_all_at_once() -> None:
    bus, done = Bus(), list[str]()

    def receive(name: str) -> Any:
        return lambda _: done.append(name)

    own = OwnBus(bus, lambda: done.append("invalidate"))
    bus.subscribe("/cmd_vel", TWIST, receive("other"))
    first = own.subscribe("/cmd_vel", TWIST, receive("first"))
    own.subscribe("/cmd_vel", TWIST, receive("second"))
    bus.publish("/cmd_vel", TWIST, STOP)
    assert done == ["other", "invalidate", "first", "invalidate", "second"]
    done.clear()
    first.close()
    own.publish("/cmd_vel", TWIST, STOP)
    assert done == ["other", "invalidate", "second"]
    done.clear()
    own.close()
    bus.publish("/cmd_vel", TWIST, STOP)
    assert done == ["other"]
