"""Types, values and former names of the parameters of well-known ROS 2 nodes.

Sources (Humble to Rolling): ros-navigation/navigation2 (collision_monitor_node.cpp, polygon.cpp, source.cpp,
velocity_smoother.cpp, amcl_node.cpp, bt_action_server_impl.hpp, controller_server.cpp, costmap_2d_ros.cpp,
behavior_server.cpp), cra-ros-pkg/robot_localization (ros_filter.cpp, navsat_transform.cpp), SteveMacenski/slam_toolbox
(slam_toolbox_common.cpp), ros-teleop/twist_mux (twist_mux.cpp), ros2/teleop_twist_joy (teleop_twist_joy.cpp),
ros-drivers/joystick_drivers (joy.cpp).
"""

from __future__ import annotations

from functools import cache

_SCHEMAS = """
teleop_twist_joy_node teleop_twist_joy
require_enable_button inverted_reverse publish_stamped_twist: bool
enable_button: int 0 63
enable_turbo_button: int -1 63
axis_linear.x axis_linear.y axis_linear.z axis_angular.yaw axis_angular.pitch axis_angular.roll: int -1 63
scale_linear.x scale_linear.y scale_linear.z scale_linear_turbo.x scale_linear_turbo.y scale_linear_turbo.z: double
scale_angular.yaw scale_angular.pitch scale_angular.roll: double
scale_angular_turbo.yaw scale_angular_turbo.pitch scale_angular_turbo.roll: double
axis_linear scale_linear scale_linear_turbo: keys x y z
axis_angular scale_angular scale_angular_turbo: keys yaw pitch roll
frame: text

joy_node joy
device_id coalesce_interval_ms: int
device_name: text
deadzone autorepeat_rate: double
sticky_buttons: bool

twist_mux
use_stamped: bool
topics.*.topic locks.*.topic: text
topics.*.timeout locks.*.timeout: double
topics.*.priority locks.*.priority: int 0 255

ekf ukf
frequency sensor_timeout transform_time_offset transform_timeout history_length control_timeout: double
two_d_mode publish_tf print_diagnostics debug permit_corrected_publication publish_acceleration: bool
use_control stamped_control reset_on_time_jump predict_to_current_time smooth_lagged_data: bool
dynamic_process_noise_covariance disabled_at_startup: bool
odom*_config imu*_config pose*_config twist*_config: list bool
odom*_differential imu*_differential pose*_differential twist*_differential: bool
odom*_relative imu*_relative pose*_relative: bool
imu*_remove_gravitational_acceleration: bool
odom*_queue_size imu*_queue_size pose*_queue_size twist*_queue_size: int
map_frame odom_frame base_link_frame world_frame: text
process_noise_covariance initial_estimate_covariance: list double 15 225
acceleration_limits deceleration_limits acceleration_gains deceleration_gains: list double 6
control_config: list bool 6
initial_state: list double 15

navsat_transform navsat_transform_node
frequency delay magnetic_declination_radians yaw_offset transform_timeout: double
zero_altitude publish_filtered_gps use_odometry_yaw wait_for_datum broadcast_utm_transform use_local_cartesian: bool
broadcast_utm_transform_as_parent_frame broadcast_cartesian_transform: bool
broadcast_cartesian_transform_as_parent_frame: bool

slam_toolbox
debug_logging enable_interactive_mode use_scan_matching use_scan_barycenter do_loop_closing use_map_saver: bool
use_response_expansion map_start_at_dock restamp_tf: bool
position_covariance_scale yaw_covariance_scale: double
transform_publish_period map_update_interval resolution min_laser_range max_laser_range minimum_time_interval: double
transform_timeout tf_buffer_duration minimum_travel_distance minimum_travel_heading: double
scan_buffer_maximum_scan_distance link_match_minimum_response_fine link_scan_maximum_distance: double
loop_search_maximum_distance loop_match_maximum_variance_coarse loop_match_minimum_response_coarse: double
loop_match_minimum_response_fine correlation_search_space_dimension correlation_search_space_resolution: double
correlation_search_space_smear_deviation loop_search_space_dimension loop_search_space_resolution: double
loop_search_space_smear_deviation distance_variance_penalty angle_variance_penalty fine_search_angle_offset: double
coarse_search_angle_offset coarse_angle_resolution minimum_angle_penalty minimum_distance_penalty: double
throttle_scans scan_queue_size scan_buffer_size loop_match_minimum_chain_size stack_size_to_use: int
map_start_pose: list double 3
odom_frame map_frame base_frame scan_topic map_name map_file_name: text

collision_monitor
base_frame_id odom_frame_id cmd_vel_in_topic cmd_vel_out_topic state_topic: text
transform_tolerance source_timeout stop_pub_timeout: double
base_shift_correction enable_stamped_cmd_vel: bool
polygons observation_sources: list text

velocity_smoother
smoothing_frequency odom_duration velocity_timeout: double
scale_velocities enable_stamped_cmd_vel: bool
max_velocity min_velocity max_accel max_decel: list double 3 6
deadband_velocity: list double 3 6
odom_topic: text

amcl
alpha1 alpha2 alpha3 alpha4 alpha5 lambda_short laser_likelihood_max_dist laser_max_range laser_min_range: double
pf_err pf_z recovery_alpha_fast recovery_alpha_slow save_pose_rate sigma_hit transform_tolerance: double
update_min_a update_min_d z_hit z_max z_rand z_short beam_skip_distance beam_skip_threshold: double
beam_skip_error_threshold initial_pose.x initial_pose.y initial_pose.z initial_pose.yaw: double
initial_pose: keys x y z yaw
max_beams max_particles min_particles resample_interval: int
set_initial_pose always_reset_initial_pose tf_broadcast do_beamskip first_map_only: bool
base_frame_id odom_frame_id global_frame_id scan_topic map_topic robot_model_type: text

bt_navigator
bt_loop_duration default_server_timeout wait_for_service_timeout: int
transform_tolerance filter_duration: double
plugin_lib_names navigators: list text

controller_server
controller_plugins goal_checker_plugins progress_checker_plugins: list text
controller_frequency failure_tolerance min_x_velocity_threshold min_y_velocity_threshold: double
min_theta_velocity_threshold: double
*.vx_samples *.vy_samples *.vtheta_samples: int
*.critics: list text

planner_server
planner_plugins: list text
expected_planner_frequency: double

smoother_server
smoother_plugins: list text

behavior_server
behavior_plugins: list text
cycle_frequency simulate_ahead_time max_rotational_vel min_rotational_vel rotational_acc_lim: double
transform_tolerance: double

waypoint_follower
loop_rate wait_at_waypoint.waypoint_pause_duration: int
stop_on_failure: bool

local_costmap global_costmap
plugins filters: list text
*.observation_sources: text
width height: int

lifecycle_manager lifecycle_manager_navigation lifecycle_manager_localization
node_names: list text
autostart: bool
bond_timeout: double
"""
"""Names of nodes, then lines of parameters with their type; lists with the numbers of their values.

``keys`` are the only parameters that a group has. ``*`` is a part of a name. Integers have their least and greatest
value.
"""

