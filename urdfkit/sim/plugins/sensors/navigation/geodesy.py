"""Geodetic coordinates: positions in the world → latitude, longitude and altitude on WGS 84."""

from dataclasses import dataclass
from math import atan2, cos, degrees, hypot, radians, sin, sqrt

import numpy as np

from urdfkit.description.sdf import World
from urdfkit.linear_algebra import Array, matmul
from urdfkit.sim.plugins.sensors.sensor_values import number

A = 6378137.0
"""Semi-major axis [m] (WGS 84)."""
F = 1 / 298.257223563
"""Flattening (WGS 84)."""
E2 = F * (2 - F)


@dataclass(frozen=True)
class Earth:
    """Geodetic position of the world's origin, and heading of its axes.

    Attributes:
        latitude: latitude of the origin [rad].
        longitude: longitude of the origin [rad].
        elevation: height of the origin above the ellipsoid [m].
        heading: angle from east to the world's x axis, counter-clockwise [rad].
    """

    latitude: float = 0.0
    longitude: float = 0.0
    elevation: float = 0.0
    heading: float = 0.0

    def locate(self, position: Array) -> tuple[float, float, float]:
        """Return latitude [°], longitude [°] and altitude [m] of a position in the world."""
        found = self._centre(self.latitude, self.longitude, self.elevation) + matmul(self._axes(), position)
        x, y, z = found.tolist()
        flat = hypot(x, y)
        latitude, altitude = atan2(z, flat * (1 - E2)), 0.0
        for _ in range(8):  # the error shrinks by a factor of E2 per iteration
            n = A / sqrt(1 - E2 * sin(latitude) ** 2)
            altitude = flat * cos(latitude) + z * sin(latitude) - A * sqrt(1 - E2 * sin(latitude) ** 2)
            latitude = atan2(z, flat * (1 - E2 * n / (n + altitude)))
        return degrees(latitude), degrees(atan2(y, x)), altitude

    def compass(self, along: Array) -> tuple[float, float, float]:
        """Return the east, north and up components of a vector along the world's axes."""
        x, y, z = along.tolist()
        c, s = cos(self.heading), sin(self.heading)
        return c * x - s * y, s * x + c * y, z

    def _axes(self) -> Array:
        """Return the world's axes in the earth-centred, earth-fixed frame; shape (3, 3)."""
        (s, c), (sl, cl) = (sin(self.latitude), cos(self.latitude)), (sin(self.longitude), cos(self.longitude))
        east, north, up = (-sl, cl, 0.0), (-s * cl, -s * sl, c), (c * cl, c * sl, s)
        turn = np.array(
            [[cos(self.heading), -sin(self.heading), 0.0], [sin(self.heading), cos(self.heading), 0.0], [0.0, 0.0, 1.0]]
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
    """Return the geodetic reference in a world's ``<spherical_coordinates>``; None without that element.

    Raises:
        SimulationError: a value is not a finite number, with its position.
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
