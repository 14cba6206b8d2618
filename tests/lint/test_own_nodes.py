"""Topics of a workspace with nodes of its own, with publishers in Python or C++."""

from __future__ import annotations

import pytest

from tests.lint.test_workspace_topics import FILES, ROBOT
from urdfkit.lint import lint

NODE = '<launch>\n  <node pkg="cart" exec="guard"/>'
PYTHON = """import rclpy
from rclpy.node import Node
from sensor_msgs.msg import LaserScan
from std_msgs.msg import Bool

class Guard(Node):
    def __init__(self, topic):
        super().__init__("guard")
        self.stop = self.create_publisher(Bool, topic, 1)
"""
CPP = """#include "rclcpp/rclcpp.hpp"
Guard::Guard() : Node("guard") {
  stop_ = create_publisher<std_msgs::msg::Bool>(topic_, 1);
  PUBLISHER
}
"""
SCAN = "scan_topic: /front/scan"


def found(folder, code, **changes):
    (folder / "cart.urdf").write_text(ROBOT)
    for file, text in FILES.items():
        text = (
            text.replace("base_driver", "nav2_velocity_smoother")
            .replace("<launch>", NODE)
            .replace("scan_topic: /scan", changes.get("slam", SCAN))
        )
        (folder / file).write_text(text.replace("</launch>", changes.get("node", "") + "</launch>"))
    for name, text in code.items():
        (folder / name).write_text(text)
    return [(one.code, one.line) for one in lint(folder, target="ros2") if one.file.endswith((".yaml", ".xml"))]


@pytest.mark.parametrize("code", [{"guard.py": PYTHON}, {"guard.cpp": CPP.replace("PUBLISHER", "")}])
def test_an_own_node_with_another_message_does_not_hide_a_topic_without_publisher(tmp_path, code):
    assert found(tmp_path, code) == [("K977", 3)]


@pytest.mark.parametrize(
    "code",
    [
        {},
        {"guard.py": f"{PYTHON}        self.scan = self.create_publisher(LaserScan, topic, 1)\n"},
        {"guard.py": f"{PYTHON}        self.scan = self.create_publisher(LaserScan, 'front/scan', 1)\n"},
        {"guard.py": f"{PYTHON}        self.scan = self.create_publisher(kind, 'scan', 1)\n"},
        {"guard.cpp": CPP.replace("PUBLISHER", "scan_ = create_publisher<sensor_msgs::msg::LaserScan>(topic_, 1);")},
        {"guard.cpp": CPP.replace("PUBLISHER", "scan_ = image_transport::create_publisher(this, topic_);")},
    ],
)
def test_an_own_node_that_may_publish_the_topic_is_trusted(tmp_path, code):
    assert found(tmp_path, code) == []


@pytest.mark.parametrize(("topic", "expected"), [("cmd_vel_joy", [("K980", 17)]), ("cmd_vel_nav", [])])
def test_a_smoother_that_reads_its_own_output_is_reported(tmp_path, topic, expected):
    node = f"""  <node pkg="nav2_velocity_smoother" exec="velocity_smoother">
    <remap from="cmd_vel" to="{topic}"/>
    <remap from="cmd_vel_smoothed" to="cmd_vel_joy"/>
  </node>
"""
    assert found(tmp_path, {"guard.py": PYTHON}, slam="scan_topic: /scan", node=node) == expected


READER = PYTHON.replace("topic, 1)", "'stop', 1)\n        self.create_subscription(LaserScan, 'ahead', self.read, 1)")
READER_IN_CPP = CPP.replace("topic_, 1", '"stop", 1').replace(
    "PUBLISHER", 'scan_ = create_subscription<sensor_msgs::msg::LaserScan>("ahead", 1, read);'
)
COMPONENT = '  <node_container pkg="rclcpp_components" exec="component_container"><composable_node/></node_container>\n'


@pytest.mark.parametrize(
    ("code", "topic", "more", "expected"),
    [
        ({"guard.py": READER}, "/front/scan", "", [("K977", 17)]),
        ({"guard.cpp": READER_IN_CPP}, "/front/scan", "", [("K977", 17)]),
        ({"guard.py": READER}, "/scan", "", []),
        ({"guard.py": READER.replace("LaserScan, 'ahead'", "kind, 'ahead'")}, "/front/scan", "", []),
        ({"guard.py": READER}, "/front/scan", '  <node pkg="base_driver" exec="driver"/>\n', []),
        ({"guard.py": READER}, "/front/scan", COMPONENT, []),
    ],
)
def test_the_remapped_input_of_an_own_node_needs_a_publisher(tmp_path, code, topic, more, expected):
    node = f'  <node pkg="cart" exec="guard" name="ahead">\n    <remap from="ahead" to="{topic}"/>\n  </node>\n{more}'
    reported = found(tmp_path, code, slam="scan_topic: /scan", node=node)
    assert [each for each in reported if each[0] == "K977"] == expected
