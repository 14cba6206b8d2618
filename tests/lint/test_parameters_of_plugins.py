"""Parameters of plugins, controllers and further nodes: types, lengths, names, levels and signs."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfkit.description.xml.source import Source
from urdfkit.lint import lint
from urdfkit.lint.facts.control.parameter_values import value_defects
from urdfkit.lint.facts.control.yaml_tree import documents, nodes
from urdfkit.lint.facts.moveit.settings import integer_limits
from urdfkit.lint.facts.navigation.defects import navigation_defects
from urdfkit.lint.facts.navigation.sections import costmaps_not_nested, nodes_without_parameters, outside_parameters
from urdfkit.lint.facts.parameters.ranges import out_of_order, out_of_range
from urdfkit.lint.facts.plugins.typed_groups import typed_defects, typed_groups, wrong_numbers_of_plugins

CONTROLLER = """controller_server:
  ros__parameters:
    controller_frequency: 20.0
    controller_plugins: [FollowPath]
    FollowPath:
      plugin: nav2_mppi_controller::MPPIController
      time_steps: 56
      vx_max: 0.5
      az_max: 3.5
      prune_distance: 1.7
      visualize: false
      critics: [GoalCritic]
      GoalCritic:
        enabled: true
        cost_power: 1
        cost_weight: 5.0
        threshold_to_consider: 1.4
    general_goal_checker:
      plugin: nav2_controller::SimpleGoalChecker
      xy_goal_tolerance: 0.25
      yaw_goal_tolerance: 0.25
"""
DOCKING = """docking_server:
  ros__parameters:
    undock_linear_tolerance: 0.05
    dock_plugins: [charger]
    charger:
      plugin: opennav_docking::SimpleChargingDock
      staging_x_offset: -0.7
      docking_threshold: 0.05
    docks: [home]
    home:
      type: charger
      pose: [1.0, 2.0, 0.0]
"""
ADMITTANCE = """controller_manager:
  ros__parameters:
    force_controller:
      type: admittance_controller/AdmittanceController
force_controller:
  ros__parameters:
    joints: [shoulder, elbow]
    admittance:
      selected_axes: [true, true, true, false, false, false]
      mass: [3.0, 3.0, 3.0, 1.0, 1.0, 1.0]
"""
MECANUM = """controller_manager:
  ros__parameters:
    drive:
      type: mecanum_drive_controller/MecanumDriveController
drive:
  ros__parameters:
    reference_timeout: 0.5
    kinematics:
      base_frame_offset: {x: 0.0, y: 0.0, theta: 0.0}
      wheels_radius: 0.08
"""
CLOUD = """cloud_to_scan:
  ros__parameters:
    min_height: -0.2
    max_height: 1.0
    angle_min: -1.0
    angle_max: 1.0
    range_max: 6.0
    use_inf: true
"""
INVERTED = """cloud_to_scan:
  ros__parameters:
    min_height: -0.4
    max_height: -0.1
    angle_min: 3.14
    angle_max: -3.14
    angle_increment: -0.01
amcl:
  ros__parameters:
    pf_z: 2.33
    pf_err: 0.05
    recovery_alpha_fast: 0.0
    sigma_hit: 0.2
"""
"""A slice of points below the sensor, an inverted lidar (sensor_msgs/LaserScan), a quantile above 1 (AMCL of Nav2)."""
ROS1 = """TebLocalPlannerROS:
  max_vel_x: 0.5
  acc_lim_x: 1
  weight_obstacle: 50
  no_inner_iterations: 5
  teb_autosize: true
