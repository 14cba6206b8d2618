"""Contact forces and slip for pages: which contacts, how many, and how often."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

pytest.importorskip("pinocchio")

from urdfkit.app.simulation.features.contact_forces import FORCES, MOST, PERIOD, ContactForces


def contact(a: str, b: str, force: float) -> SimpleNamespace:
    return SimpleNamespace(a=a, b=b, position=(1.0, 2.0, 3.0), force=(0.0, 0.0, force))


class Page:
    """The server of a page that shows some streams."""

    def __init__(self, *shown: str) -> None:
        self.hub = SimpleNamespace(accepts=shown.__contains__)
        self.sent: list[tuple[str, np.ndarray]] = []

    def sense(self, key: str, number: int, time: float, kind: int, data: bytes) -> None:
        self.sent.append((key, np.frombuffer(data, "<f4").reshape(-1, 6)))


def feature(page: Page, now: list[float], *contacts: SimpleNamespace) -> ContactForces:
    def robot(name: str, *, has_plugins: bool) -> Any:
        return SimpleNamespace(name=name, has_plugins=has_plugins, kinematics=SimpleNamespace(link_names=("base",)))

    robots = {"a": robot("a", has_plugins=True), "b": robot("b", has_plugins=True), "c": robot("c", has_plugins=False)}
    simulator = SimpleNamespace(world=SimpleNamespace(robots=robots), state=SimpleNamespace(contacts=contacts), t=0.5)
    return ContactForces(simulator, page, lambda: now[0])  # type: ignore[arg-type]


def test_contacts_of_robots_are_sent_once_per_period() -> None:
    page, now = Page(FORCES), [0.0]
    links = [("base", "ground"), ("ground", "b::base"), ("c::base", "ground"), ("crate", "ground")]
    forces = feature(page, now, *(contact(*pair, force) for force, pair in enumerate(links, start=1)))
    for now[0] in (0.0, 0.9 * PERIOD, 1.1 * PERIOD, 1.2 * PERIOD):
        forces.tick()
    assert [key for key, _ in page.sent] == [FORCES, FORCES]
    assert page.sent[0][1].tolist() == [[1, 2, 3, 0, 0, 1], [1, 2, 3, 0, 0, 2]]


def test_the_largest_forces_are_sent_if_there_are_many() -> None:
    page = Page(FORCES)
    feature(page, [0.0], *(contact("base", "ground", force) for force in range(MOST + 5))).tick()
    assert sorted(page.sent[0][1][:, 5]) == list(range(5, MOST + 5))


def test_nothing_is_sent_to_pages_that_show_neither() -> None:
    page = Page()
    feature(page, [0.0], contact("base", "ground", 1.0)).tick()
    assert page.sent == []
