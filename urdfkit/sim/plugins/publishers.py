"""What the simulator itself publishes: joint states, transforms of the links, the clock.

They are what joint_state_publisher, robot_state_publisher and Gazebo's clock publish in ROS. A message nobody listens
to is counted but not built, and the simulation does not stop on its way to count it.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from urdfkit.bus import Bus, Topic
from urdfkit.description.urdf.queries import tree_order
from urdfkit.messages import CLOCK, JOINT_STATE, TF, header, message_type, stamp, transform
from urdfkit.sim.plugins.parameters import Parameters
from urdfkit.sim.plugins.topic_names import Topics
from urdfkit.sim.state.ticks import NEVER, Ticks

if TYPE_CHECKING:
    from urdfkit.description.plugins import PluginSpec
    from urdfkit.description.urdf.robot import Plugin
    from urdfkit.kinematics import Kinematics
    from urdfkit.sim.plugins.setup import Setup
    from urdfkit.sim.state.robot_state import State

CLOCK_RATE = 100.0
"""[Hz]; rosgraph's clock need not tick faster than the fastest controller."""

TRANSFORM_RATE = 50.0
"""[Hz]; the ``publish_frequency`` of robot_state_publisher."""

JOINT_STATE_RATE = 50.0
"""[Hz] for robots whose description has no joint state publisher."""


class Publication(ABC):
    """One topic filled at a fixed rate.

    Args:
        topic: where to.
        rate: [Hz]; zero or less means every step.
        dt: the simulation's step [s].

    Attributes:
        due: the step of the next publication: before it there is nothing to catch up with, and nothing to stop for.
    """

    def __init__(self, topic: Topic, rate: float, dt: float) -> None:
        self.topic = topic
        self._ticks = Ticks(rate, dt)
        self._done = 0
        self.due = self._ticks.after(0)

    def next_stop(self, step: int) -> int:
        """Return the step at which the simulation has to stop for it; `NEVER` while nobody listens."""
        return self._ticks.after(step) if self.topic.subscribers else NEVER

    def catch_up(self, state: State) -> None:
        """Publish what has fallen due."""
        if state.step < self.due:
            return
        fallen = self._ticks.until(state.step) - self._done
        self._done += fallen
        self.due = self._ticks.after(state.step)
        self.topic.offer(self.message(state), count=fallen)

    def reset(self) -> None:
        """Start again at step 0."""
        self.start_at(0)

    def start_at(self, step: int) -> None:
        """Take what fell due until a step as done: it begins there."""
        self._done = self._ticks.until(step)
        self.due = self._ticks.after(step)

    @abstractmethod
    def message(self, state: State) -> Callable[[], Any]:
        """Return what builds the message of this moment, also later."""


class Clock(Publication):
    """``/clock``."""

    def __init__(self, bus: Bus, dt: float) -> None:
        super().__init__(bus.advertise("/clock", CLOCK), CLOCK_RATE, dt)

    def message(self, state: State) -> Callable[[], Any]:
        """Return what builds the message of this moment, also later."""
        t = state.t
        return lambda: message_type(CLOCK)(stamp(t))


class JointStates(Publication):
    """Positions, velocities and, without a plugin, efforts of joints."""

    def __init__(self, topic: Topic, rate: float, dt: float, joints: tuple[str, ...], *, efforts: bool) -> None:
        super().__init__(topic, rate, dt)
        self._joints = joints
        self._efforts = efforts

    def message(self, state: State) -> Callable[[], Any]:
        """Return what builds the message of this moment, also later."""
        t, tell = state.t, state.keep_joints(self._joints)

        def build() -> Any:
            positions, velocities, efforts = tell()
            told = efforts if self._efforts else np.zeros(0)
            return message_type(JOINT_STATE)(header(t, ""), list(self._joints), positions, velocities, told)

        return build


class Transforms(Publication):
    """``/tf``, below a namespace: each moving link in its parent, as robot_state_publisher publishes them."""

    def __init__(self, bus: Bus, dt: float, kinematics: Kinematics, namespace: str = "") -> None:
        super().__init__(bus.advertise(f"{namespace}/tf", TF), TRANSFORM_RATE, dt)
        self._pairs = _parents(kinematics, movable=True)

    def message(self, state: State) -> Callable[[], Any]:
        """Return what builds the message of this moment, also later."""
        moment = state.snapshot()
        return lambda: message_type(TF)(
            [transform(moment.t, parent, child, *moment.placement(child, parent)) for parent, child in self._pairs]
        )


def publish_fixed(bus: Bus, state: State, kinematics: Kinematics, namespace: str = "") -> None:
    """Publish ``/tf_static``, below a namespace, once: each link that is fixed to its parent."""
    if pairs := _parents(kinematics, movable=False):
        moment = state.snapshot()
        bus.advertise(f"{namespace}/tf_static", TF).offer(
            lambda: message_type(TF)(
                [transform(moment.t, parent, child, *moment.placement(child, parent)) for parent, child in pairs]
            )
        )


def _parents(kinematics: Kinematics, *, movable: bool) -> tuple[tuple[str, str], ...]:
    joints = tree_order(kinematics.robot)
    return tuple((j.parent or "", j.child or "") for j in joints if j.is_movable is movable)


def all_joint_states(setup: Setup) -> JointStates:
    """Return the joint states of a robot whose description asks for none."""
    joints = (*setup.kinematics.joint_names, *setup.kinematics.mimic_names)
    topic = setup.bus.advertise(f"{setup.namespace}/joint_states", JOINT_STATE)
    return JointStates(topic, JOINT_STATE_RATE, setup.dt, joints, efforts=True)


def joint_states(plugin: Plugin, spec: PluginSpec, setup: Setup) -> JointStates:
    """Return the joint states of a joint state publisher plugin: positions and velocities.

    Raises:
        SimulationError: a joint is not there or a parameter makes no sense, with its place.
    """
    read = Parameters(plugin, spec, setup.names)
    topics = Topics(plugin, spec, namespace=setup.model)
    joints = tuple(setup.joint(name, read.place("joints")) for name in read.texts("joints"))
    if not joints and spec.generation == "gz":
        joints = (*setup.kinematics.joint_names, *setup.kinematics.mimic_names)
    topic = setup.bus.advertise(topics.resolve(read.text("topic", "joint_states")), JOINT_STATE)
    return JointStates(topic, read.number("update_rate"), setup.dt, joints, efforts=False)
