"""Base class of lidars and cameras: sensors on a link that observe the scene while a topic has subscribers."""

from abc import abstractmethod
from collections.abc import Callable
from functools import cache, partial
from typing import Any

import numpy as np

from urdfkit.description.plugins.invalid_sensor_values import senseless_parameters
from urdfkit.description.urdf.robot import SensorTag
from urdfkit.errors import SimulationError
from urdfkit.linear_algebra import Array, matmul
from urdfkit.sim.plugins.base import Sensor
from urdfkit.sim.plugins.parameters import Parameters
from urdfkit.sim.plugins.sensors.motion_sensor import carrier
from urdfkit.sim.plugins.sensors.sensor_values import pose_of, rate_of, refuse
from urdfkit.sim.plugins.setup import Setup
from urdfkit.sim.plugins.topic_names import Topics
from urdfkit.sim.scene_view import Layout
from urdfkit.sim.state.robot_state import State


class SceneSensor(Sensor):
    """Sensor on a link that observes the scene; all its topics share one observation per measurement.

    Attributes:
        frame: frame id of its messages.
    """

    namespace = ""
    """Namespace in ROS 1 if ``<robotNamespace>`` is empty; ``{model}`` is replaced by the robot's name."""

    frame: str = ""
    viewpoint: Array
    """Placement in the world at the last observation; shape (4, 4)."""

    def configure(self, setup: Setup) -> None:
        """Read the sensor, its rate and the plugin's parameters, and advertise its topics.

        Raises:
            SimulationError: a parameter is invalid, with its position.
        """
        sensor = setup.sensor
        if sensor is None or setup.surroundings is None:
            raise SimulationError("this plugin must be in a <sensor>", position=self.plugin.element.origin.position)
        link = carrier(setup)
        self.name = sensor.name or "sensor"
        names = {**setup.names, "link": setup.link, "sensor": self.name}
        read = Parameters(self.plugin, self.spec, names)
        refuse(senseless_parameters(self.plugin, self.spec))
        empty = self.plugin.element.find("robotNamespace") is not None
        topics = self.topic_names(self.namespace.format(**names) if empty else "")
        self.rate = rate_of(sensor.element, read)
        frame = read.text("frame") or read.text("old_frame") or read.text("default_frame")
        self.frame = frame.lstrip("/")
        self._surroundings = setup.surroundings
        self._pose = pose_of(sensor.element)
        self._robot = setup.model
        self._link = setup.kinematics.link_names.index(link)
        self._key = int(setup.random.integers(1 << 62))
        self._prepare(setup, sensor, read, topics)

    @abstractmethod
    def _prepare(self, setup: Setup, sensor: SensorTag, read: Parameters, topics: Topics) -> None:
        """Read the parameters of this kind of sensor, and fill `topics`."""

    @abstractmethod
    def _observe(self, t: float, layout: Layout, frame: Array, random: np.random.Generator) -> Any:
        """Return the observation of a layout of the scene from a frame of shape (4, 4)."""

    def messages(self) -> tuple[Callable[[Any], Any], ...]:
        """Return the functions that build the messages of the first topics from an observation; see `message`."""
        return (self.message,)

    def message(self, seen: Any) -> Any:
        """Return the message of the only topic from an observation; by default the observation is the message."""
        return seen

    def other_messages(self) -> tuple[Callable[[float], Any], ...]:
        """Return the functions that build the messages of the other topics from the time [s] alone."""
        return ()

    def glimpse(self, t: float) -> tuple[Callable[[], Any], ...]:
        """Observe the scene now, regardless of rate and subscribers.

        Returns the functions that build the messages of the first topics in `topics`.

        Args:
            t: current time [s].
        """
        layout = self._surroundings.layout()
        frame = self.viewpoint = matmul(layout.placement(self._robot, self._link), self._pose)
        with self._surroundings.lock:
            seen = self._observe(t, layout, frame, np.random.Generator(np.random.Philox(key=[self._key, 0])))
        return tuple(partial(self._build, message, lambda: seen) for message in self.messages())

    def measure(self, state: State, count: int) -> None:
        """Publish the observation of the current scene; computed only for a subscriber or a reader of `latest`.

        The noise depends only on the seed and the number of the publication.
        """
        t, turn, layout = state.t, self.done, self._surroundings.layout()
        if any(topic.subscribers for topic in self.topics):
            layout.compute()  # the observation may be made later, in another thread

        @cache
        def seen() -> Any:
            frame = self.viewpoint = matmul(layout.placement(self._robot, self._link), self._pose)
            return self._observe(t, layout, frame, np.random.Generator(np.random.Philox(key=[self._key, turn])))

        def offer(topic: Any, message: Callable[[Any], Any]) -> None:
            topic.offer_later(partial(self._build, message, seen), count=count)

        messages, others = self.messages(), self.other_messages()
        for topic, message in zip(self.topics, messages, strict=not others):
            offer(topic, message)
        for topic, other in zip(self.topics[len(messages) :], others, strict=True):
            topic.offer_later(partial(other, t), count=count)

    def _build(self, message: Callable[[Any], Any], seen: Callable[[], Any]) -> Any:
        """Return the message of an observation; one thread at a time uses the scene."""
        with self._surroundings.lock:
            return message(seen())
