"""Calls in Python launch files: arguments of the launch classes, substitutions as texts, and lifecycle transitions."""

from __future__ import annotations

import pytest

from tests.lint.test_launch_mistakes import package, write
from urdfkit.lint import lint

LAUNCH = """
import launch
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, EmitEvent, OpaqueFunction, RegisterEventHandler, TimerAction
from launch.substitutions import Command, EnvironmentVariable, FindExecutable, LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import LifecycleNode, Node, SetParameter
from launch.event_handlers import OnProcessExit
from launch_ros.parameter_descriptions import ParameterValue
from launch_ros.event_handlers import OnStateTransition
from launch_ros.events.lifecycle import ChangeState
from launch_ros.substitutions import FindPackageShare
from lifecycle_msgs.msg import Transition
from nav2_common.launch import RewrittenYaml


def more(context):
    mode = LaunchConfiguration("mode").perform(context)
    nodes = [Node(package="joy", executable="joy_node", name=mode)]
    return nodes


def generate_launch_description():
    path = PathJoinSubstitution([FindPackageShare("cart"), "cart.urdf"])
    joy = Node(package="joy", executable="joy_node", arguments=["--file", path])
    home = Node(package="joy", executable="joy_node", arguments=[EnvironmentVariable("HOME", default_value="/")])
    driver = LifecycleNode(package="urg_node", executable="urg_node_driver", name="driver", namespace="")
    matcher = launch.events.matches_action(driver)
    configure = EmitEvent(event=ChangeState(
        lifecycle_node_matcher=matcher, transition_id=Transition.TRANSITION_CONFIGURE))
    activate = EmitEvent(event=ChangeState(
        lifecycle_node_matcher=launch.events.matches_action(driver), transition_id=Transition.TRANSITION_ACTIVATE))
    handler = RegisterEventHandler(OnStateTransition(
        target_lifecycle_node=driver, goal_state="inactive", entities=[activate]))
    yaml = RewrittenYaml(source_file="cart.yaml", param_rewrites={})
    common = [("joy", "cart/joy")]
    content = ParameterValue(Command(["xacro ", path]), value_type=str)
    robot = Node(package="tf2_ros", executable="tf2_echo", parameters=[{"text": content}], remappings=common)
    after = RegisterEventHandler(OnProcessExit(target_action=joy, on_exit=[home]))
    timer = TimerAction(period=2.0, actions=[joy])
    return LaunchDescription([
        DeclareLaunchArgument("mode", default_value="a", choices=["a", "b"]),
        SetParameter("use_sim_time", True),
        OpaqueFunction(function=more),
        Node(package="tf2_ros", executable="buffer_server", parameters=[yaml]),
        robot, after, timer, driver, handler, configure,
    ])
"""
MISTAKES = [
    ("period=2.0, ", "2.0, ", "timer = ", "`TimerAction` accepts this argument only by keyword; write `period=`"),
    ("function=more", "more", "OpaqueFunction(more", "write `function=` before it"),
    (
        '"use_sim_time", True',
        '"use_sim_time"',
        'SetParameter("use_sim_time")',
        "`SetParameter` needs the argument `value`",
    ),
    (', namespace=""', "", "driver = LifecycleNode", "`LifecycleNode` needs the argument `namespace`"),
    ("source_file=", "source_files=", "source_files=", "`RewrittenYaml` has no argument `source_files`"),
    ('"HOME", default_value="/"', '"HOME", "/"', '"HOME", "/"', "write `default_value=` before this argument"),
    ('choices=["a", "b"]', "choices=[True, False]", "choices", "a choice is not a string; write it in quotes"),
    ("perform(context)", "perform()", "perform()", "`perform` needs the launch context"),
    ('["--file", path]', '["--file " + path]', '["--file', "a string and a `PathJoinSubstitution` cannot be added"),
    ('["--file", path]', '[f"--file={path}"]', '[f"--file', "an f-string has no access to the value of a `PathJoin"),
    ("    return nodes", "", "name=mode", "the function `more` of an OpaqueFunction does not return its actions"),
    ("value_type=str", 'value_type="str"', "value_type", "`value_type` is a string; write a type, such as `str`"),
    ("remappings=common", "remappings=[common]", "remappings", "an item of `remappings` is a list of pairs"),
    ("remappings=common", 'remappings=[["joy", "cart/joy"]]', "remappings", "is a list; write a tuple, ("),
    ("target_action=joy, on_exit=[home]", "joy, [home]", "OnProcessExit(joy", "write `target_action=` before it"),
    ("TRANSITION_CONFIGURE", "TRANSITION_CONFIG", "TRANSITION_CONFIG", "`Transition` has no `TRANSITION_CONFIG`"),
    ("TRANSITION_ACTIVATE", "TRANSITION_CONFIGURE", "matches_action(driver), ", "does not accept `CONFIGURE`"),
    ("node=driver, goal", "node=joy, goal", "node=joy, goal", "is a `Node`; write the variable of a `LifecycleNode`"),
    ("LifecycleNode(p", "Node(p", "driver = Node", "is a `Node`; write `LifecycleNode`"),
]


