"""The skid steer drive, which only ROS 1 has."""

from urdfkit.description.plugins.common_parameters import gazebo_ros_1
from urdfkit.description.plugins.spec import Parameter

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
