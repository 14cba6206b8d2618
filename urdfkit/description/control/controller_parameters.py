"""Parameters of controllers of ros_controllers and ros2_controllers."""

from urdfkit.description.control.settings import Settings

ALWAYS = ("type", "update_rate", "use_sim_time", "is_async", "async_parameters", "params_file", "publish_rate", "pid")
"""Parameters that controllers of every type have."""

_TRAJECTORY = (
    *("joints", "gains", "constraints", "state_publish_rate", "action_monitor_rate", "allow_partial_joints_goal"),
    *("command_joints", "command_interfaces", "state_interfaces", "open_loop_control", "interpolation_method"),
    *("allow_integration_in_goal_trajectories", "allow_nonzero_velocity_at_trajectory_end", "cmd_timeout"),
    *("interpolate_from_desired_state", "set_last_command_interface_value_as_state_on_activation", "speed_scaling"),
    *("stop_trajectory_duration", "velocity_ff", "hold_trajectory_duration", "use_closed_loop_pid_adapter"),
)
_GRIPPER = (
    *("joint", "goal_tolerance", "max_effort", "allow_stalling", "stall_velocity_threshold", "stall_timeout"),
    *("action_monitor_rate", "max_effort_interface", "max_velocity_interface", "max_velocity", "state_interfaces"),
)
OF_TYPES = {
    "diff_drive_controller/DiffDriveController": (
        *("left_wheel", "right_wheel", "left_wheel_names", "right_wheel_names", "wheels_per_side", "wheel_separation"),
        *("wheel_radius", "wheel_separation_multiplier", "wheel_radius_multiplier", "left_wheel_radius_multiplier"),
        *("right_wheel_radius_multiplier", "tf_frame_prefix_enable", "tf_frame_prefix", "odom_frame_id"),
        *("base_frame_id", "pose_covariance_diagonal", "twist_covariance_diagonal", "open_loop", "position_feedback"),
        *("enable_odom_tf", "cmd_vel_timeout", "publish_limited_velocity", "velocity_rolling_window_size"),
        *("use_stamped_vel", "linear", "angular", "allow_multiple_cmd_vel_publishers", "publish_cmd"),
        *("publish_wheel_joint_controller_state", "dynamic_reconfigure"),
    ),
    "joint_trajectory_controller/JointTrajectoryController": _TRAJECTORY,
    "position_controllers/JointTrajectoryController": _TRAJECTORY,
    "velocity_controllers/JointTrajectoryController": _TRAJECTORY,
    "effort_controllers/JointTrajectoryController": _TRAJECTORY,
    "joint_state_broadcaster/JointStateBroadcaster": (
        *("use_local_topics", "joints", "extra_joints", "interfaces", "map_interface_to_joint_state", "frame_id"),
        *("use_urdf_to_filter", "publish_dynamic_joint_states"),
    ),
    "joint_state_controller/JointStateController": ("extra_joints",),
    "forward_command_controller/ForwardCommandController": ("joints", "interface_name"),
    **{
        f"{kind}_controllers/GripperActionController": (*_GRIPPER, "gains", "pid")
        for kind in ("position", "effort", "velocity")
    },
    "parallel_gripper_action_controller/GripperActionController": _GRIPPER,
    "forward_command_controller/MultiInterfaceForwardCommandController": ("joint", "interface_names"),
    **{
        f"{kind}_controllers/JointGroup{kind.title()}Controller": ("joints",)
        for kind in ("position", "velocity", "effort")
    },
    **{
        f"{kind}_controllers/Joint{name}Controller": ("joint",)
        for kind, name in (("position", "Position"), ("velocity", "Velocity"), ("effort", "Effort"))
    },
}
"""Controller type → its parameters in any release: ros_controllers (Noetic), ros2_controllers (from Humble)."""


def unknown_parameters(settings: Settings) -> list[Settings]:
    """Return the parameters of a controller that no release of its type has; none for a type without a table."""
    table = OF_TYPES.get(settings.group("type").value or "")
    if table is None:
        return []
    names = {*table, *ALWAYS}
    return [child for name, child in settings.children.items() if name not in names and "type" not in child.children]
