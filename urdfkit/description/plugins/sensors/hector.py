"""Sensors of hector_gazebo_plugins and hector_quadrotor_gazebo_plugins, for ROS 1, with drift and noise."""

from urdfkit.description.plugins.common_parameters import GAZEBO_ROS_1
from urdfkit.description.plugins.spec import Parameter, PluginSpec

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
        *GAZEBO_ROS_1,
    )


_BODY = Parameter("body", "bodyName", names="link")

HECTOR_IMU = PluginSpec(
    kind="hector_imu",
    generation="ros1",
    filenames=("hector_gazebo_ros_imu",),
    class_names=(),
    parameters=(
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
    ),
    source=f"{_REPOSITORY}/gazebo_ros_imu.cpp",
)

HECTOR_GPS = PluginSpec(
    kind="hector_gps",
    generation="ros1",
    filenames=("hector_gazebo_ros_gps",),
    class_names=(),
    parameters=(
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
    ),
    source=f"{_REPOSITORY}/gazebo_ros_gps.cpp",
)
"""The defaults of the reference values are the world's ``<spherical_coordinates>``."""

HECTOR_MAGNETIC = PluginSpec(
    kind="hector_magnetic",
    generation="ros1",
    filenames=("hector_gazebo_ros_magnetic",),
    class_names=(),
    parameters=(
        *_common("magnetic", "0"),
        _BODY,
        Parameter("magnitude", "magnitude", "1.0"),
        Parameter("heading", "referenceHeading", unit="[°]"),
        Parameter("declination", "declination", "0", "[°]"),
        Parameter("inclination", "inclination", "60", "[°]"),
        Parameter("magnetic_field_messages", "useMagneticFieldMsgs", "false"),
        *_errors(),
    ),
    source=f"{_REPOSITORY}/gazebo_ros_magnetic.cpp",
)

HECTOR_SONAR = PluginSpec(
    kind="sonar",
    generation="ros1",
    filenames=("hector_gazebo_ros_sonar", "gazebo_ros_sonar"),
    class_names=(),
    parameters=(
        Parameter("topic", "topicName", "sonar", names="topic"),
        Parameter("frame", "frameId", "/sonar_link", names="frame"),
        Parameter("update_rate", "updateRate", "10.0", "[Hz]"),
        *_errors(unit="[m]"),
        *GAZEBO_ROS_1,
    ),
    source=f"{_REPOSITORY}/gazebo_ros_sonar.cpp",
)
"""A plugin of a ray sensor."""

HECTOR_BARO = PluginSpec(
    kind="hector_baro",
    generation="ros1",
    filenames=("hector_gazebo_ros_baro",),
    class_names=(),
    parameters=(
        *_common("pressure_height", "0"),
        _BODY,
        Parameter("altimeter_topic", "altimeterTopicName", "altimeter", names="topic"),
        Parameter("elevation", "elevation", "0", "[m]"),
        Parameter("qnh", "qnh", "1013.25", "[hPa]"),
        *_errors(unit="[m]"),
    ),
    source="hector_quadrotor kinetic-devel, hector_quadrotor_gazebo_plugins/src/gazebo_ros_baro.cpp",
)

HECTOR = (HECTOR_IMU, HECTOR_GPS, HECTOR_MAGNETIC, HECTOR_SONAR, HECTOR_BARO)
"""All Hector sensors."""
