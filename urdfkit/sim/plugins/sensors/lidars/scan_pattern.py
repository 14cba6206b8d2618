"""Scan pattern of a lidar: ray directions and range limits in the ``<ray>`` or ``<lidar>`` of a ``<sensor>``."""

from dataclasses import dataclass

import numpy as np

from urdfkit.description.plugins.invalid_sensor_values import senseless_scan
from urdfkit.description.urdf.robot import SensorTag
from urdfkit.description.xml.element import Element
from urdfkit.errors import SimulationError
from urdfkit.linear_algebra import Array
from urdfkit.sim.plugins.sensors.sensor_values import number, refuse

MAX_RAYS = 4_000_000
"""Maximum number of rays of one lidar."""


@dataclass(frozen=True)
class Scan:
    """The rays of a lidar, in its frame: x forward, counter-clockwise about z, upwards with the vertical angle.

    Attributes:
        samples: rays per ring, multiplied by the resolution.
        angle_min: azimuth of the first ray [rad].
        angle_max: azimuth of the last ray [rad].
        rings: number of vertical rays.
        vertical_min: elevation of the lowest ring [rad].
        vertical_max: elevation of the highest ring [rad].
        range_min: minimum range [m].
        range_max: maximum range [m].
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
        """Angle between neighbouring rays of a ring [rad]; zero for a single ray."""
        return (self.angle_max - self.angle_min) / (self.samples - 1) if self.samples > 1 else 0.0

    @property
    def field_of_view(self) -> float:
        """The larger of the horizontal and the vertical field of view [rad]."""
        return max(self.angle_max - self.angle_min, self.vertical_max - self.vertical_min)

    def directions(self) -> Array:
        """Return the unit vector of each ray, ordered by ring, the lowest first; shape (rings · samples, 3)."""
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
        SimulationError: a parameter is invalid, with its position.
    """
    lidar = sensor.element.find("ray") or sensor.element.find("lidar")
    if lidar is None:
        tag = "lidar" if "lidar" in (sensor.type or "") else "ray"
        raise SimulationError(f"a lidar has no <{tag}>", position=sensor.element.origin.position)
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
    """Return the number of rays, and the angles of the first and the last ray."""
    if element is None:
        return default, 0.0, 0.0
    samples = number(element, "samples", float(default), least=1.0)
    rays = round(samples * number(element, "resolution", 1.0))
    return rays, number(element, "min_angle", 0.0), number(element, "max_angle", 0.0)
