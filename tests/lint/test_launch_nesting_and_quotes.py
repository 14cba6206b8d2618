"""Launch files with lists inside of lists, names in quotes, values before their evaluation, and missing folders."""

from __future__ import annotations

import pytest

from tests.lint.test_launch_mistakes import found, package, write

LAUNCH = """import os
import xacro
from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription, OpaqueFunction, RegisterEventHandler
from launch.event_handlers import OnProcessExit
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def tool(name, *more):
    return Node(package="joy", executable="joy_node", arguments=[name, "--quiet"] + list(more))


def include(name, **words):
    path = os.path.join(get_package_share_directory("cart"), "launch", name)
    return IncludeLaunchDescription(PythonLaunchDescriptionSource(path), launch_arguments=words.items())


def setup(context):
    mode = LaunchConfiguration("mode").perform(context).lower()
    model = xacro.process_file("cart.xacro", mappings={"mode": mode})
    content = {"robot_description": model.toxml()}
    return [Node(package="robot_state_publisher", executable="robot_state_publisher", parameters=[content])]


def generate_launch_description():
    mode = LaunchConfiguration("mode")
    first = tool("a")
    others = [tool("b"), tool("c", *["--fast"])]
    return LaunchDescription([
        DeclareLaunchArgument("mode", default_value="a"),
        OpaqueFunction(function=setup),
        include("other.launch.py", mode=mode, speed="1"),
        include("other.launch.py", mode=mode, speed="2"),
        first,
        RegisterEventHandler(OnProcessExit(target_action=first, on_exit=others)),
    ])
"""
OTHER = """from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    common = {"dev": LaunchConfiguration("mode")}
    return LaunchDescription([
        DeclareLaunchArgument("mode", default_value="a"),
        DeclareLaunchArgument("speed", default_value="1"),
        DeclareLaunchArgument("quiet", default_value="true"),
        Node(package="joy", executable="joy_node", parameters=[common, {"rate": LaunchConfiguration("speed")}]),
    ])
"""
MISTAKES = [
    ("on_exit=others", "on_exit=[others]", 38, "this list of actions is inside another list; write `*` before it"),
    ("[name, ", '["name", ', 13, "`name` in quotes is a string, not the variable `name`; write it without quotes"),
    ("[name, ", "[name + ", 13, "no comma before this option: it becomes part of the word before it"),
    ('"--quiet"', '"--quiet "', 13, "`--quiet ` ends with a blank, so it is an unknown option"),
    ("list(more)", 'list("more")', 13, "this creates a list of single letters; write the string in brackets"),
    ('*["--fast"]', '["d", "e"]', 31, "the strings of this inner list become one word, `de`; write `*` before it"),
    (
        ".perform(context).lower",
        ".lower",
        22,
        "a `LaunchConfiguration` has no method `lower`; write `.perform(context)` ",
    ),
    (
        ": mode}",
        ': LaunchConfiguration("mode")}',
        23,
        "xacro needs a string, not a `LaunchConfiguration`; write `.perform(",
    ),
    (
        "model.toxml()",
        "model",
        24,
        "`robot_description` is an XML document, not its text; write `.toxml()` after it",
    ),
    ("words.items()", "words", 18, "`launch_arguments` is a dictionary; write `.items()` after it"),
    (
        "def setup(context)",
        "def setup()",
        21,
        "the function `setup` of an OpaqueFunction lacks the parameter `context`",
    ),
    (
        '"other.launch.py", mode=mode, speed="2"',
        '"others.launch.py"',
        36,
        "`launch/others.launch.py` does not exist in ",
    ),
]


def cart(tmp_path, launch=LAUNCH, other=OTHER):
    folder = package(tmp_path / "cart", "ament_cmake", "joy", "launch_ros", "robot_state_publisher", "xacro")
    write(folder / "launch/cart.launch.py", launch)
    write(folder / "launch/other.launch.py", other)
    write(folder / "config/joy.yaml", "joy_node:\n  ros__parameters:\n    deadzone: 0.1\n")
    return folder


CODES = ("L105", "L106", "L107", "L108", "K958")


def test_the_correct_files_have_no_finding(tmp_path):
    assert found(cart(tmp_path), *CODES) == []


@pytest.mark.parametrize(("old", "new", "line", "message"), MISTAKES)
def test_a_mistake_has_one_finding_at_its_line(tmp_path, old, new, line, message):
    assert LAUNCH.count(old) == 1
    [(_, at, text)] = found(cart(tmp_path, LAUNCH.replace(old, new)), *CODES)
    assert at == line
    assert text.startswith(message)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("[common, ", "[[common], ", "this list of parameters is inside another list; write `*` before it"),
        (
            '{"rate": LaunchConfiguration("speed")}',
            'LaunchConfiguration("quiet")',
            "an item of `parameters` is the value",
        ),
        ('LaunchConfiguration("mode")', '"mode"', "`mode` in quotes is a string, not the value of the launch argument"),
    ],
)
def test_parameters_in_inner_lists_and_in_quotes_are_reported(tmp_path, old, new, message):
    assert OTHER.count(old) == 1
    [(_, _, text)] = found(cart(tmp_path, other=OTHER.replace(old, new)), *CODES)
    assert text.startswith(message)


