"""Sleep in the simulator: furnished rooms come to rest, and a robot that drives does not notice."""

from __future__ import annotations

from typing import Any

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


@pytest.mark.parametrize("world", ["empty", "house"])
def test_odometry_of_a_robot_that_slept_is_that_of_one_that_stayed_awake(world) -> None:
    found = []
    for sleep in (True, False):
        simulator = Simulator("simpleton", world=world, sleep=sleep)
        odometry: list[Any] = []
        simulator.subscribe("/simpleton/odom", "nav_msgs/msg/Odometry", odometry.append)
        for speed, seconds in ((0.3, 1.0), (0.0, 1.5), (-0.2, 0.505)):
            simulator.command((speed, 0.0, 0.0), (0.0, 0.0, 0.3 * speed))
            simulator.run(seconds)
            if not speed:
                assert simulator.world.builder.robot_list[0].articulation.asleep is sleep
                assert odometry[-1].twist.twist.linear.x == pytest.approx(0.0, abs=1e-6)
        found.append([(m.pose.pose.position.x, m.pose.pose.position.y, m.twist.twist.linear.x) for m in odometry])
    assert len(found[0]) == len(found[1]) > 250
    for slept, awake in zip(*found, strict=True):
        assert slept == pytest.approx(awake, abs=1e-6)
