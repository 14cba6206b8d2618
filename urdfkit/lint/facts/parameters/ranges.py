"""Sensible ranges of the parameters of controllers, navigation, localization, mapping and MoveIt.

The ranges are far wider than the defaults and examples of the packages (ros2_controllers, navigation2, navigation,
robot_localization, slam_toolbox, gmapping, twist_mux, teleop_twist_joy, moveit2, Noetic to Rolling). Values of zero and
below switch a function off in many nodes and are accepted here. The greatest number of voxels is that of
nav2_voxel_grid (voxel_grid.cpp), which has no more than 16 layers and drops the others.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from functools import cache

from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.controller_joints import Named
from urdfkit.lint.facts.control.yaml_tree import Node, nodes, number_of
from urdfkit.lint.facts.launch.actions import all_elements
from urdfkit.lint.facts.navigation.tables import ORDERED

_RANGES = """
cmd_vel_timeout|traction_joint_name|10 10000 ms
cmd_vel_timeout reference_timeout|type,wheel_separation,wheelbase,wheel_radius|0.01 10 s
timeout|priority|0.01 60 s
velocity_timeout sensor_timeout transform_tolerance transform_timeout stop_pub_timeout source_timeout||0.001 30 s
publish_rate state_publish_rate action_monitor_rate update_rate||0.1 20000 Hz
controller_frequency smoothing_frequency cycle_frequency||0.2 1000 Hz
planner_frequency expected_planner_frequency update_frequency publish_frequency gui_publish_rate||0.001 200 Hz
frequency|world_frame,base_link_frame,magnetic_declination_radians|0.1 1000 Hz
autorepeat_rate||0.1 1000 Hz
deadzone|axis_linear,device_id,autorepeat_rate,dev|0 1
scale_linear scale_linear_turbo||0.001 30 m/s
scale_angular scale_angular_turbo||0.001 30 rad/s
wheel_separation_multiplier||0.3 4
wheel_radius_multiplier left_wheel_radius_multiplier right_wheel_radius_multiplier||0.5 2
transform_publish_period||0.001 5 s
map_update_interval||0.001 300 s
tf_buffer_duration||0.5 3600 s
minimum_time_interval||0.001 60 s
minimum_travel_distance update_min_d linearUpdate||0.001 10 m
minimum_travel_heading update_min_a angularUpdate||0.001 6.3 rad
resolution|occupied_thresh,update_frequency,robot_base_frame,max_laser_range,rolling_window,global_frame|0.001 1 m
delta|maxUrange,maxRange|0.001 1 m
width height|rolling_window,update_frequency,global_frame|0.2 2000 m
inflation_radius||0.01 20 m
obstacle_range raytrace_range obstacle_max_range raytrace_max_range||0.05 500 m
max_laser_range laser_max_range maxRange maxUrange||0.1 500 m
max_obstacle_height||0.01 200 m
z_voxels|z_resolution,origin_z,observation_sources|1 16
footprint_padding||0.0001 0.5 m
particles|maxUrange,maxRange|2 5000
min_particles max_particles||5 200000
xy_goal_tolerance||0.001 5 m
yaw_goal_tolerance||0.001 6.3 rad
max_vel_x max_vel_y max_vel_trans max_trans_vel max_speed_xy desired_linear_vel vx_max||0.01 50 m/s
rotate_to_heading_min_angle||0.001 3.2 rad
max_vel_theta max_rot_vel max_rotational_vel rotate_to_heading_angular_vel wz_max||0.01 50 rad/s
acc_lim_x acc_lim_y acc_lim_trans||0.01 200 m/s²
acc_lim_theta acc_lim_th rotational_acc_lim max_angular_accel||0.01 500 rad/s²
sim_time simulate_ahead_time||0.05 30 s
sim_granularity||0.001 2 m
lookahead_dist min_lookahead_dist max_lookahead_dist||0.01 50 m
lookahead_time||0.05 60 s
required_movement_radius oscillation_distance||0.001 20 m
movement_time_allowance controller_patience planner_patience oscillation_timeout||0.1 3600 s
occupied_thresh free_thresh occ_thresh||0 1
laser_z_hit laser_z_short laser_z_max laser_z_rand z_hit z_short z_max z_rand||0 1
kinematics_solver_timeout||0.0001 30 s
kinematics_solver_search_resolution||0.00001 1
longest_valid_segment_fraction||0.00001 1
goal_bias|type|0 1
octomap_resolution||0.001 2 m
padding_scale|sensor_plugin|0.1 20
padding_offset|sensor_plugin|0.0001 2 m
max_range|sensor_plugin|0.05 200 m
max_update_rate|sensor_plugin|0.001 200 Hz
allowed_execution_duration_scaling||1 100
allowed_goal_duration_margin||0.001 600 s
allowed_start_tolerance||0.00001 3.2
vx_samples vy_samples vtheta_samples vth_samples||1 1000
trans_stopped_velocity rot_stopped_velocity trans_stopped_vel theta_stopped_vel||0.0001 5
tolerance|use_astar,max_planning_time|0.001 50 m
min_lookahead max_lookahead|k_phi,slowdown_radius|0.01 50 m
goal|trajectory|0.00001 3.2
trajectory|goal|0.00001 10
ax_max ay_max|vx_max|0.02 100 m/s²
az_max|wz_max|0.02 300 rad/s²
model_dt|time_steps|0.005 1 s
vx_std vy_std wz_std|time_steps|0.005 10
prune_distance|time_steps|0.05 100 m
min_turning_r||0.01 50 m
minimum_turning_radius min_turning_radius||0.01 50 m
angular_dist_threshold|primary_controller|0.01 3.2 rad
forward_sampling_distance|primary_controller|0.01 10 m
analytic_expansion_max_length||0.05 100 m
analytic_expansion_ratio||0.1 100
lower_singularity_threshold hard_stop_singularity_threshold||1 10000
simulation_time_step||0.005 2 s
time_before_collision||0.05 60 s
v_linear_min v_linear_max|k_phi,slowdown_radius,v_linear_max,v_linear_min|0.001 20 m/s
k_phi k_delta|v_linear_max|0.02 100
docking_threshold|staging_x_offset|0.001 2 m
external_detection_timeout||0.01 120 s
undock_linear_tolerance dock_prestaging_tolerance||0.001 4 m
undock_angular_tolerance||0.001 3.2 rad
filter_coef|docking_threshold|0 1
range_max|range_min,use_inf,scan_time|0.1 500 m
range_min|range_max|0.001 50 m
angle_increment|angle_max|0.0001 0.5 rad
scan_time|range_max,range_min|0.0001 60 s
lower_threshold upper_threshold|use_message_range_limits,lower_replacement_value|0.001 1000 m
neighbors|window|1 500
laser_likelihood_max_dist||0.05 50 m
odom_alpha1 odom_alpha2 odom_alpha3 odom_alpha4 odom_alpha5||0.0001 20
kld_z||0.5 1
pf_z||0.5 5
kld_err pf_err||0.0001 0.5
iterations|maxUrange|1 200
max_global_plan_lookahead_dist||0.05 200 m
min_obstacle_dist inflation_dist|dt_ref,teb_autosize|0.001 10 m
dt_ref|teb_autosize,max_vel_x|0.01 5 s
cost_factor|neutral_cost|0.001 10
reset_distance|layer_names|0.02 100 m
joint_limit_margin|move_group_name|0.001 1.6
incoming_command_timeout||0.005 60 s
publish_period|move_group_name|0.0005 1 s
near_clipping_plane_distance|sensor_plugin|0.005 20 m
far_clipping_plane_distance|sensor_plugin|0.1 500 m
field_of_view|sensor_name|0.005 6.3 rad
max_range|radiation_type|0.02 200 m
filter_coefficient||0 1
"""
"""Parameters, then parameters of which one is in the same group (any if empty), then range and unit.