_RENAMED = """
teleop_twist_joy_node teleop_twist_joy|deadman_button deadman enable_btn=enable_button
teleop_twist_joy_node teleop_twist_joy|turbo_button turbo_enable_button=enable_turbo_button
teleop_twist_joy_node teleop_twist_joy|requires_enable_button=require_enable_button
joy_node joy|dead_zone=deadzone
joy_node joy|auto_repeat_rate autorepeat=autorepeat_rate
ekf ukf|rate update_rate publish_rate=frequency
ekf ukf|base_frame base_frame_id base_link robot_base_frame=base_link_frame
ekf ukf|odom_frame_id=odom_frame
ekf ukf|map_frame_id=map_frame
ekf ukf|world_frame_id=world_frame
ekf ukf|publish_transform publish_odom_tf tf_broadcast=publish_tf
ekf ukf|2d_mode planar_mode=two_d_mode
slam_toolbox|stack_size=stack_size_to_use
slam_toolbox|base_frame_id robot_base_frame base_link_frame=base_frame
slam_toolbox|odom_frame_id=odom_frame
slam_toolbox|map_frame_id=map_frame
slam_toolbox|max_range laser_max_range=max_laser_range
slam_toolbox|update_interval=map_update_interval
amcl|base_frame=base_frame_id
amcl|odom_frame=odom_frame_id
amcl|global_frame map_frame=global_frame_id
amcl|odom_model_type=robot_model_type
amcl|laser_max_beams=max_beams
amcl|laser_z_hit=z_hit
amcl|laser_z_rand=z_rand
amcl|laser_sigma_hit=sigma_hit
amcl|odom_alpha1=alpha1
amcl|odom_alpha2=alpha2
amcl|odom_alpha3=alpha3
amcl|odom_alpha4=alpha4
amcl|initial_pose_x=initial_pose.x
amcl|initial_pose_y=initial_pose.y
amcl|initial_pose_a=initial_pose.yaw
bt_navigator|base_frame base_frame_id=robot_base_frame
bt_navigator|global_frame_id=global_frame
controller_server|goal_checker_plugin=goal_checker_plugins
controller_server|controller_plugin=controller_plugins
planner_server|planner_plugin=planner_plugins
smoother_server|smoother_plugin=smoother_plugins
behavior_server|behavior_plugin recovery_plugins=behavior_plugins
local_costmap global_costmap|base_frame base_frame_id=robot_base_frame
local_costmap global_costmap|global_frame_id=global_frame
local_costmap global_costmap|plugin_names=plugins
collision_monitor|base_frame robot_base_frame=base_frame_id
collision_monitor|odom_frame=odom_frame_id
collision_monitor|cmd_vel_in input_topic=cmd_vel_in_topic
collision_monitor|cmd_vel_out output_topic=cmd_vel_out_topic
velocity_smoother|max_acceleration max_acc=max_accel
velocity_smoother|max_deceleration max_dec min_accel=max_decel
velocity_smoother|max_vel=max_velocity
velocity_smoother|min_vel=min_velocity
velocity_smoother|frequency=smoothing_frequency
map_server|map map_file map_path map_yaml map_yaml_file yaml_file yaml_file_name yaml_path=yaml_filename
map_server|map_topic=topic_name
map_server|map_frame frame=frame_id
robot_state_publisher|rate publish_rate frequency=publish_frequency
robot_state_publisher|tf_prefix prefix=frame_prefix
joint_state_publisher joint_state_publisher_gui|publish_rate publish_frequency frequency=rate
joint_state_publisher joint_state_publisher_gui|source_lists sources topics=source_list
twist_mux|topic=topics
twist_mux|lock=locks
"""
"""Nodes, names of other nodes or releases = name that the nodes read."""

