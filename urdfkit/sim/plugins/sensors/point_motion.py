"""Motion of a frame on a link, computed on demand from a stored state of the robot."""

from dataclasses import dataclass

import numpy as np

from urdfkit.kinematics import Kinematics
from urdfkit.linear_algebra import Array, matmul
from urdfkit.sim.state.configuration_snapshot import Snapshot
from urdfkit.sim.state.robot_state import State


@dataclass(frozen=True, eq=False)
class PointMotion:
    """Pose and velocity of a frame in the world.

    Attributes:
        rotation: orientation of the frame in the world; shape (3, 3).
        position: position of its origin [m]; shape (3,).
        linear: velocity of its origin along the world's axes [m/s]; shape (3,).
        angular: angular velocity along the world's axes [rad/s]; shape (3,).
    """

    rotation: Array
    position: Array
    linear: Array
    angular: Array


class KinematicSnapshot:
    """Stored state of the robot at one time; motions are computed on demand.

    Args:
        kinematics: the robot's model.
        state: the state to store.
    """

    def __init__(self, kinematics: Kinematics, state: State) -> None:
        self._kinematics = kinematics
        self.step, self.t = state.step, state.t
        self._snapshot: Snapshot = state.snapshot()
        self._v = state.v.copy()

    def motion(self, link: str, mount: Array) -> PointMotion:
        """Return the motion of a frame fixed to a link.

        Args:
            link: name of the link.
            mount: placement of the frame in the link; shape (4, 4).
        """
        import pinocchio as pin

        kinematics = self._kinematics
        pin.forwardKinematics(kinematics.model, kinematics.data, self._snapshot.q, self._v)
        frame = kinematics.frame(link)
        pin.updateFramePlacement(kinematics.model, kinematics.data, frame)
        local = pin.getFrameVelocity(kinematics.model, kinematics.data, frame, pin.LOCAL)
        pose = self._snapshot.link_poses()[kinematics.link_names.index(link)]
        R = np.array(pin.Quaternion(pose[3:].copy()).matrix())
        angular = matmul(R, local.angular)
        arm = matmul(R, mount[:3, 3])
        return PointMotion(
            matmul(R, mount[:3, :3]), pose[:3] + arm, matmul(R, local.linear) + np.cross(angular, arm), angular
        )
