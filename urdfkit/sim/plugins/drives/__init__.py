"""Drives of wheeled robots; `DRIVES` lists them in the order they are tried.

A drive subscribes to velocity commands, writes joint commands and publishes odometry and transforms.
"""

from urdfkit.sim.plugins.base import Drive
from urdfkit.sim.plugins.drives.ackermann import Ackermann
from urdfkit.sim.plugins.drives.ackermann_steering import AckermannSteering
from urdfkit.sim.plugins.drives.diff_drive import DiffDrive, SkidSteer
from urdfkit.sim.plugins.drives.mecanum_drive import MecanumDrive
from urdfkit.sim.plugins.drives.odometry_publisher import OdometryPublisher
from urdfkit.sim.plugins.drives.planar_move import PlanarMove
from urdfkit.sim.plugins.drives.tricycle import Tricycle
from urdfkit.sim.plugins.drives.velocity_control import VelocityControl

DRIVES: tuple[type[Drive], ...] = (
    DiffDrive,
    SkidSteer,
    PlanarMove,
    VelocityControl,
    Ackermann,
    AckermannSteering,
    Tricycle,
    MecanumDrive,
    OdometryPublisher,
)
"""All drives; a test fails if a drive of this folder is missing here."""
