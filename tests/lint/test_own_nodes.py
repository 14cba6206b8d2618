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
    findings = [one for one in lint(folder, target="ros2") if one.code != "K956"]
    return [(one.code, one.line) for one in findings if one.file.endswith((".yaml", ".xml"))]


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
LOADED = '  <load_composable_node target="c"><composable_node pkg="a" plugin="b" name="c"/></load_composable_node>\n'
SPACED = '  <push_ros_namespace namespace="front"/>\n'
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
        ({"guard.py": READER}, "/front/scan", LOADED, []),
        ({"guard.py": READER}, "/front/scan", SPACED, []),
    ],
)
def test_the_remapped_input_of_an_own_node_needs_a_publisher(tmp_path, code, topic, more, expected):
    node = f'  <node pkg="cart" exec="guard" name="ahead">\n    <remap from="ahead" to="{topic}"/>\n  </node>\n{more}'
    reported = found(tmp_path, code, slam="scan_topic: /scan", node=node)
    assert [each for each in reported if each[0] == "K977"] == expected


GUARD = """import rclpy
from geometry_msgs.msg import Twist
from rclpy.node import Node
from std_msgs.msg import Bool

class Guard(Node):
    def __init__(self):
        super().__init__("guard")
        self.declare_parameter("input", "cmd_raw")
        topic = self.get_parameter("input").value
        self.create_subscription(Twist, topic, self.on_command, 1)
        self.stop = self.create_publisher(Bool, "~/stopped", 1)
"""
FOLLOWER = """import rclpy
from geometry_msgs.msg import Twist
from rclpy.node import Node
from std_msgs.msg import Bool

TOPIC = "cmd_raw"

class Follower(Node):
    def __init__(self):
        super().__init__("follower")
        self.out = self.create_publisher(Twist, TOPIC, 1)
        self.create_subscription(Bool, "guard/stopped", self.on_stop, 1)
"""
FOLLOWER_IN_CPP = """#include "rclcpp/rclcpp.hpp"
Follower::Follower() : Node("follower") {
  out_ = create_publisher<geometry_msgs::msg::Twist>("cmd_raw", 1);
  stop_ = create_subscription<std_msgs::msg::Bool>("guard/stopped", 1, on_stop);
}
"""
OF_HEAT = GUARD.replace("~/stopped", "cpu_temperature").replace("Bool", "Float32")
PLANS = "\n        self.plan = self.create_publisher(Twist, 'plan', 1)"
WISHES = "_command, 1)\n        self.create_subscription(Twist, 'wish', self.on_command, 1)"
SECTION = "guard:\n  ros__parameters:\n    input: cmd_raw\n"
BOTH = '<node pkg="cart" exec="follower"/>\n'


def in_code(folder, guard=GUARD, follower=FOLLOWER, section="", name="follower.py"):
    """Return file, line and message of the findings of two nodes that exchange commands and a flag."""
    (folder / "cart.urdf").write_text(ROBOT)
    for file, text in FILES.items():
        (folder / file).write_text(text.replace("<launch>", NODE + BOTH))
    (folder / "guard.py").write_text(guard)
    (folder / name).write_text(follower)
    (folder / "guard.yaml").write_text(section or "{}\n")
    findings = [one for one in lint(folder, target="ros2") if one.code in ("K980", "K985")]
    return [(one.file.rpartition("/")[2], one.line, one.message) for one in findings]


@pytest.mark.parametrize(
    "changes",
    [
        {},
        {"section": SECTION},
        {"follower": FOLLOWER_IN_CPP, "name": "follower.cpp"},
        {"guard": GUARD.replace('"cmd_raw"', '"cmd_in"'), "section": SECTION},
        {"guard": GUARD.replace("(Twist, topic", "(Twist, other()")},
        {"follower": FOLLOWER.replace("Bool, ", "Int8, ").replace("guard/stopped", "count")},
        {"follower": FOLLOWER.replace("guard/stopped", "bumper_pressed")},
        {"follower": FOLLOWER.replace("guard/stopped", "bumper_pressed").replace("Bool", "Float32"), "guard": OF_HEAT},
        {
            "follower": FOLLOWER.replace("TOPIC, 1)", f"TOPIC, 1){PLANS}"),
            "guard": GUARD.replace("_command, 1)", WISHES),
        },
        {"follower": FOLLOWER.replace("TOPIC, 1", " + ".join(["'a'"] * 900) + ", 1")},
        {"follower": FOLLOWER.replace("self.out = ", f"a{'.a' * 900}.Publisher('b', Bool)\n        self.out = ")},
    ],
)
def test_own_nodes_that_exchange_messages_are_silent(tmp_path, changes):
    assert in_code(tmp_path, **changes) == []


