"""Sensors: the plugins that stand in a ``<sensor>``, and the sensors that need none, one module per family."""

from __future__ import annotations

from urdfkit.description.plugins.camera import (
    BOUNDING_BOX_CAMERA_GZ,
    CAMERA_GZ,
    CAMERAS,
    DEPTH_CAMERA_GZ,
    RGBD_CAMERA_GZ,
    SEGMENTATION_CAMERA_GZ,
)
from urdfkit.description.plugins.hector import HECTOR
from urdfkit.description.plugins.lidar import LIDAR_GZ, LIDAR_TYPES, LIDARS
from urdfkit.description.plugins.motion import (
    AIR_PRESSURE_GZ,
    ALTIMETER_GZ,
    IMU_GZ,
    LOGICAL_CAMERA_GZ,
    MAGNETOMETER_GZ,
    MOTION,
    NAVSAT_GZ,
)
from urdfkit.description.plugins.spec import PluginSpec
from urdfkit.description.plugins.touch import CONTACT_GZ, FORCE_TORQUE_GZ, TOUCH

SENSORS = (*LIDARS, *CAMERAS, *MOTION, *TOUCH, *HECTOR)
"""Every sensor plugin."""

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
"""Type of a ``<sensor>`` without a plugin → its table: in the new Gazebo sensors publish by themselves."""

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
"""What the ``type`` of a ``<sensor>`` may be (sdformat main, src/Sensor.cc), simulated here or not."""