The first row of a parameter that fits its group counts: tricycle_controller has its timeout in milliseconds.
"""

_ANGLES = {
    "magnetic_declination_radians": 1.6,
    **dict.fromkeys(("external_detection_rotation_roll", "external_detection_rotation_pitch"), 6.3),
    **dict.fromkeys(("external_detection_rotation_yaw", "lower_angle", "upper_angle"), 6.3),
    **dict.fromkeys(("yaw_offset", "initial_pose_a", "initial_pose.yaw"), 6.3),
}
"""Parameter → its greatest sensible angle [rad]; the declination is below 0.6 rad except near the poles."""

_Row = tuple[tuple[str, ...], float, float, str]


@cache
def _ranges() -> dict[str, list[_Row]]:
    """Return parameter → rows of parameters next to it, least and greatest sensible value and unit."""
    found: dict[str, list[_Row]] = {}
    for row in _RANGES.strip().splitlines():
        names, siblings, limits = row.split("|")
        low, high, *unit = limits.split()
        for name in names.split():
            siblings_of = tuple(siblings.split(",")) if siblings else ()
            found.setdefault(name, []).append((siblings_of, float(low), float(high), unit[0] if unit else ""))
    return found


def range_names() -> Iterable[str]:
    """Return the parameters with a range."""
    return _ranges()


def groups_of_launch(source: Source) -> list[Node]:
    """Return the constant parameters of each node in an XML or YAML launch file, as in a parameter file."""
    found = []
    for element in all_elements(source):
        parts = [child.attributes for child in element.children if child.tag == "param"]
        pairs = [(each["name"], each["value"]) for each in parts if {"name", "value"} <= each.keys()]
        entries = [(_text(source, name), _text(source, value)) for name, value in pairs if "$" not in value.name]
        if element.tag == "node" and entries:
            found.append(Node("group", "", tuple(entries), (), entries[0][0].line, entries[0][0].column))
    return found


def _text(source: Source, named: Named) -> Node:
    position = source.position(named.start)
    return Node("text", named.name.strip(), (), (), position.line, position.column, True)


def out_of_range(groups: Iterable[Node]) -> Iterator[tuple[Node, str]]:
    """Yield the numbers in groups of parameters that are far outside of the sensible range of their parameter."""
    ranges, seen = _ranges(), set[tuple[int, int]]()
    for node in (node for node in groups if node.entries):
        names = {key.text for key, _ in node.entries}
        for key, value in node.entries:
            yaw = value.find("yaw") if key.text == "initial_pose" else None
            name, turn = (f"{key.text}.yaw", yaw) if yaw is not None else (key.text, value)
            most, angle = _ANGLES.get(name), number_of(turn) if turn.kind == "text" else None
            if most is not None and angle is not None and abs(angle) > most:
                yield turn, f"`{name}` is {angle:g} rad, more than {most:g} rad; convert it if it is in degrees"
            rows = (row for row in ranges.get(key.text, ()) if not row[0] or not names.isdisjoint(row[0]))
            if (row := next(rows, None)) is None:
                continue
            _, low, high, unit = row
            for item in (value, *(inner for _, inner in value.entries if key.text.startswith("scale_"))):
                number = number_of(item) if item.kind == "text" and item.is_plain else None
                if number is None or not (number > high or 0.0 < number < low) or (item.line, item.column) in seen:
                    continue
                seen.add((item.line, item.column))
                shown = f"{number:g} {unit}".strip()
                bound = f"more than {high:g}" if number > high else f"less than {low:g}"
                yield item, f"`{key.text}` is {shown}, {bound} {unit}".rstrip() + "; check the unit and the value"


_TURBO = (("scale_linear", "scale_linear_turbo"), ("scale_angular", "scale_angular_turbo"))
"""Scales of teleop_twist_joy, and those of its turbo button."""

_DISTINCT = (("enable_button", "enable_turbo_button"), ("axis_linear", "axis_angular"))
"""Parameters of teleop_twist_joy that must differ."""

_SIMILAR = (("max_vel_x", "max_vel_trans"), ("max_vel_x", "max_speed_xy"), ("max_vel_x", "max_trans_vel"))
_MAX_RATIO = 2.0
"""Accepted ratio of the first of two parameters in `_SIMILAR` to the second one, which bounds both directions."""


def out_of_order(source: Source) -> Iterator[tuple[Node, str]]:
    """Yield each parameter of navigation, localization and mapping that is larger than its bound.

    Also yields parameters of teleop_twist_joy with the same value.
    """
    for node in (node for node in nodes(source) if len(node.entries) > 1):
        numbers = {key.text: number_of(value) for key, value in node.entries if value.kind == "text"}
        for low, high in _reversed(numbers):
            if (value := node.find(low)) is not None:
                yield value, f"`{low}` is {numbers[low]:g}, more than `{high}`, {numbers[high]:g}"
        for low, high in _SIMILAR:
            least, most, value = numbers.get(low), numbers.get(high), node.find(low)
            if value is not None and least is not None and most is not None and 0.0 < _MAX_RATIO * most < least:
                yield value, f"`{low}` is {least:g}, far more than `{high}`, {most:g}"
        for slow, fast in _TURBO:
            usual_axes, turbo_axes = node.find(slow), node.find(fast)
            for axis, value in turbo_axes.entries if usual_axes is not None and turbo_axes is not None else ():
                usual = number_of(usual_axes.find(axis.text)) if usual_axes is not None else None
                turbo = number_of(value)
                if usual is not None and turbo is not None and 0.0 < turbo < usual:
                    yield value, f"`{fast}.{axis.text}` is {turbo:g}, less than `{slow}.{axis.text}`, {usual:g}"
        for one, other in _DISTINCT:
            value = node.find(other)
            if value is not None and numbers.get(one) is not None and numbers.get(one) == numbers.get(other):
                yield value, f"`{one}` and `{other}` are both {value.text}"


def _reversed(numbers: Mapping[str, float | None]) -> list[tuple[str, str]]:
    """Return the pairs of a minimum and a smaller maximum, without those of a value between two reversed bounds."""
    found = [
        (low, high)
        for low, high in ORDERED
        if (least := numbers.get(low)) is not None and (most := numbers.get(high)) is not None and least > most
    ]
    return [
        (low, high)
        for low, high in found
        if not any(
            (one == low and (high, other) in ORDERED) or (other == high and (one, low) in ORDERED)
            for one, other in found
        )
    ]
