"""Mecanum wheels and the odometry publisher, which only gz sim has."""

from urdfkit.description.plugins.common_parameters import GZ_LIMITS, GZ_ODOMETRY, GZ_SEPARATE_LIMITS, gz_system
from urdfkit.description.plugins.spec import Parameter

MECANUM_DRIVE_GZ = gz_system(
    "mecanum_drive",
    "MecanumDrive",
    Parameter("front_left_joint", "front_left_joint", names="joint", repeats=True),
    Parameter("front_right_joint", "front_right_joint", names="joint", repeats=True),
    Parameter("back_left_joint", "back_left_joint", names="joint", repeats=True),
    Parameter("back_right_joint", "back_right_joint", names="joint", repeats=True),
    Parameter("wheel_separation", "wheel_separation", "1.0", "[m]"),
    Parameter("wheel_base", "wheelbase", "1.0", "[m]"),
    Parameter("wheel_radius", "wheel_radius", "0.2", "[m]"),
    *GZ_ODOMETRY,
    *GZ_LIMITS,
    *GZ_SEPARATE_LIMITS,
)
"""Four wheels with rollers at 45°."""

ODOMETRY_PUBLISHER_GZ = gz_system(
    "odometry_publisher",
    "OdometryPublisher",
    Parameter("odometry_frame", "odom_frame", "{model}/odom", names="frame"),
    Parameter("base_frame", "robot_base_frame", "{model}/base_footprint", names="frame"),
    Parameter("odometry_rate", "odom_publish_frequency", "50", "[Hz]"),
    Parameter("odometry_topic", "odom_topic", "/model/{model}/odometry", names="topic"),
    Parameter("covariance_topic", "odom_covariance_topic", "/model/{model}/odometry_with_covariance", names="topic"),
    Parameter("tf_topic", "tf_topic", "/model/{model}/pose", names="topic"),
    Parameter("dimensions", "dimensions", "2"),
    Parameter("xyz_offset", "xyz_offset", "0 0 0", "[m]"),
    Parameter("rpy_offset", "rpy_offset", "0 0 0", "[rad]"),
    Parameter("gaussian_noise", "gaussian_noise", "0", "[m/s, rad/s]"),
)
"""Odometry from the world, for robots with a drive that publishes no odometry."""
