"""Gaussian noise of sensors: SDF's ``<noise>``, and the standard deviation that plugins of ROS 1 bring themselves."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from urdfkit.description.xml.element import Element
from urdfkit.errors import SimulationError, did_you_mean
from urdfkit.sim.plugins.sensors.sensor_values import number

Array = NDArray[np.float64]

TYPES = ("none", "gaussian", "gaussian_quantized")


@dataclass(frozen=True)
class Noise:
    """What is added to a reading.

    Attributes:
        mean: of the noise, in the unit of what is measured.
        deviation: standard deviation.
        bias: added to all readings alike, drawn once.
        precision: readings are multiples of it; zero for any.
    """

    mean: float = 0.0
    deviation: float = 0.0
    bias: float = 0.0
    precision: float = 0.0

    def __bool__(self) -> bool:
        return any((self.mean, self.deviation, self.bias, self.precision))

    def on(self, readings: Array, random: np.random.Generator) -> Array:
        """Return readings with noise on them (gazebo, GaussianNoiseModel.cc)."""
        found = readings + (self.mean + self.bias)
        if self.deviation > 0.0:
            found = found + self.deviation * random.standard_normal(readings.shape)
        return found if self.precision <= 0.0 else np.round(found / self.precision) * self.precision


def noise_of(parent: Element | None, random: np.random.Generator) -> Noise:
    """Return the ``<noise>`` in an element; none where there is none. Its bias may have either sign, as Gazebo's.

    Args:
        parent: what is measured, such as ``<ray>``.
        random: draws the bias.

    Raises:
        SimulationError: it makes no sense, with its place.
    """
    element = None if parent is None else parent.find("noise")
    if element is None:
        return Noise()
    written = element.find("type")
    kind = (written.text if written is not None else element.get("type")) or "none"
    if kind not in TYPES:
        raise SimulationError(
            f"noise of type `{kind}`{did_you_mean(kind, TYPES)}; it must be {', '.join(TYPES)}",
            position=(written or element).origin.position,
        )
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
