"""Every launch file loads."""

from pathlib import Path

import pytest
from launch.launch_description_sources import get_launch_description_from_python_launch_file

LAUNCH = Path(__file__).resolve().parents[1] / "launch"


@pytest.mark.parametrize("path", sorted(LAUNCH.glob("*.launch.py")), ids=lambda path: path.name)
def test_launch_file_loads(path):
    assert get_launch_description_from_python_launch_file(str(path)).entities
