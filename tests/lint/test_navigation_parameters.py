"""Defects of the parameters of Nav2, robot_localization and sensor controllers, and correct files next to each."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfkit.lint import lint

ROBOT = """<robot name="cart">
  <link name="base_link"/>
  <link name="imu_link"/>
  <joint name="imu_joint" type="fixed"><parent link="base_link"/><child link="imu_link"/></joint>
  <ros2_control name="cart" type="system">
    <hardware><plugin>mock_components/GenericSystem</plugin></hardware>
    <sensor name="imu"><state_interface name="orientation.x"/></sensor>
  </ros2_control>
</robot>
"""
MANIFEST = """<package format="3">
  <name>cart</name>
  <version>1.0.0</version>
  <description>A cart.</description>
  <maintainer email="cart@example.com">The maintainers</maintainer>
  <license>MIT</license>
  <buildtool_depend>ament_cmake</buildtool_depend>
  <exec_depend>diff_drive_controller</exec_depend>
  <exec_depend>imu_sensor_broadcaster</exec_depend>
  <export><build_type>ament_cmake</build_type></export>
</package>
"""
CONTROLLERS = """controller_manager:
  ros__parameters:
    update_rate: 100
    imu_broadcaster:
      type: imu_sensor_broadcaster/IMUSensorBroadcaster

imu_broadcaster:
  ros__parameters:
    sensor_name: imu
    frame_id: imu_link
"""
FILTER = """ekf_filter_node:
  ros__parameters:
    frequency: 30.0
    map_frame: map
    odom_frame: odom
    base_link_frame: base_link
    world_frame: odom
    imu0: imu_broadcaster/imu
    imu0_differential: true
"""
ROS1_FILTER = """frequency: 30
map_frame: map
odom_frame: odom
base_link_frame: base_link
world_frame: odom
imu0: imu
imu0_relative: true
two_d_mode: true
"""
NEXT = "\n                  "
MAP = """image: room.pgm
mode: trinary
resolution: 0.05
origin: [0.0, 0.0, 0.0]
occupied_thresh: 0.65
free_thresh: 0.25
"""
NAVIGATION = """controller_server:
  ros__parameters:
    controller_frequency: 20.0
    controller_plugins: ["FollowPath"]
    goal_checker_plugins: ["precise"]
    precise:
      plugin: "nav2_controller::SimpleGoalChecker"
      xy_goal_tolerance: 0.25
    FollowPath:
      plugin: "nav2_regulated_pure_pursuit_controller::RegulatedPurePursuitController"

local_costmap:
  local_costmap:
    ros__parameters:
      width: 3
      plugins: ["obstacle_layer"]
      obstacle_layer:
        plugin: "nav2_costmap_2d::ObstacleLayer"
        observation_sources: front
        front:
          topic: /scan
          data_type: "LaserScan"

velocity_smoother:
  ros__parameters:
    feedback: "OPEN_LOOP"
    max_velocity: [0.5, 0.0, 1.0]
    max_decel: [-2.5, 0.0, -3.2]

amcl:
  ros__parameters:
    min_particles: 500
    max_particles: 2000
    laser_model_type: likelihood_field
    global_frame_id: map
    robot_model_type: "nav2_amcl::DifferentialMotionModel"
"""
MUX = """twist_mux:
  ros__parameters:
    topics:
      keys:
        topic: key_vel
        timeout: 0.5
        priority: 100
"""
SLAM = """slam_toolbox:
  ros__parameters:
    mode: mapping
    solver_plugin: solver_plugins::CeresSolver
    resolution: 0.05
    use_scan_matching: true
    throttle_scans: 1
"""
FILES = {
    "controllers": CONTROLLERS,
    "filter": FILTER,
    "navigation": NAVIGATION,
    "ros1": ROS1_FILTER,
    "map": MAP,
    "mux": MUX,
    "slam": SLAM,
}
SLAM_SOLVERS = "solver_plugins::CeresSolver, solver_plugins::G2oSolver, solver_plugins::SpaSolver"
MOTION = "nav2_amcl::DifferentialMotionModel"
DRIVE = """controller_manager:
  ros__parameters:
    wheels:
      type: diff_drive_controller/DiffDriveController
