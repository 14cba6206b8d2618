"""Sensors the simulator knows, in the order they are tried."""

from __future__ import annotations

from urdfkit.sim.plugin import Sensor
from urdfkit.sim.sensors.air import GzAirPressure, GzAltimeter, HectorBaro
from urdfkit.sim.sensors.annotating import GzBoundingBoxCamera, GzSegmentationCamera
from urdfkit.sim.sensors.bumper import Bumper, GzContact, GzTouch
from urdfkit.sim.sensors.camera import GzCamera
from urdfkit.sim.sensors.depth_camera import DepthCamera, GzDepthCamera, GzRgbdCamera, OpenniKinect
from urdfkit.sim.sensors.force_torque import GzForceTorque, JointForceTorque
from urdfkit.sim.sensors.gps import Gps, GzNavSat, HectorGps
from urdfkit.sim.sensors.imu import BodyImu, GzImu, HectorImu, ImuSensor
from urdfkit.sim.sensors.laser import BlockLaser, Laser, Range, Sonar
from urdfkit.sim.sensors.logical_camera import GzLogicalCamera
from urdfkit.sim.sensors.magnetometer import GzMagnetometer, HectorMagnetic
from urdfkit.sim.sensors.multicamera import MultiCamera
from urdfkit.sim.sensors.p3d import P3d
from urdfkit.sim.sensors.point_cloud import GzLidar, RaySensor, Velodyne
from urdfkit.sim.sensors.ros_camera import RosCamera

SENSORS: tuple[type[Sensor], ...] = (
    Laser,
    BlockLaser,
    Range,
    Sonar,
    RaySensor,
    Velodyne,
    GzLidar,
    RosCamera,
    MultiCamera,
    DepthCamera,
    OpenniKinect,
    GzCamera,
    GzDepthCamera,
    GzRgbdCamera,
    GzSegmentationCamera,
    GzBoundingBoxCamera,
    ImuSensor,
    BodyImu,
    GzImu,
    HectorImu,
    P3d,
    Gps,
    GzNavSat,
    HectorGps,
    GzMagnetometer,
    HectorMagnetic,
    GzAltimeter,
    GzAirPressure,
    HectorBaro,
    GzLogicalCamera,
    Bumper,
    GzContact,
    GzTouch,
    JointForceTorque,
    GzForceTorque,
)
"""Every sensor; a test walks this folder and fails if one is missing here."""
