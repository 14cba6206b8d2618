"""The tricycle drive: one steered and driven wheel, two with encoders (ROS 1, ROS 2)."""

from urdfkit.description.plugins.common_parameters import gazebo_ros_1, gazebo_ros_2
from urdfkit.description.plugins.spec import Parameter

TRICYCLE_ROS_1 = gazebo_ros_1(
    "tricycle",
    "gazebo_ros_tricycle_drive",
    Parameter("steering_joint", "steeringJoint", "front_steering_joint", names="joint"),
    Parameter("actuated_joint", "actuatedWheelJoint", "front_wheel_joint", names="joint"),
    Parameter("left_joint", "encoderWheelLeftJoint", "left_wheel_joint", names="joint"),
    Parameter("right_joint", "encoderWheelRightJoint", "right_wheel_joint", names="joint"),
    Parameter("actuated_diameter", "actuatedWheelDiameter", "0.15", "[m]"),
    Parameter("encoder_diameter", "encoderWheelDiameter", "0.15", "[m]"),
    Parameter("wheel_separation", "encoderWheelSeparation", "0.5", "[m]"),
    Parameter("max_wheel_torque", "wheelTorque", "5", "[N·m]"),
    Parameter("max_wheel_acceleration", "wheelAcceleration", "0", "[rad/s²]"),
    Parameter("max_wheel_deceleration", "wheelDeceleration", unit="[rad/s²]"),
    Parameter("wheel_tolerance", "wheelSpeedTolerance", "0.01", "[rad/s]"),
    Parameter("steering_speed", "steeringSpeed", "0", "[rad/s]"),
    Parameter("steering_tolerance", "steeringAngleTolerance", "0.01", "[rad]"),
    Parameter("update_rate", "updateRate", "100", "[Hz]"),
    Parameter("command_topic", "commandTopic", "cmd_vel", names="topic"),
    Parameter("odometry_topic", "odometryTopic", "odom", names="topic"),
    Parameter("odometry_frame", "odometryFrame", "odom", names="frame"),
    Parameter("base_frame", "robotBaseFrame", "base_link", names="link"),
    Parameter("odometry_source", "odometrySource", "world"),
    Parameter("publish_wheel_tf", "publishWheelTF", "false"),
    Parameter("publish_wheel_joint_state", "publishWheelJointState", "false"),
)
"""Odometry and its transform are always published. The default deceleration is the acceleration."""

TRICYCLE_ROS_2 = gazebo_ros_2(
    "tricycle",
    "gazebo_ros_tricycle_drive",
    Parameter("steering_joint", "steering_joint", "front_steering_joint", names="joint"),
    Parameter("actuated_joint", "actuated_wheel_joint", "front_wheel_joint", names="joint"),
    Parameter("left_joint", "encoder_wheel_left_joint", "left_wheel_joint", names="joint"),
    Parameter("right_joint", "encoder_wheel_right_joint", "right_wheel_joint", names="joint"),
    Parameter("actuated_diameter", "actuated_wheel_diameter", "0.15", "[m]"),
    Parameter("encoder_diameter", "encoder_wheel_diameter", "0.15", "[m]"),
    Parameter("wheel_separation", "wheel_separation", "0.5", "[m]"),
    Parameter("max_wheel_torque", "max_wheel_torque", "0.15", "[N·m]"),
    Parameter("max_wheel_acceleration", "max_wheel_acceleration", "0", "[rad/s²]"),
    Parameter("max_wheel_deceleration", "max_wheel_deceleration", unit="[rad/s²]"),
    Parameter("wheel_tolerance", "max_wheel_speed_tolerance", "0.01", "[rad/s]"),
    Parameter("steering_speed", "max_steering_speed", "0", "[rad/s]"),
    Parameter("steering_tolerance", "max_steering_angle_tolerance", "0.01", "[rad]"),
    Parameter("update_rate", "update_rate", "100", "[Hz]"),
    Parameter("odometry_frame", "odometry_frame", "odom", names="frame"),
    Parameter("base_frame", "robot_base_frame", "base_link", names="link"),
    Parameter("odometry_source", "odometry_source", "1"),
    Parameter("publish_odometry", "publish_odom", "false"),
    Parameter("publish_wheel_tf", "publish_wheel_tf", "false"),
    Parameter("publish_wheel_joint_state", "publish_wheel_joint_state", "false"),
)
"""`publish_odom` turns on the odometry message and its transform."""

TRICYCLE = (TRICYCLE_ROS_1, TRICYCLE_ROS_2)
"""The specifications of the tricycle drive in both generations."""