OF_GROUPS = {
    "dwb_core::DWBLocalPlanner": {
        **dict.fromkeys(("max_rot_vel", "max_vel_rot"), "max_vel_theta"),
        **dict.fromkeys(("max_trans_vel", "max_vel_trans"), "max_speed_xy"),
        **dict.fromkeys(("min_trans_vel", "min_vel_trans"), "min_speed_xy"),
        **dict.fromkeys(("min_rot_vel", "min_vel_theta"), "min_speed_theta"),
        **{"vth_samples": "vtheta_samples", "acc_lim_th": "acc_lim_theta", "decel_lim_th": "decel_lim_theta"},
    },
    "LaserScan": {"obstacle_range": "obstacle_max_range", "raytrace_range": "raytrace_max_range"},
    "PointCloud2": {"obstacle_range": "obstacle_max_range", "raytrace_range": "raytrace_max_range"},
}
"""Plugin or type of data of a group → ROS 1 parameters → those of Nav2 since Galactic."""

OF_CONTROLLERS = {
    "diff_drive_controller/DiffDriveController": {
        **{"left_wheel_names": "left_wheel", "right_wheel_names": "right_wheel"},
        **dict.fromkeys(("wheel_seperation", "wheel_base", "track_width"), "wheel_separation"),
    },
    "joint_state_controller/JointStateController": {"update_rate": "publish_rate"},
    "ackermann_steering_controller/AckermannSteeringController": {
        **{"rear_wheels_names": "rear_wheel", "front_wheels_names": "front_steer"},
        **{"wheelbase": "wheel_separation_h"},
    },
}
"""Type of a ROS 1 controller → names in other packages and releases → its names in Noetic.

These and the names below were not compared with the sources.
"""

