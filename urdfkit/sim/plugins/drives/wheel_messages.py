"""Wheel transforms and wheel joint states of drives."""

from collections.abc import Sequence
from typing import Any

from urdfkit.bus import Topic
from urdfkit.messages import JOINT_STATE, TF, header, message_type, transform
from urdfkit.sim.plugins.setup import Setup
from urdfkit.sim.state.configuration_snapshot import Snapshot
from urdfkit.sim.state.robot_state import State


class Wheels:
    """Publishes the transforms and the joint states of wheels.

    Args:
        setup: setup of the drive.
        joints: joints of the wheels, in the order of publication.
        with_tf: publish the transform of each wheel relative to its parent link.
        states: topic of the joint states; None to publish none.
        measured: publish velocities and efforts in addition to positions.
        named_by_joint: name the child frame after the joint (gazebo_ros_tricycle_drive), not after the link.
        base: frame of the root link, to which all transforms are relative (gazebo_ros_ackermann_drive). When empty,
            each transform is relative to the parent link of the wheel.
    """

    def __init__(
        self,
        setup: Setup,
        joints: Sequence[str],
        *,
        with_tf: bool,
        states: str | None = None,
        measured: bool = False,
        named_by_joint: bool = False,
        base: str = "",
    ) -> None:
        self._base, self._root = base, setup.kinematics.root
        self._robot = setup.kinematics.robot
        self._joints = tuple(joints)
        self._measured = measured
        self._named_by_joint = named_by_joint
        self._tf = setup.bus.advertise("/tf", TF) if with_tf else None
        self._states = setup.bus.advertise(states, JOINT_STATE) if states else None

    @property
    def topics(self) -> tuple[Topic, ...]:
        """The topics that exist."""
        return tuple(topic for topic in (self._tf, self._states) if topic is not None)

    def publish(self, state: State) -> None:
        """Publish transforms and joint states of the present state."""
        t = state.t
        if self._tf is not None:
            moved = state.snapshot()
            self._tf.offer(lambda: self._transforms(t, moved))
        if self._states is not None:
            columns = [[state.position(joint) for joint in self._joints]]
            if self._measured:
                columns.append([state.velocity(joint) for joint in self._joints])
                columns.append([state.effort(joint) for joint in self._joints])
            self._states.offer(lambda: self._message(t, columns))

    def _transforms(self, t: float, moved: Snapshot) -> Any:
        links = []
        for name in self._joints:
            joint = self._robot.joint_by_name[name]
            position, quaternion = moved.placement(joint.child, self._root if self._base else joint.parent)
            child = name if self._named_by_joint else joint.child or ""
            links.append(transform(t, self._base or joint.parent or "", child, position, quaternion))
        return message_type(TF)(links)

    def _message(self, t: float, columns: list[list[float]]) -> Any:
        import numpy as np

        arrays = [np.array(column) for column in columns] + [np.zeros(0)] * (3 - len(columns))
        return message_type(JOINT_STATE)(header(t, ""), list(self._joints), *arrays)
