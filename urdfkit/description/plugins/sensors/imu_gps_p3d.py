"""Motion and position sensors: IMU, ground-truth pose (p3d), GPS and other sensors of the new Gazebo."""

from urdfkit.description.plugins.common_parameters import GAZEBO_ROS_1, GAZEBO_ROS_2
from urdfkit.description.plugins.spec import Parameter, PluginSpec

IMU_SENSOR_ROS_1 = PluginSpec(
    kind="imu_sensor",
    generation="ros1",
    filenames=("gazebo_ros_imu_sensor",),
    class_names=(),
    parameters=(
        Parameter("topic", "topicName", "imu_data", names="topic"),
        Parameter("frame", "frameName", names="frame"),
        Parameter("body", "bodyName", "{link}", names="link"),
        Parameter("update_rate", "updateRateHZ", "1.0", "[Hz]"),
        Parameter("gaussian_noise", "gaussianNoise", "0"),
        Parameter("xyz_offset", "xyzOffset", unit="[m]"),
        Parameter("rpy_offset", "rpyOffset", unit="[rad]"),
        Parameter("initial_orientation", "initialOrientationAsReference", "false"),
        *GAZEBO_ROS_1,
    ),
    source="gazebo_ros_pkgs noetic-devel, gazebo_plugins/src/gazebo_ros_imu_sensor.cpp",
)
"""Without ``robotNamespace``, topics are relative to the model's name."""

IMU_SENSOR_ROS_2 = PluginSpec(
    kind="imu_sensor",
    generation="ros2",
    filenames=("gazebo_ros_imu_sensor",),
    class_names=(),
    parameters=(
        Parameter("frame", "frame_name", "{link}", names="frame"),
        Parameter("initial_orientation", "initial_orientation_as_reference", "false"),
        *GAZEBO_ROS_2,
    ),
    source="gazebo_ros_pkgs ros2, gazebo_plugins/src/gazebo_ros_imu_sensor.cpp",
)
"""Publishes on ``~/out``; noise and covariances are defined in the ``<sensor>``."""

IMU_BODY_ROS_1 = PluginSpec(
    kind="imu",
    generation="ros1",
    filenames=("gazebo_ros_imu",),
    class_names=(),
    parameters=(
        Parameter("body", "bodyName", names="link"),
        Parameter("topic", "topicName", "/default_imu", names="topic"),
        Parameter("service", "serviceName", "/default_imu"),
        Parameter("frame", "frameName", names="frame"),
        Parameter("gaussian_noise", "gaussianNoise", "0", "[m/s², rad/s]"),
        Parameter("xyz_offset", "xyzOffset", unit="[m]"),
        Parameter("rpy_offset", "rpyOffset", unit="[rad]"),
        Parameter("update_rate", "updateRate", "0", "[Hz]"),
        *GAZEBO_ROS_1,
    ),
    source="gazebo_ros_pkgs noetic-devel, gazebo_plugins/src/gazebo_ros_imu.cpp",
)
"""A plugin of the model, not of a sensor; its accelerations exclude gravity."""

IMU_GZ = PluginSpec(
    kind="gz_imu",
    generation="gz",
    filenames=(),
    class_names=(),
    parameters=(
        Parameter("topic", "topic", "/world/{world}/model/{model}/link/{link}/sensor/{sensor}/imu", names="topic"),
        Parameter("frame", "gz_frame_id", names="frame"),
        Parameter("old_frame", "ignition_frame_id", names="frame"),
        Parameter("default_frame", "frame_id", "{model}/{link}/{sensor}", names="frame"),
    ),
    source="gz-sensors main, src/ImuSensor.cc",
)
"""Read from the ``<sensor>`` itself. The orientation is relative to the initial orientation of the sensor."""

P3D_ROS_1 = PluginSpec(
    kind="p3d",
    generation="ros1",
    filenames=("gazebo_ros_p3d",),
    class_names=(),
    parameters=(
        Parameter("body", "bodyName", names="link"),
        Parameter("topic", "topicName", names="topic"),
        Parameter("frame", "frameName", "world", names="frame"),
        Parameter("xyz_offset", "xyzOffset", unit="[m]"),
        Parameter("rpy_offset", "rpyOffset", unit="[rad]"),
        Parameter("gaussian_noise", "gaussianNoise", "0", "[m, rad, m/s, rad/s]"),
        Parameter("update_rate", "updateRate", "0", "[Hz]"),
        *GAZEBO_ROS_1,
    ),
    source="gazebo_ros_pkgs noetic-devel, gazebo_plugins/src/gazebo_ros_p3d.cpp",
)

P3D_ROS_2 = PluginSpec(
    kind="p3d",
    generation="ros2",
    filenames=("gazebo_ros_p3d",),
    class_names=(),
    parameters=(
        Parameter("body", "body_name", names="link"),
        Parameter("frame", "frame_name", "world", names="frame"),
        Parameter("xyz_offset", "xyz_offset", unit="[m]"),
        Parameter("rpy_offset", "rpy_offset", unit="[rad]"),
        Parameter("gaussian_noise", "gaussian_noise", "0", "[m/s, rad/s]"),
        Parameter("update_rate", "update_rate", "0", "[Hz]"),
        *GAZEBO_ROS_2,
    ),
    source="gazebo_ros_pkgs ros2, gazebo_plugins/src/gazebo_ros_p3d.cpp",
)
"""Publishes on ``odom``, changed by ``<ros><remapping>`` only."""

GPS_ROS_2 = PluginSpec(
    kind="gps",
    generation="ros2",
    filenames=("gazebo_ros_gps_sensor",),
    class_names=(),
    parameters=(Parameter("frame", "frame_name", "{link}", names="frame"), *GAZEBO_ROS_2),
    source="gazebo_ros_pkgs ros2, gazebo_plugins/src/gazebo_ros_gps_sensor.cpp",
)
"""Publishes on ``~/out``."""


def _bare(kind: str, topic: str, source: str) -> PluginSpec:
    """Return the table of a sensor of the new Gazebo, which needs no plugin and is configured in the ``<sensor>``."""
    scoped = "/world/{world}/model/{model}/link/{link}/sensor/{sensor}/"
    return PluginSpec(
        kind=kind,
        generation="gz",
        filenames=(),
        class_names=(),
        parameters=(
            Parameter("topic", "topic", scoped + topic, names="topic"),
            Parameter("frame", "gz_frame_id", names="frame"),
            Parameter("old_frame", "ignition_frame_id", names="frame"),
            Parameter("default_frame", "frame_id", "{model}/{link}/{sensor}", names="frame"),
        ),
        source=f"gz-sensors main, src/{source}",
    )


NAVSAT_GZ = _bare("gz_navsat", "navsat", "NavSatSensor.cc")
MAGNETOMETER_GZ = _bare("gz_magnetometer", "magnetometer", "MagnetometerSensor.cc")
ALTIMETER_GZ = _bare("gz_altimeter", "altimeter", "AltimeterSensor.cc")
AIR_PRESSURE_GZ = _bare("gz_air_pressure", "air_pressure", "AirPressureSensor.cc")
LOGICAL_CAMERA_GZ = _bare("gz_logical_camera", "logical_camera", "LogicalCameraSensor.cc")

MOTION = (IMU_SENSOR_ROS_1, IMU_SENSOR_ROS_2, IMU_BODY_ROS_1, P3D_ROS_1, P3D_ROS_2, GPS_ROS_2)
"""All plugins of motion and position sensors."""
