"""Parameters of well-known nodes in YAML, by the names that the nodes have by default, and in launch files.

Sources: teleop_twist_joy and joy (README.md), twist_mux (src/twist_mux.cpp), robot_localization (params/ekf.yaml),
slam_toolbox (config/mapper_params_online_async.yaml), nav2_amcl (src/amcl_node.cpp), Noetic to Rolling;
nav2_map_server (map_server.cpp), robot_state_publisher (robot_state_publisher.cpp), joint_state_publisher (README.md).
"""

import ast
from collections.abc import Iterator
from functools import cache

from urdfkit.description.launch.python_constants import launch_reader, name_of, parsed
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.controller_joints import Named
from urdfkit.lint.facts.control.launch_package_paths import place
from urdfkit.lint.facts.control.yaml_tree import Node, documents
from urdfkit.lint.facts.launch.actions import all_elements
from urdfkit.lint.facts.launch.ros_version import reads_ros1
from urdfkit.lint.facts.parameters.schemas import other_names
from urdfkit.lint.facts.ros_packages import is_slip

_PARAMETERS = """
teleop_twist_joy_node teleop_twist_joy: require_enable_button enable_button enable_turbo_button axis_linear axis_angular
scale_linear scale_linear_turbo scale_angular scale_angular_turbo inverted_reverse publish_stamped_twist frame;
joy_node joy: device_id device_name deadzone autorepeat_rate sticky_buttons coalesce_interval coalesce_interval_ms dev;
twist_mux: topics locks use_stamped;
ekf_filter_node ukf_filter_node ekf_localization ukf_localization ekf_localization_node: frequency sensor_timeout
two_d_mode transform_time_offset transform_timeout print_diagnostics debug debug_out_file publish_tf map_frame
permit_corrected_publication publish_acceleration odom_frame base_link_frame world_frame process_noise_covariance
initial_estimate_covariance use_control stamped_control control_timeout control_config acceleration_limits
deceleration_limits acceleration_gains deceleration_gains reset_on_time_jump predict_to_current_time history_length
smooth_lagged_data dynamic_process_noise_covariance disabled_at_startup initial_state;
slam_toolbox: solver_plugin odom_frame map_frame base_frame scan_topic mode map_file_name map_start_pose
map_start_at_dock debug_logging throttle_scans transform_publish_period map_update_interval resolution max_laser_range
minimum_time_interval transform_timeout tf_buffer_duration stack_size_to_use enable_interactive_mode use_scan_matching
use_scan_barycenter minimum_travel_distance minimum_travel_heading scan_buffer_size do_loop_closing ceres_linear_solver
ceres_preconditioner ceres_trust_strategy ceres_dogleg_type ceres_loss_function scan_buffer_maximum_scan_distance
link_match_minimum_response_fine link_scan_maximum_distance loop_search_maximum_distance loop_match_minimum_chain_size
loop_match_maximum_variance_coarse loop_match_minimum_response_coarse loop_match_minimum_response_fine
correlation_search_space_dimension correlation_search_space_resolution correlation_search_space_smear_deviation
loop_search_space_dimension loop_search_space_resolution loop_search_space_smear_deviation distance_variance_penalty
angle_variance_penalty fine_search_angle_offset coarse_search_angle_offset coarse_angle_resolution
minimum_angle_penalty minimum_distance_penalty use_response_expansion min_laser_range restamp_tf;
amcl: base_frame_id global_frame_id odom_frame_id do_beamskip lambda_short laser_likelihood_max_dist laser_max_range
laser_min_range laser_model_type max_beams max_particles min_particles recovery_alpha_fast recovery_alpha_slow
resample_interval robot_model_type save_pose_rate sigma_hit tf_broadcast transform_tolerance update_min_a update_min_d
scan_topic map_topic set_initial_pose always_reset_initial_pose first_map_only;
"""
"""Names of nodes: parameters; similar names count as misspelt, other names are ignored."""

