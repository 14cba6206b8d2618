"""Gaussian noise of sensors: SDF's ``<noise>``, and the standard deviation in the parameters of ROS 1 plugins."""

from dataclasses import dataclass

import numpy as np

from urdfkit.description.plugins.invalid_sensor_values import NOISES
from urdfkit.description.xml.element import Element
from urdfkit.errors import SimulationError, did_you_mean
from urdfkit.linear_algebra import Array
from urdfkit.sim.plugins.sensors.sensor_values import number


@dataclass(frozen=True)
class Noise:
    """Noise model of a reading.

    Attributes:
        mean: mean, in the unit of the reading.
        deviation: standard deviation.
        bias: constant offset of all readings, drawn once.
        precision: quantization step of the readings; zero for none.
    """

    mean: float = 0.0
    deviation: float = 0.0
    bias: float = 0.0
    precision: float = 0.0

    def __bool__(self) -> bool:
        return any((self.mean, self.deviation, self.bias, self.precision))

    def on(self, readings: Array, random: np.random.Generator) -> Array:
        """Return readings with noise added (gazebo, GaussianNoiseModel.cc)."""
        found = readings + (self.mean + self.bias)
        if self.deviation > 0.0:
            found = found + self.deviation * random.standard_normal(readings.shape)
        return found if self.precision <= 0.0 else np.round(found / self.precision) * self.precision


def noise_of(parent: Element | None, random: np.random.Generator) -> Noise:
    """Return the ``<noise>`` in an element; zero noise if missing. The bias gets a random sign, as in Gazebo.

    Args:
        parent: element that contains it, such as ``<ray>``.
        random: generator that draws the bias.

    Raises:
        SimulationError: a parameter is invalid, with its position.
    """
    element = None if parent is None else parent.find("noise")
    if element is None:
        return Noise()
    written = element.find("type")
    kind = (written.text if written is not None else element.get("type")) or "none"
    if kind not in NOISES:
        message = f"unknown noise type `{kind}`; use one of {', '.join(NOISES)}" + did_you_mean(kind, NOISES)
        raise SimulationError(message, position=(written or element).origin.position, code="Z823")
    if kind == "none":
        return Noise()
    bias = float(random.normal(number(element, "bias_mean", 0.0), number(element, "bias_stddev", 0.0, least=0.0)))
    if random.random() < 0.5:
        bias = -bias
    return Noise(
        number(element, "mean", 0.0),
        number(element, "stddev", 0.0, least=0.0),
        bias + 0.0,
        number(element, "precision", 0.0, least=0.0) if kind == "gaussian_quantized" else 0.0,
    )
