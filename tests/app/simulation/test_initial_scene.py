"""The page shows the robot in its initial pose before the engine is compiled."""

from __future__ import annotations

import numpy as np
import pytest

pytest.importorskip("meshcat")
pytest.importorskip("numba")

from urdfkit.app.page import faults_on_page
from urdfkit.app.simulation.initial_scene import InitialScene
from urdfkit.app.simulation.scene_bodies import SceneBodies
from urdfkit.description import load
from urdfkit.description.sdf import load_world
from urdfkit.errors import SimulationError
from urdfkit.sim import Simulator
from urdfkit.view.content.mesh_store import GeometryStore


class Page:
    def __init__(self) -> None:
        self.geometries = GeometryStore()
        self.shown: list[dict] = []
        self.reported: list[tuple[str, dict]] = []

    def send(self, command) -> None:
        command.lower()

    def show(self, *, draw, **values) -> None:
        draw(self)
        self.shown.append(values)

    def publish(self, t: float, poses) -> None:
        self.poses = np.array(poses)

    def publish_latched(self, type: str, **values) -> None:
        self.reported.append((type, values))


@pytest.mark.parametrize("name", ["simpleton", "rrbot"])
def test_it_stands_where_the_simulation_starts(name: str) -> None:
    robot, world, page = load(name), load_world("empty"), Page()
    initial = InitialScene(robot, world)
    initial.show(page)
    simulator = Simulator(robot, world=world, scene=initial.scene, note=lambda _: None)
    assert simulator.scene is initial.scene
    before = page.poses
    bodies = SceneBodies(simulator, page)
    bodies.show()
    first, second = page.shown
    assert first == second
    np.testing.assert_allclose(before, bodies.poses(), atol=1e-12)


def test_an_open_page_shows_why_the_server_stops(monkeypatch) -> None:
    monkeypatch.setattr("urdfkit.app.page.FAULT_DELAY", 0.0)
    page = Page()

    def fail() -> None:
        with faults_on_page(page):
            raise SimulationError("no such wheel")

    with pytest.raises(SimulationError):
        fail()
    assert page.reported == [("fault", {"message": "no such wheel"})]
