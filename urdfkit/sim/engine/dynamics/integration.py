"""Integration of configurations."""

import math
from typing import Any

from urdfkit.sim.engine.compilation import inlined
from urdfkit.sim.engine.dynamics.mass_matrix import FREE, PLANAR
from urdfkit.sim.engine.kernel_world import KernelWorld
from urdfkit.sim.engine.math.elementary_functions import sine_cosine
from urdfkit.sim.engine.math.spatial_algebra import SMALL, little_turn, rotate, scale, turn_of


@inlined
def turned_by(x: float, y: float, z: float, w: float, turn: Any) -> Any:
    """Return a unit quaternion turned on by a rotation vector in its own axes [rad]."""
    turn = scale(0.5, turn)
    square = turn[0] * turn[0] + turn[1] * turn[1] + turn[2] * turn[2]
    if square < SMALL:
        share, e = little_turn(square)
    else:
        half = math.sqrt(square)
        sine, e = sine_cosine(half)
        share = sine / half
    a, b, c = share * turn[0], share * turn[1], share * turn[2]
    x, y, z, w = (
        w * a + x * e + y * c - z * b,
        w * b - x * c + y * e + z * a,
        w * c + x * b - y * a + z * e,
        w * e - x * a - y * b - z * c,
    )
    # One Newton step towards unit length is exact to rounding for a quaternion that was unit before.
    norm = 1.5 - 0.5 * (x * x + y * y + z * z + w * w)
    return norm * x, norm * y, norm * z, norm * w


@inlined
def move(w: KernelWorld, first: int, beyond: int, s: Any, v: Any, dt: float) -> None:
    """Integrate the coordinates `s` of some bodies for `dt` with the velocities `v`.

    A free body moves straight while it rotates: its linear velocity is constant in the axes of its parent, so the
    components in the body's own axes, in `v`, rotate in the opposite direction.
    """
    for i in range(first, beyond):
        at, d = w.first_s[i], w.first_v[i]
        if w.kind[i] == FREE:
            x, y, z, scalar = s[at + 3], s[at + 4], s[at + 5], s[at + 6]
            linear = rotate(turn_of(x, y, z, scalar), (v[d], v[d + 1], v[d + 2]))
            s[at] += dt * linear[0]
            s[at + 1] += dt * linear[1]
            s[at + 2] += dt * linear[2]
            x, y, z, scalar = turned_by(x, y, z, scalar, scale(dt, (v[d + 3], v[d + 4], v[d + 5])))
            s[at + 3], s[at + 4], s[at + 5], s[at + 6] = x, y, z, scalar
            v[d], v[d + 1], v[d + 2] = rotate(turn_of(-x, -y, -z, scalar), linear)
        elif w.kind[i] == PLANAR:
            # The same in the plane.
            sine, cosine = sine_cosine(s[at + 2])
            along, across = cosine * v[d] - sine * v[d + 1], sine * v[d] + cosine * v[d + 1]
            s[at] += dt * along
            s[at + 1] += dt * across
            s[at + 2] += dt * v[d + 2]
            sine, cosine = sine_cosine(s[at + 2])
            v[d], v[d + 1] = cosine * along + sine * across, cosine * across - sine * along
        else:
            s[at] += dt * v[d]
