"""Drives: the plugins that turn a velocity command into wheel motion.

Defaults in braces are filled in by whoever knows the model: ``{model}`` is its name, ``{root}`` its root link.
"""

from __future__ import annotations

from urdfkit.description.plugins.spec import Parameter, PluginSpec

GAZEBO_ROS_1 = (
    Parameter("namespace", "robotNamespace"),
    Parameter("ros_debug_level", "rosDebugLevel"),
)
"""What ``gazebo_ros_utils`` reads for every ROS 1 plugin."""

GAZEBO_ROS_2 = (Parameter("ros", "ros"),)
"""The ``<ros>`` block (namespace, remapping, argument, parameter, qos) that ``gazebo_ros::Node`` reads in ROS 2."""

DIFF_DRIVE_ROS_1 = PluginSpec(
    kind="diff_drive",
    generation="ros1",
    filenames=("gazebo_ros_diff_drive",),
    class_names=(),
    parameters=(
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
        *GAZEBO_ROS_1,
    ),
    source="gazebo_ros_pkgs noetic-devel, gazebo_plugins/src/gazebo_ros_diff_drive.cpp (legacyMode: kinetic-devel)",
)
"""`publishTf` false turns off the odometry message and its transform. `legacyMode` is read in Kinetic only."""

DIFF_DRIVE_ROS_2 = PluginSpec(
    kind="diff_drive",
    generation="ros2",
    filenames=("gazebo_ros_diff_drive",),
    class_names=(),
    parameters=(
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
        *GAZEBO_ROS_2,
    ),
    source="gazebo_ros_pkgs ros2, gazebo_plugins/src/gazebo_ros_diff_drive.cpp",
)
"""Topics are ``cmd_vel`` and ``odom``, changed by ``<ros><remapping>`` only. `odometry_source`: 0 encoder, 1 world."""

DIFF_DRIVE_GZ = PluginSpec(
    kind="diff_drive",
    generation="gz",
    filenames=("gz-sim-diff-drive-system", "ignition-gazebo-diff-drive-system"),
    class_names=("gz::sim::systems::DiffDrive", "ignition::gazebo::systems::DiffDrive"),
    parameters=(
        Parameter("left_joint", "left_joint", names="joint", repeats=True),
        Parameter("right_joint", "right_joint", names="joint", repeats=True),
        Parameter("wheel_separation", "wheel_separation", "1.0", "[m]"),
        Parameter("wheel_radius", "wheel_radius", "0.2", "[m]"),
        Parameter("command_topic", "topic", "/model/{model}/cmd_vel", names="topic"),
        Parameter("odometry_topic", "odom_topic", "/model/{model}/odometry", names="topic"),
        Parameter("tf_topic", "tf_topic", "/model/{model}/tf", names="topic"),
        Parameter("odometry_frame", "frame_id", "{model}/odom", names="frame"),
        Parameter("base_frame", "child_frame_id", "{model}/{root}", names="frame"),
        Parameter("odometry_rate", "odom_publish_frequency", "50", "[Hz]"),
        Parameter("min_velocity", "min_velocity", unit="[m/s, rad/s]"),
        Parameter("max_velocity", "max_velocity", unit="[m/s, rad/s]"),
        Parameter("min_acceleration", "min_acceleration", unit="[m/s², rad/s²]"),
        Parameter("max_acceleration", "max_acceleration", unit="[m/s², rad/s²]"),
        Parameter("min_jerk", "min_jerk", unit="[m/s³, rad/s³]"),
        Parameter("max_jerk", "max_jerk", unit="[m/s³, rad/s³]"),
        Parameter("min_linear_velocity", "min_linear_velocity", unit="[m/s]"),
        Parameter("max_linear_velocity", "max_linear_velocity", unit="[m/s]"),
        Parameter("min_angular_velocity", "min_angular_velocity", unit="[rad/s]"),
        Parameter("max_angular_velocity", "max_angular_velocity", unit="[rad/s]"),
        Parameter("min_linear_acceleration", "min_linear_acceleration", unit="[m/s²]"),
        Parameter("max_linear_acceleration", "max_linear_acceleration", unit="[m/s²]"),
        Parameter("min_angular_acceleration", "min_angular_acceleration", unit="[rad/s²]"),
        Parameter("max_angular_acceleration", "max_angular_acceleration", unit="[rad/s²]"),
        Parameter("min_linear_jerk", "min_linear_jerk", unit="[m/s³]"),
        Parameter("max_linear_jerk", "max_linear_jerk", unit="[m/s³]"),
        Parameter("min_angular_jerk", "min_angular_jerk", unit="[rad/s³]"),
        Parameter("max_angular_jerk", "max_angular_jerk", unit="[rad/s³]"),
    ),
    source="gz-sim main, src/systems/diff_drive/DiffDrive.cc",
)
"""The generic limits set the linear and the angular one. A rate of zero or less publishes odometry every step."""

SKID_STEER_ROS_1 = PluginSpec(
    kind="skid_steer",
    generation="ros1",
    filenames=("gazebo_ros_skid_steer_drive",),
    class_names=(),
    parameters=(
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
        *GAZEBO_ROS_1,
    ),
    source="gazebo_ros_pkgs noetic-devel, gazebo_plugins/src/gazebo_ros_skid_steer_drive.cpp",
)
"""ROS 2 and the new Gazebo steer by skidding with the diff drive and several wheel pairs."""

DIFF_DRIVE = (DIFF_DRIVE_ROS_1, DIFF_DRIVE_ROS_2, DIFF_DRIVE_GZ)
"""The differential drive in its three spellings."""

DRIVES = (*DIFF_DRIVE, SKID_STEER_ROS_1)
"""Every drive."""
