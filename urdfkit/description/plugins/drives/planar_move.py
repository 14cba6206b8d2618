"""Plugins that move the base itself: planar move (ROS 1, ROS 2) and gz sim's velocity control."""

from urdfkit.description.plugins.common_parameters import gazebo_ros_1, gazebo_ros_2, gz_system
from urdfkit.description.plugins.spec import Parameter

PLANAR_MOVE_ROS_1 = gazebo_ros_1(
    "planar_move",
    "gazebo_ros_planar_move",
    Parameter("command_topic", "commandTopic", "cmd_vel", names="topic"),
    Parameter("odometry_topic", "odometryTopic", "odom", names="topic"),
    Parameter("odometry_frame", "odometryFrame", "odom", names="frame"),
    Parameter("base_frame", "robotBaseFrame", "base_footprint", names="link"),
    Parameter("odometry_rate", "odometryRate", "20", "[Hz]"),
    Parameter("command_timeout", "cmdTimeout", "-1", "[s]"),
)
"""A rate of zero or less publishes no odometry. `cmdTimeout`, negative for none, is read in Noetic only."""

PLANAR_MOVE_ROS_2 = gazebo_ros_2(
    "planar_move",
    "gazebo_ros_planar_move",
    Parameter("update_rate", "update_rate", "20", "[Hz]"),
    Parameter("odometry_rate", "publish_rate", "20", "[Hz]"),
    Parameter("odometry_frame", "odometry_frame", "odom", names="frame"),
    Parameter("base_frame", "robot_base_frame", "base_footprint", names="link"),
    Parameter("publish_odometry", "publish_odom", "true"),
    Parameter("publish_odometry_tf", "publish_odom_tf", "true"),
    Parameter("covariance_x", "covariance_x", "0.00001", "[m²]"),
    Parameter("covariance_y", "covariance_y", "0.00001", "[m²]"),
    Parameter("covariance_yaw", "covariance_yaw", "0.001", "[rad²]"),
)
"""Topics are ``cmd_vel`` and ``odom``, changed by ``<ros><remapping>`` only. Rates of zero or less mean every step."""

VELOCITY_CONTROL_GZ = gz_system(
    "velocity_control",
    "VelocityControl",
    Parameter("command_topic", "topic", "/model/{model}/cmd_vel", names="topic"),
    Parameter("initial_linear", "initial_linear", unit="[m/s]"),
    Parameter("initial_angular", "initial_angular", unit="[rad/s]"),
    Parameter("link", "link_name", names="link", repeats=True),
)
"""Publishes no odometry; use the odometry publisher for it."""

PLANAR_MOVE = (PLANAR_MOVE_ROS_1, PLANAR_MOVE_ROS_2, VELOCITY_CONTROL_GZ)
"""Plugins that move the base itself."""