def test_names_of_frames_and_topics_are_no_values_in_quotes(tmp_path):
    other = OTHER.replace('LaunchConfiguration("mode")}', '"odom", "frame_id": "mode"}').replace(
        'executable="joy_node", ', 'executable="joy_node", arguments=["-topic", "mode"], '
    )
    assert [each for each in found(cart(tmp_path, other=other), "L106") if "text `mode`" in each[2]] == []


@pytest.mark.parametrize(
    "old_and_new",
    [
        (
            '    mode = LaunchConfiguration("mode").perform(context).lower()',
            '    mode = context.launch_configurations["mode"]',
        ),
        ("[name, ", '[["cart", name], '),
        ("import os\n", 'import os\n\nAXES = list("xyz")\n'),
        ("(name, *more)", "(name, *more, size=None)\n\n\nSIZES = {'value': 'size'}\n\n\ndef tools(name, *more)"),
    ],
)
def test_names_in_indices_keys_and_joined_texts_are_accepted(tmp_path, old_and_new):
    assert LAUNCH.count(old_and_new[0]) == 1
    assert found(cart(tmp_path, LAUNCH.replace(*old_and_new)), *CODES) == []


@pytest.mark.parametrize(
    ("reading", "is_reported"),
    [
        ("", True),
        ('LaunchConfiguration(name) for name in ("mode", "speed")', False),
        ('context["mode"]', False),
    ],
)
def test_a_text_is_not_the_value_of_an_argument_that_code_reads(tmp_path, reading, is_reported):
    other = OTHER.replace('LaunchConfiguration("mode")', '"mode"').replace(
        "    return", f"    _ = [{reading}]\n    return"
    )
    assert bool(found(cart(tmp_path, other=other), "L106")) == is_reported


@pytest.mark.parametrize(
    ("more", "is_missing"),
    [("", True), ('("share/cart", glob("config/*.yaml")),', False), ('("lib", glob("b/*")),', True)],
)
def test_setup_can_install_a_folder_twice(tmp_path, more, is_missing):
    folder = cart(tmp_path)
    files = f'[("share/cart/config", glob("config/*.yaml")), {more}]'
    write(folder / "setup.py", f"from glob import glob\nfrom setuptools import setup\nsetup(data_files={files})\n")
    write(folder / "launch/joy.launch.xml", XML.format(name="dev", value="$(var map)", path="joy.yaml"))
    assert bool(found(folder, "K958")) == is_missing


XML = """<launch>
  <arg name="map" default="hall.yaml"/>
  <node pkg="joy" exec="joy_node" name="joy_node">
    <param name="{name}" value="{value}"/>
    <param from="$(find-pkg-share cart)/{path}"/>
  </node>
</launch>
"""
INSTALL = "install(DIRECTORY config {more} DESTINATION share/${{PROJECT_NAME}}{to})\n"


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("dev", "$(var map)", None),
        ("dev", "maps", None),
        ("dev", "map", "`map` is a string here, not the value of the launch argument; write `$(var map)`"),
        ("global_frame", "map", None),
    ],
)
def test_the_name_of_an_unused_argument_is_a_forgotten_substitution(tmp_path, name, value, message):
    folder = cart(tmp_path)
    write(folder / "launch/joy.launch.xml", XML.format(name=name, value=value, path="config/joy.yaml"))
    assert [text for _, _, text in found(folder, "L110")] == ([message] if message else [])


def test_arguments_in_expressions_are_used(tmp_path):
    folder = package(tmp_path / "cart", "catkin", "joy")
    node = '<node pkg="joy" type="joy_node" name="joy"{}><param name="dev" value="map"/></node>'
    text = f'<launch>\n<arg name="map" default="a"/>\n{node}\n</launch>\n'
    write(folder / "launch/joy.launch", text.format(""))
    assert [line for _, line, _ in found(folder, "L110")] == [3]
    write(folder / "launch/joy.launch", text.format(""" if="$(eval 'a' if map else 'b')\""""))
    assert found(folder, "L110") == []


@pytest.mark.parametrize(
    ("install", "is_missing"),
    [
        (INSTALL.format(more="launch", to=""), True),
        (INSTALL.format(more="launch", to="").replace("config", "config/"), False),
        ("install(FILES ${YAMLS} DESTINATION share/${PROJECT_NAME})\n", False),
        (INSTALL.format(more="", to="") + "install(FILES ${YAMLS} DESTINATION share/${PROJECT_NAME})\n", False),
        (INSTALL.format(more="", to="") + "set(d config)\ninstall(DIRECTORY ${d}/ DESTINATION share)\n", False),
        (INSTALL.format(more="", to="") + "install(TARGETS ${NODES} DESTINATION lib/${PROJECT_NAME})\n", True),
    ],
)
def test_a_file_in_a_folder_is_missing_at_the_root_of_its_package(tmp_path, install, is_missing):
    folder = cart(tmp_path)
    write(folder / "CMakeLists.txt", f"project(cart)\n{install}")
    write(folder / "launch/joy.launch.xml", XML.format(name="dev", value="$(var map)", path="joy.yaml"))
    messages = [text for _, _, text in found(folder, "K958")]
    assert bool(messages) == is_missing
