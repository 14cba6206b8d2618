"""Ackermann steering: gazebo_ros_ackermann_drive (ROS 2) and gz sim's AckermannSteering. Not in ROS 1."""

from urdfkit.description.plugins.common_parameters import GZ_LIMITS, GZ_ODOMETRY, gazebo_ros_2, gz_system
from urdfkit.description.plugins.spec import Parameter

ACKERMANN_ROS_2 = gazebo_ros_2(
    "ackermann",
    "gazebo_ros_ackermann_drive",
    Parameter("front_left_joint", "front_left_joint", "front_left_joint", names="joint"),
    Parameter("front_right_joint", "front_right_joint", "front_right_joint", names="joint"),
    Parameter("rear_left_joint", "rear_left_joint", "rear_left_joint", names="joint"),
    Parameter("rear_right_joint", "rear_right_joint", "rear_right_joint", names="joint"),
    Parameter("left_steering_joint", "left_steering_joint", "left_steering_joint", names="joint"),
    Parameter("right_steering_joint", "right_steering_joint", "right_steering_joint", names="joint"),
    Parameter("steering_wheel_joint", "steering_wheel_joint", names="joint"),
    Parameter("max_speed", "max_speed", "20", "[m/s]"),
    Parameter("max_steer", "max_steer", "0.6", "[rad]"),
    Parameter("max_steering_angle", "max_steering_angle", "7.85", "[rad]"),
    Parameter("left_steering_gains", "left_steering_pid_gain", "0 0 0"),
    Parameter("left_steering_range", "left_steering_i_range", "0 0", "[N·m]"),
    Parameter("right_steering_gains", "right_steering_pid_gain", "0 0 0"),
    Parameter("right_steering_range", "right_steering_i_range", "0 0", "[N·m]"),
    Parameter("speed_gains", "linear_velocity_pid_gain", "0 0 0"),
    Parameter("speed_range", "linear_velocity_i_range", "0 0", "[N·m]"),
    Parameter("update_rate", "update_rate", "100", "[Hz]"),
    Parameter("odometry_frame", "odometry_frame", "odom", names="frame"),
    Parameter("base_frame", "robot_base_frame", "base_footprint", names="link"),
    Parameter("publish_odometry", "publish_odom", "false"),
    Parameter("publish_odometry_tf", "publish_odom_tf", "false"),
    Parameter("publish_wheel_tf", "publish_wheel_tf", "false"),
    Parameter("publish_distance", "publish_distance", "false"),
    Parameter("publish_steer_angle", "publish_steerangle", "false"),
    Parameter("covariance_x", "covariance_x", "0.00001", "[m²]"),
    Parameter("covariance_y", "covariance_y", "0.00001", "[m²]"),
    Parameter("covariance_yaw", "covariance_yaw", "0.001", "[rad²]"),
)
"""Gains are proportional, integral and derivative; ranges are the minimum and maximum of the integral term.

The default name of the steering wheel's joint is ``steering_wheel_joint``; the joint is optional.
``publish_steerangle`` publishes the mean of both steered wheels' angles on ``steerangle``.
"""

ACKERMANN_GZ = gz_system(
    "ackermann_steering",
    "AckermannSteering",
    Parameter("left_joint", "left_joint", names="joint", repeats=True),
    Parameter("right_joint", "right_joint", names="joint", repeats=True),
    Parameter("left_steering_joint", "left_steering_joint", names="joint", repeats=True),
    Parameter("right_steering_joint", "right_steering_joint", names="joint", repeats=True),
    Parameter("wheel_separation", "wheel_separation", "1.0", "[m]"),
    Parameter("kingpin_width", "kingpin_width", "0.8", "[m]"),
    Parameter("wheel_base", "wheel_base", "1.0", "[m]"),
    Parameter("wheel_radius", "wheel_radius", "0.2", "[m]"),
    Parameter("max_steer", "steering_limit", "0.5", "[rad]"),
    Parameter("steer_p", "steer_p_gain", "1", "[1/s]"),
    Parameter("steer_i", "steer_i_gain", "0", "[1/s²]"),
    Parameter("steer_d", "steer_d_gain", "0"),
    Parameter("steer_i_max", "steer_i_max", "0", "[rad/s]"),
    Parameter("steer_i_min", "steer_i_min", "0", "[rad/s]"),
    Parameter("steer_max", "steer_cmd_max", "1000", "[rad/s]"),
    Parameter("steer_min", "steer_cmd_min", "-1000", "[rad/s]"),
    Parameter("steer_offset", "steer_cmd_offset", "0", "[rad/s]"),
    Parameter("steering_only", "steering_only", "false"),
    Parameter("use_actuator_message", "use_actuator_msg", "false"),
    Parameter("actuator_number", "actuator_number"),
    Parameter("command_subtopic", "sub_topic", names="topic"),
    *(p for p in GZ_ODOMETRY if p.meaning != "command_topic"),
    Parameter("command_topic", "topic", names="topic"),
    *GZ_LIMITS,
)
"""The default topic, without ``topic`` and ``sub_topic``, is ``/model/MODEL/cmd_vel``; ``…/steer_angle`` with
``steering_only``."""

ACKERMANN = (ACKERMANN_ROS_2, ACKERMANN_GZ)
"""The specifications of Ackermann steering in both generations."""