@pytest.mark.parametrize(("old", "new", "place", "words"), MISTAKES)
def test_a_wrong_call_is_reported_at_its_line(tmp_path, old, new, place, words):
    cart = package(tmp_path / "cart", "ament_cmake", "launch_ros", "joy", "urg_node", "tf2_ros", "lifecycle_msgs")
    assert LAUNCH.count(old) == 1
    wrong = LAUNCH.replace(old, new)
    write(cart / "launch/cart.launch.py", wrong)
    line = wrong[: wrong.index(place)].count("\n") + 1
    assert [each.line for each in lint(cart) if each.code in ("L105", "L106") and words in each.text] == [line]
    write(cart / "launch/cart.launch.py", LAUNCH)
    assert not [each for each in lint(cart) if each.code in ("L105", "L106")]


TIMER = """activate, TimerAction(period=9.0, actions=[EmitEvent(event=ChangeState(
        lifecycle_node_matcher=launch.events.matches_action(driver),
        transition_id=Transition.TRANSITION_DEACTIVATE))])"""
RIGHT = [
    ("entities=[activate]", f"entities=[{TIMER}]"),
    ("entities=[activate]", f"entities=[{TIMER.replace('TimerAction(period=9.0, actions=[', '').removesuffix('])')}]"),
]


@pytest.mark.parametrize(("old", "new"), RIGHT)
def test_a_right_call_is_not_reported(tmp_path, old, new):
    cart = package(tmp_path / "cart", "ament_cmake", "launch_ros", "joy", "urg_node", "tf2_ros", "lifecycle_msgs")
    assert LAUNCH.count(old) == 1
    write(cart / "launch/cart.launch.py", LAUNCH.replace(old, new))
    assert not [each for each in lint(cart) if each.code in ("L105", "L106")]


def test_expressions_of_hundreds_of_attributes_do_not_stop_a_rule(tmp_path, caplog):
    deep = "path" + ".b" * 900
    include = "launch.actions.IncludeLaunchDescription('a', condition=launch.conditions.IfCondition({0}), "
    include += "launch_arguments={{'use_sim_time': 'false', 'a': {0}}}.items()), Command({0}), home"
    cart = package(tmp_path / "cart", "ament_cmake", "launch_ros", "ros_gz_sim")
    gazebo = "launch.actions.IncludeLaunchDescription(PathJoinSubstitution(["
    gazebo += "FindPackageShare('ros_gz_sim'), 'launch', 'gz_sim.launch.py'])), "
    write(
        cart / "launch/cart.launch.py", LAUNCH.replace("robot, after, timer", f"{gazebo}{include.format(deep)}, timer")
    )
    lint(cart)
    assert not [each for each in caplog.records if "a bug in urdfkit" in each.getMessage()]