"""


def messages(text: str) -> list[str]:
    """Return the messages for a YAML file."""
    source = Source("parameters.yaml", text)
    found = [
        message
        for _, message in (*typed_defects(source), *outside_parameters(source), *nodes_without_parameters(source))
    ]
    return found + [f"{name}: {right}" for _, name, right in wrong_numbers_of_plugins(source)]


@pytest.mark.parametrize("text", [CONTROLLER, DOCKING, ADMITTANCE, MECANUM, CLOUD, INVERTED, ROS1])
def test_correct_parameters_have_no_finding(text: str) -> None:
    assert list(typed_groups(Source("parameters.yaml", text)))
    assert messages(text) == []


def test_a_minimum_above_the_maximum_may_be_right(tmp_path: Path) -> None:
    (tmp_path / "package.xml").write_text('<package format="3"><name>p</name></package>')
    (tmp_path / "config").mkdir()
    (tmp_path / "config" / "scan.yaml").write_text(INVERTED)
    (tmp_path / "robot.urdf").write_text('<robot name="r"><link name="base_link"/></robot>')
    assert [each.code for each in lint([tmp_path]) if each.file.endswith("scan.yaml")] == []


@pytest.mark.parametrize(
    ("text", "old", "new", "expected"),
    [
        (CONTROLLER, "az_max: 3.5", "az_max: 3", "az_max: 3.0"),
        (CONTROLLER, "cost_power: 1", "cost_power: 1.0", "GoalCritic.cost_power: 1"),
        (CONTROLLER, "visualize: false", 'visualize: "false"', '`visualize` is "false", a string; write false'),
        (CONTROLLER, "vx_max: 0.5", "vx_max: [0.5]", "`vx_max` is a list, but must be a number"),
        (CONTROLLER, "threshold_to_consider: 1.4", "threshold_to_consider: -1.4", "must not be negative"),
        (CONTROLLER, "prune_distance", "prune_distnace", "`MPPIController` has no parameter `prune_distnace`"),
        (CONTROLLER, "      yaw_goal", "    yaw_goal", "belongs in `general_goal_checker`; indent it"),
        (CLOUD, "    use_inf", "  use_inf", "next to `ros__parameters`, not below it"),
        (DOCKING, "[1.0, 2.0, 0.0]", "[1.0, 2.0]", "`home.pose` has 2 values; it must have 3"),
        (DOCKING, "docking_threshold: 0.05", "docking_thresold: 0.05", "did you mean `docking_threshold`"),
        (ADMITTANCE, "3.0, 1.0, 1.0, 1.0]", "3.0, 1.0, 1.0]", "`admittance.mass` has 5 values; it must have 6"),
        (CLOUD, "range_max: 6.0", "range_max: 6", "range_max: 6.0"),
        (ROS1, "weight_obstacle: 50", 'weight_obstacle: "50"', '`weight_obstacle` is "50", a quoted string'),
        (ROS1, "acc_lim_x: 1", "acc_lim_x: -1.5", "`acc_lim_x` is -1.5; it must not be negative"),
    ],
)
def test_a_wrong_parameter_is_reported(text: str, old: str, new: str, expected: str) -> None:
    assert text.count(old) == 1
    found = messages(text.replace(old, new))
    assert len(found) == 1
    assert expected in found[0]


def test_nodes_may_be_nested_in_a_namespace_with_parameters() -> None:
    nested = "robot:\n  ros__parameters: {rate: 5.0}\n  ekf:\n    ros__parameters: {frequency: 30.0}\n"
    assert messages(nested) == []


def test_integers_of_moveit_are_reported_where_it_reads_limits() -> None:
    text = """joint_limits:
  j1: {has_velocity_limits: true, max_velocity: 2, max_acceleration: 3.0, samples: 4}
  j2: {has_velocity_limits: false, max_velocity: 2}
  j3: {max_position: 1, min_position: -1}
cartesian_limits: {max_trans_vel: 1, order: 2}
"""
    found = [(value.line, name) for value, name in integer_limits(Source("joint_limits.yaml", text))]
    assert found == [(2, "max_velocity"), (4, "max_position"), (4, "min_position"), (5, "max_trans_vel")]


SMOOTHER = """velocity_smoother:
  ros__parameters:
    smoothing_frequency: 20.0
    max_velocity: [0.5, 0.0, 2.0]
    max_accel: [2.5, 0.0, 3.2]
    max_decel: [-2.5, 0.0, -3.2]
