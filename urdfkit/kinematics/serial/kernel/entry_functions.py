"""The functions of the kernel that Python calls, on blocks of memory."""

from urdfkit.kinematics.serial.kernel.chain_forward import AXIS, geometric_jacobian, place
from urdfkit.kinematics.serial.kernel.compilation import Floats, Integers, inlined, shifted, stack
from urdfkit.kinematics.serial.kernel.damped_step import volume
from urdfkit.kinematics.serial.kernel.search import ROW, search

POSE, MATRIX = 7, 16
"""Numbers of a target: x y z and a quaternion x y z w, or a homogeneous matrix by rows."""
FARTHEST = 1e6
"""Length [m] of the numbers of a target from which it is no pose: squares of far larger ones overflow."""


def forward(
    steps: Floats,
    variables: Integers,
    count: int,
    size: int,
    q: Floats,
    number: int,
    poses: Floats,
    jacobians: Floats,
    wanted: int,
    work: Floats,
) -> int:
    """Compute the poses of the tip, and the Jacobians where wanted.

    Args:
        steps: see `chain_forward.Chain`.
        variables: see `chain_forward.Chain`.
        count: number of steps.
        size: number of variables.
        q: configurations, by rows.
        number: number of configurations.
        poses: written: homogeneous matrices by rows.
        jacobians: written: 6 × size matrices by rows, in the axes of the base, linear rows first.
        wanted: 1: poses; 2: Jacobians; 3: both; 4: √det(J·Jᵀ) into `poses`, of the linear rows with 8.
        work: memory for ``AXIS * count + 6 * size`` numbers.
    """
    chain = (steps, variables, count, size)
    pose = stack(12)
    jacobian = shifted(work, AXIS * count)
    for i in range(number):
        place(chain, shifted(q, size * i), pose, work)
        if wanted & 1:
            matrix = shifted(poses, 16 * i)
            for r in range(3):
                for c in range(3):
                    matrix[4 * r + c] = pose[3 * r + c]
                matrix[4 * r + 3] = pose[9 + r]
                matrix[12 + r] = 0.0
            matrix[15] = 1.0
        if wanted & 2:
            rows = shifted(jacobians, 6 * size * i)
            geometric_jacobian(chain, pose, work, size, 1, rows)
        elif wanted & 4:
            geometric_jacobian(chain, pose, work, 1, 6, jacobian)
            poses[i] = volume(jacobian, size, 3 if wanted & 8 else 6)
    return 0


@inlined
def read_target(target: Floats, width: int, goal: Floats) -> bool:
    """Read a target as rotation by rows and translation; return whether its numbers are a pose.

    Args:
        target: its numbers.
        width: `POSE` or `MATRIX`.
        goal: written: twelve numbers.
    """
    total = 0.0
    for k in range(width):
        total += target[k] * target[k]
    if not total < FARTHEST * FARTHEST:  # nor is a sum with a number that is not finite
        return False
    if width == MATRIX:
        for r in range(3):
            for c in range(3):
                goal[3 * r + c] = target[4 * r + c]
            goal[9 + r] = target[4 * r + 3]
        skew = 0.0
        for r in range(3):
            for c in range(3):
                total = -1.0 if r == c else 0.0
                for k in range(3):
                    total += goal[3 * r + k] * goal[3 * c + k]
                skew = max(skew, abs(total))
        return (
            skew < 1e-6
            and goal[0] * (goal[4] * goal[8] - goal[5] * goal[7])
            + goal[1] * (goal[5] * goal[6] - goal[3] * goal[8])
            + goal[2] * (goal[3] * goal[7] - goal[4] * goal[6])
            > 0.0
        )
    x = target[3]
    y = target[4]
    z = target[5]
    w = target[6]
    length2 = x * x + y * y + z * z + w * w
    if length2 < 1e-18:
        return False
    s = 2.0 / length2
    goal[0] = 1.0 - s * (y * y + z * z)
    goal[1] = s * (x * y - z * w)
    goal[2] = s * (x * z + y * w)
    goal[3] = s * (x * y + z * w)
    goal[4] = 1.0 - s * (x * x + z * z)
    goal[5] = s * (y * z - x * w)
    goal[6] = s * (x * z - y * w)
    goal[7] = s * (y * z + x * w)
    goal[8] = 1.0 - s * (x * x + y * y)
    for k in range(3):
        goal[9 + k] = target[k]
    return True


def solve(
    steps: Floats,
    variables: Integers,
    count: int,
    size: int,
    limits: Floats,
    targets: Floats,
    bits: Integers,
    width: int,
    seeds: Floats,
    stride: int,
    options: Floats,
    first: int,
    last: int,
    solutions: Floats,
    work: Floats,
) -> int:
    """Solve targets `first` to `last`; return 0, or the number of the first target that is no pose, counted from 1.

    Args:
        steps: see `chain_forward.Chain`.
        variables: see `chain_forward.Chain`.
        count: number of steps.
        size: number of variables.
        limits: see `descent.LIMIT`.
        targets: `width` numbers per target.
        bits: the same memory, as integers.
        width: `POSE` or `MATRIX`.
        seeds: configurations.
        stride: numbers from one target's seed to the next; 0 for one seed for all.
        options: see `search.search`.
        first: first target.
        last: target after the last one.
        solutions: written: see `search.search`.
        work: memory for ``AXIS * count + 10 * size`` numbers.
    """
    chain = (steps, variables, count, size)
    goal = stack(12)
    block = (size + ROW) * int(options[6])
    for i in range(first, last):
        if not read_target(shifted(targets, width * i), width, goal):
            return i + 1
        search(
            *(chain, limits, goal, bits, width * i, width, shifted(seeds, stride * i)),
            *(options, shifted(solutions, block * i), work),
        )
    return 0
