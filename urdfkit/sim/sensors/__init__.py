"""Sensors the simulator knows, in the order they are tried."""

from __future__ import annotations

from urdfkit.sim.plugin import Sensor
from urdfkit.sim.sensors.camera import GzCamera, RosCamera
from urdfkit.sim.sensors.depth_camera import DepthCamera, GzDepthCamera, GzRgbdCamera, OpenniKinect
from urdfkit.sim.sensors.gps import Gps, GzNavSat
from urdfkit.sim.sensors.imu import GzImu, ImuSensor
from urdfkit.sim.sensors.laser import BlockLaser, Laser, Range
from urdfkit.sim.sensors.p3d import P3d
from urdfkit.sim.sensors.point_cloud import GzLidar, RaySensor, Velodyne

SENSORS: tuple[type[Sensor], ...] = (
    Laser,
    BlockLaser,
    Range,
    RaySensor,
    Velodyne,
    GzLidar,
    RosCamera,
    DepthCamera,
    OpenniKinect,
    GzCamera,
    GzDepthCamera,
    GzRgbdCamera,
    ImuSensor,
    GzImu,
    P3d,
    Gps,
    GzNavSat,
)
"""Every sensor; a test walks this folder and fails if one is missing here."""
