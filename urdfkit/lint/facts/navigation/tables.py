"""Names of Nav2: nodes, plugins, parameters and their types.

Sources: ros-navigation/navigation2, nav2_bringup/params/nav2_params.yaml and the plugin descriptions of its packages
(Humble to Rolling).
"""

from __future__ import annotations

_NODES = """
amcl behavior_server bt_navigator collision_monitor controller_server docking_server global_costmap local_costmap
map_saver map_server planner_server recoveries_server route_server smoother_server velocity_smoother waypoint_follower
"""
NODES = frozenset(_NODES.split())

_PLUGINS = """
dwb_core::DWBLocalPlanner nav2_amcl::DifferentialMotionModel nav2_amcl::OmniMotionModel nav2_behaviors::AssistedTeleop
nav2_behaviors::BackUp nav2_behaviors::DriveOnHeading nav2_behaviors::Spin nav2_behaviors::Wait
nav2_bt_navigator::NavigateThroughPosesNavigator nav2_bt_navigator::NavigateToPoseNavigator
nav2_constrained_smoother::ConstrainedSmoother nav2_controller::PoseProgressChecker
nav2_controller::PositionGoalChecker nav2_controller::SimpleGoalChecker nav2_controller::SimpleProgressChecker
nav2_controller::StoppedGoalChecker nav2_costmap_2d::BinaryFilter nav2_costmap_2d::DenoiseLayer
nav2_costmap_2d::InflationLayer nav2_costmap_2d::KeepoutFilter nav2_costmap_2d::ObstacleLayer
nav2_costmap_2d::RangeSensorLayer nav2_costmap_2d::SpeedFilter nav2_costmap_2d::StaticLayer nav2_costmap_2d::VoxelLayer
nav2_graceful_controller::GracefulController nav2_mppi_controller::MPPIController nav2_navfn_planner::NavfnPlanner
nav2_regulated_pure_pursuit_controller::RegulatedPurePursuitController
nav2_rotation_shim_controller::RotationShimController nav2_smac_planner::SmacPlanner2D
nav2_smac_planner::SmacPlannerHybrid nav2_smac_planner::SmacPlannerLattice nav2_smoother::SavitzkyGolaySmoother
nav2_smoother::SimpleSmoother nav2_theta_star_planner::ThetaStarPlanner nav2_waypoint_follower::InputAtWaypoint
nav2_waypoint_follower::PhotoAtWaypoint nav2_waypoint_follower::WaitAtWaypoint
spatio_temporal_voxel_layer::SpatioTemporalVoxelLayer
"""
PLUGINS = frozenset(_PLUGINS.split())

_DEFAULTS = """
AssistedTeleop DriveOnHeading FollowPath GridBased SimpleSmoother Spin Wait assisted_teleop back_up backup
drive_on_heading goal_checker inflation_layer navigate_through_poses navigate_to_pose obstacle_layer progress_checker
simple_smoother smooth_path spin static_layer voxel_layer wait wait_at_waypoint general_goal_checker
"""
DEFAULTS = frozenset(_DEFAULTS.split())
"""Names of plugins that need no section, because their nodes have types for them."""

_BEHAVIORS = ("spin", "backup", "wait")
DEFAULT_LISTS = frozenset(
    frozenset(names)
    for names in (
        *(("GridBased",), ("FollowPath",), ("simple_smoother",), ("progress_checker",), ("goal_checker",)),
        *(_BEHAVIORS, (*_BEHAVIORS, "drive_on_heading"), (*_BEHAVIORS, "drive_on_heading", "assisted_teleop")),
        *(("navigate_to_pose", "navigate_through_poses"), ("static_layer", "obstacle_layer", "inflation_layer")),
        ("wait_at_waypoint",),
    )
)
"""Lists of plugins for which nodes set the types of their plugins; not for a part of them."""

