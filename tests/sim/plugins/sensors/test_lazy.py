"""Sensors look only while somebody listens: closing a subscription stops them."""

from __future__ import annotations

from typing import Any

import pytest

from tests.sim.plugins.sensors.cameras.test_cameras import eye, ros1
from tests.sim.plugins.sensors.conftest import LASER, sensor
from urdfkit.scene.ray_renderer import RayRenderer
from urdfkit.scene.rays.ray_scene import RayTable


@pytest.mark.parametrize(
    ("made", "topic", "owner", "method"),
    [
        (eye(ros1()), "/cam/image_raw", RayRenderer, "take"),
        (sensor(LASER), "/post/scan", RayTable, "cast"),
    ],
    ids=["camera", "lidar"],
)
def test_who_stops_listening_stops_the_sensor(
    post, monkeypatch, made: str, topic: str, owner: type, method: str
) -> None:
    looks = []
    inner = getattr(owner, method)

    def counted(self: Any, *arguments: Any, **options: Any) -> Any:
        looks.append(self)
        return inner(self, *arguments, **options)

    monkeypatch.setattr(owner, method, counted)
    simulator = post(made)
    found = next(each for each in simulator.bus.topics if each.name.endswith(topic.rpartition("/")[2]))
    simulator.run(0.5)
    assert not looks
    subscription = simulator.subscribe(found.name, found.type, lambda _: None)
    simulator.run(0.5)
    assert len(looks) == 5
    subscription.close()
    simulator.run(0.5)
    assert len(looks) == 5
    assert found.count == 15
    assert found.latest is not None  # whoever asks gets one look
    assert len(looks) == 6
    simulator.subscribe(found.name, found.type, lambda _: None)
    simulator.run(0.5)
    assert len(looks) == 11
