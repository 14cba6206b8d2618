"""Configuration of controllers: YAML parameters, the launch files that load them, and the search for both.

Input: a robot and its packages; output: settings with their source positions.
"""

from urdfkit.description.control.parameter_yaml import node_settings, read_settings
from urdfkit.description.control.ros1_controllers import Configuration, find_configuration
from urdfkit.description.control.settings import Settings

__all__ = ["Configuration", "Settings", "find_configuration", "node_settings", "read_settings"]
