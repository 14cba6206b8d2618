"""Controllers the simulator knows, in the order they are tried."""

from __future__ import annotations

from urdfkit.sim.plugin import Controller

CONTROLLERS: tuple[type[Controller], ...] = ()
"""Every controller; a test walks this folder and fails if one is missing here."""
