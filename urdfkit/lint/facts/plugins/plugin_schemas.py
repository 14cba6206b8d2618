"""Types of the parameters of plugins, controllers and further nodes, which a section names or has most of.

Sources (Humble to Rolling): ros-navigation/navigation2 (nav2_mppi_controller, nav2_dwb_controller, nav2_costmap_2d,
nav2_regulated_pure_pursuit_controller, nav2_smac_planner, opennav_docking), ros-controls/ros2_controllers
(*_parameters.yaml), ros-perception (pointcloud_to_laserscan, depthimage_to_laserscan), christianrauch/apriltag_ros,
CCNYRoboticsLab/imu_tools. ROS 1 (Noetic): ros-planning/navigation, rst-tu-dortmund/teb_local_planner,
ros-perception/slam_gmapping, ros-perception/laser_filters.
"""

CLASSES = """
MPPIController
batch_size time_steps iteration_count retry_attempt_limit *.cost_power *.offset_from_furthest: int
*.trajectory_point_step: int
model_dt vx_std vy_std wz_std vx_max vx_min vy_max wz_max ax_max ax_min ay_max ay_min az_max temperature gamma: double
prune_distance transform_tolerance max_robot_pose_search_dist *.min_turning_r *.cost_weight: double
*.threshold_to_consider *.max_angle_to_furthest *.critical_cost *.collision_cost *.near_goal_distance: double
*.repulsion_weight *.critical_weight *.collision_margin_distance *.max_path_occupancy_ratio: double
visualize regenerate_noises enforce_path_inversion *.enabled *.consider_footprint *.use_path_orientations: bool
motion_model: text
critics: list text

RegulatedPurePursuitController RotationShimController
desired_linear_vel lookahead_dist min_lookahead_dist max_lookahead_dist lookahead_time transform_tolerance: double
rotate_to_heading_angular_vel min_approach_linear_velocity approach_velocity_scaling_dist cost_scaling_dist: double
max_allowed_time_to_collision_up_to_carrot regulated_linear_scaling_min_radius cost_scaling_gain: double
regulated_linear_scaling_min_speed rotate_to_heading_min_angle max_angular_accel curvature_lookahead_dist: double
inflation_cost_scaling_factor max_robot_pose_search_dist angular_dist_threshold forward_sampling_distance: double
simulate_ahead_time angular_disengage_threshold: double
use_velocity_scaled_lookahead_dist use_collision_detection use_regulated_linear_velocity_scaling: bool
use_cost_regulated_linear_velocity_scaling use_rotate_to_heading allow_reversing use_interpolation: bool
use_fixed_curvature_lookahead rotate_to_goal_heading: bool
primary_controller: text

DWBLocalPlanner
min_vel_x min_vel_y max_vel_x max_vel_y max_vel_theta min_speed_xy max_speed_xy min_speed_theta acc_lim_x: double
acc_lim_y acc_lim_theta decel_lim_x decel_lim_y decel_lim_theta sim_time linear_granularity: double
angular_granularity time_granularity transform_tolerance xy_goal_tolerance trans_stopped_velocity: double
prune_distance *.scale *.forward_point_distance *.slowing_factor *.lookahead_time: double
vx_samples vy_samples vtheta_samples: int
debug_trajectory_details short_circuit_trajectory_evaluation discretize_by_time: bool
critics: list text

GracefulController
min_lookahead max_lookahead k_phi k_delta beta lambda v_linear_min v_linear_max v_angular_max slowdown_radius: double
transform_tolerance initial_rotation_min_angle: double
initial_rotation allow_backward prefer_final_rotation: bool

NavfnPlanner
tolerance: double
use_astar allow_unknown use_final_approach_orientation: bool

ThetaStarPlanner
how_many_corners terminal_checking_interval: int
w_euc_cost w_traversal_cost w_heuristic_cost: double
allow_unknown use_final_approach_orientation: bool

SmacPlannerHybrid SmacPlannerLattice SmacPlanner2D
tolerance max_planning_time analytic_expansion_ratio analytic_expansion_max_length minimum_turning_radius: double
reverse_penalty change_penalty non_straight_penalty cost_penalty retrospective_penalty rotation_penalty: double
lookup_table_size cost_travel_multiplier analytic_expansion_max_cost smoother.w_smooth smoother.w_data: double
smoother.tolerance: double
downsampling_factor max_iterations max_on_approach_iterations angle_quantization_bins smoother.max_iterations: int
downsample_costmap allow_unknown cache_obstacle_heuristic smooth_path allow_reverse_expansion: bool
debug_visualizations use_quadratic_cost_penalty downsample_obstacle_heuristic smoother.do_refinement: bool
motion_model_for_search lattice_filepath: text

SimpleSmoother
tolerance: double
max_its refinement_num: int
do_refinement: bool

InflationLayer
cost_scaling_factor inflation_radius: double
enabled inflate_unknown inflate_around_unknown: bool

ObstacleLayer VoxelLayer
max_obstacle_height min_obstacle_height origin_z z_resolution *.max_obstacle_height *.min_obstacle_height: double
*.obstacle_max_range *.obstacle_min_range *.raytrace_max_range *.raytrace_min_range: double
*.expected_update_rate *.observation_persistence: double
z_voxels unknown_threshold mark_threshold combination_method: int
enabled footprint_clearing_enabled publish_voxel_map *.clearing *.marking *.inf_is_valid: bool
*.topic *.data_type *.sensor_frame: text

DenoiseLayer
minimal_group_size group_connectivity_type: int
enabled: bool

StaticLayer
enabled map_subscribe_transient_local subscribe_to_updates footprint_clearing_enabled: bool
map_topic: text
transform_tolerance: double

RangeSensorLayer
phi inflate_cone no_readings_timeout clear_threshold mark_threshold: double
enabled clear_on_max_reading: bool
input_sensor_type: text
topics: list text

KeepoutFilter SpeedFilter BinaryFilter
enabled: bool
filter_info_topic speed_limit_topic: text
transform_tolerance: double

SimpleGoalChecker StoppedGoalChecker PositionGoalChecker
xy_goal_tolerance yaw_goal_tolerance trans_stopped_velocity rot_stopped_velocity: double
stateful: bool

SimpleProgressChecker PoseProgressChecker
required_movement_radius required_movement_angle movement_time_allowance: double

WaitAtWaypoint
enabled: bool
waypoint_pause_duration: int

SimpleChargingDock SimpleNonChargingDock
docking_threshold staging_x_offset staging_yaw_offset external_detection_timeout filter_coef: double
external_detection_translation_x external_detection_translation_y external_detection_rotation_roll: double
external_detection_rotation_pitch external_detection_rotation_yaw charging_threshold: double
stall_velocity_threshold stall_effort_threshold: double
use_external_detection_pose use_battery_status use_stall_detection: bool
stall_joint_names: list text

AdmittanceController
joints command_interfaces state_interfaces chainable_command_interfaces: list text
kinematics.plugin_name kinematics.plugin_package kinematics.base kinematics.tip ft_sensor.name *.frame.id: text
*.frame.external enable_parameter_update_without_reactivation: bool
kinematics.alpha ft_sensor.filter_coefficient gravity_compensation.CoG.force admittance.joint_damping: double
gravity_compensation.CoG.pos: list double 3
admittance.selected_axes: list bool 6
admittance.mass admittance.damping_ratio admittance.stiffness: list double 6

IMUSensorBroadcaster
sensor_name frame_id: text
static_covariance_orientation static_covariance_angular_velocity static_covariance_linear_acceleration: list double 9

RangeSensorBroadcaster
sensor_name frame_id: text
field_of_view min_range max_range variance: double
radiation_type: int

ForceTorqueSensorBroadcaster
sensor_name frame_id: text

JointStateBroadcaster
joints interfaces extra_joints: list text
use_local_topics: bool

PidController
dof_names reference_and_state_dof_names reference_and_state_interfaces: list text
command_interface: text
gains.*.p gains.*.i gains.*.d gains.*.u_clamp_max gains.*.u_clamp_min gains.*.i_clamp_max: double
gains.*.i_clamp_min gains.*.feedforward_gain: double
gains.*.antiwindup use_external_measured_states enable_feedforward: bool

MecanumDriveController
*_wheel_command_joint_name interface_name base_frame_id odom_frame_id: text
reference_timeout kinematics.wheels_radius kinematics.sum_of_robot_center_projection_on_X_Y_axis: double
kinematics.base_frame_offset.*: double
enable_odom_tf: bool

AckermannSteeringController BicycleSteeringController TricycleSteeringController
open_loop position_feedback enable_odom_tf: bool
velocity_rolling_window_size: int
odom_frame_id base_frame_id: text
traction_joints_names steering_joints_names: list text

DiffDriveController TricycleController
open_loop position_feedback enable_odom_tf use_stamped_vel publish_limited_velocity odom_only_twist: bool
velocity_rolling_window_size wheels_per_side: int
odom_frame_id base_frame_id: text

docking_server
controller_frequency initial_perception_timeout wait_charge_timeout dock_approach_timeout: double
undock_linear_tolerance undock_angular_tolerance dock_prestaging_tolerance rotation_angular_tolerance: double
controller.k_phi controller.k_delta controller.beta controller.lambda controller.v_linear_min: double
controller.v_linear_max controller.v_angular_max controller.slowdown_radius controller.transform_tolerance: double
max_retries: int
dock_backwards controller.use_collision_detection: bool
base_frame fixed_frame dock_database odom_topic: text
dock_plugins docks: list text
*.pose: list double 3

costmap_filter_info_server
type: int
base multiplier: double
filter_info_topic mask_topic: text

collision_monitor
*.min_points *.max_points: int
*.slowdown_ratio *.time_before_collision *.simulation_time_step *.linear_limit *.angular_limit *.radius: double
*.min_height *.max_height: double
*.visualize *.enabled: bool
*.type *.topic *.action_type *.polygon_pub_topic *.footprint_topic: text

pointcloud_to_laserscan
transform_tolerance min_height max_height angle_min angle_max angle_increment scan_time range_min range_max: double
inf_epsilon: double
use_inf: bool
queue_size: int
target_frame: text

depthimage_to_laserscan
scan_time range_min range_max: double
scan_height: int
output_frame output_frame_id: text

apriltag
image_transport family: text
size detector.decimate detector.blur detector.sharpening: double
max_hamming detector.threads: int
detector.refine detector.debug profile: bool
tag.ids: list int
tag.frames: list text
tag.sizes: list double

imu_filter
use_mag publish_tf reverse_tf stateless use_magnetic_field_msg remove_gravity_vector publish_debug_topics: bool
gain zeta orientation_stddev constant_dt mag_bias_x mag_bias_y mag_bias_z: double
world_frame fixed_frame: text
"""
"""Classes of plugins and controllers, and nodes that have other names too, with the types of their parameters."""

