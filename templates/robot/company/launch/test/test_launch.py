"""Every launch file loads."""

from pathlib import Path

import pytest

sources = pytest.importorskip("launch.launch_description_sources", reason="ROS 2 is not installed")

LAUNCH = Path(__file__).resolve().parents[1] / "launch"


@pytest.mark.parametrize("path", sorted(LAUNCH.glob("*.launch.py")), ids=lambda path: path.name)
def test_launch_file_loads(path):
    assert sources.get_launch_description_from_python_launch_file(str(path)).entities
