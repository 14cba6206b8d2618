"""Search for the closest approach of two links: descent of their distance over the joints between them."""

from typing import NamedTuple

import numpy as np

from urdfkit.errors import KinematicsError
from urdfkit.kinematics.chain import Chain
from urdfkit.kinematics.self_collision.pair_check import PairCheck
from urdfkit.linear_algebra import Array

STEPS = 40
"""Steps of one descent at most."""
DEPTH = 2e-3
"""How far beyond contact a step aims [m]."""
LONGEST = 0.4
"""Largest change of a joint in one step [rad] or [m]."""
LEAST = 1e-5
"""Decrease of the distance below which a descent ends [m]."""
FAR = 0.2
"""Closest approach of the first starts above which no more are tried [m]."""
MORE = 40
"""Further starts, each the nearest of `DRAWN` random configurations."""
DRAWN = 24


class Approach(NamedTuple):
    """The closest approach that was found.

    Attributes:
        distance: [m]; 0 if the links collide.
        positions: joint between the links → position [rad] or [m].
    """

    distance: float
    positions: dict[str, float]


def closest_approach(
    chain: Chain | None,
    check: PairCheck,
    starts: list[dict[str, float]],
    bounds: tuple[Array, Array],
    random: np.random.Generator,
) -> Approach:
    """Return the closest approach, from several starts, and from random ones if it is near.

    Args:
        chain: from the first to the second link; None if no joint moves them relative to each other.
        check: their shapes.
        starts: joint → position [rad] or [m].
        bounds: lower and upper limits of the joints of the chain [rad] or [m]; shape (n,) each.
        random: for further starts.
    """
    best = Approach(np.inf, {})
    if chain is None:
        return best
    lower, upper = bounds
    for start in starts:
        q = np.array([start.get(name, 0.0) for name in chain.joint_names])
        best = min(best, _approach(chain, check, q, lower, upper), key=lambda one: one.distance)
        if best.distance <= 0.0:
            return best
    for _ in range(MORE if best.distance < FAR else 0):
        drawn = random.uniform(lower, upper, (DRAWN, len(lower)))
        poses = chain.forward(drawn)
        distances = [check.distance(pose[:3, :3], pose[:3, 3])[0] for pose in poses]
        best = min(
            best, _approach(chain, check, drawn[np.argmin(distances)], lower, upper), key=lambda one: one.distance
        )
        if best.distance <= 0.0:
            break
    return best


def _approach(chain: Chain, check: PairCheck, q: Array, lower: Array, upper: Array) -> Approach:
    """Return the closest approach from one start: of the convex shapes, then of the triangles."""
    q = np.clip(q, lower, upper)
    distance = np.inf
    for convex in (True, False):
        distance, q = _descend(chain, check, q, lower, upper, convex)
        if distance > 0.0 or check.collides(*_placement(chain, q)):
            break
    return Approach(max(0.0, distance), dict(zip(chain.joint_names, q.tolist(), strict=True)))


def _placement(chain: Chain, q: Array) -> tuple[Array, Array]:
    pose = chain.forward(q)
    return pose[:3, :3], pose[:3, 3]


def _descend(chain: Chain, check: PairCheck, q: Array, lower: Array, upper: Array, convex: bool) -> tuple[float, Array]:
    """Return distance and configuration at a local minimum, or where the links collide."""
    pose, jacobian = chain.forward_and_jacobian(q)
    distance, direction, point = check.distance(pose[:3, :3], pose[:3, 3], convex=convex)
    part = 1.0
    for _ in range(STEPS):
        if distance <= 0.0:
            break
        # The point moves with the second link; the distance changes by its velocity along the direction.
        slope = direction @ jacobian[:3] + np.cross(point - pose[:3, 3], direction) @ jacobian[3:]
        free = ~(((q <= lower) & (slope > 0.0)) | ((q >= upper) & (slope < 0.0)))
        slope = np.where(free, slope, 0.0)
        square = float(slope @ slope)
        if square < 1e-12:
            break
        step = -slope * (distance + DEPTH) / square
        step *= min(1.0, LONGEST / float(np.max(np.abs(step))))
        tried = np.clip(q + part * step, lower, upper)
        there, turned = chain.forward_and_jacobian(tried)
        found = check.distance(there[:3, :3], there[:3, 3], convex=convex)
        if found[0] < distance - LEAST:
            q, pose, jacobian = tried, there, turned
            distance, direction, point = found
            part = min(1.0, 2.0 * part)
        elif part < 0.1:
            break
        else:
            part /= 4.0
    return distance, q


def chain_between(robot: object, first: str, second: str) -> Chain | None:
    """Return the chain between two links; None if no joint moves them relative to each other."""
    try:
        return Chain(robot, first, second)  # type: ignore[arg-type]
    except KinematicsError:
        return None
