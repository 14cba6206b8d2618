"""Sensors: the plugins in a ``<sensor>``, and the sensors that need no plugin, one module per family."""

from urdfkit.description.plugins.sensors.camera import (
    BOUNDING_BOX_CAMERA_GZ,
    CAMERA_GZ,
    CAMERAS,
    DEPTH_CAMERA_GZ,
    RGBD_CAMERA_GZ,
    SEGMENTATION_CAMERA_GZ,
)
from urdfkit.description.plugins.sensors.contact_and_force import CONTACT_GZ, FORCE_TORQUE_GZ, TOUCH
from urdfkit.description.plugins.sensors.hector import HECTOR
from urdfkit.description.plugins.sensors.imu_gps_p3d import (
    AIR_PRESSURE_GZ,
    ALTIMETER_GZ,
    IMU_GZ,
    LOGICAL_CAMERA_GZ,
    MAGNETOMETER_GZ,
    MOTION,
    NAVSAT_GZ,
)
from urdfkit.description.plugins.sensors.lidar import LIDAR_GZ, LIDAR_TYPES, LIDARS
from urdfkit.description.plugins.spec import PluginSpec

SENSORS = (*LIDARS, *CAMERAS, *MOTION, *TOUCH, *HECTOR)
"""All sensor plugins."""

SENSORS_OF_LIBRARIES: dict[str, tuple[str, ...]] = {
    "gazebo_ros_block_laser": ("ray",),
    "gazebo_ros_bumper": ("contact",),
    "gazebo_ros_camera": ("camera", "depth", "multicamera", "wideanglecamera"),
    "gazebo_ros_depth_camera": ("depth",),
    "gazebo_ros_gps_sensor": ("gps",),
    "gazebo_ros_gpu_laser": ("gpu_ray",),
    "gazebo_ros_imu_sensor": ("imu",),
    "gazebo_ros_laser": ("ray",),
    "gazebo_ros_multicamera": ("multicamera",),
    "gazebo_ros_openni_kinect": ("depth", "openni_kinect"),
    "gazebo_ros_range": ("ray",),
    "gazebo_ros_ray_sensor": ("ray", "gpu_ray", "sonar"),
    "gazebo_ros_velodyne_gpu_laser": ("gpu_ray",),
    "gazebo_ros_velodyne_laser": ("ray",),
}
"""Library of Gazebo Classic → types of the ``<sensor>`` that it accepts: those of its base class, or the type that it
casts its sensor to (gazebo_ros_pkgs, gazebo_plugins/include; velodyne_simulator, GazeboRosVelodyneLaser.h)."""

BARE: dict[str, PluginSpec] = {
    **dict.fromkeys(LIDAR_TYPES, LIDAR_GZ),
    "imu": IMU_GZ,
    "gps": NAVSAT_GZ,
    "navsat": NAVSAT_GZ,
    "magnetometer": MAGNETOMETER_GZ,
    "altimeter": ALTIMETER_GZ,
    "air_pressure": AIR_PRESSURE_GZ,
    "logical_camera": LOGICAL_CAMERA_GZ,
    "contact": CONTACT_GZ,
    "force_torque": FORCE_TORQUE_GZ,
    "camera": CAMERA_GZ,
    "depth": DEPTH_CAMERA_GZ,
    "depth_camera": DEPTH_CAMERA_GZ,
    "rgbd": RGBD_CAMERA_GZ,
    "rgbd_camera": RGBD_CAMERA_GZ,
    "segmentation": SEGMENTATION_CAMERA_GZ,
    "segmentation_camera": SEGMENTATION_CAMERA_GZ,
    "boundingbox": BOUNDING_BOX_CAMERA_GZ,
    "boundingbox_camera": BOUNDING_BOX_CAMERA_GZ,
}
"""Type of a ``<sensor>`` without a plugin → its table; sensors of gz sim need no plugin."""

SENSOR_TYPES = tuple(
    dict.fromkeys(
        (
            *BARE,
            *("air_flow", "air_speed", "bounding_box_camera", "boundingbox", "boundingbox_camera", "custom", "dvl"),
            *("multicamera", "rfid", "rfidtag", "segmentation", "segmentation_camera", "sonar", "thermal"),
            *("thermal_camera", "transceiver", "wideanglecamera", "wide_angle_camera", "wireless_receiver"),
            *("wireless_transmitter",),
        )
    )
)
"""Valid types of a ``<sensor>`` (sdformat main, src/Sensor.cc), including types that urdfkit does not simulate."""

_NEAREST_OF_RAYS = (
    'write type="ray" and a plugin that publishes the nearest range, libgazebo_ros_range.so in ROS 1 or '
    "libgazebo_ros_ray_sensor.so in ROS 2, with {} as the kind of radiation"
)
_TWO = 'write a sensor of type="camera" for each, or libgazebo_ros_camera.so into this one'

INSTEAD: dict[str, str] = {
    **dict.fromkeys(("sonar", "ultrasonic", "ultrasound"), _NEAREST_OF_RAYS.format("ultrasound")),
    **dict.fromkeys(("infrared", "ir", "range"), _NEAREST_OF_RAYS.format("infrared")),
    **dict.fromkeys(("thermal", "thermal_camera"), 'use type="camera"; temperatures are not simulated'),
    **dict.fromkeys(("wideanglecamera", "wide_angle_camera"), 'write type="camera", with <distortion> if needed'),
    **dict.fromkeys(("multicamera", "stereo", "stereo_camera"), _TWO),
    **dict.fromkeys(
        ("openni", "openni_kinect", "kinect"), 'write type="depth"; ROS 1 needs libgazebo_ros_openni_kinect.so'
    ),
    "laser": 'write type="ray"',
}
"""Type of a ``<sensor>`` that is not simulated or unknown in SDF → suggested replacement."""