wheels:
  ros__parameters:
    left_wheel_names: []
    right_wheel_names: []
    enable_odom_tf: false
    pose_covariance_diagonal: [0.001, 0.001, 0.0, 0.0, 0.0, 0.01]
    linear.x.max_velocity: 1.0
"""
BEHAVIORS = """behavior_server:
  ros__parameters:
    behavior_plugins: ["spin"]
    spin:
      plugin: "nav2_behaviors::Spin"

amcl:
  ros__parameters:
    robot_model_type: "nav2_amcl::DifferentialMotionModel"

planner_server:
  ros__parameters:
    planner_plugins: ["GridBased"]
    GridBased:
      plugin: "nav2_navfn_planner::NavfnPlanner"
      use_astar: false

global_costmap:
  global_costmap:
    ros__parameters:
      footprint: "[[0.3, 0.2], [0.3, -0.2], [-0.3, 0.0]]"
"""
FILES |= {"drive": DRIVE, "behaviors": BEHAVIORS}

TELEOP = """axis_linear: 1
axis_angular: 0
enable_button: 4
enable_turbo_button: 5
"""
PLANNERS = """DWAPlannerROS:
  max_vel_x: 0.5
  min_vel_trans: 0.1
  max_vel_trans: 0.5
costmap:
  obstacle_range: 2.5
  raytrace_range: 3.0
"""
PAIR = """ekf_odom:
  ros__parameters:
    odom_frame: odom
    map_frame: map
    world_frame: odom
    base_link_frame: base_link
ekf_map:
  ros__parameters:
    odom_frame: odom
    map_frame: map
    world_frame: map
    base_link_frame: base_link
wheels:
  type: diff_drive_controller/DiffDriveController
  enable_odom_tf: false