OF_ROS1 = {
    "amcl": {
        **{f"alpha{at}": f"odom_alpha{at}" for at in range(1, 6)},
        **{name: f"laser_{name}" for name in ("max_beams", "z_hit", "z_short", "z_max", "z_rand", "sigma_hit")},
        **{"pf_err": "kld_err", "pf_z": "kld_z", "robot_model_type": "odom_model_type"},
        **{"base_frame": "base_frame_id", "odom_frame": "odom_frame_id"},
        **dict.fromkeys(("global_frame", "map_frame"), "global_frame_id"),
    },
    "gmapping": {
        **{"base_frame_id": "base_frame", "odom_frame_id": "odom_frame", "map_frame_id": "map_frame"},
        **{"max_range": "maxRange", "resolution": "delta", "max_laser_range": "maxRange"},
    },
    "teleop_twist_joy": {
        **{"axis_linear.x": "axis_linear", "axis_angular.yaw": "axis_angular"},
        **{"deadman_button": "enable_button", "turbo_button": "enable_turbo_button"},
    },
    "move_base": {
        **{"controller_plugins": "base_local_planner", "planner_plugins": "base_global_planner"},
        **{"expected_planner_frequency": "planner_frequency"},
    },
    "moveit_ros_move_group": {"planning_plugins": "planning_plugin"},
    "robot_localization": {"base_link": "base_link_frame", "base_frame": "base_link_frame", "rate": "frequency"},
    "robot_state_publisher": {"frequency": "publish_frequency"},
}
"""ROS 1 package → names of other releases and nodes → names of Noetic."""


_KINDS = {"ekf_filter_node": "ekf"}
"""Default name of a node → its name in the tables."""


@cache
def schemas() -> dict[str, list[tuple[str, str]]]:
    """Return node → patterns of parameters and their types."""
    return rows_of(_SCHEMAS)


def rows_of(table: str) -> dict[str, list[tuple[str, str]]]:
    """Return name → patterns of parameters and their types, of a table in the form of `_SCHEMAS`."""
    found: dict[str, list[tuple[str, str]]] = {}
    for block in table.strip().split("\n\n"):
        head, *rows = block.splitlines()
        entries = [
            (name, kind.strip()) for row in rows for names, _, kind in [row.partition(":")] for name in names.split()
        ]
        found |= dict.fromkeys(head.split(), entries)
    return found


@cache
def renamed() -> dict[str, dict[str, str]]:
    """Return node → other name of a parameter → its name."""
    found: dict[str, dict[str, str]] = {}
    for row in _RENAMED.strip().splitlines():
        nodes, _, pair = row.partition("|")
        others, _, name = pair.partition("=")
        for node in nodes.split():
            found.setdefault(node, {}).update(dict.fromkeys(others.split(), name))
    return found


def other_names(node: str) -> dict[str, str]:
    """Return the parameters of other nodes or releases → those of a ROS 2 node by its default name."""
    return renamed().get(_KINDS.get(node, node), {})
