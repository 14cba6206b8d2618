"""Gazebo can read every world file."""

import xml.etree.ElementTree as ET
from pathlib import Path

WORLDS = Path(__file__).resolve().parents[1] / "worlds"


def test_worlds():
    paths = [path for path in WORLDS.iterdir() if path.suffix in (".sdf", ".world")]
    assert paths
    for path in paths:
        sdf = ET.parse(str(path)).getroot()
        assert sdf.tag == "sdf" and sdf.find("world") is not None, path
