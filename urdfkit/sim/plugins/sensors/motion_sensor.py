"""Base class of motion and position sensors: measures the motion of a link."""

from abc import abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np

from urdfkit.description.xml.element import Element
from urdfkit.errors import SimulationError, did_you_mean
from urdfkit.linear_algebra import Array
from urdfkit.sim.plugins.base import Sensor
from urdfkit.sim.plugins.parameters import Parameters
from urdfkit.sim.plugins.sensors.point_motion import KinematicSnapshot, PointMotion
from urdfkit.sim.plugins.sensors.sensor_values import pose_of, rate_of
from urdfkit.sim.plugins.setup import Setup
from urdfkit.sim.plugins.topic_names import Topics
from urdfkit.sim.scene_view import Surroundings
from urdfkit.sim.state.robot_state import State


@dataclass(frozen=True, eq=False)
class Sample:
    """Inputs of one reading.

    Attributes:
        t: time stamp [s].
        turn: number of the publication.
        motion: motion of the sensor.
        acceleration: mean acceleration of its origin in the last step, along the world's axes [m/s²]; shape (3,).
        random: generator of its noise; depends only on the seed and the number of the publication.
    """

    t: float
    turn: int
    motion: PointMotion
    acceleration: Array
    random: np.random.Generator


class LinkSensor(Sensor):
    """Sensor on a link; all its topics share one reading per measurement.

    With a `lead` of 1 the acceleration is that of the last step.

    Attributes:
        frame: frame id of its messages.
    """

    frame: str = ""

    def configure(self, setup: Setup) -> None:
        """Read the link, the rate and the parameters, and advertise the topics.

        The link is that of the ``<sensor>``. A plugin of the model uses the link in ``bodyName``, else the root link.

        Raises:
            SimulationError: a parameter is invalid, with its position.
        """
        sensor, surroundings = setup.sensor, setup.surroundings
        if surroundings is None:
            raise SimulationError("nothing is around", position=self.plugin.element.origin.position)
        self.name = (sensor.name if sensor is not None else self.plugin.name) or "sensor"
        read = self.parameters(setup, link=setup.link, sensor=self.name)
        if sensor is not None:
            self.link = carrier(setup)
            self._mount = pose_of(sensor.element)
        else:
            self.link = read.text("body") or setup.kinematics.root
            if self.link not in (links := setup.kinematics.link_names):
                message = f"<{read.tag('body')}> is `{self.link}`, which is not a link" + did_you_mean(self.link, links)
                raise SimulationError(message, position=read.place("body"))
            self._mount = np.eye(4)
        self.rate = rate_of(None if sensor is None else sensor.element, read)
        frame = read.text("frame") or read.text("old_frame") or read.text("default_frame")
        self.frame = (frame or read.text("body") or self.link).lstrip("/")
        self._kinematics = setup.kinematics
        self._key = int(setup.random.integers(1 << 62))
        self._before: KinematicSnapshot | None = None
        element = None if sensor is None else sensor.element
        topics = self.topic_names(self._namespace(setup))
        self._prepare(setup, element, read, topics, surroundings)

    def _namespace(self, setup: Setup) -> str:
        """Return the namespace in ROS 1 if ``<robotNamespace>`` is missing."""
        return ""

    @abstractmethod
    def _prepare(
        self, setup: Setup, element: Element | None, read: Parameters, topics: Topics, surroundings: Surroundings
    ) -> None:
        """Read this kind of sensor from the ``<sensor>`` and the parameters, and fill `topics`."""

    @abstractmethod
    def _measure(self, sample: Sample) -> Any:
        """Return the reading, noise included."""

    def messages(self) -> tuple[Callable[[Any], Any], ...]:
        """Return the function that builds the message of each topic in `topics` from a reading; see `message`."""
        return (self.message,)

    def message(self, reading: Any) -> Any:
        """Return the message of the only topic from a reading; by default the reading is the message."""
        return reading

    def act(self, state: State) -> None:
        """Publish the messages that are due, and store this state for the next measurement."""
        super().act(state)
        if self.lead:
            self._before = KinematicSnapshot(self._kinematics, state)

    def reset(self, step: int = 0) -> None:
        """Restart at a step."""
        super().reset(step)
        self._before = None

    def measure(self, state: State, count: int) -> None:
        """Publish the reading of this state; computed only for a subscriber or a reader of `latest`."""
        now, before, turn = KinematicSnapshot(self._kinematics, state), self._before, self.done

        @cache
        def felt() -> Any:
            motion, acceleration = now.motion(self.link, self._mount), np.zeros(3)
            if before is not None and before.step < now.step:
                gained = motion.linear - before.motion(self.link, self._mount).linear
                acceleration = gained / (now.t - before.t)
            random = np.random.Generator(np.random.Philox(key=[self._key, turn]))
            return self._measure(Sample(now.t, turn, motion, acceleration, random))

        def offer(topic: Any, message: Callable[[Any], Any]) -> None:
            topic.offer(lambda: message(felt()), count=count)

        for topic, message in zip(self.topics, self.messages(), strict=True):
            offer(topic, message)


def carrier(setup: Setup) -> str:
    """Return the link of a ``<sensor>``.

    Raises:
        SimulationError: its ``<gazebo>`` block refers to no link, with its position and the nearest name.
    """
    assert setup.sensor is not None
    links = setup.kinematics.link_names
    if setup.link in links:
        return setup.link
    place = setup.sensor.element.origin.position
    if not setup.link:
        message = "a sensor must be in the <gazebo reference=…> of a link; this <gazebo> has no reference"
        raise SimulationError(message, position=place, code="Z801")
    if setup.link not in setup.kinematics.robot.joint_by_name:
        blocks = setup.kinematics.robot.gazebo
        place = next((each.element.origin.position for each in blocks if setup.sensor in each.sensors), place)
    message = f"a sensor must be in the <gazebo reference=…> of a link; `{setup.link}` is not a link" + did_you_mean(
        setup.link, links
    )
    raise SimulationError(message, position=place, code="Z801")
