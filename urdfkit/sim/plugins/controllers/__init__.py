"""Controllers of ros_control, ros2_control and Gazebo; `CONTROLLERS` lists them in the order they are tried.

Parameters and commands go in; joint commands, states and odometry come out.
"""

from __future__ import annotations

from urdfkit.sim.plugins.base import Controller
from urdfkit.sim.plugins.controllers.gz_joint_controllers import JointController, JointPositionController
from urdfkit.sim.plugins.controllers.ros2_control import Ros2Control
from urdfkit.sim.plugins.controllers.ros_control import GazeboRosControl

CONTROLLERS: tuple[type[Controller], ...] = (
    GazeboRosControl,
    Ros2Control,
    JointPositionController,
    JointController,
)
"""Every controller; a test walks this folder and fails if one is missing here."""
