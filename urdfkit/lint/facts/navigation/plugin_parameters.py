"""Plugins of Nav2 whose section has the parameters of another plugin, and parameters that contradict each other.

Sources: ros-navigation/navigation2 (nav2_mppi_controller: optimizer.cpp). The tables of the other plugins were not
compared with the sources.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache

from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.yaml_tree import Node, number_of, walk
from urdfkit.lint.facts.navigation.sections import sections

Defects = Iterator[tuple[Source, Node, str]]

_PARAMETERS = """
controller|MPPIController: time_steps model_dt batch_size vx_std vy_std wz_std vx_max vx_min vy_max wz_max ax_max ax_min
 az_max iteration_count temperature gamma motion_model prune_distance regenerate_noises
controller|DWBLocalPlanner: min_vel_x max_vel_x max_vel_theta min_speed_xy max_speed_xy min_speed_theta acc_lim_x
 acc_lim_theta decel_lim_x decel_lim_theta vx_samples vtheta_samples sim_time linear_granularity angular_granularity
controller|RegulatedPurePursuitController: desired_linear_vel lookahead_dist min_lookahead_dist max_lookahead_dist
 lookahead_time use_velocity_scaled_lookahead_dist min_approach_linear_velocity use_rotate_to_heading
 use_regulated_linear_velocity_scaling regulated_linear_scaling_min_radius approach_velocity_scaling_dist
controller|GracefulController: k_phi k_delta beta lambda v_linear_min v_linear_max v_angular_max slowdown_radius
planner|NavfnPlanner: use_astar use_final_approach_orientation
planner|SmacPlannerHybrid SmacPlannerLattice SmacPlanner2D: downsample_costmap downsampling_factor max_iterations
 max_on_approach_iterations max_planning_time motion_model_for_search angle_quantization_bins reverse_penalty
 change_penalty non_straight_penalty cost_penalty lattice_filepath minimum_turning_radius analytic_expansion_ratio
planner|ThetaStarPlanner: how_many_corners w_euc_cost w_traversal_cost
layer|ObstacleLayer VoxelLayer SpatioTemporalVoxelLayer: observation_sources
layer|StaticLayer: map_subscribe_transient_local map_topic subscribe_to_updates
layer|InflationLayer: inflation_radius cost_scaling_factor inflate_unknown
checker|SimpleGoalChecker StoppedGoalChecker PositionGoalChecker: xy_goal_tolerance yaw_goal_tolerance
checker|SimpleProgressChecker PoseProgressChecker: required_movement_radius movement_time_allowance
"""
"""Kind and classes of plugins, with parameters that plugins of the other rows of that kind do not have."""

_OF_TWO_PLUGINS = ("RotationShimController",)
"""Controllers whose section also has the parameters of another controller."""


@cache
def _rows() -> list[tuple[frozenset[str], str, frozenset[str]]]:
    """Return the classes, the kind and the parameters of each row."""
    rows = _PARAMETERS.strip().replace("\n ", " ").splitlines()
    return [
        (frozenset(classes.split()), kind, frozenset(names.split()))
        for row in rows
        for kind, _, rest in [row.partition("|")]
        for classes, _, names in [rest.partition(":")]
    ]


def foreign_parameters(source: Source) -> Defects:
    """Yield each plugin whose section has parameters of one other plugin only: file, value of ``plugin``, message."""
    for node in (each for _, group in sections(source) for each in walk(group)):
        plugin = node.find("plugin")
        name = plugin.class_name if plugin is not None else ""
        own = next((row for row in _rows() if name in row[0]), None)
        if plugin is None or own is None or name in _OF_TWO_PLUGINS:
            continue
        written = {key.text for key, _ in node.entries}
        others = [row for row in _rows() if row[1] == own[1] and row is not own and written & row[2]]
        found = written & others[0][2] if len(others) == 1 else set[str]()
        if not written & own[2] and (len(found) > 1 or (found and own[1] == "layer")):
            other, first = sorted(others[0][0])[0], next(key.text for key, _ in node.entries if key.text in found)
            yield source, plugin, f"`{name}` has no parameter `{first}`; this section has the parameters of `{other}`"


_SINGLE = ("Spin", "BackUp", "DriveOnHeading", "Wait", "AssistedTeleop", "StaticLayer", "InflationLayer")
"""Plugins of which a node needs one."""


def repeated_plugins(source: Source) -> Defects:
    """Yield each plugin that another section of its node has too, and whose section has another name."""
    for _, group in sections(source):
        seen: dict[str, list[tuple[str, Node]]] = {}
        for key, value in group.entries:
            plugin = value.find("plugin")
            name = plugin.class_name if plugin is not None else ""
            if plugin is not None and name in _SINGLE and value.find("map_topic") is None:
                seen.setdefault(name, []).append((key.text, plugin))
        for name, found in seen.items():
            other = [(key, plugin) for key, plugin in found if _plain(key) != _plain(name)]
            if len(found) == 2 and len(other) == 1:
                section, place = other[0]
                yield source, place, f"section `{section}` has the plugin `{name}`, which another section also uses"


def _plain(name: str) -> str:
    return name.replace("_", "").lower()


_MODEL_STEP = 0.05
"""Default of ``model_dt`` [s], the period of the default frequency (nav2_mppi_controller, optimizer.cpp)."""


def short_model_steps(source: Source) -> Defects:
    """Yield each time step of MPPI that is shorter than the period of the controller, which the controller refuses."""
    for key, group in sections(source) if "model_dt" in source.text else ():
        rate = number_of(group.find("controller_frequency"))
        for node in walk(group) if rate else ():
            value, step = node.find("model_dt"), number_of(node.find("model_dt"))
            if value is not None and step is not None and rate and 1.0 / rate > step + 1e-6:
                message = f"`model_dt` is {step:g} s, shorter than the period of `{key.text}`, {1.0 / rate:g} s"
                frequency = group.find("controller_frequency")
                is_default = abs(step - _MODEL_STEP) < 1e-9 and frequency is not None  # so the frequency was changed
                yield source, frequency if is_default and frequency is not None else value, message
