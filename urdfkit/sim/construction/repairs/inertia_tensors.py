"""Replacement of impossible inertia tensors by the nearest possible ones.

A tensor I belongs to the matrix of second moments of the density S = tr(I)/2·1 − I. A distribution of mass exists if
and only if S is positive semidefinite. The nearest such matrix, by the Frobenius norm, has the same eigenvectors and
the negative eigenvalues replaced by zero (Higham, Computing a nearest symmetric positive semidefinite matrix, 1988).
"""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from urdfkit.defect_message import with_effect
from urdfkit.description.urdf.attached_bodies import AttachedBodies
from urdfkit.description.urdf.repair_record import Repair, RepairKind
from urdfkit.description.urdf.robot import Inertia, Link
from urdfkit.description.xacro.evaluation.failures import chain_words
from urdfkit.description.xml.element import Element
from urdfkit.linear_algebra import matmul, symmetric_eigen, vector_norm
from urdfkit.sim.construction.validation import impossible

Array = NDArray[np.float64]

ROUNDING = 1e-9
"""Largest violation that is not repaired, relative to the largest moment: that of the computed moments (I503)."""

ZERO = 1e-9
"""Smallest principal moment that is not a zero, relative to the largest moment (I502)."""

SLIP = 1e-4
"""Largest violation that is a note, relative to the largest moment."""


def nearest_tensor(tensor: Array) -> Array:
    """Return the tensor of a distribution of mass whose second moments differ least from those of a tensor."""
    values, axes = symmetric_eigen(np.trace(tensor) / 2.0 * np.eye(3) - tensor)
    second = matmul(axes * np.maximum(values, 0.0), axes.T)
    nearest = np.trace(second) * np.eye(3) - second
    return np.asarray((nearest + nearest.T) / 2.0)


def possible(link: Link, bodies: AttachedBodies) -> tuple[Link, Repair | None]:
    """Return a link with a possible inertia tensor, and the repair if its tensor was changed.

    Args:
        link: the link.
        bodies: the bodies of its robot.
    """
    inertial = link.inertial
    if inertial is None or inertial.inertia is None or (inertial.mass or 0.0) < 0.0:
        return link, None
    written = np.array(inertial.inertia.rows)
    a, b, c = symmetric_eigen(written)[0].tolist()
    excess = (c - a - b) / max(abs(a), abs(c), 1e-300)
    if excess <= ROUNDING:
        return link, None
    nearest = nearest_tensor(written)
    change = vector_norm((nearest - written).ravel()) / vector_norm(written.ravel())
    moments = ", ".join(f"{moment:.6g}" for moment in symmetric_eigen(nearest)[0].tolist())
    message = with_effect(
        f"the inertia of link `{link.name}` is impossible: {impossible(inertial.inertia.rows, ROUNDING)}",
        f"simulated with {moments} kg·m² (changed by {100.0 * change:.3g} %)",
    )
    code = "I502" if a <= ZERO * c else "I503"
    is_note = (code == "I503" and excess < SLIP) or bodies.is_negligible(link)
    repair = repair_at(inertial.inertia.element, "inertia", code, message, link=link.name, is_note=is_note)
    repaired = replace(inertial, inertia=inertia_of(nearest, inertial.inertia.element))
    return replace(link, inertial=repaired), repair


def inertia_of(tensor: Array, element: Element) -> Inertia:
    """Return a tensor as a part of a description."""
    ixx, ixy, ixz, iyy, iyz, izz = tensor[np.triu_indices(3)].tolist()
    return Inertia(ixx, ixy, ixz, iyy, iyz, izz, element)


def repair_at(
    element: Element,
    kind: RepairKind,
    code: str,
    message: str,
    *,
    link: str | None = None,
    joint: str | None = None,
    is_note: bool = False,
) -> Repair:
    """Return a repair at the position of an element; the message gets the macro calls that lead to it."""
    origin = element.origin
    message += chain_words(origin.expansions)
    return Repair(kind, code, message, origin.position, link, joint, "note" if is_note else "warning")
