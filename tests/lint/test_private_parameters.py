"""Parameters of ROS 1 launch files that a node reads from another namespace than the one with their value."""

from __future__ import annotations

import pytest

from tests.lint.test_launch_mistakes import found, package, write

CODE = """#!/usr/bin/env python3
import rospy

rospy.init_node("talker")
rate = rospy.get_param("{rate}", 10)
speed = rospy.get_param("~speed", 1.0)
"""
LAUNCH = """<launch>
  <node pkg="cart" type="talker.py" name="talker"{args}>
    <param name="speed" value="2.0"/>
    {inside}
  </node>
  {outside}
</launch>
"""
RATE = '<param name="rate" value="5"/>'
FILE = '<rosparam command="load" file="$(find cart)/config/talker.yaml"/>'
PRIVATE = "node `talker` reads its private parameter `rate`, but "


@pytest.mark.parametrize(
    ("rate", "args", "inside", "outside", "expected"),
    [
        ("~rate", "", RATE, "", None),
        ("/rate", "", "", RATE, None),
        ("rate", "", "", RATE, None),
        ("rate", "", RATE, RATE, None),
        ("rate", "", RATE + '<remap from="rate" to="~rate"/>', "", None),
        ("~rate", "", RATE, RATE, None),
        ("~rate", ' args="_rate:=3"', "", RATE, None),
        ("~rate", "", FILE, RATE, None),
        ("~rate", "", "", '<param name="talker/rate" value="5"/>', None),
        ("~rate", "", "", f'<group ns="talker">{RATE}</group>', None),
        ("~rate", "", "", '<param name="~rate" value="5"/>', None),
        ('~" + "rate', "", "", RATE, None),
        ("/rate", "", RATE, "", (4, "node `talker` reads `/rate`, but this parameter is in `/talker`")),
        ("rate", "", RATE, "", (4, "node `talker` reads `rate`, but this parameter is in `/talker`")),
        ("rate", "", FILE, "", (4, "node `talker` reads `rate`, but talker.yaml is loaded into `/talker`")),
        ("~rate", "", "", RATE, (6, PRIVATE + "this parameter is in `/`; write it inside of the node")),
        ("~rate", "", "", FILE, (6, PRIVATE + "talker.yaml is loaded into `/`; load it inside of the node")),
    ],
)
def test_a_parameter_is_where_the_code_of_its_node_reads_it(tmp_path, rate, args, inside, outside, expected):
    cart = package(tmp_path / "cart", "catkin", "rospy")
    write(cart / "scripts/talker.py", CODE.replace("{rate}", rate))
    write(cart / "config/talker.yaml", "rate: 5\n")
    write(cart / "launch/cart.launch", LAUNCH.format(args=args, inside=inside, outside=outside))
    findings = found(cart, "L110")
    assert [line for _, line, _ in findings] == ([expected[0]] if expected else [])
    assert all(text.startswith(expected[1]) for _, _, text in findings)


def test_other_code_can_read_a_global_parameter(tmp_path):
    cart = package(tmp_path / "cart", "catkin", "rospy")
    write(cart / "scripts/talker.py", CODE.replace("{rate}", "~rate"))
    write(cart / "src/listener.cpp", 'double rate = node.param("rate", 1.0);\n')
    write(cart / "launch/cart.launch", LAUNCH.format(args="", inside="", outside=RATE))
    assert found(cart, "L110") == []


def test_other_code_can_read_a_parameter_of_a_namespace(tmp_path):
    cart = package(tmp_path / "cart", "catkin", "rospy")
    write(cart / "scripts/talker.py", CODE.replace("{rate}", "~rate"))
    launch = LAUNCH.format(args="", inside="", outside=RATE)
    launch = launch.replace("<launch>", '<launch><group ns="a">').replace("</launch>", "</group></launch>")
    write(cart / "launch/cart.launch", launch)
    assert [line for _, line, _ in found(cart, "L110")] == [6]
    write(cart / "scripts/listener.py", CODE.replace("{rate}", "/a/rate"))
    assert found(cart, "L110") == []


