"""Python launch files with functions: places of findings, names that are assigned again, and equal conditions."""

from __future__ import annotations

import pytest

from tests.lint.test_launch_mistakes import found, package, write

LAUNCH = """import os
from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
from launch.conditions import IfCondition, UnlessCondition
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def action({parameters}):
    {body}


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument("mode", default_value="a"),
        {first},
        {second},
    ])
"""
EMPTY = """from launch import LaunchDescription


def generate_launch_description():
    return LaunchDescription([])
"""
INCLUDE = "return IncludeLaunchDescription(PythonLaunchDescriptionSource({}))"
SHARE = 'get_package_share_directory("cart")'
JOY = 'Node(package="joy", executable="joy_node", {})'


def cart(tmp_path, parameters, body, first, second):
    folder = package(tmp_path / "cart", "ament_cmake", "ament_index_python", "joy", "launch_ros")
    text = LAUNCH.format(parameters=parameters, body=body, first=first, second=second)
    write(folder / "launch/cart.launch.py", text)
    write(folder / "launch/other.launch.py", EMPTY)
    return folder


@pytest.mark.parametrize(
    ("path", "name"),
    [
        (f'os.path.join({SHARE}, "launch", name)', "other.launch.py"),
        (f'os.path.join({SHARE}, "launch", name + ".launch.py")', "other"),
        (f'os.path.join({SHARE}, "launch", f"{{name}}.launch.py")', "other"),
        (f'{SHARE} + "/launch/" + name', "other.launch.py"),
    ],
)
def test_a_missing_file_is_reported_where_a_call_names_it(tmp_path, path, name):
    wrong = name.replace("other", "another")
    folder = cart(tmp_path, "name", INCLUDE.format(path), f'action("{name}")', f'action("{wrong}")')
    message = "`launch/another.launch.py` does not exist in package `cart`"
    assert [(line, text[: len(message)]) for _, line, text in found(folder, "K958")] == [(19, message)]


def test_a_missing_file_is_reported_at_its_line_of_a_path(tmp_path):
    path = f'os.path.join({SHARE},\n        "launch",\n        "another.launch.py")'
    folder = cart(tmp_path, "name", "return name", 'action("a")', INCLUDE.format(path).removeprefix("return "))
    assert [line for _, line, _ in found(folder, "K958")] == [21]


@pytest.mark.parametrize("name", ["name", 'f"{name}_node"', 'name + "_node"', '"joy"'])
def test_a_name_of_two_nodes_is_reported_at_the_second_call(tmp_path, name):
    body = "return " + JOY.format(f"name={name}")
    folder = cart(tmp_path, "name", body, 'action("a")', 'action("a")')
    [(_, line, message)] = found(folder, "L111")
    assert line == 19
    assert message.startswith("the node on line 18 also has the name ")


def test_a_path_in_a_list_of_parameters_is_reported_once(tmp_path):
    body = "return " + JOY.format(f'parameters=[os.path.join({SHARE}, "config", file)]')
    folder = cart(tmp_path, "file", body, 'action("joy.yaml")', 'action("job.yaml")')
    write(folder / "config/joy.yaml", "/**:\n  ros__parameters:\n    deadzone: 0.1\n")
    assert [line for _, line, _ in found(folder, "K958")] == [19]


@pytest.mark.parametrize(
    ("first", "second", "is_reported"),
    [("If", "If", True), ("If", "Unless", False), ("Unless", "Unless", True)],
)
def test_two_nodes_of_one_name_need_different_conditions(tmp_path, first, second, is_reported):
    mode = 'LaunchConfiguration("mode")'
    nodes = [JOY.format(f'name="joy", condition={each}Condition({mode})') for each in (first, second)]
    folder = cart(tmp_path, "", "return None", *nodes)
    words = {"If": "if", "Unless": "unless"}
    xml = [f'<node pkg="joy" exec="joy_node" name="joy" {words[each]}="$(var mode)"/>' for each in (first, second)]
    write(
        folder / "launch/joy.launch.xml", f'<launch>\n<arg name="mode" default="true"/>\n{xml[0]}\n{xml[1]}\n</launch>'
    )
    messages = {name: text for name, _, text in found(folder, "L111")}
    joy = {
        "cart.launch.py": "the node on line 18 also has the name `joy`",
        "joy.launch.xml": "the node on line 3 also has the name `joy`",
    }
    assert messages == (joy if is_reported else {})


@pytest.mark.parametrize(
    ("body", "is_reported"),
    [
        ('mode = LaunchConfiguration("modes")\n    return ' + JOY.format("arguments=[mode]"), True),
        ('mode = LaunchConfiguration("modes")\n    mode = LaunchConfiguration("mode")\n    return [mode]', False),
        ('mode = LaunchConfiguration("modes")\n    mode = [mode]\n    return mode', True),
        ('return [LaunchConfiguration(name) for name in ["mode"]]', False),
        ('context.launch_configurations.update({"modes": "1"})\n    return LaunchConfiguration("modes")', False),
        ('return LaunchConfiguration("modes") if "modes" in context.launch_configurations else None', False),
    ],
)
def test_a_value_that_nothing_uses_needs_no_argument(tmp_path, body, is_reported):
    folder = cart(tmp_path, "context, name", body, 'action(None, "modes")', JOY.format('name="joy"'))
    assert bool(found(folder, "L101")) is is_reported
