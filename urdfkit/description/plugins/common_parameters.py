"""What several plugins have in common: parameters, and the names of libraries, classes and source files."""

from urdfkit.description.plugins.spec import Parameter, PluginSpec

GAZEBO_ROS_1 = (Parameter("namespace", "robotNamespace"), Parameter("ros_debug_level", "rosDebugLevel"))
"""Parameters that ``gazebo_ros_utils`` reads for every ROS 1 plugin."""

GAZEBO_ROS_2 = (Parameter("ros", "ros"),)
"""The ``<ros>`` block (namespace, remapping, argument, parameter, qos) that ``gazebo_ros::Node`` reads in ROS 2."""

_LIMITS = (("velocity", ""), ("acceleration", "²"), ("jerk", "³"))
"""Quantity → exponent of the second in its unit."""

GZ_LIMITS = tuple(
    Parameter(f"{end}_{quantity}", f"{end}_{quantity}", unit=f"[m/s{power}, rad/s{power}]")
    for quantity, power in _LIMITS
    for end in ("min", "max")
)
"""Limits that apply to both the linear and the angular velocity."""

GZ_SEPARATE_LIMITS = tuple(
    Parameter(f"{end}_{kind}_{quantity}", f"{end}_{kind}_{quantity}", unit=f"[{unit}/s{power}]")
    for quantity, power in _LIMITS
    for kind, unit in (("linear", "m"), ("angular", "rad"))
    for end in ("min", "max")
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


def gazebo_ros_1(kind: str, libraries: str, *parameters: Parameter, source: str = "") -> PluginSpec:
    """Return the table of a plugin for ROS 1.

    Args:
        kind: kind of the plugin in the simulator.
        libraries: names of its libraries, separated by blanks.
        parameters: its own parameters.
        source: its source file; by default the file of gazebo_ros_pkgs with the name of its library.
    """
    source = source or f"gazebo_ros_pkgs noetic-devel, gazebo_plugins/src/{libraries}.cpp"
    return PluginSpec(kind, "ros1", tuple(libraries.split()), (), (*parameters, *GAZEBO_ROS_1), source)


def gazebo_ros_2(kind: str, libraries: str, *parameters: Parameter, source: str = "") -> PluginSpec:
    """Return the table of a plugin for ROS 2; its arguments are those of `gazebo_ros_1`."""
    source = source or f"gazebo_ros_pkgs ros2, gazebo_plugins/src/{libraries}.cpp"
    return PluginSpec(kind, "ros2", tuple(libraries.split()), (), (*parameters, *GAZEBO_ROS_2), source)


def gz_sensor(kind: str, topic: str, source: str, *, meaning: str = "topic", part: str = "link") -> PluginSpec:
    """Return the table of a sensor of gz sim, which needs no plugin and is configured in the ``<sensor>``.

    Args:
        kind: kind of the sensor in the simulator.
        topic: end of its default topic.
        source: its source file.
        meaning: meaning of the parameter that names the topic.
        part: part of the robot with the ``<sensor>``, ``link`` or ``joint``.
    """
    scoped = f"/world/{{world}}/model/{{model}}/{part}/{{{part}}}/sensor/{{sensor}}{topic}"
    parameters = (
        Parameter(meaning, "topic", scoped, names="topic"),
        Parameter("frame", "gz_frame_id", names="frame"),
        Parameter("old_frame", "ignition_frame_id", names="frame"),
        Parameter("default_frame", "frame_id", f"{{model}}/{{{part}}}/{{sensor}}", names="frame"),
    )
    return PluginSpec(kind, "gz", (), (), parameters, f"gz-sensors main, src/{source}")


def gz_system(kind: str, name: str, *parameters: Parameter) -> PluginSpec:
    """Return the table of a system of Gazebo (gz sim), whose libraries and source file have the name of its class."""
    snake = "".join(f"_{letter.lower()}" if letter.isupper() else letter for letter in name)[1:]
    libraries = tuple(f"{prefix}-{snake.replace('_', '-')}-system" for prefix in ("gz-sim", "ignition-gazebo"))
    classes = (f"gz::sim::systems::{name}", f"ignition::gazebo::systems::{name}")
    return PluginSpec(kind, "gz", libraries, classes, parameters, f"gz-sim main, src/systems/{snake}/{name}.cc")
