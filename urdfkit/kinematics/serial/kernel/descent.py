"""Levenberg-Marquardt within joint limits, from one configuration to the nearest minimum of the pose error."""

from urdfkit.kinematics.serial.kernel.chain_forward import AXIS, Chain, geometric_jacobian, place, rotation_vector
from urdfkit.kinematics.serial.kernel.compilation import Floats, compiled, inlined, shifted, stack
from urdfkit.kinematics.serial.kernel.damped_step import damped_step

LIMIT = 6
"""Numbers of a variable: lower and upper limit, lower and upper end of random samples, whether these are relative to
the seed, and whether whole turns change nothing."""
DAMPING = 0.1
"""Initial ratio of the damping λ to the cost."""
LEAST_DAMPING = 1e-12
POLISH = 8
"""Maximum number of further iterations within the tolerance, each of which reduces the cost to less than a quarter."""


@inlined
def pose_error(goal: Floats, pose: Floats, linear: float, angular: float, error: Floats) -> tuple[float, float]:
    """Compute the weighted error of a pose; return the squares of its distance [m²] and angle [rad²].

    Args:
        goal: rotation (9, by rows) and translation (3) of the target.
        pose: those of the tip.
        linear: weight of the distance [1/m].
        angular: weight of the angle [1/rad].
        error: written: six numbers.
    """
    turn = stack(3)
    rotation_vector(goal, pose, turn)
    distance2 = 0.0
    angle2 = 0.0
    for k in range(3):
        along = goal[9 + k] - pose[9 + k]
        distance2 += along * along
        angle2 += turn[k] * turn[k]
        error[k] = linear * along
        error[3 + k] = angular * turn[k]
    return distance2, angle2


@compiled
def descend(
    chain: Chain,
    limits: Floats,
    goal: Floats,
    q: Floats,
    work: Floats,
    linear: float,
    angular: float,
    distance: float,
    angle: float,
    iterations: int,
    patience: int,
    fall: float,
) -> tuple[float, float, float]:
    """Move a configuration to a minimum of the error; return squares of distance and angle, and the weighted cost.

    Args:
        chain: see `chain_forward.Chain`.
        limits: `LIMIT` numbers per variable.
        goal: see `pose_error`.
        q: the configuration, changed in place.
        work: memory for ``AXIS * count + 8 * size`` numbers.
        linear: see `pose_error`.
        angular: see `pose_error`.
        distance: tolerance [m].
        angle: tolerance [rad].
        iterations: maximum number.
        patience: number of iterations in which the cost must fall by the factor `fall`.
        fall: see `patience`.
    """
    _, _, count, size = chain
    axes = work
    jacobian = shifted(work, AXIS * count)
    step = shifted(jacobian, 6 * size)
    trial = shifted(step, size)
    pose = stack(12)
    error = stack(6)
    next_error = stack(6)
    place(chain, q, pose, axes)
    distance2, angle2 = pose_error(goal, pose, linear, angular, error)
    cost = 0.5 * (linear * linear * distance2 + angular * angular * angle2)
    marked = cost
    since = 0
    ratio = DAMPING
    growth = 2.0
    moved = True
    polished = 0
    before = cost
    for _ in range(iterations):
        if distance2 <= distance * distance and (angular == 0.0 or angle2 <= angle * angle):
            if cost < 1e-20 or polished == POLISH or (cost > 0.25 * before and polished > 0):
                break
            polished += 1
            before = cost
        elif since == patience:
            if cost > fall * marked:
                break
            marked = cost
            since = 0
        since += 1
        if moved:
            geometric_jacobian(chain, pose, axes, 1, 6, jacobian)
            for j in range(size):
                gradient = 0.0
                for k in range(3):
                    jacobian[6 * j + k] *= linear
                    jacobian[6 * j + 3 + k] *= angular
                for k in range(6):
                    gradient += jacobian[6 * j + k] * error[k]
                at_lower = q[j] <= limits[LIMIT * j] and gradient < 0.0
                if at_lower or (q[j] >= limits[LIMIT * j + 1] and gradient > 0.0):
                    for k in range(6):
                        jacobian[6 * j + k] = 0.0
        damped_step(jacobian, size, error, ratio * cost + LEAST_DAMPING, step)
        for j in range(size):
            trial[j] = min(max(q[j] + step[j], limits[LIMIT * j]), limits[LIMIT * j + 1])
        place(chain, trial, pose, axes)
        next_distance2, next_angle2 = pose_error(goal, pose, linear, angular, next_error)
        next_cost = 0.5 * (linear * linear * next_distance2 + angular * angular * next_angle2)
        if next_cost < cost:
            remaining = 0.0
            for k in range(6):
                rest = error[k]
                for j in range(size):
                    rest -= jacobian[6 * j + k] * (trial[j] - q[j])
                remaining += rest * rest
            gain = cost - next_cost
            predicted = cost - 0.5 * remaining
            for j in range(size):
                q[j] = trial[j]
            for k in range(6):
                error[k] = next_error[k]
            distance2 = next_distance2
            angle2 = next_angle2
            cost = next_cost
            moved = True
            growth = 2.0
            if gain > 0.75 * predicted:
                ratio = max(0.3 * ratio, 1e-6)
            elif gain < 0.25 * predicted:
                ratio *= 2.0
        else:
            moved = False
            if polished > 0:
                break
            ratio = growth * max(ratio, 1e-3)
            growth *= 2.0
    return distance2, angle2, cost
