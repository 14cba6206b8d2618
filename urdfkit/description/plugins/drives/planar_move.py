"""Plugins that move the base itself: planar move (ROS 1, ROS 2) and the new Gazebo's velocity control."""

from urdfkit.description.plugins.common_parameters import GAZEBO_ROS_1, GAZEBO_ROS_2
from urdfkit.description.plugins.spec import Parameter, PluginSpec

PLANAR_MOVE_ROS_1 = PluginSpec(
    kind="planar_move",
    generation="ros1",
    filenames=("gazebo_ros_planar_move",),
    class_names=(),
    parameters=(
        Parameter("command_topic", "commandTopic", "cmd_vel", names="topic"),
        Parameter("odometry_topic", "odometryTopic", "odom", names="topic"),
        Parameter("odometry_frame", "odometryFrame", "odom", names="frame"),
        Parameter("base_frame", "robotBaseFrame", "base_footprint", names="link"),
        Parameter("odometry_rate", "odometryRate", "20", "[Hz]"),
        Parameter("command_timeout", "cmdTimeout", "-1", "[s]"),
        *GAZEBO_ROS_1,
    ),
    source="gazebo_ros_pkgs noetic-devel, gazebo_plugins/src/gazebo_ros_planar_move.cpp",
)
"""A rate of zero or less publishes no odometry. `cmdTimeout`, negative for none, is read in Noetic only."""

PLANAR_MOVE_ROS_2 = PluginSpec(
    kind="planar_move",
    generation="ros2",
    filenames=("gazebo_ros_planar_move",),
    class_names=(),
    parameters=(
        Parameter("update_rate", "update_rate", "20", "[Hz]"),
        Parameter("odometry_rate", "publish_rate", "20", "[Hz]"),
        Parameter("odometry_frame", "odometry_frame", "odom", names="frame"),
        Parameter("base_frame", "robot_base_frame", "base_footprint", names="link"),
        Parameter("publish_odometry", "publish_odom", "true"),
        Parameter("publish_odometry_tf", "publish_odom_tf", "true"),
        Parameter("covariance_x", "covariance_x", "0.00001", "[m²]"),
        Parameter("covariance_y", "covariance_y", "0.00001", "[m²]"),
        Parameter("covariance_yaw", "covariance_yaw", "0.001", "[rad²]"),
        *GAZEBO_ROS_2,
    ),
    source="gazebo_ros_pkgs ros2, gazebo_plugins/src/gazebo_ros_planar_move.cpp",
)
"""Topics are ``cmd_vel`` and ``odom``, changed by ``<ros><remapping>`` only. Rates of zero or less mean every step."""

VELOCITY_CONTROL_GZ = PluginSpec(
    kind="velocity_control",
    generation="gz",
    filenames=("gz-sim-velocity-control-system", "ignition-gazebo-velocity-control-system"),
    class_names=("gz::sim::systems::VelocityControl", "ignition::gazebo::systems::VelocityControl"),
    parameters=(
        Parameter("command_topic", "topic", "/model/{model}/cmd_vel", names="topic"),
        Parameter("initial_linear", "initial_linear", unit="[m/s]"),
        Parameter("initial_angular", "initial_angular", unit="[rad/s]"),
        Parameter("link", "link_name", names="link", repeats=True),
    ),
    source="gz-sim main, src/systems/velocity_control/VelocityControl.cc",
)
"""Publishes no odometry; use the odometry publisher for it."""

PLANAR_MOVE = (PLANAR_MOVE_ROS_1, PLANAR_MOVE_ROS_2, VELOCITY_CONTROL_GZ)
"""Plugins that move the base itself."""
