"""Controllers of ros_control, ros2_control and Gazebo; `CONTROLLERS` lists them in the order they are tried.

A controller reads parameters and subscribes to commands. It writes joint commands and publishes states and odometry.
"""

from urdfkit.sim.plugins.base import Controller
from urdfkit.sim.plugins.controllers.gz_joint_controllers import JointController, JointPositionController
from urdfkit.sim.plugins.controllers.ros2_control import Ros2Control
from urdfkit.sim.plugins.controllers.ros_control import GazeboRosControl

CONTROLLERS: tuple[type[Controller], ...] = (GazeboRosControl, Ros2Control, JointPositionController, JointController)
"""All controller plugins; a test fails if one of this folder is missing here."""
