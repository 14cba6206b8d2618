"""Drives: the plugins that turn a velocity command into motion, one module per family.

Placeholders in defaults are replaced per model: ``{model}`` is its name, ``{root}`` its root link.
"""

from urdfkit.description.plugins.drives.ackermann import ACKERMANN
from urdfkit.description.plugins.drives.diff_drive import DIFF_DRIVE, SKID_STEER_ROS_1
from urdfkit.description.plugins.drives.gz_mecanum_drive import MECANUM_DRIVE_GZ, ODOMETRY_PUBLISHER_GZ
from urdfkit.description.plugins.drives.planar_move import PLANAR_MOVE
from urdfkit.description.plugins.drives.tricycle import TRICYCLE

DRIVES = (*DIFF_DRIVE, SKID_STEER_ROS_1, *PLANAR_MOVE, *ACKERMANN, *TRICYCLE, MECANUM_DRIVE_GZ, ODOMETRY_PUBLISHER_GZ)
"""All drives."""
