"""Defects of the parameters of well-known nodes of ROS 2: their types, names, plugins, inputs and frames."""

from __future__ import annotations

import pytest

from tests.lint.test_navigation_parameters import MANIFEST, ROBOT
from urdfkit.lint import lint

FILES = {
    "joystick": """teleop_twist_joy_node:
  ros__parameters:
    require_enable_button: true
    enable_button: 4
    enable_turbo_button: -1
    axis_linear:
      x: 1
    axis_angular: {yaw: 0}
    scale_linear:
      x: 0.5
joy_node:
  ros__parameters:
    autorepeat_rate: 20.0
""",
    "mux": """twist_mux:
  ros__parameters:
    topics:
      keys:
        topic: cmd_vel_keys
        timeout: 0.5
        priority: 100
      stick:
        topic: cmd_vel_stick
        timeout: 0.5
        priority: 10
    locks:
      e_stop:
        topic: e_stop
        timeout: 0.0
        priority: 255
""",
    "monitor": """collision_monitor:
  ros__parameters:
    cmd_vel_in_topic: cmd_vel_smoothed
    cmd_vel_out_topic: cmd_vel
    polygons: [Stop]
    Stop:
      type: polygon
      points: "[[0.3, 0.2], [0.3, -0.2], [0.0, -0.2], [0.0, 0.2]]"
      action_type: stop
      min_points: 4
    observation_sources: [front]
    front:
      type: scan
      topic: /scan
twist_mux:
  ros__parameters:
    topics:
      monitor: {topic: cmd_vel, timeout: 0.5, priority: 10}
""",
    "behaviors": """amcl:
  ros__parameters:
    odom_frame_id: odom
    global_frame_id: map
    robot_model_type: nav2_amcl::DifferentialMotionModel
controller_server:
  ros__parameters:
    controller_plugins: [FollowPath]
    FollowPath:
      plugin: dwb_core::DWBLocalPlanner
      max_vel_y: 0.0
      max_vel_theta: 1.0
      decel_lim_x: -2.5
      critics: [PathDist, GoalDist]
      PathDist.scale: 32.0
behavior_server:
  ros__parameters:
    local_frame: odom
    behavior_plugins: [spin, wait]
    spin:
      plugin: nav2_behaviors::Spin
    wait:
      plugin: nav2_behaviors::Wait
local_costmap:
  local_costmap:
    ros__parameters:
      global_frame: odom
      plugins: [obstacle_layer, inflation_layer]
      obstacle_layer:
        plugin: nav2_costmap_2d::ObstacleLayer
        observation_sources: front
        front: {topic: /scan, data_type: LaserScan, obstacle_max_range: 2.5}
      inflation_layer:
        plugin: nav2_costmap_2d::InflationLayer
      static_layer:
        plugin: nav2_costmap_2d::StaticLayer
""",
    "groups_of_lists": """gpio_controller:
  ros__parameters:
    command_interfaces:
      flange:
        - interfaces:
          - analog_output
          - digital_output
""",
    "filter": """ekf_filter_node:
  ros__parameters:
    frequency: 30.0
    map_frame: map
    odom_frame: odom
    base_link_frame: base_link
    world_frame: odom
    imu0: imu/data
    imu0_config: [false, false, false, false, false, true, false, false, false, false, false, true, false, false, false]
""",
}

