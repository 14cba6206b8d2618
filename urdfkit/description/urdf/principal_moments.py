"""Principal moments of an inertia tensor, in plain Python."""

from collections.abc import Iterator, Sequence
from math import isfinite, sqrt

from urdfkit.description.urdf.robot import Link
from urdfkit.description.xml.element import Element
from urdfkit.description.xml.numbers import number

_COMPONENTS = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")


def principal_moments(link: Link) -> Iterator[tuple[tuple[float, float, float], Element]]:
    """Yield the principal moments [kg·m²] of each ``<inertia>`` of a link, smallest first, and the element.

    URDF parsers differ in which of several ``<inertia>`` elements they use, so each is checked; unreadable elements are
    skipped.
    """
    if link.inertial is None:
        return
    for element in link.inertial.element.find_all("inertia"):
        values = [number(element.attributes.get(name, "")) for name in _COMPONENTS]
        finite = [value for value in values if value is not None and isfinite(value)]
        if len(finite) == len(_COMPONENTS):
            xx, xy, xz, yy, yz, zz = finite
            yield eigenvalues(xx, xy, xz, yy, yz, zz), element


def eigenvalues(xx: float, xy: float, xz: float, yy: float, yz: float, zz: float) -> tuple[float, float, float]:
    """Return the eigenvalues of a symmetric 3 × 3 matrix, smallest first.

    The error relative to the largest entry is about 1e-15: Jacobi rotations on the matrix scaled to 1 (Golub and Van
    Loan, Matrix Computations, 8.5).

    Args:
        xx: an entry; all entries must be finite.
        xy: an entry.
        xz: an entry.
        yy: an entry.
        yz: an entry.
        zz: an entry.
    """
    if xy == xz == yz == 0.0:
        first, second, third = sorted((xx, yy, zz))
        return first, second, third
    scale = max(abs(xx), abs(xy), abs(xz), abs(yy), abs(yz), abs(zz))
    if scale == 0.0:
        return 0.0, 0.0, 0.0
    a = [
        [xx / scale, xy / scale, xz / scale],
        [xy / scale, yy / scale, yz / scale],
        [xz / scale, yz / scale, zz / scale],
    ]
    for _ in range(20):
        if a[0][1] ** 2 + a[0][2] ** 2 + a[1][2] ** 2 < 1e-36:
            break
        for p, q in ((0, 1), (0, 2), (1, 2)):
            _rotate(a, p, q)
    first, second, third = sorted((a[0][0] * scale, a[1][1] * scale, a[2][2] * scale))
    return first, second, third


def _rotate(a: list[list[float]], p: int, q: int) -> None:
    """Zero the entry p, q by one Jacobi rotation."""
    if a[p][q] == 0.0:
        return
    tau = (a[q][q] - a[p][p]) / (2.0 * a[p][q])
    t = (1.0 if tau >= 0 else -1.0) / (abs(tau) + sqrt(1.0 + tau * tau))
    c = 1.0 / sqrt(1.0 + t * t)
    s = t * c
    r = 3 - p - q
    a[p][p], a[q][q] = a[p][p] - t * a[p][q], a[q][q] + t * a[p][q]
    a[p][q] = a[q][p] = 0.0
    rp, rq = a[r][p], a[r][q]
    a[r][p] = a[p][r] = c * rp - s * rq
    a[r][q] = a[q][r] = s * rp + c * rq


_ORDERS = {
    "by columns (ixx, ixy, iyy, ixz, iyz, izz)": (0, 1, 3, 2, 4, 5),
    "with the diagonal first (ixx, iyy, izz, ixy, ixz, iyz)": (0, 3, 4, 1, 5, 2),
    "with the diagonal first (ixx, iyy, izz, ixy, iyz, ixz)": (0, 3, 5, 1, 4, 2),
    "with the diagonal first (ixx, iyy, izz, iyz, ixz, ixy)": (0, 5, 4, 1, 3, 2),
}
"""Mistaken order of the six entries → indices of ixx, ixy, ixz, iyy, iyz and izz in that order."""


def reordered(element: Element) -> tuple[str, tuple[float, ...]] | None:
    """Return the mistaken order in which the entries of an ``<inertia>`` are written, and the reordered entries.

    The order is mistaken if a moment of the tensor is not positive, and exactly one other order gives a physical tensor
    whose moments are more than twice its products of inertia. None otherwise.

    Args:
        element: the ``<inertia>``.
    """
    values = [number(element.attributes.get(name, "")) for name in _COMPONENTS]
    finite = [value for value in values if value is not None and isfinite(value)]
    if len(finite) < len(_COMPONENTS) or not any(finite[1:3]) or is_possible(finite):
        return None
    found: dict[tuple[tuple[float, ...], ...], tuple[str, tuple[float, ...]]] = {}
    for order, places in _ORDERS.items():
        reordered = tuple(finite[place] for place in places)
        diagonal, products = (reordered[0], reordered[3], reordered[5]), (reordered[1], reordered[2], reordered[4])
        if is_possible(reordered) and max(map(abs, products)) < 0.5 * min(diagonal):
            found.setdefault((tuple(sorted(diagonal)), tuple(sorted(map(abs, products)))), (order, reordered))
    return next(iter(found.values())) if len(found) == 1 else None


def is_possible(values: Sequence[float]) -> bool:
    """Return whether the six entries ixx, ixy, ixz, iyy, iyz, izz are a physical inertia tensor."""
    xx, xy, xz, yy, yz, zz = values
    small, middle, large = eigenvalues(xx, xy, xz, yy, yz, zz)
    return small > 1e-9 * large and small + middle >= large * (1.0 - 1e-3)


def shown(values: Sequence[float], *, digits: int = 3) -> list[str]:
    """Format the values with at least `digits` digits, and enough to preserve the triangle inequality."""
    first, second, third = values
    for enough in range(digits, 17):
        texts = [f"{value:.{enough}g}" for value in values]
        if (float(texts[0]) + float(texts[1]) < float(texts[2])) == (first + second < third):
            return [_padded(value, enough) for value in values]
    return [repr(value) for value in values]


def _padded(value: float, digits: int) -> str:
    text = f"{value:#.{digits}g}"
    return text.rstrip(".") if "e" not in text else f"{value:.{digits}g}"


def is_identity(element: Element) -> bool:
    """Return whether an ``<inertia>`` is the identity matrix."""
    values = [number(element.attributes.get(name, "")) for name in _COMPONENTS]
    return values == [1.0, 0.0, 0.0, 1.0, 0.0, 1.0]
