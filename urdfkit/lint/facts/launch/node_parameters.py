"""Parameters of well-known nodes in YAML, by the names that the nodes have by default.

Sources: teleop_twist_joy and joy (README.md), twist_mux (src/twist_mux.cpp), robot_localization (params/ekf.yaml),
slam_toolbox (config/mapper_params_online_async.yaml), nav2_amcl (src/amcl_node.cpp), Noetic to Rolling.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache

from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.yaml_tree import Node, documents

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
use_scan_barycenter minimum_travel_distance minimum_travel_heading scan_buffer_size do_loop_closing;
amcl: base_frame_id global_frame_id odom_frame_id do_beamskip lambda_short laser_likelihood_max_dist laser_max_range
laser_min_range laser_model_type max_beams max_particles min_particles recovery_alpha_fast recovery_alpha_slow
resample_interval robot_model_type save_pose_rate sigma_hit tf_broadcast transform_tolerance update_min_a update_min_d
scan_topic map_topic set_initial_pose always_reset_initial_pose first_map_only;
"""
"""Names of nodes: parameters; similar names are misspelt ones, other names are ignored."""

_MIN_LENGTH = 5
"""Length of a parameter from which on a similar name is a misspelt one."""


@cache
def _parameters() -> dict[str, tuple[str, ...]]:
    rows = (row.partition(":") for row in _PARAMETERS.strip(";\n").split(";"))
    return {name: tuple(accepted.split()) for names, _, accepted in rows for name in names.split()}


def misspelt_parameters(source: Source) -> Iterator[tuple[Node, str, str]]:
    """Yield the misspelt parameters of well-known nodes in a YAML file: key, name of the node, suggested name."""
    from urdfkit.lint.facts.ros_packages import is_slip

    if not any(name in source.text for name in _parameters()):
        return
    for document in documents(source)[0]:
        for name, section in document.entries:
            accepted = _parameters().get(name.text.rpartition("/")[2], ())
            group = section.find("ros__parameters") or section
            written = {key.text.partition(".")[0] for key, _ in group.entries} if accepted else set()
            lacking = [each for each in accepted if each not in written and len(each) >= _MIN_LENGTH]
            for key, _ in group.entries if lacking else ():
                first = key.text.partition(".")[0]
                near = next((each for each in lacking if is_slip(first, each)), None) if first not in accepted else None
                if near is not None:
                    yield key, name.text, near
