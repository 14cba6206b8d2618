"""Controllers the simulator knows, in the order they are tried."""

from __future__ import annotations

from urdfkit.sim.controllers.gz import JointController, JointPositionController
from urdfkit.sim.controllers.ros2_control import Ros2Control
from urdfkit.sim.controllers.ros_control import GazeboRosControl
from urdfkit.sim.plugin import Controller

CONTROLLERS: tuple[type[Controller], ...] = (
    GazeboRosControl,
    Ros2Control,
    JointPositionController,
    JointController,
)
"""Every controller; a test walks this folder and fails if one is missing here."""
