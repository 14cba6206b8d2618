"""Topics of a simulator: what used to fail silently raises an error with the nearest name."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from urdfkit import Simulator, load
from urdfkit.errors import UnknownNameError, UrdfkitError, UsageError
from urdfkit.messages import FLOAT, TWIST, from_fields, twist

ODOMETRY = "nav_msgs/msg/Odometry"


@pytest.fixture(scope="module")
def simulator() -> Simulator:
    return Simulator("simpleton", note=lambda _: None)


def test_an_unknown_topic_is_reported_with_the_nearest_name(simulator: Simulator) -> None:
    with pytest.raises(UnknownNameError) as caught:
        simulator.subscribe("simpleton/odm", ODOMETRY, print)
    assert str(caught.value) == "no topic `/simpleton/odm` in the simulation; did you mean `/simpleton/odom`?"
    with pytest.raises(UnknownNameError, match=r"no topic `/xyz` in the simulation; wait=True accepts"):
        simulator.subscribe("/xyz", ODOMETRY, print)
    assert "/xyz" not in [topic.name for topic in simulator.bus.topics]


def test_the_last_part_of_a_name_finds_the_topic(simulator: Simulator) -> None:
    with pytest.raises(UnknownNameError, match="did you mean `/simpleton/odom`"):
        simulator.subscribe("/a_robot_of_another_name/odom", ODOMETRY, print)


def test_a_topic_to_come_is_waited_for() -> None:
    simulator, received = Simulator("simpleton", note=lambda _: None), []
    simulator.subscribe("/later", FLOAT, received.append, wait=True)
    simulator.bus.publish("/later", FLOAT, from_fields(FLOAT, {"data": 1.0}))
    assert [message.data for message in received] == [1.0]


@pytest.mark.parametrize(
    ("ask", "error", "message"),
    [
        (lambda s: s.subscribe("/simpleton/odom", TWIST, print), UsageError, f"has type {ODOMETRY}, not {TWIST}"),
        (
            lambda s: s.publish("/simpleton/cmd_vl", TWIST, twist((0, 0, 0), (0, 0, 0))),
            UnknownNameError,
            "topic `/simpleton/cmd_vl` has no subscribers; did you mean `/simpleton/cmd_vel`?",
        ),
        (
            lambda s: s.publish(s.command_topics[0], FLOAT, from_fields(FLOAT, {"data": 1.0})),
            UsageError,
            f"has type {TWIST}, not {FLOAT}",
        ),
        (
            lambda s: s.publish(s.command_topics[0], TWIST, from_fields(FLOAT, {"data": 1.0})),
            UsageError,
            f"has type {TWIST}, not {FLOAT}",
        ),
        (lambda s: s.publish(s.command_topics[0], TWIST, 3), UsageError, f"`3` is not a {TWIST}: write its fields"),
        (lambda s: s.publish(s.command_topics[0], TWIST, Path("x")), UsageError, f"`x` is not a {TWIST}"),
        (lambda s: s.subscribe("/simpleton/odom", ODOMETRY, 3), UsageError, "the callback of topic `/simpleton/odom`"),
    ],
)
def test_a_wrong_topic_or_type_is_reported(
    simulator: Simulator, ask: Callable[[Simulator], Any], error: type[UrdfkitError], message: str
) -> None:
    with pytest.raises(error) as caught:
        ask(simulator)
    assert message in str(caught.value)


def test_a_published_command_reaches_the_drive() -> None:
    simulator = Simulator("simpleton", note=lambda _: None)
    simulator.publish(simulator.command_topics[0], TWIST, twist((0.5, 0.0, 0.0), (0.0, 0.0, 0.0)))
    simulator.run(0.5)
    assert simulator.state.base_twist[0] > 0.1


def test_fields_of_a_message_are_published_and_a_wrong_one_is_named() -> None:
    simulator = Simulator("simpleton", note=lambda _: None)
    heard: list[Any] = []
    simulator.bus.subscribe(simulator.command_topics[0], TWIST, heard.append)
    simulator.publish(simulator.command_topics[0], TWIST, {"linear": {"x": 0.5}})
    assert (heard[0].linear.x, heard[0].angular.z) == (0.5, 0.0)
    with pytest.raises(UsageError, match=r"`linaer`.*did you mean `linear`"):
        simulator.publish(simulator.command_topics[0], TWIST, {"linaer": {"x": 0.5}})


def test_the_state_cannot_be_written(simulator: Simulator) -> None:
    for array in (simulator.state.q, simulator.state.v, simulator.state.tau, simulator.link_poses()):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 1.0


def test_reprs_name_what_they_show() -> None:
    simulator = Simulator("simpleton", note=lambda _: None)
    name = simulator.world.spawn("crate", (2.0, 0.0, 0.0))
    crate = simulator.world.bodies[name]
    assert repr(simulator) == "<Simulator of simpleton in world empty at t = 0 s>"
    assert repr(simulator.world) == f"<LiveWorld empty: simpleton, ground_plane, {name}>"
    assert repr(crate).startswith("<RigidBody crate at 2 0 ")
    assert repr(simulator.state).startswith("<State at t = 0 s: base at 0 0 ")
    joint = simulator.kinematics.joint_names[0]
    assert joint in repr(simulator.state)
    assert f"<td>{joint}</td>" in simulator.state._repr_html_()
    assert repr(simulator.world.robots["simpleton"]).startswith("<SimulatedRobot simpleton: <State at t = 0 s")
    simulator.world.remove(name)
    assert repr(crate) == "<RigidBody crate: removed>"
    robot = load("simpleton")
    assert (
        repr(robot) == f"<Robot simpleton from {robot.files[0]}: {len(robot.links)} links, {len(robot.joints)} joints>"
    )
    assert repr(simulator.world.description) == "<World empty: ground_plane>"