_OF_PACKAGES = """
ros_gz_bridge: config_file expand_gz_topic_names override_timestamps_with_wall_time subscription_heartbeat bridge_names
override_frame_id; robot_state_publisher: publish_frequency ignore_timestamp frame_prefix use_tf_static tf_prefix;
joint_state_publisher joint_state_publisher_gui: source_list dependent_joints publish_default_positions use_mimic_tags
publish_default_velocities publish_default_efforts use_smallest_joint_limits rate delta zeros;
nav2_map_server: yaml_filename topic_name
frame_id save_map_timeout free_thresh_default occupied_thresh_default map_subscribe_transient_local;
nav2_lifecycle_manager: node_names
autostart bond_timeout attempt_respawn_reconnection bond_respawn_max_duration service_timeout bond_heartbeat_period;
moveit_ros_move_group: planning_plugin planning_plugins request_adapters response_adapters moveit_controller_manager
moveit_manage_controllers allow_trajectory_execution publish_monitored_planning_scene capabilities disable_capabilities
max_safe_path_cost use_controller_manager default_planning_pipeline planning_pipelines planning_scene_monitor_options
publish_robot_description publish_robot_description_semantic jiggle_fraction start_state_max_bounds_error;
gmapping: base_frame odom_frame map_frame map_update_interval maxUrange maxRange sigma kernelSize lstep astep iterations
lsigma ogain lskip minimumScore linearUpdate angularUpdate temporalUpdate resampleThreshold particles occ_thresh
throttle_scans transform_publish_period inverted_laser delta llsamplerange llsamplestep lasamplerange lasamplestep;
amcl: min_particles max_particles kld_err kld_z update_min_d update_min_a resample_interval transform_tolerance
recovery_alpha_slow recovery_alpha_fast initial_pose_x initial_pose_y initial_pose_a initial_cov_xx initial_cov_yy
initial_cov_aa gui_publish_rate save_pose_rate use_map_topic first_map_only selective_resampling laser_min_range
laser_max_range laser_max_beams laser_z_hit laser_z_short laser_z_max laser_z_rand laser_sigma_hit laser_lambda_short
laser_likelihood_max_dist laser_model_type odom_model_type odom_alpha1 odom_alpha2 odom_alpha3 odom_alpha4 odom_alpha5
odom_frame_id base_frame_id global_frame_id tf_broadcast;
"""
"""Packages: parameters of their nodes (ros_gz_bridge, nav2 and robot_state_publisher of Jazzy, gmapping of Noetic).

The nodes of the packages in `_NODES` have the parameters in `_PARAMETERS`.
"""

_COMPLETE = ("joint_state_publisher", "joint_state_publisher_gui", "nav2_map_server", "robot_state_publisher")
"""Packages whose nodes have no other parameters in ROS 2, except those of `_EVERY_NODE`."""

_EVERY_NODE = (
    *("use_sim_time", "qos_overrides", "start_type_description_service", "robot_description", "diagnostic_updater"),
    *("bond_heartbeat_period", "introspection_mode", "service_introspection_mode", "use_robot_description_topic"),
)
"""Parameters that are accepted in every ROS 2 node, as other parts of it read them."""

_DESCRIPTIONS = ("robot_description_semantic", "robot_description_kinematics", "robot_description_planning")
_OF_MOVEIT = ("moveit_ros_move_group", "moveit_servo", "rviz2")

_NODES = {
    "joy": "joy_node",
    "nav2_amcl": "amcl",
    "nav2_behaviors": "behavior_server",
    "nav2_bt_navigator": "bt_navigator",
    "nav2_collision_monitor": "collision_monitor",
    "nav2_controller": "controller_server",
    "nav2_map_server": "map_server",
    "nav2_planner": "planner_server",
    "nav2_smoother": "smoother_server",
    "nav2_velocity_smoother": "velocity_smoother",
    "robot_localization": "ekf_filter_node",
    "slam_toolbox": "slam_toolbox",
    "teleop_twist_joy": "teleop_twist_joy_node",
    "twist_mux": "twist_mux",
}
"""Package → the default name of its node."""

_MIN_LENGTH = 5
"""Length of a parameter from which on a similar name is a misspelt one."""


@cache
def _parameters(table: str = _PARAMETERS) -> dict[str, tuple[str, ...]]:
    rows = (row.partition(":") for row in table.strip(";\n").split(";"))
    return {name: tuple(accepted.split()) for names, _, accepted in rows for name in names.split()}


def parameters_of(node: str) -> tuple[str, ...]:
    """Return parameters of a well-known node by its default name; empty for other nodes."""
    return _parameters().get(node, ())


def parameters_of_package(package: str) -> tuple[str, ...]:
    """Return parameters of the nodes of a well-known package; empty for other packages."""
    return _parameters(_OF_PACKAGES).get(package, ())


