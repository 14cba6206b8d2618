"""How long a command waits until a graph of ROS 2 is discovered."""

from __future__ import annotations

import pytest

from urdfkit.app.replay.discovery import SETTLED, Search, wait_for_discovery
from urdfkit.bridges.ros2.rclpy_node import DISCOVERY

OWN = {"topics": {"/rosout": "", "/parameter_events": ""}, "services": {"/urdfkit/get_type_description": ""}}
ODOMETRY, TWIST = "nav_msgs/msg/Odometry", "geometry_msgs/msg/Twist"


def duration(search: Search, appears: dict[float, dict[str, dict[str, str]]]) -> float:
    """Return how long a search takes, if names appear at certain times [s]."""
    t = 0.0

    def find() -> dict[str, dict[str, str]]:
        types: dict[str, dict[str, str]] = {kind: dict(OWN.get(kind, {})) for kind in ("topics", "services", "actions")}
        for kind, names in (item for at, each in appears.items() if at <= t for item in each.items()):
            types[kind] |= names
        return types

    def sleep(seconds: float) -> None:
        nonlocal t
        t += seconds

    wait_for_discovery(find, search, clock=lambda: t, sleep=sleep)
    return t


def test_a_name_ends_its_search_even_if_it_appears_late() -> None:
    appears = {0.1: {"topics": {"/cmd_vel": TWIST}}, 5.0: {"topics": {"/odom": ODOMETRY}}}
    assert duration(Search(name="/odom"), appears) == pytest.approx(5.0, abs=0.1)
    assert duration(Search(name="/cmd_vel"), appears) == pytest.approx(0.1, abs=0.1)
    assert duration(Search(name="/scan"), appears) == pytest.approx(DISCOVERY, abs=0.1)


def test_a_list_ends_when_nothing_new_appears() -> None:
    appears = {at: {"topics": {f"/topic_{at}": TWIST}} for at in (3.0, 3.5, 4.2)}
    assert duration(Search(), appears) == pytest.approx(4.2 + SETTLED, abs=0.2)
    assert duration(Search(), {}) == pytest.approx(DISCOVERY, abs=0.1)


def test_a_list_of_actions_waits_for_an_action() -> None:
    appears = {0.1: {"topics": {"/odom": ODOMETRY}}, 3.0: {"actions": {"/arm/move": "a/action/Move"}}}
    assert duration(Search("actions"), appears) == pytest.approx(3.0 + SETTLED, abs=0.2)
    assert duration(Search("services"), appears) == pytest.approx(DISCOVERY, abs=0.1)


def test_topics_of_a_type_are_waited_for() -> None:
    appears = {0.1: {"topics": {"/odom": ODOMETRY}}, 3.0: {"topics": {"/cmd_vel": TWIST}}}
    assert duration(Search(type=TWIST), appears) == pytest.approx(3.0 + SETTLED, abs=0.2)


def test_kinds_that_the_library_lacks_are_not_waited_for() -> None:
    wait_for_discovery(lambda: {"topics": {}}, Search("actions"), sleep=lambda _: pytest.fail("waited"))