_DOUBLES = """
acc_lim_theta acc_lim_x acc_lim_y angular_granularity bond_heartbeat_period controller_frequency cost_scaling_factor
cycle_frequency decel_lim_theta decel_lim_x decel_lim_y desired_linear_vel expected_planner_frequency failure_tolerance
inflation_radius laser_likelihood_max_dist laser_max_range laser_min_range linear_granularity lookahead_dist
lookahead_time max_lookahead_dist max_obstacle_height max_rotational_vel max_speed_xy max_vel_theta max_vel_x max_vel_y
min_lookahead_dist min_rotational_vel min_theta_velocity_threshold min_x_velocity_threshold min_y_velocity_threshold
movement_time_allowance obstacle_max_range obstacle_min_range origin_z publish_frequency raytrace_max_range
raytrace_min_range required_movement_radius resolution robot_radius rotational_acc_lim save_map_timeout sim_time
simulate_ahead_time smoothing_frequency tolerance transform_tolerance update_frequency velocity_timeout
xy_goal_tolerance yaw_goal_tolerance z_resolution
"""
DOUBLES = frozenset(_DOUBLES.split())

INTEGERS = frozenset(("height", "loop_rate", "max_beams", "max_particles", "min_particles", "width", "z_voxels"))

_POSITIVE = """
controller_frequency cycle_frequency inflation_radius resolution robot_radius smoothing_frequency update_frequency
xy_goal_tolerance yaw_goal_tolerance z_resolution max_particles min_particles max_beams width height bt_loop_duration
cost_scaling_factor default_server_timeout desired_linear_vel expected_planner_frequency lookahead_dist lookahead_time
max_lookahead_dist min_lookahead_dist max_its movement_time_allowance obstacle_max_range publish_frequency
raytrace_max_range rotational_acc_lim sim_time transform_tolerance required_movement_radius alpha1 alpha2 alpha3 alpha4
alpha5
"""
POSITIVE = frozenset(_POSITIVE.split())

MAY_BE_ZERO = frozenset(
    (
        *(
            "alpha1",
            "alpha2",
            "alpha3",
            "alpha4",
            "alpha5",
            "robot_radius",
            "inflation_radius",
            "cost_scaling_factor",
            "expected_planner_frequency",
        ),
        *("min_lookahead_dist", "publish_frequency", "transform_tolerance", "sensor_timeout", "transform_timeout"),
        *("minimum_time_interval", "minimum_travel_distance", "minimum_travel_heading", "transform_publish_period"),
    )
)
"""Parameters that may be zero."""

PLANNERS_POSITIVE = frozenset(("acc_lim_theta", "acc_lim_x", "sim_time", "vx_samples", "vth_samples"))
"""Parameters of the local planners of ROS 1 that are positive (dwa_local_planner: dwa_planner.cpp)."""

_SLAM = """
map_update_interval max_laser_range minimum_time_interval minimum_travel_distance minimum_travel_heading resolution
scan_buffer_size tf_buffer_duration throttle_scans transform_publish_period transform_timeout
"""
SLAM_POSITIVE = frozenset(_SLAM.split())
"""Parameters of slam_toolbox that are not negative (slam_toolbox_common.cpp, karto_sdk: Mapper.cpp)."""

SLAM_DOUBLES = frozenset(("map_update_interval", "max_laser_range", "resolution", "tf_buffer_duration"))

FILTER_POSITIVE = frozenset(("frequency", "sensor_timeout"))
"""Parameters of robot_localization that are not negative (ros_filter.cpp)."""

_SWITCHES = """
allow_reversing allow_unknown always_reset_initial_pose always_send_full_costmap clearing debug_logging do_beamskip
do_loop_closing enable_interactive_mode enabled first_map_only footprint_clearing_enabled map_start_at_dock
map_subscribe_transient_local marking permit_corrected_publication print_diagnostics publish_acceleration publish_tf
rolling_window set_initial_pose stateful tf_broadcast track_unknown_space two_d_mode use_astar use_collision_detection
use_control use_rotate_to_heading use_scan_barycenter use_scan_matching use_sim_time
"""
SWITCHES = frozenset(_SWITCHES.split())
"""Parameters that are true or false."""

