"""How controllers are configured: parameters in YAML, launch files that load them, and where both are found."""

from __future__ import annotations

from urdfkit.description.control.find import Configuration, find_configuration
from urdfkit.description.control.settings import Settings, node_settings, read_settings

__all__ = ["Configuration", "Settings", "find_configuration", "node_settings", "read_settings"]
