"""Sensors of hector_gazebo_plugins and hector_quadrotor_gazebo_plugins, for ROS 1, with drift and noise."""

from urdfkit.description.plugins.common_parameters import gazebo_ros_1
from urdfkit.description.plugins.spec import Parameter

_REPOSITORY = "hector_gazebo noetic-devel, hector_gazebo_plugins/src"


def _errors(prefix: str = "", tag: str = "", unit: str = "") -> tuple[Parameter, ...]:
    """Return the parameters of one error model (sensor_model.h), e.g. ``accelDrift`` for the tag ``accel``."""

    def spelled(name: str) -> str:
        return tag + name if tag else name[0].lower() + name[1:]

    return (
        Parameter(f"{prefix}offset", spelled("Offset"), unit=unit),
        Parameter(f"{prefix}drift", spelled("Drift"), unit=unit),
        Parameter(f"{prefix}drift_frequency", spelled("DriftFrequency"), unit="[Hz]"),
        Parameter(f"{prefix}gaussian_noise", spelled("GaussianNoise"), unit=unit),
    )


def _common(topic: str, rate: str) -> tuple[Parameter, ...]:
    return (
        Parameter("topic", "topicName", topic, names="topic"),
        Parameter("frame", "frameId", names="frame"),
        Parameter("update_rate", "updateRate", rate, "[Hz]"),
    )


_BODY = Parameter("body", "bodyName", names="link")

HECTOR_IMU = gazebo_ros_1(
    "hector_imu",
    "hector_gazebo_ros_imu",
    *_common("imu", "0"),
    _BODY,
    Parameter("service", "serviceName"),
    *_errors("accel_", "accel", "[m/s²]"),
    *_errors("rate_", "rate", "[rad/s]"),
    *_errors("yaw_", "yaw", "[rad]"),
    *_errors("heading_", "heading", "[rad]"),
    Parameter("gaussian_noise", "gaussianNoise"),
    Parameter("rpy_offset", "rpyOffset", unit="[rad]"),
    Parameter("xyz_offset", "xyzOffset", unit="[m]"),
    source=f"{_REPOSITORY}/gazebo_ros_imu.cpp",
)

HECTOR_GPS = gazebo_ros_1(
    "hector_gps",
    "hector_gazebo_ros_gps",
    *_common("fix", "4.0"),
    _BODY,
    Parameter("velocity_topic", "velocityTopicName", "fix_velocity", names="topic"),
    Parameter("latitude", "referenceLatitude", unit="[°]"),
    Parameter("longitude", "referenceLongitude", unit="[°]"),
    Parameter("altitude", "referenceAltitude", unit="[m]"),
    Parameter("heading", "referenceHeading", unit="[°]"),
    Parameter("status", "status", "0"),
    Parameter("service", "service", "1"),
    *_errors(unit="[m]"),
    *_errors("velocity_", "velocity", "[m/s]"),
    source=f"{_REPOSITORY}/gazebo_ros_gps.cpp",
)
"""The defaults of the reference values are the world's ``<spherical_coordinates>``."""

HECTOR_MAGNETIC = gazebo_ros_1(
    "hector_magnetic",
    "hector_gazebo_ros_magnetic",
    *_common("magnetic", "0"),
    _BODY,
    Parameter("magnitude", "magnitude", "1.0"),
    Parameter("heading", "referenceHeading", unit="[°]"),
    Parameter("declination", "declination", "0", "[°]"),
    Parameter("inclination", "inclination", "60", "[°]"),
    Parameter("magnetic_field_messages", "useMagneticFieldMsgs", "false"),
    *_errors(),
    source=f"{_REPOSITORY}/gazebo_ros_magnetic.cpp",
)

HECTOR_SONAR = gazebo_ros_1(
    "sonar",
    "hector_gazebo_ros_sonar gazebo_ros_sonar",
    Parameter("topic", "topicName", "sonar", names="topic"),
    Parameter("frame", "frameId", "/sonar_link", names="frame"),
    Parameter("update_rate", "updateRate", "10.0", "[Hz]"),
    *_errors(unit="[m]"),
    source=f"{_REPOSITORY}/gazebo_ros_sonar.cpp",
)
"""A plugin of a ray sensor."""

HECTOR_BARO = gazebo_ros_1(
    "hector_baro",
    "hector_gazebo_ros_baro",
    *_common("pressure_height", "0"),
    _BODY,
    Parameter("altimeter_topic", "altimeterTopicName", "altimeter", names="topic"),
    Parameter("elevation", "elevation", "0", "[m]"),
    Parameter("qnh", "qnh", "1013.25", "[hPa]"),
    *_errors(unit="[m]"),
    source="hector_quadrotor kinetic-devel, hector_quadrotor_gazebo_plugins/src/gazebo_ros_baro.cpp",
)

HECTOR = (HECTOR_IMU, HECTOR_GPS, HECTOR_MAGNETIC, HECTOR_SONAR, HECTOR_BARO)
"""All Hector sensors."""
