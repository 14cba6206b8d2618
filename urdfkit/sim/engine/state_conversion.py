"""The engine's coordinates as Pinocchio's configuration, contacts as records, and back."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from urdfkit.errors import SimulationError
from urdfkit.linear_algebra import Array, vector_norm
from urdfkit.sim.engine.contact_surface import Contact, Touching
from urdfkit.sim.engine.dynamics.mass_matrix import FREE, PLANAR
from urdfkit.sim.engine.simulation_memory import FOUND_CONTACTS, HAS_PAIRS, SLEEPING, Arrays


class CoordinateLayout:
    """Places of the engine's coordinates of a robot in Pinocchio's configuration.

    Args:
        model: the robot's ``pin.Model``.
        arrays: the engine's.
        tree: number of the robot among the engine's.
    """

    def __init__(self, model: Any, arrays: Arrays, tree: int) -> None:
        copied, angles = [], []
        for joint, at in enumerate(_starts(arrays, tree) - arrays["tree_s"][tree], 1):
            iq, nq = model.idx_qs[joint], model.nqs[joint]
            has_angle = nq in (2, 4)
            copied += [(iq + k, at + k) for k in range(nq - 2 if has_angle else nq)]
            angles += [(iq + nq - 2, at + nq - 2)] * has_angle
        self._nq = model.nq
        self._copied_q, self._copied_s = np.array(copied, dtype=np.int64).reshape(-1, 2).T
        self._cosine_q, self._angle_s = np.array(angles, dtype=np.int64).reshape(-1, 2).T

    def configuration(self, coordinates: Array) -> Array:
        """Return q for these coordinates; shape (nq,)."""
        if not len(self._angle_s):
            return np.array(coordinates)
        q = np.empty(self._nq)
        q[self._copied_q] = coordinates[self._copied_s]
        angles = coordinates[self._angle_s]
        q[self._cosine_q], q[self._cosine_q + 1] = np.cos(angles), np.sin(angles)
        return q


def set_configuration(model: Any, arrays: Arrays, q: Array, tree: int = 0) -> None:
    """Write the coordinates of a robot's configuration in Pinocchio's layout."""
    s = arrays["s"]
    for b, at in enumerate(_starts(arrays, tree)):
        iq, nq = model.idx_qs[b + 1], model.nqs[b + 1]
        if nq == 2:
            s[at] = math.atan2(q[iq + 1], q[iq])
        elif nq == 4:
            s[at : at + 3] = q[iq], q[iq + 1], math.atan2(q[iq + 3], q[iq + 2])
        else:
            s[at : at + nq] = q[iq : iq + nq]
            if nq == 7:
                norm = vector_norm(s[at + 3 : at + 7])
                if not norm > 1e-9:
                    raise SimulationError(f"q has no orientation for joint `{model.names[b + 1]}`: its quaternion is 0")
                s[at + 3 : at + 7] /= norm


def _starts(arrays: Arrays, tree: int) -> NDArray[np.int64]:
    """Return where the coordinates of each body of a tree start."""
    first, beyond = arrays["tree_body"][tree : tree + 2]
    return arrays["first_s"][first:beyond]


def positions(arrays: Arrays, tree: int = 0) -> Array:
    """Return the position of each dof of a tree, NaN for those of floating joints; shape (nv,)."""
    found = arrays["s"][arrays["dof_s"] % max(1, len(arrays["s"]))]
    for b, kind in enumerate(arrays["kind"]):
        if kind == FREE:
            found[arrays["first_v"][b] : arrays["first_v"][b + 1]] = np.nan
    first, beyond = arrays["tree_dof"][tree : tree + 2]
    return np.array(found[first:beyond])


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
    """Return the contacts of the last step and those of what sleeps, with their forces."""
    counts = arrays["counts"]
    kept = len(arrays["contact_row"]) - 1 - np.arange(int(counts[SLEEPING]))
    numbers = np.concatenate([np.arange(int(counts[FOUND_CONTACTS])), kept])
    # Contacts without a row have no force: nothing can move that point along the normal.
    numbers = numbers[arrays["contact_row"][numbers] >= 0]
    frames, impulses = arrays["contact_frame"][numbers].reshape(-1, 3, 3), arrays["contact_impulse"][numbers]
    if len(arrays["tree_floats"]) == 1 and not arrays["numbers"][HAS_PAIRS]:
        rows, rubs = arrays["contact_row"][numbers], arrays["contact_mu"][numbers] > 0.0
        impulses = np.zeros((len(numbers), 3))
        impulses[:, 2] = arrays["x"][rows]
        impulses[rubs, :2] = arrays["x"][rows[rubs, None] + np.array([1, 2])]
    trees = arrays["body_tree"][arrays["contact_body"][numbers]]
    values = (
        arrays["contact_shape"][numbers],
        arrays["contact_against"][numbers],
        arrays["contact_origin"][trees] + arrays["contact_point"][numbers],
        frames[:, 2],
        -arrays["contact_gap"][numbers],
        np.einsum("ki,kij->kj", impulses, frames) / dt,
    )
    found = []
    for shape, against, position, normal, depth, force in zip(*(each.tolist() for each in values), strict=True):
        mine, other = touches[shape], None if against < 0 else touches[against]
        found.append(
            Contact(
                mine.link,
                ground if other is None else other.link,
                tuple(position),
                tuple(normal),
                depth,
                tuple(force),
                mine.number,
                -1 if other is None else other.number,
            )
        )
    return tuple(found)
