"""The engine's coordinates as Pinocchio's configuration, contacts as records, and back."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from urdfkit.errors import SimulationError
from urdfkit.sim.engine.arrays import FOUND_CONTACTS, Arrays
from urdfkit.sim.engine.dynamics import FREE, PLANAR
from urdfkit.sim.engine.model import Touching
from urdfkit.sim.engine.surface import Contact

Array = NDArray[np.float64]


def configuration(model: Any, arrays: Arrays) -> Array:
    """Return q in Pinocchio's layout; shape (nq,)."""
    q = np.empty(model.nq)
    s = arrays["s"]
    for b, at in enumerate(arrays["first_s"]):
        iq, nq = model.idx_qs[b + 1], model.nqs[b + 1]
        if nq == 2:
            q[iq], q[iq + 1] = np.cos(s[at]), np.sin(s[at])
        elif nq == 4:
            q[iq : iq + 4] = s[at], s[at + 1], np.cos(s[at + 2]), np.sin(s[at + 2])
        else:
            q[iq : iq + nq] = s[at : at + nq]
    return q


def set_configuration(model: Any, arrays: Arrays, q: Array) -> None:
    """Write the coordinates of a configuration in Pinocchio's layout."""
    s = arrays["s"]
    for b, at in enumerate(arrays["first_s"]):
        iq, nq = model.idx_qs[b + 1], model.nqs[b + 1]
        if nq == 2:
            s[at] = np.arctan2(q[iq + 1], q[iq])
        elif nq == 4:
            s[at : at + 3] = q[iq], q[iq + 1], np.arctan2(q[iq + 3], q[iq + 2])
        else:
            s[at : at + nq] = q[iq : iq + nq]
            if nq == 7:
                norm = float(np.linalg.norm(s[at + 3 : at + 7]))
                if not norm > 1e-9:
                    raise SimulationError(f"q has no orientation for joint `{model.names[b + 1]}`: its quaternion is 0")
                s[at + 3 : at + 7] /= norm


def positions(arrays: Arrays) -> Array:
    """Return the position of each dof, NaN for those of floating joints; shape (nv,)."""
    found = arrays["s"][arrays["dof_s"] % max(1, len(arrays["s"]))]
    for b, kind in enumerate(arrays["kind"]):
        if kind == FREE:
            found[arrays["first_v"][b] : arrays["first_v"][b + 1]] = np.nan
    return np.array(found)


def turning(arrays: Arrays, v: Array) -> Array:
    """Return how fast linear velocities in their own turning axes change when they are constant in space."""
    found = np.zeros_like(v)
    for kind, d in zip(arrays["kind"], arrays["first_v"], strict=False):
        if kind == FREE:
            found[d : d + 3] = np.cross(v[d + 3 : d + 6], v[d : d + 3])
        elif kind == PLANAR:
            found[d : d + 2] = v[d + 2] * np.array([-v[d + 1], v[d]])
    return found


def contacts(arrays: Arrays, touches: Sequence[Touching], ground: str, dt: float) -> tuple[Contact, ...]:
    """Return the contacts of the last step, with their forces."""
    found = []
    for k in range(int(arrays["counts"][FOUND_CONTACTS])):
        frame = arrays["contact_frame"][k].reshape(3, 3)
        at = int(arrays["contact_row"][k])
        if at < 0:  # nothing can move that point along the normal: no force would change anything
            continue
        impulse = arrays["x"][at] * frame[2]
        if arrays["mu"][at] > 0.0:
            impulse = impulse + arrays["x"][at + 1] * frame[0] + arrays["x"][at + 2] * frame[1]
        found.append(
            Contact(
                touches[shape_of_feature(arrays, int(arrays["contact_feature"][k]))].link,
                ground,
                _vector(arrays["contact_origin"] + arrays["contact_point"][k]),
                _vector(frame[2]),
                -float(arrays["contact_gap"][k]),
                _vector(impulse / dt),
            )
        )
    return tuple(found)


def _vector(values: Array) -> tuple[float, float, float]:
    x, y, z = values.tolist()
    return (x, y, z)


def shape_of_feature(arrays: Arrays, feature: int) -> int:
    """Return the number of the shape that has a feature."""
    return int(np.searchsorted(arrays["shape_feature"], feature, side="right")) - 1
