"""Properties of links and joints for the page: masses, origins, limits and source locations."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from urdfkit.description.urdf.queries import tree_order
from urdfkit.description.urdf.robot import Box, Capsule, Cylinder, Mesh, Sphere
from urdfkit.description.urdf.version import RATES
from urdfkit.description.xml.source import Source
from urdfkit.description.xml.start_tag import element_span
from urdfkit.kinematics.pinocchio_model import joint_model
from urdfkit.scene.pose_matrices import pose_matrix

if TYPE_CHECKING:
    from collections.abc import Callable

    from urdfkit.description.urdf.robot import Collision, Geometry, Inertial, Joint, Link, Pose, Visual
    from urdfkit.description.xml.element import Element
    from urdfkit.kinematics import Kinematics

    Array = NDArray[np.float64]

LINES = 16
"""Maximum number of source lines of an element."""


def inspection(kinematics: Kinematics) -> dict[str, Any]:
    """Return links and joints as JSON values for the page.

    Args:
        kinematics: the robot.

    Returns:
        ``root``, the root link; ``links``, in the order of `Kinematics.link_names`; ``joints``, in document order.
        Poses are x y z [m] and quaternion x y z w, angles radians.
    """
    robot = kinematics.robot
    excerpt = excerpts()
    links = [_link(robot.link_by_name[name], excerpt) for name in kinematics.link_names]
    joints = [_joint(joint, kinematics, excerpt) for joint in tree_order(robot)]
    order = {joint.name: i for i, joint in enumerate(robot.joints)}
    return {"root": kinematics.root, "links": links, "joints": sorted(joints, key=lambda row: order[row["name"]])}


def excerpts() -> Callable[[Element], dict[str, Any]]:
    """Return a function for the location of an element: file, line, column, source lines and chain of macro calls."""
    source = cache(Source.read_if_possible)

    def excerpt(element: Element) -> dict[str, Any]:
        at = element.origin.position
        text = source(at.file)
        span = element_span(text, at) if text is not None else None
        last = at.line if span is None else min(span.end_line, at.line + LINES - 1)
        numbers = range(at.line, last + 1) if text is not None else ()
        lines = [text.excerpt(each, at.column if each == at.line else 1) for each in numbers if text is not None]
        return {
            "file": at.file,
            "line": at.line,
            "column": at.column,
            "lines": lines,
            "more": 0 if span is None else span.end_line - last,
            "chain": [
                {"macro": call.macro, "file": call.position.file, "line": call.position.line}
                for call in element.origin.expansions
            ],
        }

    return excerpt


def _link(link: Link, excerpt: Callable[[Element], dict[str, Any]]) -> dict[str, Any]:
    return {
        "name": link.name,
        "source": excerpt(link.element),
        "inertial": None if link.inertial is None else _inertial(link.inertial, excerpt),
        "visuals": _shapes(link.visuals, excerpt),
        "collisions": _shapes(link.collisions, excerpt),
    }


def _inertial(inertial: Inertial, excerpt: Callable[[Element], dict[str, Any]]) -> dict[str, Any]:
    """Return mass, centre of mass, tensor, and the equivalent solid ellipsoid if one exists."""
    found: dict[str, Any] = {
        "mass": inertial.mass,
        "origin": pose(inertial.origin),
        "rpy": list(inertial.origin.rpy),
        "tensor": None,
        "ellipsoid": None,
        "source": excerpt(inertial.element),
    }
    if (i := inertial.inertia) is not None:
        found["tensor"] = [i.ixx, i.ixy, i.ixz, i.iyy, i.iyz, i.izz]
        found["ellipsoid"] = ellipsoid(inertial.mass or 0.0, found["tensor"])
    return found


def ellipsoid(mass: float, tensor: Sequence[float]) -> dict[str, Any] | None:
    """Return the solid ellipsoid of uniform density with this inertia.

    With half axes a, b, c its moments are m/5·(b² + c²), …: a² = 5/(2m)·(I₂ + I₃ - I₁).

    Args:
        mass: [kg].
        tensor: ixx, ixy, ixz, iyy, iyz, izz about the centre of mass [kg·m²].

    Returns:
        ``moments`` [kg·m²], ``axes`` (half axes) [m], ``turn``, the quaternion x y z w of the principal axes in the
        inertial frame; None if the inertia is not physically valid.
    """
    ixx, ixy, ixz, iyy, iyz, izz = tensor
    matrix = np.array([[ixx, ixy, ixz], [ixy, iyy, iyz], [ixz, iyz, izz]])
    if mass <= 0 or not np.isfinite(matrix).all():
        return None
    moments, axes = np.linalg.eigh(matrix)
    squares = 2.5 / mass * (moments.sum() - 2 * moments)
    if moments[0] <= 0 or squares.min() < -1e-9 * squares.max():
        return None
    if np.linalg.det(axes) < 0:
        axes[:, 2] *= -1
    return {
        "moments": moments.tolist(),
        "axes": np.sqrt(np.maximum(squares, 0.0)).tolist(),
        "turn": quaternion(axes).tolist(),
    }


def _shapes(shapes: Sequence[Visual | Collision], excerpt: Callable[[Element], dict[str, Any]]) -> list[dict[str, Any]]:
    rows = []
    for shape in shapes:
        material = getattr(shape, "material", None)
        rows.append(
            {
                "name": shape.name,
                "geometry": describe(shape.geometry),
                "origin": pose(shape.origin),
                "rpy": list(shape.origin.rpy),
                "material": material.name if material is not None else None,
                "source": excerpt(shape.element),
            }
        )
    return rows


def describe(geometry: Geometry | None) -> str:
    """Return a description of a geometry, lengths in metres."""
    if isinstance(geometry, Box):
        return f"box {' × '.join(f'{edge:g}' for edge in geometry.size)} m"
    if isinstance(geometry, Cylinder):
        return f"cylinder, radius {geometry.radius:g} m, length {geometry.length:g} m"
    if isinstance(geometry, Sphere):
        return f"sphere, radius {geometry.radius:g} m"
    if isinstance(geometry, Capsule):
        return f"capsule, radius {geometry.radius:g} m, length {geometry.length:g} m"
    if isinstance(geometry, Mesh):
        scaled = "" if geometry.scale == (1.0, 1.0, 1.0) else f", scale {' '.join(f'{s:g}' for s in geometry.scale)}"
        return f"mesh {geometry.uri}{scaled}"
    return "no geometry"


def _joint(joint: Joint, kinematics: Kinematics, excerpt: Callable[[Element], dict[str, Any]]) -> dict[str, Any]:
    axis = np.array(joint.axis, dtype=float)
    length = float(np.linalg.norm(axis))
    single = joint.type in ("revolute", "continuous", "prismatic")
    coupling = kinematics.couplings.get(joint.name)
    limit, dynamics = joint.limit, joint.dynamics
    return {
        "name": joint.name,
        "type": joint.type,
        "parent": joint.parent,
        "child": joint.child,
        "origin": pose(joint.origin),
        "rpy": list(joint.origin.rpy),
        "axis": (axis / length).tolist() if length > 0 else [1.0, 0.0, 0.0],
        "turn": quaternion(np.array(joint_model(joint)[1].rotation)).tolist() if joint.type == "planar" else None,
        "lower": finite(kinematics.limits(joint.name)[0]) if single else None,
        "upper": finite(kinematics.limits(joint.name)[1]) if single else None,
        "effort": finite(limit.effort) if limit is not None else None,
        "velocity": finite(limit.velocity) if limit is not None else None,
        **{rate: finite(getattr(limit, rate, None)) for rate in RATES},
        "damping": finite(dynamics.damping) if dynamics is not None else None,
        "friction": finite(dynamics.friction) if dynamics is not None else None,
        "mimic": None
        if coupling is None
        else {"master": coupling.master, "multiplier": coupling.multiplier, "offset": coupling.offset},
        "source": excerpt(joint.element),
    }


def finite(value: float | None) -> float | None:
    """Return a number, or None if it is missing or not finite."""
    return value if value is not None and math.isfinite(value) else None


def pose(origin: Pose) -> list[float]:
    """Return an ``<origin>`` as x y z [m] and quaternion x y z w."""
    matrix = pose_matrix(origin)
    return [*(float(x) for x in matrix[:3, 3]), *quaternion(matrix[:3, :3]).tolist()]


def quaternion(R: Array) -> Array:
    """Return the unit quaternion x y z w of a rotation matrix, w not negative; shape (4,).

    Shepperd's method: the largest of the four squares is computed first, to avoid division by a small number (J.
    Guidance and Control 1, 1978).
    """
    trace = float(np.trace(R))
    i = int(np.argmax([R[0, 0], R[1, 1], R[2, 2], trace]))
    q = np.empty(4)
    if i == 3:
        q[:] = R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1], 1.0 + trace
    else:
        j, k = (i + 1) % 3, (i + 2) % 3
        q[i], q[j] = 1.0 + R[i, i] - R[j, j] - R[k, k], R[j, i] + R[i, j]
        q[k], q[3] = R[k, i] + R[i, k], R[k, j] - R[j, k]
    q /= np.linalg.norm(q)
    unit: Array = -q if q[3] < 0 else q
    return unit
