"""What several plugins have in common: parameters, and the names of libraries, classes and source files."""

from urdfkit.description.plugins.spec import Parameter, PluginSpec

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


def gazebo_ros_1(kind: str, library: str, *parameters: Parameter, source: str = "") -> PluginSpec:
    """Return the table of a plugin of gazebo_ros_pkgs for ROS 1, whose source file has the name of its library."""
    source = source or f"gazebo_ros_pkgs noetic-devel, gazebo_plugins/src/{library}.cpp"
    return PluginSpec(kind, "ros1", (library,), (), (*parameters, *GAZEBO_ROS_1), source)


def gazebo_ros_2(kind: str, library: str, *parameters: Parameter, source: str = "") -> PluginSpec:
    """Return the table of a plugin of gazebo_ros_pkgs for ROS 2, whose source file has the name of its library."""
    source = source or f"gazebo_ros_pkgs ros2, gazebo_plugins/src/{library}.cpp"
    return PluginSpec(kind, "ros2", (library,), (), (*parameters, *GAZEBO_ROS_2), source)


def gz_system(kind: str, name: str, *parameters: Parameter) -> PluginSpec:
    """Return the table of a system of Gazebo (gz sim), whose libraries and source file have the name of its class."""
    snake = "".join(f"_{letter.lower()}" if letter.isupper() else letter for letter in name)[1:]
    libraries = tuple(f"{prefix}-{snake.replace('_', '-')}-system" for prefix in ("gz-sim", "ignition-gazebo"))
    classes = (f"gz::sim::systems::{name}", f"ignition::gazebo::systems::{name}")
    return PluginSpec(kind, "gz", libraries, classes, parameters, f"gz-sim main, src/systems/{snake}/{name}.cc")
