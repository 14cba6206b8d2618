"""Sensors the simulator knows, in the order they are tried."""

from __future__ import annotations

from urdfkit.sim.plugin import Sensor
from urdfkit.sim.sensors.laser import BlockLaser, Laser, Range
from urdfkit.sim.sensors.point_cloud import GzLidar, RaySensor, Velodyne

SENSORS: tuple[type[Sensor], ...] = (Laser, BlockLaser, Range, RaySensor, Velodyne, GzLidar)
"""Every sensor; a test walks this folder and fails if one is missing here."""