_OTHERS = """
allow_unknown always_send_full_costmap base_frame_id behavior_plugins bt_loop_duration clearing controller_plugins
costmap_topic data_type default_server_timeout enabled footprint footprint_padding footprint_topic global_frame
global_frame_id goal_checker_plugins lethal_cost_threshold local_frame map_subscribe_transient_local map_topic marking
navigators observation_sources odom_frame_id odom_topic planner_plugins plugin_lib_names plugins
progress_checker_plugin progress_checker_plugins robot_base_frame rolling_window scan_topic smoother_plugins stateful
tf_broadcast track_unknown_space use_astar yaml_filename
min_approach_linear_velocity approach_velocity_scaling_dist use_velocity_scaled_lookahead_dist
use_regulated_linear_velocity_scaling use_cost_regulated_linear_velocity_scaling regulated_linear_scaling_min_radius
regulated_linear_scaling_min_speed use_fixed_curvature_lookahead curvature_lookahead_dist use_rotate_to_heading
rotate_to_heading_angular_vel rotate_to_heading_min_angle max_angular_accel max_robot_pose_search_dist
max_allowed_time_to_collision_up_to_carrot use_collision_detection allow_reversing min_speed_xy min_speed_theta
min_vel_x min_vel_y vx_samples vy_samples vtheta_samples short_circuit_trajectory_evaluation debug_trajectory_details
publish_cost_grid_pc trans_stopped_velocity critics time_steps model_dt batch_size vx_std vy_std wz_std vx_max vx_min
vy_max wz_max iteration_count prune_distance temperature motion_model visualize downsample_costmap
downsampling_factor max_iterations max_on_approach_iterations max_planning_time motion_model_for_search
angle_quantization_bins analytic_expansion_ratio analytic_expansion_max_length minimum_turning_radius reverse_penalty
change_penalty non_straight_penalty cost_penalty retrospective_penalty lookup_table_size cache_obstacle_heuristic
smooth_path node_names autostart smoothing_frequency scale_velocities feedback max_velocity min_velocity max_accel
max_decel odom_duration deadband_velocity velocity_timeout cmd_vel_in_topic cmd_vel_out_topic state_topic
source_timeout base_shift_correction stop_pub_timeout polygons action_type max_points slowdown_ratio
time_before_collision simulation_time_step visualize polygon_pub_topic observation_source stop_on_failure
waypoint_task_executor_plugin waypoint_pause_duration loop_rate current_goal_checker unknown_cost_value
trinary_costmap inflate_unknown inflate_around_unknown mark_threshold unknown_threshold combination_method
obstacle_min_range expected_update_rate observation_persistence inf_is_valid sensor_frame subscribe_to_updates
error_code_names error_code_name_prefixes default_nav_to_pose_bt_xml default_nav_through_poses_bt_xml
wait_for_service_timeout bt_loop_duration save_map_timeout free_thresh_default occupied_thresh_default
map_subscribe_transient_local required_movement_angle trans_stopped_velocity rot_stopped_velocity xy_goal_tolerance
behavior_server_timeout
"""
OTHERS = frozenset(_OTHERS.split())
"""Further parameters, for which a similar name is a misspelt one."""

CHOICES = {
    "laser_model_type": ("beam", "likelihood_field", "likelihood_field_prob"),
    "odom_model_type": ("diff", "omni", "diff-corrected", "omni-corrected"),
    "solver_plugin": ("solver_plugins::CeresSolver", "solver_plugins::G2oSolver", "solver_plugins::SpaSolver"),
    "ceres_linear_solver": ("SPARSE_NORMAL_CHOLESKY", "SPARSE_SCHUR", "ITERATIVE_SCHUR", "CGNR"),
    "ceres_preconditioner": ("SCHUR_JACOBI", "JACOBI", "IDENTITY"),
    "ceres_trust_strategy": ("LEVENBERG_MARQUARDT", "DOGLEG"),
    "ceres_dogleg_type": ("TRADITIONAL_DOGLEG", "SUBSPACE_DOGLEG"),
    "ceres_loss_function": ("None", "HuberLoss", "CauchyLoss"),
}
"""Parameters of amcl and slam_toolbox: their values (nav2_amcl: amcl_node.cpp; slam_toolbox: ceres_solver.cpp)."""

SLAM_MODES = ("mapping", "localization")
"""Values of ``mode`` of slam_toolbox (README.md)."""

MOTION_MODELS = {"differential": "nav2_amcl::DifferentialMotionModel", "omnidirectional": "nav2_amcl::OmniMotionModel"}
"""Motion models of amcl until Galactic → the plugins of Humble and later."""

SIMILAR = {
    "robot_model_type": (
        *("nav2_amcl::DifferentialMotionModel", "nav2_amcl::OmniMotionModel", "differential", "omnidirectional"),
        *("omni_directional",),
    ),
    "motion_model_for_search": ("DUBIN", "REEDS_SHEPP", "STATE_LATTICE", "MOORE", "VON_NEUMANN"),
}
"""Parameters for which a value that differs by a letter is misspelt; other values can be those of plugins."""

