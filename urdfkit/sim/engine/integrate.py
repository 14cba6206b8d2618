"""Configurations moved by velocities, on the groups they live on (as ``pinocchio.integrate``)."""

from __future__ import annotations

import math
from typing import Any

from urdfkit.sim.engine.compilation import inlined
from urdfkit.sim.engine.dynamics import FREE, PLANAR
from urdfkit.sim.engine.spatial import add, cross, rotate, scale, turn_of


@inlined
def exponential_factors(angle: float) -> tuple[float, float]:
    """Return (1 - cos a)/a² and (a - sin a)/a³, by series where they cancel."""
    square = angle * angle
    if angle < 0.05:
        return 0.5 - square / 24.0 * (1.0 - square / 30.0), (1.0 - square / 20.0 * (1.0 - square / 42.0)) / 6.0
    return (1.0 - math.cos(angle)) / square, (angle - math.sin(angle)) / (square * angle)


@inlined
def move(bodies: int, kind: Any, first_s: Any, first_v: Any, start: Any, v: Any, dt: float, s: Any) -> None:
    """Write to `s` where `start` gets in `dt` at constant joint twists `v`."""
    for i in range(bodies):
        at, d = first_s[i], first_v[i]
        if kind[i] == FREE:
            linear = scale(dt, (v[d], v[d + 1], v[d + 2]))
            turn = scale(dt, (v[d + 3], v[d + 4], v[d + 5]))
            angle = math.sqrt(turn[0] * turn[0] + turn[1] * turn[1] + turn[2] * turn[2])
            b, c = exponential_factors(angle)
            once = cross(turn, linear)
            moved = add(linear, add(scale(b, once), scale(c, cross(turn, once))))
            x, y, z, w = start[at + 3], start[at + 4], start[at + 5], start[at + 6]
            moved = rotate(turn_of(x, y, z, w), moved)
            s[at], s[at + 1], s[at + 2] = start[at] + moved[0], start[at + 1] + moved[1], start[at + 2] + moved[2]
            half = 0.5 * angle
            # sin(half)/angle by series where the angle is too small to divide by.
            k = 0.5 - half * half / 12.0 if half < 1e-3 else math.sin(half) / angle
            e, f, g, h = k * turn[0], k * turn[1], k * turn[2], math.cos(half)
            x, y, z, w = (
                w * e + x * h + y * g - z * f,
                w * f - x * g + y * h + z * e,
                w * g + x * f - y * e + z * h,
                w * h - x * e - y * f - z * g,
            )
            # One Newton step towards unit length is exact to rounding for a quaternion that was unit before.
            k = 1.5 - 0.5 * (x * x + y * y + z * z + w * w)
            s[at + 3], s[at + 4], s[at + 5], s[at + 6] = k * x, k * y, k * z, k * w
        elif kind[i] == PLANAR:
            angle = dt * v[d + 2]
            b, c = exponential_factors(abs(angle))
            x, y = dt * v[d], dt * v[d + 1]
            along = x - b * angle * y - c * angle * angle * x
            across = y + b * angle * x - c * angle * angle * y
            cosine, sine = math.cos(start[at + 2]), math.sin(start[at + 2])
            s[at] = start[at] + cosine * along - sine * across
            s[at + 1] = start[at + 1] + sine * along + cosine * across
            s[at + 2] = start[at + 2] + angle
        else:
            s[at] = start[at] + dt * v[d]
