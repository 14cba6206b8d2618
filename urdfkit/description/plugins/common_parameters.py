"""Parameters common to several plugins: ROS blocks of Gazebo Classic, limits and odometry of gz drives."""

from urdfkit.description.plugins.spec import Parameter

GAZEBO_ROS_1 = (
    Parameter("namespace", "robotNamespace"),
    Parameter("ros_debug_level", "rosDebugLevel"),
)
"""Parameters that ``gazebo_ros_utils`` reads for every ROS 1 plugin."""

GAZEBO_ROS_2 = (Parameter("ros", "ros"),)
"""The ``<ros>`` block (namespace, remapping, argument, parameter, qos) that ``gazebo_ros::Node`` reads in ROS 2."""

GZ_LIMITS = (
    Parameter("min_velocity", "min_velocity", unit="[m/s, rad/s]"),
    Parameter("max_velocity", "max_velocity", unit="[m/s, rad/s]"),
    Parameter("min_acceleration", "min_acceleration", unit="[m/s², rad/s²]"),
    Parameter("max_acceleration", "max_acceleration", unit="[m/s², rad/s²]"),
    Parameter("min_jerk", "min_jerk", unit="[m/s³, rad/s³]"),
    Parameter("max_jerk", "max_jerk", unit="[m/s³, rad/s³]"),
)
"""Limits that apply to both the linear and the angular velocity."""

GZ_SEPARATE_LIMITS = (
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
)
"""Limits of either the linear or the angular velocity; they override the common limits."""

GZ_ODOMETRY = (
    Parameter("command_topic", "topic", "/model/{model}/cmd_vel", names="topic"),
    Parameter("odometry_topic", "odom_topic", "/model/{model}/odometry", names="topic"),
    Parameter("tf_topic", "tf_topic", "/model/{model}/tf", names="topic"),
    Parameter("odometry_frame", "frame_id", "{model}/odom", names="frame"),
    Parameter("base_frame", "child_frame_id", "{model}/{root}", names="frame"),
    Parameter("odometry_rate", "odom_publish_frequency", "50", "[Hz]"),
)
"""Topics, frames and rate of the drives that publish odometry."""