OF_ROS1 = """
TebLocalPlannerROS
dt_ref dt_hysteresis global_plan_viapoint_sep max_global_plan_lookahead_dist max_vel_x max_vel_x_backwards: double
max_vel_y max_vel_theta acc_lim_x acc_lim_y acc_lim_theta min_turning_radius wheelbase xy_goal_tolerance: double
yaw_goal_tolerance min_obstacle_dist inflation_dist costmap_obstacles_behind_robot_dist penalty_epsilon: double
weight_max_vel_x weight_max_vel_y weight_max_vel_theta weight_acc_lim_x weight_acc_lim_y weight_acc_lim_theta: double
weight_kinematics_nh weight_kinematics_forward_drive weight_kinematics_turning_radius weight_optimaltime: double
weight_shortest_path weight_obstacle weight_inflation weight_dynamic_obstacle weight_viapoint: double
weight_adapt_factor obstacle_cost_exponent selection_cost_hysteresis selection_obst_cost_scale: double
roadmap_graph_area_width h_signature_prescaler h_signature_threshold obstacle_heading_threshold: double
max_samples min_samples feasibility_check_no_poses obstacle_poses_affected no_inner_iterations: int
no_outer_iterations max_number_classes roadmap_graph_no_samples: int
teb_autosize global_plan_overwrite_orientation allow_init_with_backwards_motion exact_arc_length free_goal_vel: bool
complete_global_plan include_costmap_obstacles optimization_activate optimization_verbose publish_feedback: bool
enable_homotopy_class_planning enable_multithreading viapoints_all_candidates visualize_hc_graph: bool
include_dynamic_obstacles legacy_obstacle_association cmd_angle_instead_rotvel oscillation_recovery: bool
odom_topic map_frame costmap_converter_plugin: text

DWAPlannerROS TrajectoryPlannerROS
acc_lim_x acc_lim_y acc_lim_theta acc_lim_th max_vel_trans min_vel_trans max_vel_x min_vel_x max_vel_y: double
min_vel_y max_vel_theta min_vel_theta min_in_place_vel_theta escape_vel yaw_goal_tolerance xy_goal_tolerance: double
sim_time sim_granularity angular_sim_granularity path_distance_bias goal_distance_bias occdist_scale: double
path_distance_bias goal_distance_bias forward_point_distance stop_time_buffer scaling_speed: double
max_scaling_factor oscillation_reset_dist oscillation_reset_angle prune_distance trans_stopped_vel: double
theta_stopped_vel pdist_scale gdist_scale heading_lookahead: double
vx_samples vy_samples vth_samples vtheta_samples: int
latch_xy_goal_tolerance holonomic_robot meter_scoring dwa prune_plan publish_traj_pc publish_cost_grid_pc: bool
odom_topic global_frame_id: text

GlobalPlanner
default_tolerance cost_factor: double
lethal_cost neutral_cost orientation_mode: int
allow_unknown use_dijkstra use_quadratic use_grid_path old_navfn_behavior publish_potential: bool
visualize_potential outline_map: bool

NavfnROS
default_tolerance planner_window_x planner_window_y: double
allow_unknown visualize_potential: bool

move_base
controller_frequency planner_frequency controller_patience planner_patience oscillation_timeout: double
oscillation_distance conservative_reset_dist: double
max_planning_retries: int
recovery_behavior_enabled clearing_rotation_allowed shutdown_costmaps make_plan_clear_costmap: bool
base_global_planner base_local_planner: text

costmap
update_frequency publish_frequency transform_tolerance width height resolution robot_radius: double
footprint_padding inflation_radius cost_scaling_factor origin_x origin_y obstacle_range raytrace_range: double
rolling_window static_map track_unknown_space always_send_full_costmap: bool
global_frame robot_base_frame map_type: text

amcl
odom_alpha1 odom_alpha2 odom_alpha3 odom_alpha4 odom_alpha5 kld_err kld_z update_min_d update_min_a: double
transform_tolerance laser_min_range laser_max_range laser_z_hit laser_z_short laser_z_max laser_z_rand: double
laser_sigma_hit laser_lambda_short laser_likelihood_max_dist gui_publish_rate save_pose_rate: double
recovery_alpha_slow recovery_alpha_fast initial_pose_x initial_pose_y initial_pose_a: double
min_particles max_particles resample_interval laser_max_beams: int
use_map_topic first_map_only tf_broadcast: bool
odom_frame_id base_frame_id global_frame_id odom_model_type laser_model_type: text

gmapping
map_update_interval maxUrange maxRange sigma lstep astep lsigma ogain minimumScore srr srt str stt: double
linearUpdate angularUpdate temporalUpdate resampleThreshold xmin ymin xmax ymax delta occ_thresh: double
transform_publish_period llsamplerange llsamplestep lasamplerange lasamplestep tf_delay: double
kernelSize iterations lskip particles throttle_scans: int
base_frame odom_frame map_frame: text

robot_localization
frequency sensor_timeout transform_time_offset transform_timeout: double
two_d_mode publish_tf print_diagnostics publish_acceleration: bool
odom*_config imu*_config pose*_config twist*_config: list bool
odom*_differential imu*_differential pose*_differential twist*_differential: bool
odom*_relative imu*_relative pose*_relative imu*_remove_gravitational_acceleration: bool
odom*_queue_size imu*_queue_size pose*_queue_size twist*_queue_size: int
map_frame odom_frame base_link_frame world_frame: text

four_wheel_steering
track wheel_base wheel_radius wheel_steering_y_offset cmd_vel_timeout publish_rate: double
enable_twist_cmd enable_odom_tf: bool
base_frame_id odom_frame_id: text

moveit_servo
publish_period incoming_command_timeout lower_singularity_threshold hard_stop_singularity_threshold: double
joint_limit_margin collision_check_rate self_collision_proximity_threshold: double
scene_collision_proximity_threshold scale.linear scale.rotational scale.joint: double
use_gazebo low_latency_mode publish_joint_positions publish_joint_velocities publish_joint_accelerations: bool
use_smoothing check_collisions halt_all_joints_in_joint_mode halt_all_joints_in_cartesian_mode: bool
command_in_type command_out_type smoothing_filter_plugin_name move_group_name planning_frame ee_frame_name: text
robot_link_command_frame cartesian_command_in_topic joint_command_in_topic joint_topic status_topic: text
command_out_topic monitored_planning_scene_topic: text

teleop_twist_joy
enable_button enable_turbo_button: int

pointcloud_to_laserscan
transform_tolerance min_height max_height angle_min angle_max angle_increment scan_time range_min range_max: double
use_inf: bool
queue_size concurrency_level: int
target_frame: text

depthimage_to_laserscan
scan_time range_min range_max: double
scan_height: int
output_frame_id: text

imu_filter
use_mag publish_tf reverse_tf stateless publish_debug_topics: bool
gain zeta orientation_stddev constant_dt: double
world_frame fixed_frame: text
"""
"""Sections of planners, and nodes of ROS 1, with the types of their parameters."""