MPPI_MODELS = ("DiffDrive", "Omni", "Ackermann")
"""Values of ``motion_model`` of MPPI, which refuses others (nav2_mppi_controller: optimizer.cpp)."""

COSTMAP_ROS1 = frozenset(
    (
        *("footprint", "footprint_padding", "global_frame", "height", "inflation_radius", "map_type"),
        *("max_obstacle_height", "observation_sources", "obstacle_range", "origin_x", "origin_y", "origin_z"),
        *("plugins", "unknown_threshold", "mark_threshold", "z_resolution", "z_voxels", "track_unknown_space"),
        *("publish_frequency", "raytrace_range", "resolution", "robot_base_frame", "robot_radius", "rolling_window"),
        *("static_map", "transform_tolerance", "update_frequency", "width", "cost_scaling_factor"),
    )
)
"""Parameters of costmap_2d in ROS 1 (costmap_2d_ros.cpp and its layers, Noetic)."""

MUX = ("topic", "timeout", "priority", "short_desc", "name")
"""Parameters of an input of twist_mux (twist_mux.cpp)."""

FRAMES = ("global_frame", "global_frame_id", "local_frame", "map_frame", "odom_frame", "odom_frame_id", "world_frame")
"""Parameters whose values are usually ``map`` or ``odom``."""

DIFFERENT_FRAMES = (
    *(("map_frame", "odom_frame"), ("odom_frame", "base_frame"), ("global_frame_id", "odom_frame_id")),
    *(("odom_frame_id", "base_frame_id"), ("map_frame", "base_frame"), ("global_frame_id", "base_frame_id")),
)
"""Pairs of parameters of a node whose frames must differ."""

VELOCITY_LIMITS = {"max_velocity": -1, "min_velocity": 1, "max_accel": -1, "max_decel": 1}
"""List of velocity_smoother → the sign that its values must not have."""

ORDERED = (
    *(("min_vel_x", "max_vel_x"), ("min_vel_y", "max_vel_y"), ("min_speed_xy", "max_speed_xy")),
    *(("min_speed_theta", "max_vel_theta"), ("min_rotational_vel", "max_rotational_vel")),
    *(("min_obstacle_height", "max_obstacle_height"), ("obstacle_min_range", "obstacle_max_range")),
    *(("raytrace_min_range", "raytrace_max_range"), ("min_lookahead_dist", "max_lookahead_dist")),
    *(("min_lookahead_dist", "lookahead_dist"), ("lookahead_dist", "max_lookahead_dist"), ("vx_min", "vx_max")),
    *(("min_vel_trans", "max_vel_trans"), ("min_vel_theta", "max_vel_theta"), ("min_trans_vel", "max_trans_vel")),
    *(("min_rot_vel", "max_rot_vel"), ("min_in_place_vel_theta", "max_vel_theta"), ("maxUrange", "maxRange")),
    *(("min_laser_range", "max_laser_range"), ("laser_min_range", "laser_max_range"), ("xmin", "xmax")),
    *(("ymin", "ymax"), ("obstacle_range", "raytrace_range"), ("obstacle_max_range", "raytrace_max_range")),
    *(("v_linear_min", "v_linear_max"), ("min_lookahead", "max_lookahead"), ("u_clamp_min", "u_clamp_max")),
    *(("range_min", "range_max"), ("lower_threshold", "upper_threshold")),
    *(("near_clipping_plane_distance", "far_clipping_plane_distance"), ("lower_angle", "upper_angle")),
    ("free_thresh_default", "occupied_thresh_default"),
)
"""Pairs of a minimum and its maximum."""

CRITICS = frozenset(
    (
        *("BaseObstacle", "GoalAlign", "GoalDist", "ObstacleFootprint", "Oscillation", "PathAlign", "PathDist"),
        *("PreferForward", "RotateToGoal", "Twirling", "ConstraintCritic", "CostCritic", "GoalCritic"),
        *("GoalAngleCritic", "ObstaclesCritic", "PathAlignCritic", "PathAlignLegacyCritic", "PathAngleCritic"),
        *("PathFollowCritic", "PreferForwardCritic", "TwirlingCritic", "VelocityDeadbandCritic"),
    )
)
"""Critics of dwb_critics and nav2_mppi_controller (Humble to Kilted)."""
