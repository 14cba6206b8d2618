"""Bridges in the arguments of a launched node, and in the YAML of a bridge."""

from __future__ import annotations

import pytest

from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.controller_joints import Named
from urdfkit.lint.facts.control.ros_gz_bridges import in_launch, in_yaml

LAUNCH = """from launch_ros.actions import Node

node = Node(package="ros_gz_bridge", executable="%s", arguments=["%s"])
"""


def check_places(source: Source, *names: Named | None) -> None:
    for named in names:
        assert named is not None
        assert source.text[named.start : named.start + len(named.name)] == named.name


@pytest.mark.parametrize(("sign", "direction"), [("[", "GZ_TO_ROS"), ("]", "ROS_TO_GZ"), ("@", "BIDIRECTIONAL")])
def test_a_bridge_in_a_launch_file(sign: str, direction: str) -> None:
    argument = f"/scan@sensor_msgs/msg/LaserScan{sign}gz.msgs.LaserScan"
    source = Source("a.launch.py", LAUNCH % ("parameter_bridge", argument))
    (bridge,) = in_launch(source)
    assert bridge.topic is not None
    assert bridge.ros is not None
    assert bridge.gazebo is not None
    assert bridge.direction is not None
    named = bridge.topic, bridge.ros, bridge.gazebo
    assert [one.name for one in named] == ["/scan", "sensor_msgs/msg/LaserScan", "gz.msgs.LaserScan"]
    check_places(source, *named)
    assert bridge.direction.name == direction
    assert source.text[bridge.direction.start] == sign


@pytest.mark.parametrize(
    ("program", "argument"), [("image_bridge", "/a@b/msg/C[gz.msgs.D"), ("parameter_bridge", "--ros-args")]
)
def test_other_programs_and_arguments_are_no_bridge(program: str, argument: str) -> None:
    assert not list(in_launch(Source("a.launch.py", LAUNCH % (program, argument))))


def test_a_bridge_in_yaml() -> None:
    text = (
        "- topic_name: /clock\n  ros_type_name: rosgraph_msgs/msg/Clock\n"
        "  gz_type_name: gz.msgs.Clock\n  direction: GZ_TO_ROS\n- topic_name: /other\n"
        "- gz_topic_name: $(var name)\n  ign_type_name: ignition.msgs.Clock\n"
    )
    source = Source("a.yaml", text)
    (first, keys), (second, _) = in_yaml(source)
    assert [key.text for key in keys] == ["topic_name", "ros_type_name", "gz_type_name", "direction"]
    names = first.topic, first.ros, first.gazebo, first.direction
    assert [one and one.name for one in names] == ["/clock", "rosgraph_msgs/msg/Clock", "gz.msgs.Clock", "GZ_TO_ROS"]
    check_places(source, *names)
    assert (second.topic, second.ros, second.direction) == (None, None, None)
    assert second.gazebo is not None
    assert second.gazebo.name == "ignition.msgs.Clock"
