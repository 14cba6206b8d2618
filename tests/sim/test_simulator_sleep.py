"""Sleep in the simulator: furnished rooms come to rest, and a robot that drives does not notice."""

from __future__ import annotations

import pytest

from urdfkit.sim import Simulator


@pytest.mark.parametrize("world", ["house", "office"])
def test_what_stands_in_a_room_comes_to_rest_and_sleeps(world) -> None:
    simulator = Simulator("simpleton", world=world)
    simulator.command((0.2, 0.0, 0.0), (0.0, 0.0, 0.0))
    simulator.run(1.5)
    free = {name: thing for name, thing in simulator.world.bodies.items() if not thing.body.static}
    assert len(free) > 5
    assert all(thing.asleep for thing in free.values())
    assert not simulator.world.builder.robot_list[0].articulation.asleep
    touching = {name for contact in simulator.state.contacts for name in (contact.a, contact.b)}
    assert set(free) <= touching


def test_sleep_can_be_switched_off() -> None:
    simulator = Simulator("simpleton", world="house", sleep=False)
    simulator.run(0.7)
    assert not any(thing.asleep for thing in simulator.world.bodies.values())
