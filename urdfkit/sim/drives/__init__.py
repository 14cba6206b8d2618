"""Drives the simulator knows, in the order they are tried."""

from __future__ import annotations

from urdfkit.sim.drives.ackermann import Ackermann
from urdfkit.sim.drives.ackermann_steering import AckermannSteering
from urdfkit.sim.drives.diff_drive import DiffDrive
from urdfkit.sim.drives.mecanum_drive import MecanumDrive
from urdfkit.sim.drives.odometry_publisher import OdometryPublisher
from urdfkit.sim.drives.planar_move import PlanarMove
from urdfkit.sim.drives.skid_steer import SkidSteer
from urdfkit.sim.drives.tricycle import Tricycle
from urdfkit.sim.drives.velocity_control import VelocityControl
from urdfkit.sim.plugin import Drive

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
"""Every drive; a test walks this folder and fails if one is missing here."""
