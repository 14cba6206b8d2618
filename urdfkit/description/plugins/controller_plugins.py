"""Control: joint state publishers, single-joint controllers, ros_control and ros2_control.

Placeholders in defaults are replaced per model: ``{world}``, ``{model}`` and ``{joint}`` are names.
"""

from urdfkit.description.plugins.common_parameters import GAZEBO_ROS_2, gazebo_ros_1, gazebo_ros_2, gz_system
from urdfkit.description.plugins.spec import Parameter, PluginSpec

JOINT_STATE_PUBLISHER_ROS_1 = gazebo_ros_1(
    "joint_state_publisher",
    "gazebo_ros_joint_state_publisher",
    Parameter("joints", "jointName", names="joint", separator=","),
    Parameter("update_rate", "updateRate", "100", "[Hz]"),
)

JOINT_STATE_PUBLISHER_ROS_2 = gazebo_ros_2(
    "joint_state_publisher",
    "gazebo_ros_joint_state_publisher",
    Parameter("joints", "joint_name", names="joint", repeats=True),
    Parameter("update_rate", "update_rate", "100", "[Hz]"),
)

JOINT_STATE_PUBLISHER_GZ = gz_system(
    "joint_state_publisher",
    "JointStatePublisher",
    Parameter("joints", "joint_name", names="joint", repeats=True),
    Parameter("topic", "topic", "/world/{world}/model/{model}/joint_state", names="topic"),
    Parameter("update_rate", "update_rate", "0", "[Hz]"),
)

_COMMANDS_GZ = (
    Parameter("command_subtopic", "sub_topic", names="topic"),
    Parameter("actuator_number", "actuator_number"),
    Parameter("use_actuator_message", "use_actuator_msg", "false"),
)
_BOUNDS_GZ = (
    Parameter("i_max", "i_max", "1"),
    Parameter("i_min", "i_min", "-1"),
    Parameter("max_command", "cmd_max", "1000"),
    Parameter("min_command", "cmd_min", "-1000"),
    Parameter("command_offset", "cmd_offset", "0"),
)

JOINT_CONTROLLER_GZ = gz_system(
    "joint_controller",
    "JointController",
    Parameter("joints", "joint_name", names="joint", repeats=True),
    Parameter("command_topic", "topic", "/model/{model}/joint/{joint}/cmd_vel", names="topic"),
    *_COMMANDS_GZ,
    Parameter("initial_velocity", "initial_velocity", "0", "[rad/s]"),
    Parameter("use_force_commands", "use_force_commands", "false"),
    Parameter("p_gain", "p_gain", "1"),
    Parameter("i_gain", "i_gain", "0"),
    Parameter("d_gain", "d_gain", "0"),
    *_BOUNDS_GZ,
)

JOINT_POSITION_CONTROLLER_GZ = gz_system(
    "joint_position_controller",
    "JointPositionController",
    Parameter("joints", "joint_name", names="joint", repeats=True),
    Parameter("joint_index", "joint_index", "0"),
    Parameter("command_topic", "topic", "/model/{model}/joint/{joint}/0/cmd_pos", names="topic"),
    *_COMMANDS_GZ,
    Parameter("use_velocity_commands", "use_velocity_commands", "false"),
    Parameter("initial_position", "initial_position", "0", "[rad]"),
    Parameter("p_gain", "p_gain", "1"),
    Parameter("i_gain", "i_gain", "0.1"),
    Parameter("d_gain", "d_gain", "0.01"),
    *_BOUNDS_GZ,
)

GAZEBO_ROS_CONTROL = gazebo_ros_1(
    "gazebo_ros_control",
    "gazebo_ros_control",
    Parameter("robot_parameter", "robotParam", "robot_description"),
    Parameter("hardware", "robotSimType", "gazebo_ros_control/DefaultRobotHWSim"),
    Parameter("control_period", "controlPeriod", unit="[s]"),
    Parameter("emergency_stop_topic", "eStopTopic", names="topic"),
    Parameter("legacy_namespace", "legacyModeNS"),
    source="gazebo_ros_pkgs noetic-devel, gazebo_ros_control/src/gazebo_ros_control_plugin.cpp (legacyModeNS: kinetic)",
)
"""Uses the controllers on the parameter server and the joints of each ``<transmission>``."""

GAZEBO_ROS2_CONTROL = gazebo_ros_2(
    "ros2_control",
    "gazebo_ros2_control",
    Parameter("configuration", "parameters", repeats=True),
    Parameter("robot_parameter", "robot_param", "robot_description"),
    Parameter("robot_node", "robot_param_node", "robot_state_publisher"),
    Parameter("hardware", "robot_sim_type"),
    source="gazebo_ros2_control humble, src/gazebo_ros2_control_plugin.cpp",
)

GZ_ROS2_CONTROL = PluginSpec(
    kind="ros2_control",
    generation="gz",
    filenames=("gz_ros2_control-system", "ign_ros2_control-system"),
    class_names=("gz_ros2_control::GazeboSimROS2ControlPlugin", "ign_ros2_control::IgnitionROS2ControlPlugin"),
    parameters=(
        Parameter("configuration", "parameters", repeats=True),
        Parameter("robot_parameter", "robot_param", "robot_description"),
        Parameter("robot_node", "robot_param_node", "robot_state_publisher"),
        Parameter("controller_manager", "controller_manager_name", "controller_manager"),
        Parameter("hold_joints", "hold_joints", "true"),
        Parameter("position_gain", "position_proportional_gain", "0.1"),
        *GAZEBO_ROS_2,
    ),
    source="gz_ros2_control, src/gz_ros2_control_plugin.cpp and gz_system.cpp",
)

CONTROL = (
    JOINT_STATE_PUBLISHER_ROS_1,
    JOINT_STATE_PUBLISHER_ROS_2,
    JOINT_STATE_PUBLISHER_GZ,
    JOINT_CONTROLLER_GZ,
    JOINT_POSITION_CONTROLLER_GZ,
    GAZEBO_ROS_CONTROL,
    GAZEBO_ROS2_CONTROL,
    GZ_ROS2_CONTROL,
)
"""All joint state publishers, joint controllers and controller managers."""
