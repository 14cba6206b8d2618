"""Every launch file loads."""

from pathlib import Path

import pytest

try:
    from launch.launch_description_sources import get_launch_description_from_python_launch_file as loaded
except ImportError:
    loaded = None

LAUNCH = Path(__file__).resolve().parents[1] / "launch"


@pytest.mark.skipif(loaded is None, reason="ROS 2 is not installed")
@pytest.mark.parametrize("path", sorted(LAUNCH.glob("*.launch.py")), ids=lambda path: path.name)
def test_launch_file_loads(path):
    assert loaded(str(path)).entities
