"""Search for the closest approach of two links: descent of their distance over the joints between them.

The distance has many local minima, and edges on which descents end early. Further descents start near the best
configurations: basin hopping (Wales and Doye, J. Phys. Chem. A 101, 1997).
"""

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
NEAR = 0.05
"""Closest approach so far from which descents start near the best configurations [m]."""
BEST = 4
"""Configurations from which these descents start, in turns."""
HOPS = 120
"""Number of these descents."""
HOP = (0.1, 0.3)
"""Standard deviations of the changes of a joint before a descent, in turns [rad] or [m]."""


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
    if chain is None:
        return Approach(np.inf, {})
    lower, upper = bounds
    found: list[tuple[float, Array]] = []
    for start in starts:
        found.append(_approach(chain, check, np.array([start.get(name, 0.0) for name in chain.joint_names]), bounds))
        if found[-1][0] <= 0.0:
            return _named(chain, *found[-1])
    if min(distance for distance, _ in found) < FAR:
        for _ in range(MORE):
            drawn = random.uniform(lower, upper, (DRAWN, len(lower)))
            distances = [check.distance(pose[:3, :3], pose[:3, 3])[0] for pose in chain.forward(drawn)]
            found.append(_approach(chain, check, drawn[np.argmin(distances)], bounds))
            if found[-1][0] <= 0.0:
                return _named(chain, *found[-1])
    best = sorted(found, key=lambda one: one[0])[:BEST]
    for k in range(HOPS if best[0][0] < NEAR else 0):
        near = best[k % len(best)][1] + HOP[k // len(best) % len(HOP)] * random.normal(size=len(lower))
        best[k % len(best)] = min(best[k % len(best)], _approach(chain, check, near, bounds), key=lambda one: one[0])
        if best[k % len(best)][0] <= 0.0:
            break
    return _named(chain, *min(best, key=lambda one: one[0]))


def _named(chain: Chain, distance: float, q: Array) -> Approach:
    return Approach(max(0.0, distance), dict(zip(chain.joint_names, q.tolist(), strict=True)))


def _approach(chain: Chain, check: PairCheck, q: Array, bounds: tuple[Array, Array]) -> tuple[float, Array]:
    """Return the closest approach from one start: of the convex shapes, then of the triangles."""
    lower, upper = bounds
    q = np.clip(q, lower, upper)
    distance = np.inf
    for convex in (True, False):
        distance, q = _descend(chain, check, q, lower, upper, convex)
        if distance > 0.0 or check.collides(*_placement(chain, q)):
            break
    return distance, q


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
        slope = np.array([*direction, *_cross(point - pose[:3, 3], direction)]) @ jacobian
        free = ~(((q <= lower) & (slope > 0.0)) | ((q >= upper) & (slope < 0.0)))
        slope = np.where(free, slope, 0.0)
        square = float(slope @ slope)
        if square < 1e-12:
            break
        step = -slope * (distance + DEPTH) / square
        step *= min(1.0, LONGEST / float(np.max(np.abs(step))))
        tried = np.minimum(np.maximum(q + part * step, lower), upper)
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


def _cross(a: Array, b: Array) -> tuple[float, float, float]:
    """Return the cross product of two vectors; ``np.cross`` takes longer than a whole distance by coal."""
    (x, y, z), (u, v, w) = a.tolist(), b.tolist()
    return y * w - z * v, z * u - x * w, x * v - y * u


def chain_between(robot: object, first: str, second: str) -> Chain | None:
    """Return the chain between two links; None if no joint moves them relative to each other."""
    try:
        return Chain(robot, first, second)  # type: ignore[arg-type]
    except KinematicsError:
        return None
