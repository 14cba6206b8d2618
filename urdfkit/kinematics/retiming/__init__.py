"""The fastest motion of joints through waypoints within their limits, and the files of paths and motions.

Configurations and limits go in; samples with times, positions, velocities and accelerations come out.
"""

from urdfkit.kinematics.retiming.fastest_motion import TimedPath, retime
from urdfkit.kinematics.retiming.motion_limits import MotionLimits, find_joint_limits, motion_limits
from urdfkit.kinematics.retiming.path_files import JointPath, read_path

__all__ = ["JointPath", "MotionLimits", "TimedPath", "find_joint_limits", "motion_limits", "read_path", "retime"]
