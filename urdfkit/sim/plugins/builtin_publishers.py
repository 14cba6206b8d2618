"""Built-in publishers of the simulator: joint states, transforms of the links, and the clock.

In ROS, joint_state_publisher, robot_state_publisher and Gazebo publish them. A message without subscribers is counted
but not built, and the simulation does not stop to count it.
"""

from abc import abstractmethod
from collections.abc import Callable
from typing import Any

import numpy as np

from urdfkit.bus import Bus, Topic
from urdfkit.description.plugins import PluginSpec
from urdfkit.description.urdf.queries import tree_order
from urdfkit.description.urdf.robot import Plugin
from urdfkit.kinematics import Kinematics
from urdfkit.messages import CLOCK, JOINT_STATE, TF, header, message_type, stamp, transform
from urdfkit.sim.plugins.parameters import Parameters
from urdfkit.sim.plugins.periodic import Publisher
from urdfkit.sim.plugins.setup import Setup
from urdfkit.sim.plugins.topic_names import Topics
from urdfkit.sim.state.robot_state import State

CLOCK_RATE = 100.0
"""Rate of ``/clock`` [Hz]; it need not be higher than that of the fastest controller."""

TRANSFORM_RATE = 50.0
"""Rate of ``/tf`` [Hz]; the ``publish_frequency`` of robot_state_publisher."""

JOINT_STATE_RATE = 50.0
"""Rate of ``/joint_states`` [Hz] for robots whose description has no joint state publisher."""


class Publication(Publisher):
    """Publisher of one topic at a fixed rate.

    Args:
        topic: the topic.
        rate: [Hz]; zero or less means every step.
        dt: the simulation's step [s].
    """

    def __init__(self, topic: Topic, rate: float, dt: float) -> None:
        self.topics = (topic,)
        self.rate = rate
        self.schedule(dt)

    def measure(self, state: State, count: int) -> None:
        """Offer the message of this state."""
        self.topics[0].offer(self.message(state), count=count)

    @abstractmethod
    def message(self, state: State) -> Callable[[], Any]:
        """Return a function that builds the message of this state; it may be called in a later step."""


class Clock(Publication):
    """Publisher of ``/clock``."""

    def __init__(self, bus: Bus, dt: float) -> None:
        super().__init__(bus.advertise("/clock", CLOCK), CLOCK_RATE, dt)

    def message(self, state: State) -> Callable[[], Any]:
        """Return a function that builds the message of this state; it may be called in a later step."""
        t = state.t
        return lambda: message_type(CLOCK)(stamp(t))


class JointStates(Publication):
    """Publisher of positions and velocities of joints, and of efforts if no plugin publishes joint states."""

    def __init__(self, topic: Topic, rate: float, dt: float, joints: tuple[str, ...], *, efforts: bool) -> None:
        super().__init__(topic, rate, dt)
        self._joints = joints
        self._efforts = efforts

    def message(self, state: State) -> Callable[[], Any]:
        """Return a function that builds the message of this state; it may be called in a later step."""
        t, values = state.t, state.keep_joints(self._joints)

        def build() -> Any:
            positions, velocities, efforts = values()
            efforts = efforts if self._efforts else np.zeros(0)
            return message_type(JOINT_STATE)(header(t, ""), list(self._joints), positions, velocities, efforts)

        return build


class Transforms(Publication):
    """Publisher of ``/tf`` below a namespace: each moving link in its parent, as in robot_state_publisher."""

    def __init__(self, bus: Bus, dt: float, kinematics: Kinematics, namespace: str = "") -> None:
        super().__init__(bus.advertise(f"{namespace}/tf", TF), TRANSFORM_RATE, dt)
        self._pairs = _parents(kinematics, movable=True)

    def message(self, state: State) -> Callable[[], Any]:
        """Return a function that builds the message of this state; it may be called in a later step."""
        snapshot = state.snapshot()
        return lambda: message_type(TF)(
            [transform(snapshot.t, parent, child, *snapshot.placement(child, parent)) for parent, child in self._pairs]
        )


def publish_fixed(bus: Bus, state: State, kinematics: Kinematics, namespace: str = "") -> None:
    """Publish ``/tf_static`` below a namespace once: each link with a fixed joint in its parent."""
    if pairs := _parents(kinematics, movable=False):
        snapshot = state.snapshot()
        bus.advertise(f"{namespace}/tf_static", TF).offer(
            lambda: message_type(TF)(
                [transform(snapshot.t, parent, child, *snapshot.placement(child, parent)) for parent, child in pairs]
            )
        )


def _parents(kinematics: Kinematics, *, movable: bool) -> tuple[tuple[str, str], ...]:
    joints = tree_order(kinematics.robot)
    return tuple((j.parent or "", j.child or "") for j in joints if j.is_movable is movable)


def all_joint_states(setup: Setup) -> JointStates:
    """Return the joint state publisher of a robot whose description has none."""
    joints = (*setup.kinematics.joint_names, *setup.kinematics.mimic_names)
    topic = setup.bus.advertise(f"{setup.namespace}/joint_states", JOINT_STATE)
    return JointStates(topic, JOINT_STATE_RATE, setup.dt, joints, efforts=True)


def joint_states(plugin: Plugin, spec: PluginSpec, setup: Setup) -> JointStates:
    """Return the publisher of a joint state publisher plugin: positions and velocities.

    Raises:
        SimulationError: a joint is unknown or a parameter is wrong, with its position.
    """
    read = Parameters(plugin, spec, setup.names)
    topics = Topics(plugin, spec, namespace=setup.model)
    joints = tuple(setup.joint(name, read.place("joints", i)) for i, name in enumerate(read.texts("joints")))
    if not joints and spec.generation == "gz":
        joints = (*setup.kinematics.joint_names, *setup.kinematics.mimic_names)
    topic = setup.bus.advertise(topics.resolve(read.text("topic", "joint_states")), JOINT_STATE)
    return JointStates(topic, read.number("update_rate"), setup.dt, joints, efforts=False)
