"""Read values of SDF strictly: an unusable value raises an error with its position."""

from math import isfinite, radians

from urdfkit.description.sdf.shapes import Rgba
from urdfkit.description.urdf.geometry import rpy_of_quaternion
from urdfkit.description.urdf.robot import Pose, Vector
from urdfkit.description.xml.element import Element
from urdfkit.description.xml.numbers import numbers, why_not
from urdfkit.description.xml.source import Position
from urdfkit.errors import DescriptionError
from urdfkit.record import record

_BOOLEANS = {"true": True, "1": True, "false": False, "0": False}


@record
class RawPose:
    """An unresolved ``<pose>``.

    Attributes:
        pose: the pose; the identity if it is missing.
        relative_to: name of the reference frame; empty for the default.
        position: source position.
    """

    pose: Pose
    relative_to: str
    position: Position


def wrong(element: Element, message: str) -> DescriptionError:
    """Return an error with the position of an element."""
    return DescriptionError(message, position=element.origin.position)


def floats(element: Element, count: int, *, infinite: bool = False) -> tuple[float, ...]:
    """Return the numbers that an element's text lists.

    Raises:
        DescriptionError: the count is wrong, or a number is not finite.
    """
    found = numbers(element.text)
    if found is None or len(found) != count or not (infinite or all(map(isfinite, found))):
        why = why_not(element.text) if found is None else ""
        wanted = f"{count} finite numbers" if count > 1 else "a finite number"
        shown = " ".join(element.text.split())
        shown = shown if len(shown) <= 60 else shown[:59] + "…"
        raise wrong(element, f"<{element.tag}> is `{shown}`; it must be {wanted}{f' ({why})' if why else ''}")
    return tuple(found)


def scalar(parent: Element | None, tag: str, default: float, *, infinite: bool = False) -> float:
    """Return the number in a child; a default if it is missing."""
    child = None if parent is None else parent.find(tag)
    if child is None:
        return default
    value = floats(child, 1, infinite=infinite)[0]
    if value != value:
        raise wrong(child, f"<{tag}> is `nan`; it must be a number")
    return value


def positive(parent: Element, tag: str) -> float:
    """Return the number greater than zero in a required child.

    Raises:
        DescriptionError: the child is missing, or its number is not greater than zero.
    """
    child = parent.find(tag)
    if child is None:
        raise wrong(parent, f"<{parent.tag}> has no <{tag}>")
    value = floats(child, 1)[0]
    if value <= 0:
        raise wrong(child, f"<{tag}> is {value:g}; it must be greater than zero")
    return value


def vector(parent: Element | None, tag: str, default: Vector) -> Vector:
    """Return the three numbers in a child; a default if it is missing."""
    child = None if parent is None else parent.find(tag)
    if child is None:
        return default
    x, y, z = floats(child, 3)
    return x, y, z


def color(parent: Element, tag: str, default: Rgba | None) -> Rgba | None:
    """Return red, green, blue and alpha in a child; alpha is optional."""
    child = parent.find(tag)
    if child is None:
        return default
    count = 3 if len(child.text.split()) == 3 else 4
    r, g, b, *a = floats(child, count)
    return r, g, b, a[0] if a else 1.0


def boolean(parent: Element | None, tag: str, default: bool) -> bool:
    """Return the boolean in a child; a default if it is missing.

    Raises:
        DescriptionError: the text is neither true nor false.
    """
    child = None if parent is None else parent.find(tag)
    if child is None:
        return default
    value = _BOOLEANS.get(child.text.lower())
    if value is None:
        raise wrong(child, f"<{tag}> is `{child.text}`; it must be true or false")
    return value


def text(parent: Element | None, tag: str, default: str = "") -> str:
    """Return the text in a child; a default if it is missing."""
    child = None if parent is None else parent.find(tag)
    return default if child is None else child.text


def name_of(element: Element) -> str:
    """Return the name of an element.

    Raises:
        DescriptionError: the element has no name.
    """
    name = element.get("name")
    if not name:
        raise wrong(element, f"<{element.tag}> has no name")
    return name


def raw_pose(parent: Element) -> RawPose:
    """Return the ``<pose>`` in an element; the identity if it is missing.

    Angles are in radians, or in degrees with ``degrees="true"``; with ``rotation_format="quat_xyzw"`` they are
    a quaternion (SDF 1.9).

    Raises:
        DescriptionError: the pose is invalid.
    """
    child = parent.find("pose")
    if child is None:
        return RawPose(Pose(), "", parent.origin.position)
    relative_to = child.get("relative_to") or child.get("frame") or ""  # `frame` until SDF 1.6
    position = child.origin.position
    form = child.get("rotation_format", "euler_rpy")
    if form == "quat_xyzw":
        x, y, z, *q = floats(child, 7)
        if not any(q):
            raise wrong(child, "the quaternion of <pose> is zero")
        return RawPose(Pose((x, y, z), rpy_of_quaternion(q[0], q[1], q[2], q[3])), relative_to, position)
    if form != "euler_rpy":
        raise wrong(child, f"rotation_format is `{form}`; it must be euler_rpy or quat_xyzw")
    if not child.text:
        return RawPose(Pose(), relative_to, position)
    x, y, z, roll, pitch, yaw = floats(child, 6)
    if _BOOLEANS.get((child.get("degrees") or "false").lower()):
        roll, pitch, yaw = radians(roll), radians(pitch), radians(yaw)
    return RawPose(Pose((x, y, z), (roll, pitch, yaw)), relative_to, position)
