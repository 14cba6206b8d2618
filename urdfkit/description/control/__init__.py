"""How controllers are configured: parameters in YAML, launch files that load them, and where both are found.

A robot and its packages go in; settings that know their place come out.
"""

from __future__ import annotations

from urdfkit.description.control.parameter_yaml import Settings, node_settings, read_settings
from urdfkit.description.control.ros1_controllers import Configuration, find_configuration

__all__ = ["Configuration", "Settings", "find_configuration", "node_settings", "read_settings"]
