"""Motion and position sensors: IMU, ground-truth pose (p3d), GPS and other sensors of gz sim."""

from urdfkit.description.plugins.common_parameters import gazebo_ros_1, gazebo_ros_2, gz_sensor
from urdfkit.description.plugins.spec import Parameter

IMU_SENSOR_ROS_1 = gazebo_ros_1(
    "imu_sensor",
    "gazebo_ros_imu_sensor",
    Parameter("topic", "topicName", "imu_data", names="topic"),
    Parameter("frame", "frameName", names="frame"),
    Parameter("body", "bodyName", "{link}", names="link"),
    Parameter("update_rate", "updateRateHZ", "1.0", "[Hz]"),
    Parameter("gaussian_noise", "gaussianNoise", "0"),
    Parameter("xyz_offset", "xyzOffset", unit="[m]"),
    Parameter("rpy_offset", "rpyOffset", unit="[rad]"),
    Parameter("initial_orientation", "initialOrientationAsReference", "false"),
)
"""Without ``robotNamespace``, topics are relative to the model's name."""

IMU_SENSOR_ROS_2 = gazebo_ros_2(
    "imu_sensor",
    "gazebo_ros_imu_sensor",
    Parameter("frame", "frame_name", "{link}", names="frame"),
    Parameter("initial_orientation", "initial_orientation_as_reference", "false"),
)
"""Publishes on ``~/out``; noise and covariances are defined in the ``<sensor>``."""

IMU_BODY_ROS_1 = gazebo_ros_1(
    "imu",
    "gazebo_ros_imu",
    Parameter("body", "bodyName", names="link"),
    Parameter("topic", "topicName", "/default_imu", names="topic"),
    Parameter("service", "serviceName", "/default_imu"),
    Parameter("frame", "frameName", names="frame"),
    Parameter("gaussian_noise", "gaussianNoise", "0", "[m/s², rad/s]"),
    Parameter("xyz_offset", "xyzOffset", unit="[m]"),
    Parameter("rpy_offset", "rpyOffset", unit="[rad]"),
    Parameter("update_rate", "updateRate", "0", "[Hz]"),
)
"""A plugin of the model, not of a sensor; its accelerations exclude gravity."""

IMU_GZ = gz_sensor("gz_imu", "/imu", "ImuSensor.cc")
"""Read from the ``<sensor>`` itself. The orientation is relative to the initial orientation of the sensor."""

P3D_ROS_1 = gazebo_ros_1(
    "p3d",
    "gazebo_ros_p3d",
    Parameter("body", "bodyName", names="link"),
    Parameter("topic", "topicName", names="topic"),
    Parameter("frame", "frameName", "world", names="frame"),
    Parameter("xyz_offset", "xyzOffset", unit="[m]"),
    Parameter("rpy_offset", "rpyOffset", unit="[rad]"),
    Parameter("gaussian_noise", "gaussianNoise", "0", "[m, rad, m/s, rad/s]"),
    Parameter("update_rate", "updateRate", "0", "[Hz]"),
)

P3D_ROS_2 = gazebo_ros_2(
    "p3d",
    "gazebo_ros_p3d",
    Parameter("body", "body_name", names="link"),
    Parameter("frame", "frame_name", "world", names="frame"),
    Parameter("xyz_offset", "xyz_offset", unit="[m]"),
    Parameter("rpy_offset", "rpy_offset", unit="[rad]"),
    Parameter("gaussian_noise", "gaussian_noise", "0", "[m/s, rad/s]"),
    Parameter("update_rate", "update_rate", "0", "[Hz]"),
)
"""Publishes on ``odom``, changed by ``<ros><remapping>`` only."""

GPS_ROS_2 = gazebo_ros_2("gps", "gazebo_ros_gps_sensor", Parameter("frame", "frame_name", "{link}", names="frame"))
"""Publishes on ``~/out``."""

NAVSAT_GZ = gz_sensor("gz_navsat", "/navsat", "NavSatSensor.cc")
MAGNETOMETER_GZ = gz_sensor("gz_magnetometer", "/magnetometer", "MagnetometerSensor.cc")
ALTIMETER_GZ = gz_sensor("gz_altimeter", "/altimeter", "AltimeterSensor.cc")
AIR_PRESSURE_GZ = gz_sensor("gz_air_pressure", "/air_pressure", "AirPressureSensor.cc")
LOGICAL_CAMERA_GZ = gz_sensor("gz_logical_camera", "/logical_camera", "LogicalCameraSensor.cc")

MOTION = (IMU_SENSOR_ROS_1, IMU_SENSOR_ROS_2, IMU_BODY_ROS_1, P3D_ROS_1, P3D_ROS_2, GPS_ROS_2)
"""All plugins of motion and position sensors."""
