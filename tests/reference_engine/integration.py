"""How coordinates move by velocities: `dynamics.integration` and `stepping.ballistic` in numpy."""

from __future__ import annotations

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

from urdfkit.sim.engine.dynamics.mass_matrix import FREE, PLANAR
from urdfkit.sim.engine.simulation_memory import Arrays

Array = NDArray[np.float64]


def move(a: Arrays, s: Array, v: Array, dt: float) -> None:
    """Let the coordinates go on for `dt`, linear velocities constant in space; changes `s` and `v`."""
    for b, kind in enumerate(a["kind"]):
        at, d = a["first_s"][b], a["first_v"][b]
        if kind == FREE:
            before = pin.Quaternion(s[at + 3 : at + 7].copy())
            after = before * pin.Quaternion(pin.exp3_quat(v[d + 3 : d + 6] * dt))
            after.normalize()
            linear = before.matrix() @ v[d : d + 3]
            s[at : at + 3] += dt * linear
            s[at + 3 : at + 7] = after.coeffs()
            v[d : d + 3] = after.matrix().T @ linear
        elif kind == PLANAR:
            linear = in_plane(s[at + 2]) @ v[d : d + 2]
            s[at : at + 2] += dt * linear
            s[at + 2] += dt * v[d + 2]
            v[d : d + 2] = in_plane(s[at + 2]).T @ linear
        else:
            s[at] += dt * v[d]


def in_plane(angle: float) -> Array:
    """Return the rotation of the plane by an angle [rad]."""
    return np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])


def go(a: Arrays, s_first: Array, dq: Array) -> None:
    """Set the coordinates to those at the start and what they gained, turns in the axes of the start."""
    for b, kind in enumerate(a["kind"]):
        at, d = a["first_s"][b], a["first_v"][b]
        n = 1 if kind < PLANAR else 3
        a["s"][at : at + n] = s_first[at : at + n] + dq[d : d + n]
        if kind == FREE:
            turned = pin.Quaternion(s_first[at + 3 : at + 7].copy()) * pin.Quaternion(pin.exp3_quat(dq[d + 3 : d + 6]))
            a["s"][at + 3 : at + 7] = turned.normalized().coeffs()


def outward(a: Arrays, v: Array, sign: float = 1.0) -> Array:
    """Return velocities whose linear parts are along the axes of what the joint moves in."""
    found = np.array(v)
    for b, kind in enumerate(a["kind"]):
        at, d = a["first_s"][b], a["first_v"][b]
        if kind == FREE:
            R = pin.Quaternion(a["s"][at + 3 : at + 7].copy()).matrix()
            found[d : d + 3] = (R if sign > 0.0 else R.T) @ v[d : d + 3]
        elif kind == PLANAR:
            found[d : d + 2] = in_plane(sign * a["s"][at + 2]) @ v[d : d + 2]
    return found


def inward(a: Arrays, v: Array) -> Array:
    """Return velocities whose linear parts are along the joint's own axes."""
    return outward(a, v, -1.0)
