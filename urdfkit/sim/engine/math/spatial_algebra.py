"""Spatial algebra on tuples, for the compiled kernel.

A vector is three floats, a rotation nine (row by row), a symmetric tensor six (xx, xy, xz, yy, yz, zz). A motion or
force vector is a pair of vectors, linear part first; motions are twists, forces are wrenches (force, then moment). All
are of one point, which the caller chooses. Names and formulas: R. Featherstone, Rigid Body Dynamics Algorithms, 2008,
chapter 2; the order of the two parts is Pinocchio's.
"""

from typing import Any

from urdfkit.sim.engine.compilation import inlined
from urdfkit.sim.engine.math.elementary_functions import sine_cosine

Vector = tuple[float, float, float]
Spatial = tuple[Vector, Vector]
ZERO: Vector = (0.0, 0.0, 0.0)
IDENTITY = (1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)
SMALL = 2.5e-3
"""Square of an angle [rad²] below which these series, of sin(x)/x and cos(x), are exact to rounding."""
SINE = (-1.0 / 6.0, 1.0 / 120.0, -1.0 / 5040.0, 1.0 / 362880.0)
COSINE = (-0.5, 1.0 / 24.0, -1.0 / 720.0, 1.0 / 40320.0)


@inlined
def add(a: Vector, b: Vector) -> Vector:
    """Return a + b."""
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


@inlined
def sub(a: Vector, b: Vector) -> Vector:
    """Return a - b."""
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


@inlined
def scale(s: float, a: Vector) -> Vector:
    """Return s·a."""
    return (s * a[0], s * a[1], s * a[2])


@inlined
def dot(a: Vector, b: Vector) -> float:
    """Return a · b."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@inlined
def cross(a: Vector, b: Vector) -> Vector:
    """Return a × b."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


@inlined
def rotate(R: Any, a: Vector) -> Vector:
    """Return R·a."""
    return (
        R[0] * a[0] + R[1] * a[1] + R[2] * a[2],
        R[3] * a[0] + R[4] * a[1] + R[5] * a[2],
        R[6] * a[0] + R[7] * a[1] + R[8] * a[2],
    )


@inlined
def compose(A: Any, B: Any) -> Any:
    """Return A·B."""
    return (
        A[0] * B[0] + A[1] * B[3] + A[2] * B[6],
        A[0] * B[1] + A[1] * B[4] + A[2] * B[7],
        A[0] * B[2] + A[1] * B[5] + A[2] * B[8],
        A[3] * B[0] + A[4] * B[3] + A[5] * B[6],
        A[3] * B[1] + A[4] * B[4] + A[5] * B[7],
        A[3] * B[2] + A[4] * B[5] + A[5] * B[8],
        A[6] * B[0] + A[7] * B[3] + A[8] * B[6],
        A[6] * B[1] + A[7] * B[4] + A[8] * B[7],
        A[6] * B[2] + A[7] * B[5] + A[8] * B[8],
    )


@inlined
def tensor_times(T: Any, a: Vector) -> Vector:
    """Return T·a of a symmetric tensor."""
    return (
        T[0] * a[0] + T[1] * a[1] + T[2] * a[2],
        T[1] * a[0] + T[3] * a[1] + T[4] * a[2],
        T[2] * a[0] + T[4] * a[1] + T[5] * a[2],
    )


@inlined
def tensor_inverse(T: Any) -> Any:
    """Return the inverse of a symmetric tensor."""
    x, y, z = T[3] * T[5] - T[4] * T[4], T[2] * T[4] - T[1] * T[5], T[1] * T[4] - T[2] * T[3]
    c = 1.0 / (T[0] * x + T[1] * y + T[2] * z)
    middle = c * (T[0] * T[5] - T[2] * T[2])
    return (c * x, c * y, c * z, middle, c * (T[1] * T[2] - T[0] * T[4]), c * (T[0] * T[3] - T[1] * T[1]))


@inlined
def tensor_turned(R: Any, T: Any) -> Any:
    """Return R·T·Rᵀ of a symmetric tensor."""
    x = tensor_times(T, (R[0], R[1], R[2]))
    y = tensor_times(T, (R[3], R[4], R[5]))
    z = tensor_times(T, (R[6], R[7], R[8]))
    return (
        R[0] * x[0] + R[1] * x[1] + R[2] * x[2],
        R[3] * x[0] + R[4] * x[1] + R[5] * x[2],
        R[6] * x[0] + R[7] * x[1] + R[8] * x[2],
        R[3] * y[0] + R[4] * y[1] + R[5] * y[2],
        R[6] * y[0] + R[7] * y[1] + R[8] * y[2],
        R[6] * z[0] + R[7] * z[1] + R[8] * z[2],
    )


@inlined
def little_turn(square: float) -> tuple[float, float]:
    """Return sin(x)/x and cos(x) of a small angle, of its square."""
    return (
        1.0 + square * (SINE[0] + square * (SINE[1] + square * (SINE[2] + square * SINE[3]))),
        1.0 + square * (COSINE[0] + square * (COSINE[1] + square * (COSINE[2] + square * COSINE[3]))),
    )


