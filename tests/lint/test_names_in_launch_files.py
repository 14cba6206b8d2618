"""Names in launch files that no other part of the packages has."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfkit.lint import lint

ROBOT = '<robot name="arm"><link name="base_link"/></robot>'
GROUP = '<group name="arm"><link name="base_link"/></group>'
VIRTUAL = '<virtual_joint name="v" type="fixed" parent_frame="world" child_link="base_link"/>'
SRDF = f'<robot name="arm">{GROUP}{VIRTUAL}</robot>'
NODELET = '<node pkg="nodelet" type="nodelet" name="points" args="load depth_image_proc/point_cloud_xyzrgb {}"/>'
MANAGER = '<node pkg="nodelet" type="nodelet" name="manager" args="manager"/>'
STATIC = '<node pkg="tf2_ros" type="static_transform_publisher" name="w" args="0 0 0 0 0 0 {}"/>'
DRIVER = '<node pkg="nmea_navsat_driver" exec="nmea_serial_driver"><remap from="{}" to="{}"/></node>'
MUX = '<node pkg="twist_mux" exec="twist_mux"><remap from="cmd_vel_out" to="/drive/{}"/></node>'
COMMAND = '<node pkg="robot_state_publisher" exec="robot_state_publisher"><param name="robot_description" {}/></node>'
TEXT = "value=\"$(command 'xacro $(find-pkg-share arm)/arm.urdf')\""
CONDITION = '<arg name="gui" default="true"/><node if="{}" pkg="rviz" type="rviz" name="rviz"/>'
INCLUDE = '<include file="$(find-pkg-share ros_gz_sim)/launch/gz_sim.launch.py"><arg name="{}" value="-r"/></include>'
YAML_TEXT = 'the launch reads the output of the command as YAML, and stops at text that is not YAML; add `type="str"`'
CONDITION_TEXT = "condition `$(arg gui)!=false` is not evaluated, because other text surrounds it; write `$(eval …)`"
PLUGIN = '<node pkg="moveit_ros_move_group" type="move_group" name="move_group"><param name="{}" value="{}"/></node>'
PLANNER = PLUGIN.format("planning_plugin", "{}")
ADAPTERS = PLUGIN.format("request_adapters", "default_planner_request_adapters/FixStartStateBounds {}")
MANAGER2 = PLUGIN.format("moveit_controller_manager", "{}/MoveItFakeControllerManager").replace("type", "exec")
BASE = '<node pkg="move_base" type="move_base" name="m"><param name="base_global_planner" value="{}"/></node>'
STICK = (
    '<node pkg="joy" type="joy_node" name="j"><param name="dev" value="/d"/><param name="deadzone" value="{}"/></node>'
)
CAMERA = '<node pkg="usb_cam" type="usb_cam_node" name="c"><remap from="{}/></node>'
SPAWN = (
    '<param name="robot_description" textfile="$(find arm)/arm.urdf"/>'
    '<node pkg="gazebo_ros" type="spawn_model" name="s" args="-{} -param robot_description -model arm"/>'
)
SIMULATED = (
    '<include file="$(find gazebo_ros)/launch/empty_world.launch"/><group if="$(arg rviz)">'
    '<include file="$(find a)/b"/></group><param name="use_sim_time" value="{}"/>'
)
MAPPING = '<node pkg="gmapping" type="slam_gmapping" name="m"><param name="base_frame" value="{}"/></node>'
TO_TOOL = STATIC.format("base_link tool")
BOTH = "`respawn` and `required` are both true, which roslaunch rejects; remove one"
FILTER = '<node pkg="robot_localization" exec="ekf_node" name="ekf"><remap from="{}/></node>'
CASES = [
    (1, STICK, "10", "0.1", "`deadzone` is 10, more than 1"),
    (1, '<node pkg="d" type="d" name="d" required="{}" respawn="true"/>', "true", "false", BOTH),
    (1, CAMERA, 'image_raw" to="~image_raw"', '~image_raw" to="image_raw"', "write `~image_raw` first"),
    (1, SPAWN, "sdf", "urdf", "`robot_description` is a URDF; did you mean `-urdf`?"),
    (1, SIMULATED, "false", "true", "`use_sim_time` is false, but this file starts Gazebo"),
    (1, MAPPING, "footprint", "base_link", "has no link `footprint`, the frame of this node"),
    (1, MAPPING + TO_TOOL, "footprint", "tool", "has no link `footprint`, the frame of this node"),
    (2, FILTER, 'odom" to="odometry/filtered"', 'odometry/filtered" to="odom"', "`ekf_node` has no topic `odom`"),
    (1, PLANNER, "ompl_interface/OMPLPlannerPlugin", "ompl_interface/OMPLPlanner", "has no plugin `OMPLPlannerPlugin`"),
    (1, BASE, "nav2_navfn_planner/NavfnPlanner", "navfn/NavfnROS", "ROS 1; did you mean `navfn/NavfnROS`?"),
    (
        1,
        ADAPTERS,
        "default_planning_request_adapters/CheckStartStateBounds",
        "default_planner_request_adapters/FixWorkspaceBounds",
        "belongs to ROS 2, and this file is for ROS 1",
    ),
    (2, MANAGER2, "moveit_fake_controller_manager", "my_controller_manager", "belongs to ROS 1, and this file is"),
    (
        1,
        '<node pkg="controller_manager" type="{}" name="s" args="arm"/>',
        "spawner.py",
        "spawner",
        "`spawner.py` in ROS 1; did you mean `spawner`?",
    ),
    (2, '<arg name="gui" {}="true"/>', "value", "default", "<arg> has no attribute `value` in ROS 2; did you mean"),
    (1, NODELET.format("{}") + MANAGER, "cameras", "manager", "no launch file starts the nodelet manager `cameras`"),
    (1, STATIC, "base_link world", "world base_link", "the virtual joint of the SRDF puts `base_link` below `world`"),
    (
        1,
        '<!-- moveit --><param name="$(arg robot_description){}" value="a"/>',
        "_semantics",
        "_semantic",
        "`_semantic`",
    ),
    (1, CONDITION, "$(arg gui)!=false", "$(eval arg('gui'))", CONDITION_TEXT),
    (1, CONDITION, "not $(arg gui)", "$(arg gui)", "because other text surrounds it; write `$(eval …)`"),
    (2, DRIVER.format("{}", "gps/fix"), "fixx", "fix", "`nmea_navsat_driver` has no topic `fixx`; did you mean `fix`?"),
    (2, MUX, "cmd_vel_unstamped", "reference_unstamped", "did you mean `drive/reference_unstamped`?"),
    (2, COMMAND, TEXT, f'{TEXT} type="str"', YAML_TEXT),
    (2, INCLUDE, "ign_args", "gz_args", "argument `ign_args` of gz_sim.launch.py is deprecated; write `gz_args`"),
]
CONTROLLERS = """controller_manager:
  ros__parameters:
    drive:
      type: ackermann_steering_controller/AckermannSteeringController
