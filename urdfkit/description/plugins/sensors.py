"""Sensors: the plugins that stand in a ``<sensor>``, and the sensors that need none, one module per family."""

from __future__ import annotations

from urdfkit.description.plugins.lidar import LIDAR_GZ, LIDAR_TYPES, LIDARS
from urdfkit.description.plugins.spec import PluginSpec

SENSORS = (*LIDARS,)
"""Every sensor plugin."""

BARE: dict[str, PluginSpec] = dict.fromkeys(LIDAR_TYPES, LIDAR_GZ)
"""Type of a ``<sensor>`` without a plugin → its table: in the new Gazebo sensors publish by themselves."""