@inlined
def turned_further(sine: float, cosine: float, angle: float) -> tuple[float, float]:
    """Return sine and cosine of an angle that is larger by `angle`, most often a small one."""
    if angle * angle < SMALL:
        share, c = little_turn(angle * angle)
        s = share * angle
    else:
        s, c = sine_cosine(angle)
    return sine * c + cosine * s, cosine * c - sine * s


@inlined
def turn_about(axis: Vector, s: float, c: float) -> Any:
    """Return the rotation about a unit axis by an angle of this sine and cosine (Rodrigues)."""
    x, y, z = axis
    k = 1.0 - c
    return (
        c + k * x * x,
        k * x * y - s * z,
        k * x * z + s * y,
        k * x * y + s * z,
        c + k * y * y,
        k * y * z - s * x,
        k * x * z - s * y,
        k * y * z + s * x,
        c + k * z * z,
    )


@inlined
def turn_of(x: float, y: float, z: float, w: float) -> Any:
    """Return the rotation of a unit quaternion."""
    return (
        1.0 - 2.0 * (y * y + z * z),
        2.0 * (x * y - z * w),
        2.0 * (x * z + y * w),
        2.0 * (x * y + z * w),
        1.0 - 2.0 * (x * x + z * z),
        2.0 * (y * z - x * w),
        2.0 * (x * z - y * w),
        2.0 * (y * z + x * w),
        1.0 - 2.0 * (x * x + y * y),
    )


@inlined
def motion_cross(v: Spatial, m: Spatial) -> Spatial:
    """Return v × m: how a motion fixed in a body that moves with v changes."""
    return (add(cross(v[1], m[0]), cross(v[0], m[1])), cross(v[1], m[1]))


@inlined
def force_cross(v: Spatial, f: Spatial) -> Spatial:
    """Return v ×* f: how a force fixed in a body that moves with v changes."""
    return (cross(v[1], f[0]), add(cross(v[1], f[1]), cross(v[0], f[0])))


@inlined
def spatial_add(a: Spatial, b: Spatial) -> Spatial:
    """Return a + b of motions or forces."""
    return (add(a[0], b[0]), add(a[1], b[1]))


@inlined
def spatial_dot(m: Spatial, f: Spatial) -> float:
    """Return the power of force f on motion m."""
    return dot(m[0], f[0]) + dot(m[1], f[1])


@inlined
def momentum(mass: float, h: Vector, T: Any, v: Spatial) -> Spatial:
    """Return I·v of a body with first moment h = mass · centre and tensor T, all of the same point."""
    return (add(scale(mass, v[0]), cross(v[1], h)), add(tensor_times(T, v[1]), cross(h, v[0])))


@inlined
def load_vector(a: Any, k: int) -> Vector:
    """Return the k-th vector of a flat array."""
    return (a[3 * k], a[3 * k + 1], a[3 * k + 2])


@inlined
def store_vector(a: Any, k: int, x: Vector) -> None:
    """Write the k-th vector of a flat array."""
    a[3 * k], a[3 * k + 1], a[3 * k + 2] = x


@inlined
def load_spatial(a: Any, k: int) -> Spatial:
    """Return the k-th motion or force of a flat array."""
    return (
        (a[6 * k], a[6 * k + 1], a[6 * k + 2]),
        (a[6 * k + 3], a[6 * k + 4], a[6 * k + 5]),
    )


@inlined
def store_spatial(a: Any, k: int, x: Spatial) -> None:
    """Write the k-th motion or force of a flat array."""
    a[6 * k], a[6 * k + 1], a[6 * k + 2] = x[0]
    a[6 * k + 3], a[6 * k + 4], a[6 * k + 5] = x[1]


@inlined
def load_tensor(a: Any, k: int) -> Any:
    """Return the k-th symmetric tensor of a flat array."""
    return (a[6 * k], a[6 * k + 1], a[6 * k + 2], a[6 * k + 3], a[6 * k + 4], a[6 * k + 5])


@inlined
def store_tensor(a: Any, k: int, x: Any) -> None:
    """Write the k-th symmetric tensor of a flat array."""
    a[6 * k], a[6 * k + 1], a[6 * k + 2], a[6 * k + 3], a[6 * k + 4], a[6 * k + 5] = x


@inlined
def load_rotation(a: Any, k: int) -> Any:
    """Return the k-th rotation of a flat array."""
    j = 9 * k
    return (a[j], a[j + 1], a[j + 2], a[j + 3], a[j + 4], a[j + 5], a[j + 6], a[j + 7], a[j + 8])


@inlined
def store_rotation(a: Any, k: int, R: Any) -> None:
    """Write the k-th rotation of a flat array."""
    j = 9 * k
    a[j], a[j + 1], a[j + 2], a[j + 3], a[j + 4], a[j + 5], a[j + 6], a[j + 7], a[j + 8] = R