"""
SERVO = """publish_period: 0.02
move_group_name: arm
joint_limit_margin: 0.1
check_collisions: true
lower_singularity_threshold: 17.0
hard_stop_singularity_threshold: 30.0
"""


def test_an_acceleration_of_zero_is_reported_where_a_velocity_is_positive() -> None:
    assert list(navigation_defects(Source("smoother.yaml", SMOOTHER), frozenset())) == []
    wrong = Source("smoother.yaml", SMOOTHER.replace("[2.5, 0.0, 3.2]", "[0.0, 2.5, 3.2]"))
    ((place, message),) = navigation_defects(wrong, frozenset())
    assert (place.line, message) == (
        5,
        "`max_accel` has 0 where `max_velocity` is 0.5, so this velocity never changes",
    )


@pytest.mark.parametrize(
    ("text", "old", "new", "expected"),
    [
        (CONTROLLER, "az_max: 3.5", "az_max: 3500.0", "`az_max` is 3500 rad/s²"),
        (CLOUD, "range_max: 6.0", "range_max: 6000.0", "`range_max` is 6000 m"),
        (SERVO, "publish_period: 0.02", "publish_period: 20.0", "`publish_period` is 20 s"),
        (SERVO, "joint_limit_margin: 0.1", "joint_limit_margin: 5.7", "`joint_limit_margin` is 5.7"),
    ],
)
def test_values_of_another_unit_are_out_of_range(text: str, old: str, new: str, expected: str) -> None:
    text = text.replace("vx_max", "wz_max: 1.5\n      vx_max")
    assert list(out_of_range(nodes(Source("parameters.yaml", text)))) == []
    found = [message for _, message in out_of_range(nodes(Source("parameters.yaml", text.replace(old, new))))]
    assert [message.partition(",")[0] for message in found] == [expected]


def test_parameters_of_servo_are_known_without_a_node() -> None:
    assert messages(SERVO) == []
    (found,) = messages(SERVO.replace("move_group_name", "move_gruop_name"))
    assert "did you mean `move_group_name`" in found


def test_a_node_without_the_level_of_its_parameters_is_reported() -> None:
    (found,) = messages(CONTROLLER + "planner_server:\n  planner_plugins: [GridBased]\n")
    assert "node `planner_server` has no `ros__parameters`" in found


def test_parameters_next_to_an_empty_costmap_are_reported() -> None:
    text = "local_costmap:\n  local_costmap:\n  ros__parameters:\n    width: 4\n"
    ((place, _),) = costmaps_not_nested(Source("parameters.yaml", text))
    assert place.line == 1


@pytest.mark.parametrize(
    ("low", "high"), [("range_min", "range_max"), ("u_clamp_min", "u_clamp_max"), ("v_linear_min", "v_linear_max")]
)
def test_a_minimum_above_its_maximum_is_reported(low: str, high: str) -> None:
    assert list(out_of_order(Source("parameters.yaml", f"{low}: 0.1\n{high}: 0.5\n"))) == []
    ((_, message),) = out_of_order(Source("parameters.yaml", f"{low}: 0.5\n{high}: 0.1\n"))
    assert message == f"`{low}` is 0.5, more than `{high}`, 0.1"


def test_a_negative_variance_is_reported() -> None:
    (document,) = documents(Source("parameters.yaml", "pose_covariance_diagonal: [0.1, -0.1, 1.0, 1.0, 1.0, 0.1]"))
    ((_, message),) = value_defects(document, True)
    assert message == "`pose_covariance_diagonal` has -0.1; a variance must not be negative"


def test_the_topics_of_four_wheel_steering_are_those_of_ros1(tmp_path: Path) -> None:
    texts = {
        "package.xml": '<package format="2"><name>rover</name><version>1.0.0</version><description>Rover</description>'
        '<maintainer email="a@example.com">A</maintainer><license>MIT</license>'
        "<buildtool_depend>catkin</buildtool_depend><exec_depend>move_base</exec_depend>"
        "<exec_depend>four_wheel_steering_controller</exec_depend></package>",
        "rover.urdf": '<robot name="rover"><link name="base_link"/></robot>',
        "config/drive.yaml": "drive:\n  type: four_wheel_steering_controller/FourWheelSteeringController\n"
        "  wheel_base: 0.7\n  track: 0.6\n  wheel_radius: 0.2\n  enable_twist_cmd: true\n",
        "launch/move.launch": '<launch><rosparam file="$(find rover)/config/drive.yaml"/>\n'
        '<node pkg="move_base" type="move_base" name="move_base">\n<remap from="cmd_vel" to="/drive/cmd_vel"/>\n'
        '<remap from="odom" to="/drive/odom"/></node></launch>',
    }
    for name, text in texts.items():
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(text)
    assert [str(each.message) for each in lint(tmp_path / "rover.urdf") if each.code in ("K977", "K980", "K992")] == []
