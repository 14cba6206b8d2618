"""Planes of the world on the page."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from urdfkit.app.simulation.displays.world_appearance import WorldPlanes
from urdfkit.sim import Simulator

MODEL = """<model name="{name}"><static>true</static><pose>{pose}</pose><link name="l"><visual name="v">
  <pose>0 0 0.5 0 0 0</pose><geometry><plane><normal>{normal}</normal><size>{size}</size></plane></geometry>
  <material><diffuse>0.2 0.6 0.4 1</diffuse></material></visual></link></model>"""
GROUND = """<model name="ground"><static>true</static><link name="l"><collision name="c"><geometry><plane/></geometry>
  </collision></link></model>"""


class Sent:
    """Keeps the messages to the page."""

    def __init__(self) -> None:
        self.messages: list[tuple[str, dict[str, Any]]] = []

    def publish_latched(self, name: str, **values: Any) -> None:
        self.messages.append((name, values))


def test_planes_are_sent_with_their_pose_and_again_after_a_change(tmp_path: Path) -> None:
    path = tmp_path / "planes.sdf"
    tilted = MODEL.format(name="tilted", pose="1 2 3 0 0 1.5707963267948966", normal="1 0 0", size="4 6")
    path.write_text(f'<?xml version="1.0"?><sdf version="1.9"><world name="w">{GROUND}{tilted}</world></sdf>')
    simulator, sent = Simulator("simpleton", world=path), Sent()
    planes = WorldPlanes(simulator, sent, lambda: 0.0)  # type: ignore[arg-type]
    planes.show()
    planes.show()
    [(name, values)] = sent.messages
    [found] = values["planes"]
    assert name == "planes"
    assert found["size"] == (4.0, 6.0)
    assert found["color"] == pytest.approx((0.2, 0.6, 0.4, 1.0))
    pose = np.array(found["pose"]).reshape(4, 4)
    assert pose[:3, 3] == pytest.approx([1.0, 2.0, 3.5])
    # The normal is turned with the model; the side of 4 m is upright and that of 6 m across, as in Gazebo.
    assert pose[:3, :3] == pytest.approx(np.array([[0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [-1.0, 0.0, 0.0]]))
    simulator.world.remove("tilted")
    planes.show()
    assert sent.messages[1:] == [("planes", {"planes": []})]