def test_a_node_of_another_workspace_can_read_a_global_parameter(tmp_path):
    cart = package(tmp_path / "cart", "catkin", "rospy", "cart_driver", "joy")
    write(cart / "scripts/talker.py", CODE.replace("{rate}", "~rate"))
    node = '<node pkg="joy" type="driver" name="driver"/>'
    write(cart / "launch/cart.launch", LAUNCH.format(args="", inside="", outside=RATE + node))
    assert [line for _, line, _ in found(cart, "L110")] == [6]
    node = node.replace("joy", "cart_driver")
    write(cart / "launch/cart.launch", LAUNCH.format(args="", inside="", outside=RATE + node))
    assert found(cart, "L110") == []


@pytest.mark.parametrize(
    ("code", "is_reported"),
    [
        ("import json\n", True),
        ("from cart.core import Core\n", False),
        ('def parameter(name):\n    return rospy.get_param("~%s" % name)\n', False),
    ],
)
def test_imported_code_and_functions_can_read_private_parameters(tmp_path, code, is_reported):
    cart = package(tmp_path / "cart", "catkin", "rospy")
    write(cart / "scripts/talker.py", code + CODE.replace("{rate}", "/rate"))
    write(cart / "src/cart/core.py", 'import rospy\nrate = rospy.get_param("~rate")\n')
    write(cart / "launch/cart.launch", LAUNCH.format(args="", inside=RATE, outside=""))
    assert [line for _, line, _ in found(cart, "L110")] == [4] * is_reported


@pytest.mark.parametrize(
    ("package_name", "node", "code", "is_reported"),
    [
        ("robot_localization", "ekf", "", True),
        ("robot_localization", "ekf_node", "", False),
        ("costmap_2d", "ekf", "", False),
        ("cart", "ekf", 'ros::init(argc, argv, "ekf"); ros::NodeHandle node("~");', True),
        ("cart", "ekf", 'ros::NodeHandle node("~"), filter(node, "ekf");', False),
        ("cart", "ekf", 'ros::NodeHandle node("~"); node.getParam("ekf", values);', False),
    ],
)
def test_a_section_with_the_name_of_its_node_is_loaded_outside_of_the_node(
    tmp_path, package_name, node, code, is_reported
):
    cart = package(tmp_path / "cart", "catkin", "costmap_2d", "robot_localization")
    write(cart / "src/ekf.cpp", code)
    write(cart / "config/ekf.yaml", "ekf:\n  rate: 5\n")
    inside = FILE.replace("talker", "ekf")
    write(
        cart / "launch/cart.launch",
        f'<launch>\n<node pkg="{package_name}" type="ekf" name="{node}">\n{inside}\n</node>\n</launch>\n',
    )
    message = "the only section of ekf.yaml is `ekf`, so its parameters are in `/ekf/ekf`; load it outside the node"
    assert found(cart, "L110") == ([("cart.launch", 3, message)] if is_reported else [])


def test_parameters_of_amcl_are_private(tmp_path):
    cart = package(tmp_path / "cart", "catkin", "amcl")
    outside = '<param name="min_particles" value="50"/>'
    write(cart / "launch/cart.launch", f'<launch><node pkg="amcl" type="amcl" name="amcl"/>\n{outside}</launch>')
    [(_, line, message)] = found(cart, "L110")
    assert (line, message.partition(",")[0]) == (2, "node `amcl` reads its private parameter `min_particles`")


def test_other_nodes_can_read_global_names_of_frames(tmp_path):
    cart = package(tmp_path / "cart", "catkin", "amcl", "cart_driver")
    nodes = '<node pkg="amcl" type="amcl" name="amcl"/><node pkg="cart_driver" type="driver" name="driver"/>'
    write(cart / "launch/cart.launch", f'<launch>{nodes}<param name="base_frame_id" value="base"/></launch>')
    assert found(cart, "L110") == []