drive:
  ros__parameters:
    use_stamped_vel: false
twist_mux:
  ros__parameters:
    topics:
      joy: {topic: joy_vel, timeout: 0.5, priority: 10}
"""


@pytest.mark.parametrize(("version", "text", "wrong", "right", "words"), CASES)
def test_a_wrong_name_is_reported(tmp_path: Path, version: int, text: str, wrong: str, right: str, words: str) -> None:
    build = "catkin" if version == 1 else "ament_cmake"
    manifest = f"<name>arm</name><version>1.0.0</version><buildtool_depend>{build}</buildtool_depend>"
    (tmp_path / "package.xml").write_text(f'<package format="3">{manifest}</package>')
    (tmp_path / "arm.urdf").write_text(ROBOT)
    (tmp_path / "launch").mkdir()
    (tmp_path / "config").mkdir()
    if version == 1:
        (tmp_path / "config/arm.srdf").write_text(SRDF)
    else:
        (tmp_path / "config/drive.yaml").write_text(CONTROLLERS)
    for name, count in ((wrong, 1), (right, 0)):
        path = tmp_path / "launch" / ("arm.launch" if version == 1 else "arm.launch.xml")
        path.write_text(f"<launch>{text.replace('{}', name)}</launch>")
        assert sum(words in each.text for each in lint(tmp_path)) == count


MECANUM = """controller_manager:
  ros__parameters:
    base:
      type: mecanum_drive_controller/MecanumDriveController
base:
  ros__parameters:
    reference_timeout: 0.5
"""


@pytest.mark.parametrize(
    ("setting", "topic", "count"),
    [
        ("", "reference", 0),
        ("", "reference_unstamped", 1),
        ("", "cmd_vel", 1),
        ("    use_stamped_vel: false\n", "reference_unstamped", 0),
        ("    use_stamped_vel: false\n", "reference", 1),
    ],
)
def test_a_mecanum_controller_reads_one_of_two_topics(tmp_path: Path, setting: str, topic: str, count: int) -> None:
    manifest = "<name>arm</name><version>1.0.0</version><buildtool_depend>ament_cmake</buildtool_depend>"
    (tmp_path / "package.xml").write_text(f'<package format="3">{manifest}</package>')
    (tmp_path / "arm.urdf").write_text(ROBOT)
    (tmp_path / "base.yaml").write_text(MECANUM + setting)
    node = f'<node pkg="twist_mux" exec="twist_mux"><remap from="cmd_vel_out" to="/base/{topic}"/></node>'
    (tmp_path / "base.launch.xml").write_text(f"<launch>{node}</launch>")
    assert sum("no node subscribes" in each.text for each in lint(tmp_path)) == count


@pytest.mark.parametrize(
    ("name", "started", "message"),
    [
        ("GAZEBO_MODEL_PATH", "ros_gz_sim", "only Gazebo classic reads `GAZEBO_MODEL_PATH`"),
        ("GZ_SIM_RESOURCE_PATH", "ros_gz_sim", ""),
        ("IGN_GAZEBO_RESOURCE_PATH", "ros_gz_sim", ""),
        ("IGN_GAZEBO_RESOURCE_PATH", "gazebo_ros", "Gazebo classic does not read `IGN_GAZEBO_RESOURCE_PATH`"),
        ("GAZEBO_MODEL_PATH", "gazebo_ros", ""),
        ("GAZEBO_MODEL_PATH", "rviz2", ""),
        ("GZ_SIM_RESOURSE_PATH", "ros_gz_sim", "unknown environment variable `GZ_SIM_RESOURSE_PATH`"),
        ("CART_RESOURCE_PATH", "ros_gz_sim", ""),
        ('GAZEBO_MODEL_PATH" value="a"/><set_env name="GZ_SIM_RESOURCE_PATH', "ros_gz_sim", ""),
    ],
)
def test_environment_variables(tmp_path, monkeypatch, name, started, message):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "cart.urdf").write_text('<robot name="cart"><link name="base"/></robot>')
    (tmp_path / "package.xml").write_text("<package><name>cart</name></package>")
    include = f'<include file="$(find-pkg-share {started})/launch/start.launch.py"/>'
    (tmp_path / "cart.launch.xml").write_text(f'<launch>\n<set_env name="{name}" value="a"/>\n{include}\n</launch>\n')
    found = [one.message.partition(";")[0] for one in lint(tmp_path / "cart.urdf") if one.code == "L104"]
    assert found == ([message] if message else [])
