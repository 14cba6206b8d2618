"""Differential drive: ROS 1, ROS 2 and gz sim; and the skid steer drive, which only ROS 1 has."""

from urdfkit.description.plugins.common_parameters import (
    GZ_LIMITS,
    GZ_ODOMETRY,
    GZ_SEPARATE_LIMITS,
    gazebo_ros_1,
    gazebo_ros_2,
    gz_system,
)
from urdfkit.description.plugins.spec import Parameter

DIFF_DRIVE_ROS_1 = gazebo_ros_1(
    "diff_drive",
    "gazebo_ros_diff_drive",
    Parameter("left_joint", "leftJoint", "left_joint", names="joint"),
    Parameter("right_joint", "rightJoint", "right_joint", names="joint"),
    Parameter("wheel_separation", "wheelSeparation", "0.34", "[m]"),
    Parameter("wheel_diameter", "wheelDiameter", "0.15", "[m]"),
    Parameter("max_wheel_torque", "wheelTorque", "5", "[N·m]"),
    Parameter("max_wheel_acceleration", "wheelAcceleration", "0", "[m/s²]"),
    Parameter("update_rate", "updateRate", "100", "[Hz]"),
    Parameter("command_topic", "commandTopic", "cmd_vel", names="topic"),
    Parameter("odometry_topic", "odometryTopic", "odom", names="topic"),
    Parameter("odometry_frame", "odometryFrame", "odom", names="frame"),
    Parameter("base_frame", "robotBaseFrame", "base_footprint", names="link"),
    Parameter("odometry_source", "odometrySource", "world"),
    Parameter("publish_odometry", "publishTf", "true"),
    Parameter("publish_odometry_tf", "publishOdomTF", "true"),
    Parameter("publish_wheel_tf", "publishWheelTF", "false"),
    Parameter("publish_wheel_joint_state", "publishWheelJointState", "false"),
    Parameter("legacy_mode", "legacyMode"),
    source="gazebo_ros_pkgs noetic-devel, gazebo_plugins/src/gazebo_ros_diff_drive.cpp (legacyMode: kinetic-devel)",
)
"""`publishTf` false turns off the odometry message and its transform. `publishOdomTF` is read since Kinetic,
`legacyMode` in Kinetic and Lunar only."""

DIFF_DRIVE_ROS_2 = gazebo_ros_2(
    "diff_drive",
    "gazebo_ros_diff_drive",
    Parameter("left_joint", "left_joint", "left_joint", names="joint", repeats=True),
    Parameter("right_joint", "right_joint", "right_joint", names="joint", repeats=True),
    Parameter("wheel_pairs", "num_wheel_pairs", "1"),
    Parameter("wheel_separation", "wheel_separation", "0.34", "[m]", repeats=True),
    Parameter("wheel_diameter", "wheel_diameter", "0.15", "[m]", repeats=True),
    Parameter("max_wheel_torque", "max_wheel_torque", "5", "[N·m]"),
    Parameter("max_wheel_acceleration", "max_wheel_acceleration", "0", "[m/s²]"),
    Parameter("update_rate", "update_rate", "100", "[Hz]"),
    Parameter("odometry_frame", "odometry_frame", "odom", names="frame"),
    Parameter("base_frame", "robot_base_frame", "base_footprint", names="link"),
    Parameter("odometry_source", "odometry_source", "1"),
    Parameter("publish_odometry", "publish_odom", "false"),
    Parameter("publish_odometry_tf", "publish_odom_tf", "false"),
    Parameter("publish_wheel_tf", "publish_wheel_tf", "false"),
    Parameter("covariance_x", "covariance_x", "0.00001", "[m²]"),
    Parameter("covariance_y", "covariance_y", "0.00001", "[m²]"),
    Parameter("covariance_yaw", "covariance_yaw", "0.001", "[rad²]"),
)
"""Topics are ``cmd_vel`` and ``odom``, changed by ``<ros><remapping>`` only. `odometry_source`: 0 encoder, 1 world."""

DIFF_DRIVE_GZ = gz_system(
    "diff_drive",
    "DiffDrive",
    Parameter("left_joint", "left_joint", names="joint", repeats=True),
    Parameter("right_joint", "right_joint", names="joint", repeats=True),
    Parameter("wheel_separation", "wheel_separation", "1.0", "[m]"),
    Parameter("wheel_radius", "wheel_radius", "0.2", "[m]"),
    *GZ_ODOMETRY,
    *GZ_LIMITS,
    *GZ_SEPARATE_LIMITS,
)
"""Generic limits apply to linear and angular velocity. A rate of zero or less publishes odometry every step."""

DIFF_DRIVE = (DIFF_DRIVE_ROS_1, DIFF_DRIVE_ROS_2, DIFF_DRIVE_GZ)
"""The specifications of the differential drive in all generations."""


SKID_STEER_ROS_1 = gazebo_ros_1(
    "skid_steer",
    "gazebo_ros_skid_steer_drive",
    Parameter("left_front_joint", "leftFrontJoint", "left_front_joint", names="joint"),
    Parameter("right_front_joint", "rightFrontJoint", "right_front_joint", names="joint"),
    Parameter("left_rear_joint", "leftRearJoint", "left_rear_joint", names="joint"),
    Parameter("right_rear_joint", "rightRearJoint", "right_rear_joint", names="joint"),
    Parameter("wheel_separation", "wheelSeparation", "0.4", "[m]"),
    Parameter("wheel_diameter", "wheelDiameter", "0.15", "[m]"),
    Parameter("max_wheel_torque", "torque", "5", "[N·m]"),
    Parameter("update_rate", "updateRate", "100", "[Hz]"),
    Parameter("command_topic", "commandTopic", "cmd_vel", names="topic"),
    Parameter("odometry_topic", "odometryTopic", "odom", names="topic"),
    Parameter("odometry_frame", "odometryFrame", "odom", names="frame"),
    Parameter("base_frame", "robotBaseFrame", "base_footprint", names="link"),
    Parameter("publish_odometry_tf", "broadcastTF", "false"),
    Parameter("covariance_x", "covariance_x", "0.0001", "[m²]"),
    Parameter("covariance_y", "covariance_y", "0.0001", "[m²]"),
    Parameter("covariance_yaw", "covariance_yaw", "0.01", "[rad²]"),
)
"""In ROS 2 and gz sim, skid steering uses the differential drive with several wheel pairs."""
