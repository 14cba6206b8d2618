"""Sleep in the simulator: furnished rooms come to rest, and a robot that drives does not notice."""

from __future__ import annotations

import pytest

from urdfkit.sim import Simulator


@pytest.mark.parametrize("world", ["house", "office"])
def test_what_stands_in_a_room_comes_to_rest_and_sleeps(world) -> None:
    simulator = Simulator("simpleton", world=world)
    simulator.command((0.2, 0.0, 0.0), (0.0, 0.0, 0.0))
    simulator.run(1.5)
    assert simulator.bodies
    assert all(body.asleep for body in simulator.bodies.values())
    carried = {contact.a for contact in simulator.state.contacts}
    assert set(simulator.bodies) <= carried | {contact.b for contact in simulator.state.contacts}


def test_sleep_can_be_switched_off() -> None:
    simulator = Simulator("simpleton", world="house", sleep=False)
    simulator.run(0.7)
    assert not any(body.asleep for body in simulator.bodies.values())