BAD = [
    (
        "filter",
        "world_frame: odom",
        "world_frame: map",
        "K983",
        7,
        "no input measures x and y; write the odometry frame",
    ),
    ("joystick", "x: 1", "x: 1.0", "K974", 7, "`axis_linear.x` is the number with a decimal point 1.0; write 1"),
    (
        "joystick",
        "enable_button: 4",
        "enable_button: -4",
        "K971",
        4,
        "`enable_button` is -4; it must be between 0 and 63",
    ),
    ("joystick", "enable_button: 4", "deadman_button: 4", "K971", 4, "did you mean `enable_button`?"),
    ("joystick", "axis_linear:\n      x: 1", "axis_linear: 1", "K971", 6, "`axis_linear` is a group; write `x` below"),
    ("joystick", "yaw: 0", "z: 0", "K971", 8, "`axis_angular` has no `z`; write `yaw`, `pitch` or `roll`"),
    ("joystick", "yaw: 0", "yaw: 1", "K971", 8, "`axis_linear.x` and `axis_angular.yaw` are both 1"),
    ("joystick", "x: 0.5", 'x: "0.5"', "K971", 10, '`scale_linear.x` is "0.5", a quoted string'),
    ("joystick", "20.0", "20", "K974", 13, "`autorepeat_rate` is the integer 20; write 20.0"),
    (
        "mux",
        "priority: 100",
        "priority: 10",
        "K971",
        11,
        "inputs `keys` and `stick` of twist_mux have the same priority",
    ),
    (
        "mux",
        "keys:\n        topic: cmd_vel_keys\n        timeout: 0.5\n        priority: 100\n      stick:",
        "goals:\n        topic: cmd_vel_nav\n        timeout: 0.5\n        priority: 100\n      joystick:",
        "K971",
        11,
        "input `joystick` has the priority 10, lower than `goals`, so an operator cannot interrupt it",
    ),
    ("mux", "priority: 100", "priority: high", "K971", 7, "`topics.keys.priority` is `high`, which is not a number"),
    ("mux", "priority: 100", "priority: 100.0", "K974", 7, "write 100"),
    ("mux", "topics:", "topic:", "K971", 3, "`twist_mux` has no parameter `topic`; did you mean `topics`?"),
    ("mux", "      e_stop:", "    e_stop:", "K971", 13, "`e_stop` belongs in `locks`, which is empty; indent it"),
    ("joystick", "      x: 1", "    x: 1", "K971", 7, "`x` belongs in `axis_linear`, which is empty; indent it"),
    ("mux", "priority: 255", "priority: 50", "K971", 16, "lock `e_stop` has the priority 50 and does not stop"),
    (
        "monitor",
        "cmd_vel_out_topic: cmd_vel",
        "cmd_vel_out_topic: cmd_vel_smoothed",
        "K971",
        4,
        "to which the node subscribes",
    ),
    (
        "monitor",
        "in_topic: cmd_vel_smoothed",
        "in_topic: cmd_vel_smooth",
        "K980",
        3,
        "did you mean `cmd_vel_smoothed`?",
    ),
    (
        "monitor",
        "out_topic: cmd_vel",
        "out_topic: cmd_vel_safe",
        "K980",
        4,
        "no node subscribes to the velocity commands on",
    ),
    ("monitor", "type: polygon", "type: rectangle", "K971", 7, "unknown type `rectangle` of `Stop`"),
    ("monitor", "action_type: stop", "action_type: halt", "K971", 9, "unknown `action_type` `halt` of `Stop`"),
    ("monitor", ", [0.0, 0.2]", "", "K971", 8, "`points` of `Stop` has 3 points; collision_monitor needs at least 4"),
    ("monitor", "[Stop]", "[Stop, Slow]", "K971", 5, "`polygons` lists `Slow`, which has no section"),
    ("monitor", "[front]", "[laser]", "K971", 11, "`observation_sources` lists `laser`, which has no section"),
    ("monitor", "type: scan", "type: laser", "K971", 13, "unknown type `laser` of `front`"),
    ("behaviors", "nav2_behaviors::Spin", "nav2_recoveries::Spin", "K971", 21, "write `nav2_behaviors::Spin`"),
    ("behaviors", "behavior_server:", "recoveries_server:", "K971", 16, "its name since Humble is `behavior_server`"),
    ("behaviors", "[spin, wait]", "[spin, backup, wait]", "K971", 19, "lists `backup`, which has no section with its"),
    ("behaviors", "[spin, wait]", "[spin]", "K971", 19, "`behavior_plugins` does not list `wait`"),
    ("behaviors", ", inflation_layer]", "]", "K971", 28, "`plugins` does not list `inflation_layer`"),
    ("behaviors", "plugin: nav2_costmap_2d::Static", "type: nav2_costmap_2d::Static", "K971", 36, "mean `plugin`?"),
    ("behaviors", "[FollowPath]", "FollowPath", "K971", 8, "`controller_plugins` is not a list; write it in brackets"),
    ("behaviors", "-2.5", "2.5", "K971", 13, "`decel_lim_x` is 2.5; DWB requires zero or negative values"),
    ("behaviors", "PathDist.scale", "PathDst.scale", "K971", 15, "`critics` does not list `PathDst`"),
    ("behaviors", "max_vel_theta", "max_rot_vel", "K971", 12, "did you mean `max_vel_theta`?"),
    ("behaviors", "obstacle_max_range", "obstacle_range", "K971", 32, "did you mean `obstacle_max_range`?"),
    ("behaviors", "Differential", "Omni", "K982", 5, "but the controller does not drive sideways"),
    ("behaviors", "global_frame: odom", "global_frame: map", "K971", 27, "`local_frame` of behavior_server is `odom`"),
    (
        "behaviors",
        "d: odom\n    global_frame_id: map",
        "d: map\n    global_frame_id: odom",
        "K971",
        3,
        "swap them",
    ),
    ("filter", "frequency", "rate", "K971", 3, "has no parameter `rate`; did you mean `frequency`?"),
    (
        "filter",
        "imu0_config",
        "imu1_config",
        "K971",
        9,
        "`imu1_config` has no effect, because the topic `imu1` is not set",
    ),
    ("filter", "imu0_config", "imu0_configuration", "K971", 9, "did you mean `imu0_config`?"),
]


