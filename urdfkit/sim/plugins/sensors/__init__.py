"""Simulated sensors; `SENSORS` lists their classes in the order of selection.

A sensor reads the state of the robot or the scene, and publishes messages at its update rate.
"""

from urdfkit.sim.plugins.base import Sensor
from urdfkit.sim.plugins.sensors.cameras.annotated_camera import GzBoundingBoxCamera, GzSegmentationCamera
from urdfkit.sim.plugins.sensors.cameras.camera import GzCamera
from urdfkit.sim.plugins.sensors.cameras.depth_camera import DepthCamera, GzDepthCamera, GzRgbdCamera, OpenniKinect
from urdfkit.sim.plugins.sensors.cameras.gazebo_ros_camera import RosCamera
from urdfkit.sim.plugins.sensors.cameras.logical_camera import GzLogicalCamera
from urdfkit.sim.plugins.sensors.cameras.multicamera import MultiCamera
from urdfkit.sim.plugins.sensors.contact.bumper import Bumper, GzContact, GzTouch
from urdfkit.sim.plugins.sensors.contact.force_torque import GzForceTorque, JointForceTorque
from urdfkit.sim.plugins.sensors.lidars.laser_scan import BlockLaser, Laser, Range, Sonar
from urdfkit.sim.plugins.sensors.lidars.point_cloud import GzLidar, RaySensor, Velodyne
from urdfkit.sim.plugins.sensors.navigation.altimeter_and_barometer import GzAirPressure, GzAltimeter, HectorBaro
from urdfkit.sim.plugins.sensors.navigation.gps import Gps, GzNavSat, HectorGps
from urdfkit.sim.plugins.sensors.navigation.imu import BodyImu, GzImu, HectorImu, ImuSensor
from urdfkit.sim.plugins.sensors.navigation.magnetometer import GzMagnetometer, HectorMagnetic
from urdfkit.sim.plugins.sensors.navigation.p3d import P3d

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
"""All sensor classes; a test searches this folder and fails if a class is missing here."""
