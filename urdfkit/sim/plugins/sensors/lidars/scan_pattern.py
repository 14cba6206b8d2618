"""Where a lidar looks: the ``<ray>`` or ``<lidar>`` of a ``<sensor>``."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from urdfkit.description.plugins.sensor_values import senseless_scan
from urdfkit.description.urdf.robot import SensorTag
from urdfkit.description.xml.element import Element
from urdfkit.errors import SimulationError
from urdfkit.sim.plugins.sensors.sensor_values import number, refuse

Array = NDArray[np.float64]

MAX_RAYS = 4_000_000
"""Most rays of one lidar."""


@dataclass(frozen=True)
class Scan:
    """The rays of a lidar, in its frame: x forward, counter-clockwise about z, upwards with the vertical angle.

    Attributes:
        samples: rays side by side, the resolution counted in.
        angle_min: of the first [rad].
        angle_max: of the last [rad].
        rings: rays above each other.
        vertical_min: of the lowest [rad].
        vertical_max: of the highest [rad].
        range_min: nothing nearer is seen [m].
        range_max: nothing farther is seen [m].
    """

    samples: int
    angle_min: float
    angle_max: float
    rings: int
    vertical_min: float
    vertical_max: float
    range_min: float
    range_max: float

    @property
    def increment(self) -> float:
        """Angle from one ray to the next [rad]; zero where there is one only."""
        return (self.angle_max - self.angle_min) / (self.samples - 1) if self.samples > 1 else 0.0

    @property
    def field_of_view(self) -> float:
        """The larger of the two angles it covers [rad]."""
        return max(self.angle_max - self.angle_min, self.vertical_max - self.vertical_min)

    def directions(self) -> Array:
        """Return a unit vector per ray, ring by ring from the lowest; shape (rings · samples, 3)."""
        azimuth, elevation = np.meshgrid(
            np.linspace(self.angle_min, self.angle_max, self.samples),
            np.linspace(self.vertical_min, self.vertical_max, self.rings),
        )
        across = np.cos(elevation)
        found = np.stack([across * np.cos(azimuth), across * np.sin(azimuth), np.sin(elevation)], axis=-1)
        return np.ascontiguousarray(found.reshape(-1, 3))


def scan_of(sensor: SensorTag) -> Scan:
    """Return the scan of a lidar; the defaults are sdformat's (lidar.sdf).

    Raises:
        SimulationError: it makes no sense, with its place.
    """
    lidar = sensor.element.find("ray") or sensor.element.find("lidar")
    if lidar is None:
        tag = "lidar" if "lidar" in (sensor.type or "") else "ray"
        raise SimulationError(f"a lidar lacks its <{tag}>", position=sensor.element.origin.position)
    refuse(senseless_scan(lidar))
    pattern, reach = lidar.find("scan"), lidar.find("range")
    samples, angle_min, angle_max = _fan(None if pattern is None else pattern.find("horizontal"), 640)
    rings, vertical_min, vertical_max = _fan(None if pattern is None else pattern.find("vertical"), 1)
    if samples * rings > MAX_RAYS:
        raise SimulationError(
            f"{samples} × {rings} rays are more than {MAX_RAYS}", position=(pattern or lidar).origin.position
        )
    range_min, range_max = number(reach, "min", 0.0), number(reach, "max", 0.0, infinite=True)
    return Scan(samples, angle_min, angle_max, rings, vertical_min, vertical_max, range_min, range_max)


def _fan(element: Element | None, default: int) -> tuple[int, float, float]:
    """Return how many rays there are, and the angles of the first and the last."""
    if element is None:
        return default, 0.0, 0.0
    samples = number(element, "samples", float(default), least=1.0)
    rays = round(samples * number(element, "resolution", 1.0))
    return rays, number(element, "min_angle", 0.0), number(element, "max_angle", 0.0)