def misspelt_in_launch(source: Source) -> Iterator[tuple[Named, str, str | None]]:
    """Yield the unknown parameters of well-known nodes in a launch file: key, package, suggested name or None."""
    is_ros1 = source.file.endswith((".launch", ".xml")) and reads_ros1(source)
    for package, keys in _in_python(source) if source.file.endswith(".py") else _in_elements(source):
        accepted = _parameters(_OF_PACKAGES).get(package) or _parameters().get(_NODES.get(package, ""), ())
        others = {} if is_ros1 else other_names(_NODES.get(package, package))
        written = {key.name.partition(".")[0] for key in keys}
        lacking = [each for each in accepted if each not in written and len(each) >= _MIN_LENGTH]
        for key in (Named(each.name.partition(".")[0], each.start) for each in keys):
            near = next((each for each in lacking if is_slip(key.name, each) or _is_other_form(key.name, each)), None)
            if near is None and others.get(key.name, key.name) not in written:
                near = others[key.name]
            is_described = package in _OF_MOVEIT and key.name.startswith("robot_description_")
            is_unknown = package in _COMPLETE and key.name not in _EVERY_NODE
            if key.name in accepted or (is_ros1 and near is None):
                continue
            if near is not None or is_unknown:
                yield key, package, near
            elif is_described and key.name not in _DESCRIPTIONS:
                left = [each for each in _DESCRIPTIONS if each not in written]
                yield key, package, left[0] if len(left) == 1 or "srdf" in key.name else None


def _is_other_form(name: str, parameter: str) -> bool:
    """Return whether a name is the plural or the longer part of a parameter: ``yaml_file`` of ``yaml_filename``."""
    is_start = len(name) >= _MIN_LENGTH and parameter.startswith(name) and 2 * len(name) > len(parameter)
    return is_start or name == f"{parameter}s"


def _in_elements(source: Source) -> Iterator[tuple[str, list[Named]]]:
    for element in (each for each in all_elements(source) if each.tag == "node" and "pkg" in each.attributes):
        inner = [child.attributes for child in element.children if child.tag == "param"]
        yield element.attributes["pkg"].name, [each["name"] for each in inner if "name" in each]


def _in_python(source: Source) -> Iterator[tuple[str, list[Named]]]:
    tree = parsed(source) if any(name in source.text for name in (*_parameters(_OF_PACKAGES), *_NODES)) else None
    if tree is None:
        return
    reader = launch_reader(tree)
    for call in (each for each in ast.walk(tree) if isinstance(each, ast.Call) and name_of(each.func) == "Node"):
        words = {word.arg: word.value for word in call.keywords}
        package, listed = (words.get(key) for key in ("package", "parameters"))
        if package is None or not (listed_items := reader.items(listed)):
            continue
        items = [reader.assigned.get(item.id) if isinstance(item, ast.Name) else item for item in listed_items]
        keys = [key for item in items if isinstance(item, ast.Dict) for key in item.keys]
        yield (
            reader.text(package) or "",
            [
                Named(key.value, place(source, key)[0] + 1)
                for key in keys
                if isinstance(key, ast.Constant) and isinstance(key.value, str)
            ],
        )


def misspelt_parameters(source: Source) -> Iterator[tuple[Node, str, str]]:
    """Yield the misspelt parameters of well-known nodes in a YAML file: key, name of the node, suggested name."""
    if not any(name in source.text for name in (*_parameters(), "base_link_frame")):
        return
    for document in documents(source):
        entries = [(key, key.text.rpartition("/")[2], value) for key, value in document.entries]
        frame, is_filter = document.find("base_link_frame"), document.find("world_frame") is not None
        if frame is not None and is_filter:  # a ROS 1 file, loaded inside of the node
            entries = [(frame, "ekf_filter_node", document)]
        for name, kind, section in entries:
            accepted = _parameters().get(kind, ())
            group = section.find("ros__parameters") or section
            written = {key.text.partition(".")[0] for key, _ in group.entries} if accepted else set()
            lacking = [each for each in accepted if each not in written and len(each) >= _MIN_LENGTH]
            for key, _ in group.entries if lacking else ():
                first = key.text.partition(".")[0]
                near = next((each for each in lacking if is_slip(first, each)), None) if first not in accepted else None
                if near is not None:
                    yield key, name.text if name is not frame else "robot_localization", near
