"""The settings of the controllers are readable, and no joint has two controllers."""

from pathlib import Path

import yaml

CONFIG = Path(__file__).resolve().parents[1] / "config"


def lists_of_joints(settings):
    """Yield all lists of joints at any depth."""
    for key, value in settings.items():
        if key in ("joint", "joints"):
            yield [value] if key == "joint" else value
        elif isinstance(value, dict):
            yield from lists_of_joints(value)


def test_joints_have_one_controller():
    for path in sorted(CONFIG.glob("*.yaml")):
        joints = [joint for listed in lists_of_joints(yaml.safe_load(path.read_text())) for joint in listed]
        assert len(set(joints)) == len(joints), path
