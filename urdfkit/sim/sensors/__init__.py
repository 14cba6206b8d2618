"""Sensors the simulator knows, in the order they are tried."""

from __future__ import annotations

from urdfkit.sim.plugin import Sensor

SENSORS: tuple[type[Sensor], ...] = ()
"""Every sensor; a test walks this folder and fails if one is missing here."""
