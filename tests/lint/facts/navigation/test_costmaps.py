"""Polygons around a robot."""

import pytest

from urdfkit.lint.facts.navigation.costmaps import inscribed_radius


@pytest.mark.parametrize(
    ("points", "radius"),
    [
        ([(0.4, 0.3), (0.4, -0.3), (-0.4, -0.3), (-0.4, 0.3)], 0.3),
        ([(1.4, 0.3), (1.4, -0.3), (0.4, -0.3), (0.4, 0.3)], 0.0),
        ([(1e200, 1e200), (1e200, -1e200), (-1e200, -1e200), (-1e200, 1e200)], 1e200),
    ],
    ids=["around the origin", "next to it", "huge"],
)
def test_the_inscribed_radius_of_a_polygon(points, radius):
    assert inscribed_radius(points) == pytest.approx(radius)
