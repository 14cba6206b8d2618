"""The settings of the bridge contain topic, type and direction for both sides, each topic once."""

from pathlib import Path

import yaml

BRIDGE = Path(__file__).resolve().parents[1] / "config" / "bridge.yaml"
KEYS = {"ros_topic_name", "gz_topic_name", "ros_type_name", "gz_type_name", "direction"}


def test_bridge():
    entries = yaml.safe_load(BRIDGE.read_text())
    for entry in entries:
        assert set(entry) == KEYS
        assert entry["direction"] in ("GZ_TO_ROS", "ROS_TO_GZ", "BIDIRECTIONAL")
    topics = [entry["ros_topic_name"] for entry in entries]
    assert len(set(topics)) == len(topics)
