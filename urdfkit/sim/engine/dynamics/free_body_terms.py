"""Mass matrix and bias forces of a single free body, written out: what `mass_matrix` computes for any tree.

The dofs of a free body are along its own axes, so that M does not depend on its pose, and is factored only when the
mass, its centre or the tensor changes.
"""

from urdfkit.sim.engine.compilation import inlined
from urdfkit.sim.engine.kernel_world import KernelWorld
from urdfkit.sim.engine.math.spatial_algebra import (
    add,
    cross,
    dot,
    load_rotation,
    load_tensor,
    load_vector,
    rotate,
    scale,
    store_spatial,
    sub,
    tensor_times,
)


@inlined
def free_body_terms(w: KernelWorld, i: int) -> None:
    """Compute M, bias and the twist of a free body that has been placed."""
    R, d = load_rotation(w.R, i), w.first_v[i]
    linear, angular = (w.v[d], w.v[d + 1], w.v[d + 2]), (w.v[d + 3], w.v[d + 4], w.v[d + 5])
    turning = rotate(R, angular)
    store_spatial(w.twist, i, (add(rotate(R, linear), cross(load_vector(w.r, i), turning)), turning))
    m, c, T = w.mass[i], load_vector(w.centre, i), load_tensor(w.tensor, i)
    h, square = scale(m, c), m * dot(c, c)
    # About the origin of the body.
    T = (
        T[0] + square - h[0] * c[0],
        T[1] - h[0] * c[1],
        T[2] - h[0] * c[2],
        T[3] + square - h[1] * c[1],
        T[4] - h[1] * c[2],
        T[5] + square - h[2] * c[2],
    )
    g = load_vector(w.gravity, 0)
    down = (
        R[0] * g[0] + R[3] * g[1] + R[6] * g[2],
        R[1] * g[0] + R[4] * g[1] + R[7] * g[2],
        R[2] * g[0] + R[5] * g[1] + R[8] * g[2],
    )
    w.bias[d], w.bias[d + 1], w.bias[d + 2] = sub(cross(angular, cross(angular, h)), scale(m, down))
    w.bias[d + 3], w.bias[d + 4], w.bias[d + 5] = sub(cross(angular, tensor_times(T, angular)), cross(h, down))
    x, y, z = w.dof_row[d] + d, w.dof_row[d + 1] + d, w.dof_row[d + 2] + d
    w.M[x], w.M[y], w.M[y + 1], w.M[z], w.M[z + 1], w.M[z + 2] = m, 0.0, m, 0.0, 0.0, m
    x, y, z = w.dof_row[d + 3] + d, w.dof_row[d + 4] + d, w.dof_row[d + 5] + d
    w.M[x], w.M[x + 1], w.M[x + 2], w.M[x + 3] = 0.0, -h[2], h[1], T[0]
    w.M[y], w.M[y + 1], w.M[y + 2], w.M[y + 3], w.M[y + 4] = h[2], 0.0, -h[0], T[1], T[3]
    w.M[z], w.M[z + 1], w.M[z + 2] = -h[1], h[0], 0.0
    w.M[z + 3], w.M[z + 4], w.M[z + 5] = T[2], T[4], T[5]


@inlined
def has_factors(w: KernelWorld, i: int, undamped: bool) -> bool:
    """Return whether L has the factors of M alone of a free body; note that it will have them if it is `undamped`.

    For that, ``factored`` has the numbers that M is computed from.
    """
    at = 10 * i
    same = undamped and w.factored[at] == w.mass[i]
    w.factored[at] = w.mass[i] if undamped else 0.0
    for k in range(3):
        same = same and w.factored[at + 1 + k] == w.centre[3 * i + k]
        w.factored[at + 1 + k] = w.centre[3 * i + k]
    for k in range(6):
        same = same and w.factored[at + 4 + k] == w.tensor[6 * i + k]
        w.factored[at + 4 + k] = w.tensor[6 * i + k]
    return bool(same)
