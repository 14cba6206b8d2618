"""Lists, levels and names in YAML files that do not suit each other."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfkit.description.xml.source import Source
from urdfkit.lint import lint
from urdfkit.lint.facts.moveit.planning import planning_defects

NODE = "local_costmap:\n  {}ros__parameters: {{global_frame: {}, robot_base_frame: base_link, width: 3}}"
NESTED = NODE.replace("{}ros", "local_costmap:\n    ros")
ADAPTERS = """planning_plugins: [ompl_interface/OMPLPlanner]
request_adapters: [default_planning_request_adapters/CheckStartStateBounds, {}]
response_adapters: [default_planning_response_adapters/AddTimeOptimalParameterization]"""
OLD, NEW = (
    "default_planner_request_adapters/FixStartStateBounds",
    "default_planning_request_adapters/ResolveConstraintFrames",
)
MUX = """twist_mux:
  ros__parameters:
    topics:
      joy: {{topic: {}, timeout: 0.5, priority: 10}}"""
DRIVE = """controller_manager:
  ros__parameters:
    drive: {{type: ackermann_steering_controller/AckermannSteeringController}}
drive:
  ros__parameters: {{rear_wheels_names: [{}], front_wheels_names: [steer], rear_wheels_radius: 0.45}}"""
CASES = [
    (
        "targets:\n- joints: [a, b]\n  positions: {}",
        "[1.0]",
        "[1.0, 2.0]",
        "`positions` has 1 values, but `joints` has 2 names",
    ),
    (
        NESTED.replace("{{", "{").replace("}}", "}"),
        "/map",
        "map",
        "`global_frame` is `/map`; tf2 rejects frames with a leading slash",
    ),
    (
        DRIVE.replace("{}", "wheel").replace("0.45", "{}"),
        "0.54",
        "0.45",
        "`rear_wheels_radius` is 0.54 m, but the radius of the wheels is 0.45 m",
    ),
    (MUX, "joy_vell", "joy_vel", "no node publishes velocity commands on `joy_vell`; did you mean `joy_vel`?"),
    (DRIVE, "steer", "wheel", "commands the velocity interface of joint `steer`, whose hardware provides `position`"),
]
ROBOT = """<robot name="cart"><link name="base"/>
<link name="w"><collision><geometry><cylinder radius="0.45" length="0.1"/></geometry></collision></link>
<joint name="wheel" type="continuous"><parent link="base"/><child link="w"/><axis xyz="0 1 0"/></joint>
<link name="s"/><joint name="steer" type="continuous"><parent link="base"/><child link="s"/><axis xyz="0 0 1"/></joint>
<ros2_control name="cart" type="system"><hardware><plugin>mock_components/GenericSystem</plugin></hardware>
<joint name="wheel"><command_interface name="velocity"/><state_interface name="velocity"/></joint>
<joint name="steer"><command_interface name="position"/><state_interface name="position"/></joint>
</ros2_control></robot>"""
TELEOP = """<launch><node pkg="teleop_twist_joy" exec="teleop_node"><remap from="cmd_vel" to="joy_vel"/></node>
<node pkg="twist_mux" exec="twist_mux"/></launch>"""


def found(folder: Path, text: str) -> list[str]:
    manifest = "<name>cart</name><version>1.0.0</version><buildtool_depend>ament_cmake</buildtool_depend>"
    (folder / "package.xml").write_text(f'<package format="3">{manifest}</package>')
    (folder / "cart.urdf").write_text(ROBOT)
    for name in ("config", "launch"):
        (folder / name).mkdir(exist_ok=True)
    (folder / "launch/cart.launch.xml").write_text(TELEOP)
    (folder / "config/cart.yaml").write_text(f"{text}\n")
    return [each.message for each in lint(folder)]


@pytest.mark.parametrize(("text", "wrong", "right", "words"), CASES)
def test_a_wrong_value_is_reported(tmp_path: Path, text: str, wrong: str, right: str, words: str) -> None:
    plain = text.replace("{}", "@").replace("{{", "{").replace("}}", "}")
    assert sum(words in each for each in found(tmp_path, plain.replace("@", wrong))) == 1
    assert sum(words in each for each in found(tmp_path, plain.replace("@", right))) == 0


def test_a_costmap_without_its_namespace_is_reported(tmp_path: Path) -> None:
    message = "the node is `/local_costmap/local_costmap`; write `local_costmap:` twice, one level below the other"
    assert message in found(tmp_path, NODE.format("", "odom"))
    assert message not in found(tmp_path, NESTED.replace("{}", "odom").replace("{{", "{").replace("}}", "}"))


def test_adapters_of_two_releases_of_moveit_are_reported() -> None:
    message = f"`{OLD}` is an adapter of releases before Jazzy, unlike the other adapters"
    assert [each for _, each in planning_defects(Source("a.yaml", ADAPTERS.format(OLD)), ())] == [message]
    assert [each for _, each in planning_defects(Source("a.yaml", ADAPTERS.format(NEW)), ())] == []