@pytest.mark.parametrize(
    ("changes", "expected"),
    [
        (
            {"follower": FOLLOWER.replace("cmd_raw", "cmd_line"), "section": SECTION},
            ("follower.py", 6, "no node subscribes to the Twist messages on `cmd_line`; did you mean `cmd_raw`?"),
        ),
        (
            {"section": SECTION.replace("cmd_raw", "cmd_line")},
            ("guard.yaml", 3, "no node publishes the Twist messages on `cmd_line`; did you mean `cmd_raw`?"),
        ),
        (
            {"follower": FOLLOWER.replace("guard/stopped", "guard/halted")},
            ("follower.py", 12, "no node publishes the Bool messages on `guard/halted`; did you mean `guard/stopped`?"),
        ),
        (
            {"follower": FOLLOWER_IN_CPP.replace("guard/stopped", "guard/halted"), "name": "follower.cpp"},
            ("follower.cpp", 4, "no node publishes the Bool messages on `guard/halted`; did you mean `guard/stopped`"),
        ),
        (
            {"follower": FOLLOWER.replace("Bool, ", "Int8, ")},
            ("follower.py", 12, "`guard/stopped` has Bool messages, but its subscriber expects Int8 messages"),
        ),
    ],
)
def test_own_nodes_on_different_topics_are_reported_once(tmp_path, changes, expected):
    (reported,) = in_code(tmp_path, **changes)
    assert reported[:2] == expected[:2]
    assert reported[2].startswith(expected[2])


MEMBERS = """class Follower : public rclcpp::Node {
  rclcpp::Publisher<geometry_msgs::msg::Twist>::SharedPtr out_;
  rclcpp::Subscription<std_msgs::msg::Bool>::SharedPtr stop_;
};
"""


def test_a_publisher_that_is_a_member_of_a_class_is_no_publisher_of_unknown_messages(tmp_path):
    assert found(tmp_path, {"guard.cpp": CPP.replace("PUBLISHER", "") + MEMBERS}) == [("K977", 3)]


NAMED = '<node pkg="cart" exec="guard" name="{}"><param from="$(find-pkg-share cart)/guard.yaml"/></node>\n'


@pytest.mark.parametrize(
    ("name", "section", "expected"),
    [
        ("guard", "guard", []),
        ("guard", "stopper", [("guard.yaml", 1)]),
        ("keeper", "guard", [("cart.launch.xml", 2)]),
        ("keeper", "other:\n  ros__parameters:\n    x: 1\nkeeper", []),
    ],
)
def test_the_section_of_an_own_node_has_its_name(tmp_path, name, section, expected):
    (tmp_path / "cart.urdf").write_text(ROBOT)
    for file, text in FILES.items():
        (tmp_path / file).write_text(text.replace("<launch>", f"<launch>\n{NAMED.format(name)}"))
    (tmp_path / "guard.py").write_text(GUARD)
    more = "other_node:\n  ros__parameters:\n    rate: 1\n"
    (tmp_path / "guard.yaml").write_text(SECTION.replace("guard:", f"{section}:") + more)
    findings = [one for one in lint(tmp_path, target="ros2") if one.code == "L117"]
    assert [(one.file.rpartition("/")[2], one.line) for one in findings] == expected


SWERVE = """import rclpy
from geometry_msgs.msg import Twist
from rclpy.node import Node
from std_msgs.msg import Bool, Float64MultiArray

class Swerve(Node):
    def __init__(self):
        super().__init__("swerve")
        self.create_subscription(Twist, "cmd_vel", self.on_command, 1)
        self.out = self.create_publisher(Float64MultiArray, "wheels/commands", 1)
"""
SMOOTHER = """<launch>
  <node pkg="cart" exec="swerve" name="swerve"/>
  <node pkg="nav2_velocity_smoother" exec="velocity_smoother" name="velocity_smoother">
    <remap from="cmd_vel" to="cmd_vel_nav"/>{}
  </node>
</launch>
"""


@pytest.mark.parametrize(
    ("output", "message", "lines"),
    [
        ("", "Float64MultiArray", [4]),
        ('\n    <remap from="cmd_vel_smoothed" to="cmd_vel"/>', "Float64MultiArray", []),
        ("", "Bool", []),  # a node that reads commands but does not drive
    ],
)
def test_the_output_of_a_smoother_that_an_own_drive_does_not_read(tmp_path, output, message, lines):
    (tmp_path / "cart.urdf").write_text('<robot name="cart"><link name="base_link"/></robot>')
    (tmp_path / "package.xml").write_text(FILES["package.xml"])
    (tmp_path / "cart.launch.xml").write_text(SMOOTHER.format(output))
    (tmp_path / "swerve.py").write_text(SWERVE.replace("(Float64MultiArray", f"({message}"))
    assert [one.line for one in lint(tmp_path, target="ros2") if one.code == "K980"] == lines
