"""Where a world lies on the earth: its axes → latitude, longitude and altitude on WGS 84."""

from __future__ import annotations

from dataclasses import dataclass
from math import atan2, cos, degrees, hypot, radians, sin, sqrt

import numpy as np
from numpy.typing import NDArray

from urdfkit.description.sdf import World
from urdfkit.linear_algebra import matmul
from urdfkit.sim.plugins.sensors.sensor_values import number

Array = NDArray[np.float64]

A = 6378137.0
"""Semi-major axis [m] (WGS 84)."""
F = 1 / 298.257223563
"""Flattening (WGS 84)."""
E2 = F * (2 - F)


@dataclass(frozen=True)
class Earth:
    """The world's origin on the earth, and which way its axes point.

    Attributes:
        latitude: of the origin [rad].
        longitude: of the origin [rad].
        elevation: of the origin above the ellipsoid [m].
        heading: counter-clockwise, from east to the world's x axis [rad].
    """

    latitude: float = 0.0
    longitude: float = 0.0
    elevation: float = 0.0
    heading: float = 0.0

    def locate(self, position: Array) -> tuple[float, float, float]:
        """Return latitude [°], longitude [°] and altitude [m] of a point in the world."""
        found = self._centre(self.latitude, self.longitude, self.elevation) + matmul(self._axes(), position)
        x, y, z = found.tolist()
        flat = hypot(x, y)
        latitude, altitude = atan2(z, flat * (1 - E2)), 0.0
        for _ in range(8):  # converges by a factor of E2 a round
            n = A / sqrt(1 - E2 * sin(latitude) ** 2)
            altitude = flat * cos(latitude) + z * sin(latitude) - A * sqrt(1 - E2 * sin(latitude) ** 2)
            latitude = atan2(z, flat * (1 - E2 * n / (n + altitude)))
        return degrees(latitude), degrees(atan2(y, x)), altitude

    def compass(self, along: Array) -> tuple[float, float, float]:
        """Return what a vector along the world's axes is to the east, to the north and up."""
        x, y, z = along.tolist()
        c, s = cos(self.heading), sin(self.heading)
        return c * x - s * y, s * x + c * y, z

    def _axes(self) -> Array:
        """Return the world's axes in the earth's; shape (3, 3)."""
        (s, c), (sl, cl) = (sin(self.latitude), cos(self.latitude)), (sin(self.longitude), cos(self.longitude))
        east, north, up = (-sl, cl, 0.0), (-s * cl, -s * sl, c), (c * cl, c * sl, s)
        turn = np.array(
            [
                [cos(self.heading), -sin(self.heading), 0.0],
                [sin(self.heading), cos(self.heading), 0.0],
                [0.0, 0.0, 1.0],
            ]
        )
        axes: Array = matmul(np.column_stack([east, north, up]), turn)
        return axes

    @staticmethod
    def _centre(latitude: float, longitude: float, altitude: float) -> Array:
        n = A / sqrt(1 - E2 * sin(latitude) ** 2)
        return np.array(
            [
                (n + altitude) * cos(latitude) * cos(longitude),
                (n + altitude) * cos(latitude) * sin(longitude),
                (n * (1 - E2) + altitude) * sin(latitude),
            ]
        )


def earth_of(world: World) -> Earth | None:
    """Return what a world's ``<spherical_coordinates>`` say; None where it has none.

    Raises:
        SimulationError: a number is none, with its place.
    """
    element = next((kept.element for kept in world.kept if kept.element.tag == "spherical_coordinates"), None)
    if element is None:
        return None
    return Earth(
        radians(number(element, "latitude_deg", 0.0)),
        radians(number(element, "longitude_deg", 0.0)),
        number(element, "elevation", 0.0),
        radians(number(element, "heading_deg", 0.0)),
    )