"""
FILES |= {"teleop": TELEOP, "planners": PLANNERS}

BAD = [
    ("map", "[0.0, 0.0, 0.0]", "[0.0, 0.0]", "K971", 4, "`origin` of the map has 2 values"),
    ("map", "[0.0, 0.0, 0.0]", "[0.0, 0.0, 90.0]", "K971", 4, "yaw of the map is 90.0 rad"),
    ("map", "mode: trinary", "negate: 2", "K971", 2, "`negate` of the map is `2`"),
    ("teleop", "angular: 0", "angular: 1", "K971", 2, "`axis_linear` and `axis_angular` are both 1"),
    ("teleop", "button: 5", "button: 4", "K971", 4, "`enable_button` and `enable_turbo_button` are both 4"),
    ("planners", "0.1", "0.9", "K971", 3, "`min_vel_trans` is 0.9, more than `max_vel_trans`, 0.5"),
    ("planners", "vel_x: 0.5", "vel_x: 5.0", "K971", 2, "`max_vel_x` is 5, far more than `max_vel_trans`, 0.5"),
    ("planners", "3.0", "1.0", "K971", 6, "`obstacle_range` is 2.5, more than `raytrace_range`, 1"),
    ("controllers", "update_rate: 100", "update_rate: 100.0", "K974", 3, "write 100"),
    ("controllers", "\nimu_broadcaster:", "\nimu_sensor:", "K971", 7, "controller `imu_broadcaster` has no section"),
    ("controllers", "sensor_name: imu", "sensor_name: imuu", "K965", 9, "did you mean `imu`?"),
    ("controllers", "imu_link", "imu_lnk", "K961", 10, "did you mean `imu_link`?"),
    ("filter", "30.0", "30", "K974", 3, "`frequency` is the integer 30; write 30.0"),
    ("filter", "world_frame: odom", "world_frame: base", "K971", 7, "neither `map_frame` nor `odom_frame`"),
    ("filter", "imu_broadcaster/imu", "imu_brodcaster/imu", "K971", 8, "did you mean `imu_broadcaster/imu`?"),
    ("filter", "imu0_differential", "imu0_diferential", "K971", 9, "did you mean `imu0_differential`?"),
    ("navigation", "\ncontroller_server", "\ncontoller_server", "L104", 1, "did you mean `controller_server`?"),
    ("navigation", "    FollowPath:", "    Followpath:", "K971", 9, "section `Followpath` is not in"),
    (
        "navigation",
        '["precise"]\n    precise:',
        '["general_goal_checker"]\n    goal_checker:',
        "K971",
        5,
        "lists `general_goal_checker`, which has no section; did you mean `goal_checker`?",
    ),
    ("navigation", '["precise"]', '["exact"]', "K971", 5, "`goal_checker_plugins` lists `exact`, which has no section"),
    (
        "navigation",
        "pursuit_controller::",
        "pursuit_controller/",
        "L104",
        10,
        "did you mean `nav2_regulated_pure_pursuit_controller::",
    ),
    ("navigation", "PursuitController", "PursuitControler", "L104", 10, "unknown plugin"),
    ("navigation", "xy_goal_tolerance", "xy_goal_tolerence", "L104", 8, "did you mean `xy_goal_tolerance`?"),
    ("navigation", "xy_goal_tolerance: 0.25", "xy_goal_tolerance: -0.25", "K971", 8, "it must be positive"),
    ("navigation", "20.0", "20", "K974", 3, "write 20.0"),
    ("navigation", "width: 3", "width: 3.0", "K974", 15, "write 3"),
    (
        "navigation",
        "sources: front",
        "sources: rear",
        "K971",
        19,
        "lists `rear`, which has no section with its `topic`",
    ),
    ("navigation", "/scan", "/sacn", "L104", 21, "did you mean `/scan`?"),
    ("navigation", '"LaserScan"', '"Laserscan"', "K971", 22, "did you mean `LaserScan`?"),
    ("navigation", '"OPEN_LOOP"', '"OPENLOOP"', "K971", 26, "did you mean `OPEN_LOOP`?"),
    ("navigation", "[0.5, 0.0, 1.0]", "[0.5, 1.0]", "K971", 27, "has 2 values"),
    ("navigation", "[-2.5, 0.0, -3.2]", "[2.5, 0.0, 3.2]", "K971", 28, "requires zero or negative values"),
    (
        "navigation",
        "pursuit_controller::",
        "pursuit::",
        "L104",
        10,
        "`nav2_regulated_pure_pursuit_controller::Regulated",
    ),
    ("navigation", "  local_costmap:\n    r", "  local_costmaps:\n    r", "L104", 13, "did you mean `local_costmap`?"),
    ("navigation", ": 500", ": 5000", "K971", 32, "`min_particles` is 5000, more than `max_particles`, 2000"),
    ("navigation", "likelihood", "likelyhood", "K971", 34, "did you mean `likelihood_field`?"),
    ("navigation", "_id: map", "_id: mpa", "K971", 35, "unknown frame `mpa`; did you mean `map`?"),
    ("filter", "imu0_differential", "imu_differential", "K971", 9, "did you mean `imu0_differential`?"),
    ("filter", "30.0", "0.0", "K971", 3, "`frequency` is 0; it must be positive"),
    ("ros1", "world_frame: odom", "world_frame: base", "K971", 5, "neither `map_frame` nor `odom_frame`"),
    (
        "filter",
        "    imu0_differential",
        (
            f"    imu0_config: [{'false, false, false,' + NEXT}true, true,{NEXT}{('true, true, true,' + NEXT) * 2}"
            "false, false, true]\n    imu0_differential"
        ),
        "K971",
        10,
        "`imu0_config` has 14 values; robot_localization requires 15",
    ),
    ("ros1", "imu0_relative", "imu0_relativ", "K971", 7, "did you mean `imu0_relative`?"),
    ("ros1", "two_d_mode", "two_d_mod", "L104", 8, "parameter `two_d_mod` of node `robot_localization`; did you mean"),
    ("map", "room.pgm", "roon.pgm", "K971", 1, "image `roon.pgm` of the map does not exist; did you mean `room.pgm`?"),
    ("map", "trinary", "trinery", "K971", 2, "unknown `mode` `trinery` of the map; did you mean `trinary`?"),
    (
        "map",
        "resolution: 0.05\norigin: [0.0, 0.0",
        "resolution: 0.5\norigin: [-0.5, -0.25",
        "K971",
        3,
        "`resolution` is 0.5 m per pixel, but `origin` is half of the image size for 0.05 m per pixel",
    ),
    ("map", "0.05", "0", "K971", 3, "`resolution` is 0 m; it must be positive"),
    ("drive", "tf: false", "tf: true", "K971", 9, "the filter in filter.yaml publishes the same transform"),
    ("drive", "[0.001, ", "[", "K971", 10, "has 5 values; it requires 6"),
    ("drive", "max_velocity", "max_velocty", "K962", 11, "did you mean `linear.x.max_velocity`?"),
    (
        "drive",
        "      type",
        "      typ",
        "K962",
        4,
        "unknown parameter `typ` of controller `wheels`; did you mean `type`?",
    ),
    (
        "behaviors",
        '      plugin: "nav2_behaviors::Spin"\n',
        "      yes: true\n",
        "K971",
        4,
        "whose section has no `plugin`",
    ),
    (
        "behaviors",
        "nav2_amcl::DifferentialMotionModel",
        "differential",
        "K971",
        9,
        "is from Galactic or earlier; write",
    ),
    ("behaviors", "use_astar", "use_atar", "L104", 16, "did you mean `use_astar`?"),
    ("behaviors", "0.0]]", "0.0]", "K971", 21, "`footprint` has 4 `[` and 3 `]`"),
    ("behaviors", ", [-0.3, 0.0]", "", "K971", 21, "`footprint` has 2 points; a polygon needs at least 3"),
    ("behaviors", "[-0.3, 0.0]", "[-0.3, x]", "K971", 21, "`footprint` is not a list of points"),
    ("map", "0.25", "0.75", "K971", 6, "`free_thresh` is 0.75, more than `occupied_thresh`, 0.65"),
    ("mux", "100", "300", "K971", 7, "`priority` is 300; twist_mux requires 0 to 255"),
    ("mux", "100", "-1", "K971", 7, "`priority` is -1; twist_mux requires 0 to 255"),
    ("mux", "0.5", "-0.5", "K971", 6, "`timeout` is -0.5; it must not be negative"),
    ("mux", "timeout", "timeuot", "K971", 6, "unknown parameter `timeuot` of twist_mux; did you mean `timeout`?"),
    ("mux", "        topic: key_vel\n", "", "K971", 4, "input `keys` of twist_mux lacks `topic`"),
    ("slam", "mapping", "maping", "K971", 3, "unknown `mode` `maping` of slam_toolbox; did you mean `mapping`?"),
    ("slam", "mapping", "x", "K971", 3, "unknown `mode` `x` of slam_toolbox; write `mapping` or `localization`"),
    (
        "slam",
        "solver_plugins::Ceres",
        "x",
        "K971",
        4,
        f"unknown `solver_plugin` `xSolver`; write one of {SLAM_SOLVERS}",
    ),
    ("slam", "0.05", "0.0", "K971", 5, "`resolution` is 0; it must be positive"),
    ("slam", "true", "maybe", "K971", 6, "`use_scan_matching` is `maybe`, which is neither true nor false"),
    ("slam", "true", '"true"', "K971", 6, '`use_scan_matching` is "true", a quoted string; write true'),
    ("slam", "scans: 1", "scans: -1", "K971", 7, "`throttle_scans` is -1; it must be positive"),
    (
        "navigation",
        "Differ",
        "Difer",
        "K971",
        36,
        f"unknown `robot_model_type` `{MOTION.replace('ff', 'f')}`; did you mean `{MOTION}`?",
    ),
    (
        "navigation",
        "OPEN",
        "NO",
        "K971",
        26,
        "unknown `feedback` `NO_LOOP` of velocity_smoother; did you mean `OPEN_LOOP`?",
    ),
    ("navigation", '"OPEN_LOOP"', "x", "K971", 26, "`x` of velocity_smoother; write `OPEN_LOOP` or `CLOSED_LOOP`"),
    (
        "navigation",
        '"LaserScan"',
        "x",
        "K971",
        22,
        "unknown `data_type` `x` of an observation source; write `LaserScan` or `PointCloud2`",
    ),
    (
        "navigation",
        "[-2.5, 0.0, -3.2]",
        "[-2.5, 0.0, 3.2]",
        "K971",
        28,
        "`max_decel` has 3.2; velocity_smoother requires zero or negative values",
    ),
    (
        "navigation",
        "[0.5, 0.0, 1.0]",
        "[0.5]",
        "K971",
        27,
        "`max_velocity` has 1 values; velocity_smoother requires 3 (x, y, rotation) or 6",
    ),
    (
        "filter",
        "world_frame: odom",
        "world_frame: x",
        "K971",
        7,
        "`world_frame` is `x`, which is neither `map_frame` nor `odom_frame`; write `map` or `odom`",
    ),
    (
        "behaviors",
        '"[[0.3, 0.2], [0.3, -0.2], [-0.3, 0.0]]"',
        "[[0.3, 0.2], [0.3, -0.2], [-0.3, 0.0]]",
        "K971",
        21,
        "`footprint` is a list of lists, which ROS 2 rejects",
    ),
]

GOOD = [
    ("navigation", "/scan", "/front/points"),
    ("navigation", "nav2_costmap_2d::ObstacleLayer", "my_layers::ObstaclesLayer"),
    ("navigation", '["FollowPath"]', "$(var plugins)"),
    ("navigation", "nav2_costmap_2d::ObstacleLayer", "my_recoveries::Spin"),
    ("navigation", "likelihood_field", "beam"),
    ("navigation", "local_costmap:\n  local_costmap", "rear_costmap:\n  rear_costmap"),
    ("navigation", "max_velocity: [0.5, 0.0, 1.0]", "max_velocity: [0.5, 0.0, 0.0, 0.0, 0.0, 1.0]"),
    ("filter", "world_frame: odom", "world_frame: $(var world)"),
    ("behaviors", "use_astar", "use_my_star"),
    ("drive", "linear.x.max_velocity: 1.0", "linear.x.max_deceleration: -1.0"),
    ("behaviors", '      plugin: "nav2_navfn_planner::NavfnPlanner"\n', ""),
    ("filter", "imu_broadcaster/imu", "imu/data"),
    ("ros1", "imu0: imu", "imu0: imu/data"),
    ("map", "room.pgm", "/maps/room.pgm"),
    ("map", "origin: [0.0, 0.0", "origin: [-0.5, -0.25"),
    ("map", "origin: [0.0, 0.0", "origin: [-0.1, -0.25"),
    ("map", "trinary", "scale"),
    ("mux", "priority: 100", "priority: 255"),
    ("mux", "priority: 100", "priority: 0"),
    ("mux", "timeout: 0.5", "timeout: 0.0"),
    ("slam", "mapping", "localization"),
    ("slam", "true", "off"),
    ("slam", "Ceres", "G2o"),
    ("navigation", MOTION, "my_robot::MotionModel"),
    ("navigation", "OPEN_LOOP", "CLOSED_LOOP"),
    ("navigation", "LaserScan", "PointCloud2"),
    ("navigation", "width: 3", "robot_radius: 0.0"),
]


NO_NUMBERS = [
    ("navigation", "max_velocity: [0.5", "max_velocity: [1.2.3"),
    ("navigation", "width: 3", "robot_radius: .inf"),
]
"""Values that Python cannot convert to a number: no rule may fail by them."""


def findings(folder: Path, name: str, old: str, new: str) -> list[tuple[str, int, str]]:
    (folder / "config").mkdir()
    (folder / "package.xml").write_text(MANIFEST)
    (folder / "cart.urdf").write_text(ROBOT)
    for file, text in FILES.items():
        before = f"\n{text}"
        assert file != name or old in before
        changed = before.replace(old, new, 1)[1:] if file == name else text
        (folder / f"config/{file}.yaml").write_text(changed)
    (folder / "config/room.pgm").write_bytes(b"P5\n# a room\n20 10\n255\n" + bytes(200))
    found = lint(folder)
    return [(one.code, one.line, one.message) for one in found if one.file.endswith(".yaml")]


@pytest.mark.parametrize(("name", "old", "new", "code", "line", "message"), BAD)
def test_each_defect_is_one_finding_at_its_line(tmp_path, name, old, new, code, line, message):
    [(found, at, text)] = findings(tmp_path, name, old, new)
    assert (found, at) == (code, line)
    assert message in text


@pytest.mark.parametrize(("name", "old", "new"), [("navigation", "width", "width"), *NO_NUMBERS, *GOOD])
def test_correct_parameters_are_silent(tmp_path, name, old, new):
    assert findings(tmp_path, name, old, new) == []


@pytest.mark.parametrize(
    ("flag", "messages"), [("true", []), ("false", ["no node publishes the transform from the odometry"])]
)
def test_some_node_publishes_the_transform_of_the_odometry(tmp_path: Path, flag: str, messages: list[str]) -> None:
    (tmp_path / "package.xml").write_text(MANIFEST)
    (tmp_path / "cart.urdf").write_text(ROBOT)
    text = PAIR.replace("ros__parameters:", f"ros__parameters:\n    publish_tf: {flag}", 1)
    (tmp_path / "pair.yaml").write_text(text)
    found = [one.message for one in lint(tmp_path) if one.file.endswith(".yaml")]
    assert [message[:49] for message in found] == messages


def test_filters_that_both_publish_the_global_transform_are_one_finding(tmp_path: Path) -> None:
    (tmp_path / "package.xml").write_text(MANIFEST)
    (tmp_path / "cart.urdf").write_text(ROBOT)
    assert PAIR.count("world_frame: odom") == 1
    (tmp_path / "pair.yaml").write_text(PAIR.replace("world_frame: odom", "world_frame: map"))
    [found] = [one.message for one in lint(tmp_path) if one.code == "K983"]
    assert "publish the same transform" in found


GROUPS = """teleop_twist_joy:
  enable_button: 4
  axis_linear:
    x: 1
  scale_linear:
    x: 0.4
  axis_angular:
    yaw: 0
"""


def test_axes_of_a_joystick_in_ros1_are_numbers_or_groups(tmp_path: Path) -> None:
    (tmp_path / "package.xml").write_text(
        "<package format='2'><name>cart</name><version>1.0.0</version><description>A cart.</description>"
        "<maintainer email='test@example.org'>tester</maintainer><license>MIT</license>"
        "<buildtool_depend>catkin</buildtool_depend><exec_depend>teleop_twist_joy</exec_depend></package>"
    )
    (tmp_path / "launch").mkdir()
    (tmp_path / "launch/joy.launch").write_text(
        "<launch><rosparam command='load' file='$(find cart)/joy.yaml'/>"
        "<node pkg='teleop_twist_joy' type='teleop_node' name='teleop_twist_joy'/></launch>"
    )
    (tmp_path / "joy.yaml").write_text(GROUPS)
    assert [one for one in lint(tmp_path) if one.file.endswith(".yaml")] == []
    (tmp_path / "joy.yaml").write_text(GROUPS.replace("button: 4", "button: four"))
    assert [one.code for one in lint(tmp_path) if one.file.endswith(".yaml")] == ["K971"]
