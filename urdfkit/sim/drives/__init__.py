"""Drives the simulator knows, in the order they are tried."""

from __future__ import annotations

from urdfkit.sim.drives.diff_drive import DiffDrive
from urdfkit.sim.plugin import Drive

DRIVES: tuple[type[Drive], ...] = (DiffDrive,)
"""Every drive; a test walks this folder and fails if one is missing here."""