def findings(folder, name, old, new):
    (folder / "config").mkdir()
    (folder / "package.xml").write_text(MANIFEST)
    (folder / "cart.urdf").write_text(ROBOT)
    assert old in FILES[name]
    (folder / f"config/{name}.yaml").write_text(FILES[name].replace(old, new, 1))
    return [(one.code, one.line, one.message) for one in lint(folder) if one.file.endswith(".yaml")]


@pytest.mark.parametrize(("name", "old", "new", "code", "line", "message"), BAD)
def test_each_defect_has_a_finding_at_its_line(tmp_path, name, old, new, code, line, message):
    first, *others = findings(tmp_path, name, old, new)
    assert first[:2] == (code, line)
    assert message in first[2]
    assert len(others) <= new.count("\n")


def test_an_empty_group_before_another_parameter_has_no_finding(tmp_path):
    lock = FILES["mux"].partition("    locks:\n")[2]
    assert findings(tmp_path, "mux", f"locks:\n{lock}", "locks:\n    use_stamped: true\n") == []


@pytest.mark.parametrize("name", FILES)
def test_correct_parameters_have_no_finding(tmp_path, name):
    assert findings(tmp_path, name, "ros__parameters", "ros__parameters") == []


ROS1 = """<launch>
  <node pkg="amcl" type="amcl" name="amcl">
    <param name="odom_model_type" value="diff"/>
    <param name="min_particles" value="500"/>
    <param name="max_particles" value="5000"/>
    <param name="laser_max_range" value="12.0"/>
    <param name="odom_frame_id" value="odom"/>
    <param name="global_frame_id" value="map"/>
  </node>
</launch>
"""


@pytest.mark.parametrize(
    ("old", "new", "line", "message"),
    [
        ('"diff"', '"omni"', 0, ""),
        ('"diff"', '"differential"', 3, "unknown `odom_model_type` `differential` of amcl"),
        ('"500"', '"50000"', 4, "`min_particles` is 50000, more than `max_particles`, 5000"),
        ('"12.0"', '"12m"', 6, "`laser_max_range` is `12m`, which is not a number"),
        (
            '"odom"/>\n    <param name="global_frame_id" value="map"',
            '"map"/>\n    <param name="global_frame_id" value="odom"',
            7,
            "swap",
        ),
        ("odom_frame_id", "base_frame_id", 0, ""),
        (
            '    <param name="global_frame_id" value="map"/>',
            '    <param name="base_frame_id" value="odom"/>',
            8,
            "`odom_frame_id` and `base_frame_id` are both `odom`",
        ),
        ('value="map"', 'value="odom"', 8, "`global_frame_id` and `odom_frame_id` are both `odom`"),
        ("odom_frame_id", "odom_frame", 7, "`amcl` has no parameter `odom_frame`; did you mean `odom_frame_id`?"),
    ],
)
def test_parameters_in_launch_files_of_ros_1(tmp_path, old, new, line, message):
    manifest = MANIFEST.replace("ament_cmake</build", "catkin</build").replace("diff_drive_controller", "amcl")
    (tmp_path / "package.xml").write_text(manifest.replace("<export><build_type>catkin</build_type></export>", ""))
    (tmp_path / "cart.urdf").write_text(ROBOT)
    (tmp_path / "launch").mkdir()
    launch_file = tmp_path / "launch/nodes.launch"
    launch_file.write_text(ROS1.replace(old, new, 1))
    found = [one for one in lint(tmp_path) if one.code == "L110"]
    assert [one.line for one in found] == ([line] if line else [])
    assert all(message in one.message for one in found)


@pytest.mark.parametrize(
    ("file", "message"),
    [
        ("DWAPlannerROS: {max_trans_vel: 0.5}", "`DWAPlannerROS` has no parameter `max_trans_vel`"),
        ("plugins: [{name: a, type: 'costmap_2d/StaticLayer'}]", "did you mean `costmap_2d::StaticLayer`?"),
        ("base_global_planner: nav2_navfn_planner/NavfnPlanner", "belongs to Nav2, which ROS 1 does not have"),
    ],
)
def test_planners_and_layers_of_ros_1(tmp_path, file, message):
    (tmp_path / "config").mkdir()
    (tmp_path / "package.xml").write_text(MANIFEST)
    (tmp_path / "cart.urdf").write_text(ROBOT)
    (tmp_path / "config/planner.yaml").write_text(f"{file}\n")
    assert [message in one.message for one in lint(tmp_path) if one.file.endswith(".yaml")] == [True]
