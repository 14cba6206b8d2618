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


@pytest.mark.parametrize(("node", "is_reported"), [("ekf", True), ("ekf_node", False)])
def test_a_section_with_the_name_of_its_node_is_loaded_outside_of_the_node(tmp_path, node, is_reported):
    cart = package(tmp_path / "cart", "catkin", "cart_filters")
    write(cart / "config/ekf.yaml", "ekf:\n  rate: 5\n")
    inside = FILE.replace("talker", "ekf")
    write(
        cart / "launch/cart.launch",
        f'<launch>\n<node pkg="cart_filters" type="ekf" name="{node}">\n{inside}\n</node>\n</launch>\n',
    )
    message = "the only section of ekf.yaml is `ekf`, so its parameters are in `/ekf/ekf`; load it outside of the node"
    assert found(cart, "L110") == ([("cart.launch", 3, message)] if is_reported else [])


def test_parameters_of_amcl_are_private(tmp_path):
    cart = package(tmp_path / "cart", "catkin", "amcl")
    outside = '<param name="min_particles" value="50"/>'
    write(cart / "launch/cart.launch", f'<launch><node pkg="amcl" type="amcl" name="amcl"/>\n{outside}</launch>')
    [(_, line, message)] = found(cart, "L110")
    assert (line, message.partition(",")[0]) == (2, "node `amcl` reads its private parameter `min_particles`")
