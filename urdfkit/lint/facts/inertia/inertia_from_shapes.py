"""Inertia tensor of a link's shapes, in plain Python; the reference for rules and fixes."""

from urdfkit.description.urdf.geometry import combined, principal_moments, rotated_tensor, rotation_of, volume_of
from urdfkit.description.urdf.robot import Link
from urdfkit.description.xml.element import Element
from urdfkit.lint.finding import Fix
from urdfkit.lint.fix_builders import new_values
from urdfkit.lint.model.model import Model
from urdfkit.lint.model.placement import Extent
from urdfkit.position import Position

COMPONENTS = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
"""URDF names of the entries of a tensor."""


def tensor_of(link: Link, extent: Extent, mass: float) -> tuple[float, ...] | None:
    """Return the six entries [kg·m²] of a link's shapes with uniform density and `mass` [kg], in its inertial frame.

    Uses the collision shapes, or the visual shapes of a link without collision shapes. Overlaps count twice; meshes
    are replaced by their bounding boxes. The tensor is about the centre of mass of the shapes. None if they have no
    volume, or the mass is so small that a part of it is zero.
    """
    count = len(link.visuals)
    shapes = extent.shapes[count:] or extent.shapes[:count]
    volumes = [volume_of(shape) for shape, _ in shapes]
    if sum(volumes) <= 0.0:
        return None
    if len(shapes) == 1 and shapes[0][1].rpy == (0.0, 0.0, 0.0) and not _is_turned(link):
        xx, yy, zz = principal_moments(shapes[0][0], mass)
        return xx, 0.0, 0.0, yy, 0.0, zz
    parts = []
    for (shape, pose), volume in zip(shapes, volumes, strict=True):
        share = mass * volume / sum(volumes)
        parts.append((pose, share, principal_moments(shape, share)))
    if not sum(share for _, share, _ in parts):
        return None
    frame = link.inertial.origin.rpy if link.inertial is not None else (0.0, 0.0, 0.0)
    return rotated_tensor(combined(parts)[2], rotation_of(frame))


def _is_turned(link: Link) -> bool:
    return link.inertial is not None and link.inertial.origin.rpy != (0.0, 0.0, 0.0)


def computed(model: Model, link: Link, element: Element) -> Fix | None:
    """Return the fix that writes the tensor of the link's shapes; None if the shapes or the mass are unknown."""
    extent = model.extents.get(link.name)
    mass = link.inertial.mass if link.inertial is not None else None
    if extent is None or mass is None or mass <= 0.0:
        return None
    values = tensor_of(link, extent, mass)
    if values is None:
        return None
    largest = max(values)
    texts = {name: _written(value, largest) for name, value in zip(COMPONENTS, values, strict=True)}
    return new_values(model, element, texts, "unsafe", "Compute it from shape and mass")


def place_and_help(element: Element, plausible: list[Element]) -> tuple[Element | Position, str]:
    """Return the place of an implausible tensor and the help: the macro call if other calls give plausible tensors."""
    from urdfkit.lint.facts.root_cause import call_of

    call = call_of(element, plausible) if element.origin.expansions else None
    if call is None:
        return element, "compute it from shape and mass"
    return call, "check the arguments of this macro call; other calls give plausible tensors"


def _written(value: float, largest: float) -> str:
    return "0" if abs(value) < 1e-9 * largest else f"{value:.6g}"
