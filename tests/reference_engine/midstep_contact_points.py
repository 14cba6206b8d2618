"""Where two trees swap an impulse: `contacts.midstep_contact_points` in numpy, for the reference."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from urdfkit.sim.engine.contacts.ground_contacts import CAPSULE, CYLINDER, SPHERE, WHEEL
from urdfkit.sim.engine.simulation_memory import DT, Arrays

Array = NDArray[np.float64]


def exchange(a: Arrays, k: int, axes: list[Array]) -> Array:
    """Return what is added to the Jacobian of a contact, so that both trees have the impulse at one place; (3, nv).

    Args:
        a: the engine's arrays, its bodies placed where the step is expected to end.
        k: number of the contact.
        axes: those of each body halfway through the step.
    """
    found = np.zeros((3, len(a["v"])))
    if a["contact_other"][k] < 0:
        return found
    trees = [int(a["body_tree"][a[name][k]]) for name in ("contact_body", "contact_other")]
    if trees[0] == trees[1] or not a["tree_floats"][trees].all():
        return found
    half = 0.5 * float(a["numbers"][DT]) * wandering(a, k, trees)
    for sign, tree in zip((1.0, -1.0), trees, strict=True):
        base, d = int(a["tree_body"][tree]), int(a["tree_dof"][tree]) + 3
        found[:, d : d + 3] = sign * np.cross(axes[base].T, a["r"][base] - half).T
    return found


def wandering(a: Arrays, k: int, trees: list[int]) -> Array:
    """Return how fast the place where two shapes touch moves through the world [m/s]."""
    speeds, radii = [], []
    # All points where they touch go with the first.
    while k > 0 and all(a[name][k - 1] == a[name][k] for name in ("contact_shape", "contact_against")):
        k -= 1
    for tree, body, shape in zip(
        trees, ("contact_body", "contact_other"), ("contact_shape", "contact_against"), strict=True
    ):
        b, s = int(a[body][k]), int(a[shape][k])
        at = a["contact_point"][k] + a["P"][trees[0]] - a["P"][tree]
        radii.append(np.inf)
        if a["shape_kind"][s] in (SPHERE, CYLINDER, WHEEL, CAPSULE):
            at = a["r"][b] + a["R"][b].reshape(3, 3) @ a["shape_p"][s]
            radii[-1] = a["shape_size"][s, 0]
        speeds.append(a["twist"][b, :3] + np.cross(a["twist"][b, 3:], at))
    # Between two round shapes it moves less with the one that is curved less.
    share = [1.0 / radius if np.isfinite(radii).any() else 1.0 for radius in radii]
    return np.array((share[0] * speeds[0] + share[1] * speeds[1]) / (share[0] + share[1]))
