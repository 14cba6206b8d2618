"""joint_state_controller (ROS 1) and joint_state_broadcaster (ROS 2): joint states on ``joint_states``."""

from collections.abc import Callable
from typing import Any, ClassVar

import numpy as np

from urdfkit.errors import DescriptionError
from urdfkit.messages import JOINT_STATE, header, message_type
from urdfkit.sim.plugins.controllers.controller import RosController
from urdfkit.sim.state.robot_state import State


class JointStatePublisher(RosController):
    """Publishes positions, velocities and efforts of all joints of the hardware.

    ROS 1: at the required ``publish_rate``, in alphabetical order of the joints (joint_state_controller.cpp). ROS 2: at
    the controller manager's rate; ``joints`` selects joints, ``use_local_topics`` makes the topic relative to the
    controller.
    """

    types: ClassVar[dict[str, str]] = {
        "joint_state_controller/JointStateController": "1",
        "joint_state_broadcaster/JointStateBroadcaster": "2",
    }

    def configure(self) -> None:
        """Read the parameters and advertise.

        Raises:
            DescriptionError: the rate is missing (ROS 1) or invalid, or a joint is unknown.
        """
        hardware = self.hardware
        if hardware.ros == 1:
            rate = self.settings.number("publish_rate")
            if rate <= 0:
                where = self.settings.find("publish_rate")
                message = f"`publish_rate` is {rate:g} Hz; it must be greater than zero"
                raise DescriptionError(message, position=(where or self.settings).position)
            self._joints = tuple(sorted(hardware.joints))
            topic = hardware.resolve("joint_states")
        else:
            rate = 1.0 / hardware.period
            named = self.settings.texts("joints")
            self._joints = (
                tuple(hardware.setup.joint(e.value or "", e.position, "K959") for e in named) or hardware.joints
            )
            local = self.settings.flag("use_local_topics", False)
            topic = self.topic("joint_states") if local else hardware.resolve("joint_states")
        self.report(hardware.setup.bus.advertise(topic, JOINT_STATE), rate, self._message)

    def _message(self, state: State) -> Callable[[], Any]:
        t, joints = state.t, self._joints
        positions = [state.position(name) for name in joints]
        velocities = [state.velocity(name) for name in joints]
        efforts = [state.effort(name) for name in joints]
        return lambda: message_type(JOINT_STATE)(
            header(t, ""), list(joints), np.array(positions), np.array(velocities), np.array(efforts)
        )
