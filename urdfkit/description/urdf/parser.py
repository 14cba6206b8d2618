"""Element → Robot, leniently: an unusable value becomes an entry of `Robot.problems` and raises no error.

The elements and defaults are those of http://wiki.ros.org/urdf/XML and of urdfdom's parser, with its tolerance: white
space around numbers, the first of repeated elements. Attributes of a later version than the robot's are ignored; a
capsule is read in every version, as PyBullet and MuJoCo do.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from urdfkit.description.urdf.extensions import gazebo_block, ros2_control, transmission
from urdfkit.description.urdf.robot import (
    JOINT_TYPES,
    Box,
    Calibration,
    Capsule,
    Collision,
    Cylinder,
    Dynamics,
    Geometry,
    Inertia,
    Inertial,
    Joint,
    Limit,
    Link,
    Material,
    Mesh,
    Mimic,
    Robot,
    SafetyController,
    Sphere,
    Visual,
)
from urdfkit.description.urdf.values import Reader
from urdfkit.description.urdf.version import CAPSULE, RATE_LIMITS, RATES, version_of
from urdfkit.description.xml.element import Element
from urdfkit.errors import did_you_mean

TYPE_CHECKING = False
if TYPE_CHECKING:
    from urdfkit.description.packages.resolver import Packages
    from urdfkit.description.urdf.values import Part

SHAPES = ("box", "cylinder", "sphere", "capsule", "mesh")
"""Shapes allowed in a ``<geometry>``."""

EMPTY_NAME = "the file name of <mesh> is empty"

_TENSOR = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")


def parse(
    root: Element,
    *,
    files: tuple[Path, ...] = (),
    packages: Packages | None = None,
    arguments: Mapping[str, str] | None = None,
    cached_parts: dict[Element, Part] | None = None,
) -> Robot:
    """Read a robot.

    Args:
        root: the ``<robot>`` element after expansion. Any other element results in a robot without links.
        files: the files read, for `Robot.files`.
        packages: for `Robot.packages`.
        arguments: for `Robot.arguments`.
        cached_parts: element → the part read from it earlier, with its problems; updated by this function.
    """
    reader = Reader(cached_parts, version_of(root))
    name = reader.text(root, "name") if root.tag == "robot" else root.get("name")
    links, joints, materials, transmissions, gazebo, controls = [], [], [], [], [], []
    for child in root.children:
        reader.subject = ""
        if child.tag == "link":
            links.append(reader.part(_link, child))
        elif child.tag == "joint":
            joints.append(reader.part(_joint, child))
        elif child.tag == "material":
            materials.append(_material(reader, child))
        elif child.tag == "transmission":
            transmissions.append(transmission(reader, child))
        elif child.tag == "gazebo":
            gazebo.append(gazebo_block(reader, child))
        elif child.tag == "ros2_control":
            controls.append(ros2_control(child))
    if cached_parts is not None:
        cached_parts.clear()
        cached_parts.update(reader.parts)
    return Robot(
        name,
        tuple(links),
        tuple(joints),
        tuple(materials),
        tuple(transmissions),
        tuple(gazebo),
        tuple(controls),
        tuple(reader.problems),
        root,
        files,
        packages,
        arguments or {},
    )


def _link(reader: Reader, element: Element) -> Link:
    name = _name(reader, element)
    inertial = element.find("inertial")
    return Link(
        name,
        reader.part(_inertial, inertial) if inertial is not None else None,
        tuple([reader.part(_visual, child) for child in element.find_all("visual")]),
        tuple([reader.part(_collision, child) for child in element.find_all("collision")]),
        element,
    )


def _inertial(reader: Reader, element: Element) -> Inertial:
    mass, inertia = element.find("mass"), element.find("inertia")
    for tag, child in (("mass", mass), ("inertia", inertia)):
        if child is None:
            reader.note("missing", f"<inertial> lacks <{tag}>", element)
    return Inertial(
        reader.pose(element),
        reader.number(mass, "value", required=True) if mass is not None else None,
        _inertia(reader, inertia) if inertia is not None else None,
        element,
    )


def _inertia(reader: Reader, element: Element) -> Inertia | None:
    values = [reader.number(element, name, required=True) for name in _TENSOR]
    present = [value for value in values if value is not None]
    if len(present) < len(_TENSOR):
        return None
    ixx, ixy, ixz, iyy, iyz, izz = present
    return Inertia(ixx, ixy, ixz, iyy, iyz, izz, element)


def _visual(reader: Reader, element: Element) -> Visual:
    material = element.find("material")
    return Visual(
        element.get("name"),
        reader.pose(element),
        _geometry(reader, element),
        _material(reader, material) if material is not None else None,
        element,
    )


def _collision(reader: Reader, element: Element) -> Collision:
    return Collision(element.get("name"), reader.pose(element), _geometry(reader, element), element)


def _geometry(reader: Reader, parent: Element) -> Geometry | None:
    element = parent.find("geometry")
    if element is None:
        reader.note("missing", f"<{parent.tag}> lacks <geometry>", parent)
        return None
    shape = next((child for child in element.children if child.tag in SHAPES), None)
    if shape is None:
        if element.children:
            tag = element.children[0].tag
            message = f"unknown shape <{tag}> in <geometry>" + did_you_mean(tag, SHAPES)
            reader.note("unknown-value", message, element.children[0])
        else:
            reader.note("missing", f"<geometry> is empty; it holds one of {', '.join(SHAPES)}", element)
        return None
    return _shape(reader, shape)


def _shape(reader: Reader, element: Element) -> Geometry | None:
    if element.tag == "mesh":
        uri = reader.text(element, "filename")
        if uri is not None and not uri.strip():
            reader.note("missing", EMPTY_NAME, element, "filename")
        scale = reader.vector(element, "scale")
        return None if uri is None else Mesh(uri, scale or (1.0, 1.0, 1.0))
    if element.tag == "box":
        reader.text(element, "size")
        size = reader.vector(element, "size")
        return None if size is None else Box(size)
    if element.tag == "capsule" and reader.version < CAPSULE:
        reader.note("version", "<capsule> in URDF 1.0", element)
    radius = reader.number(element, "radius", required=True)
    if element.tag == "sphere":
        return None if radius is None else Sphere(radius)
    length = reader.number(element, "length", required=True)
    if radius is None or length is None:
        return None
    return Cylinder(radius, length) if element.tag == "cylinder" else Capsule(radius, length)


def _material(reader: Reader, element: Element) -> Material:
    color, texture = element.find("color"), element.find("texture")
    rgba = None
    if color is not None:
        reader.text(color, "rgba")
        rgba = reader.numbers(color, "rgba", 4)
    return Material(
        element.get("name"),
        (rgba[0], rgba[1], rgba[2], rgba[3]) if rgba is not None else None,
        reader.text(texture, "filename") if texture is not None else None,
        element,
    )


def _joint(reader: Reader, element: Element) -> Joint:
    name = _name(reader, element)
    kind = element.get("type")
    if kind is None:
        reader.note("missing", f"missing attribute `type`; joint types are {', '.join(JOINT_TYPES)}", element, "type")
    elif kind not in JOINT_TYPES:
        hint = did_you_mean(kind, JOINT_TYPES) or f"; joint types are {', '.join(JOINT_TYPES)}"
        reader.note("unknown-value", f"unknown type `{kind}`" + hint, element, "type")
    parent, child = (_linked(reader, element, end) for end in ("parent", "child"))
    axis = element.find("axis")
    direction = reader.vector(axis, "xyz") if axis is not None else None
    return Joint(
        name,
        kind,
        parent,
        child,
        reader.pose(element),
        direction or (1.0, 0.0, 0.0),
        _limit(reader, element.find("limit"), kind),
        _dynamics(reader, element.find("dynamics")),
        _mimic(reader, element.find("mimic")),
        _safety_controller(reader, element.find("safety_controller")),
        _calibration(reader, element.find("calibration")),
        element,
    )


def _name(reader: Reader, element: Element) -> str:
    """Return the name of a link or joint (empty if missing), and set it as the subject of later messages."""
    reader.subject = ""
    name = reader.text(element, "name") or ""
    reader.subject = f"{element.tag} `{name}`" if name else ""
    return name


def _linked(reader: Reader, joint: Element, end: str) -> str | None:
    element = joint.find(end)
    if element is None:
        reader.note("missing", f"missing <{end} link=…>", joint)
        return None
    return reader.text(element, "link")


def _limit(reader: Reader, element: Element | None, kind: str | None) -> Limit | None:
    if element is None:
        return None
    has_rates = reader.version >= RATE_LIMITS  # in exchange, effort and velocity are optional, lower and upper not
    ends = has_rates and kind in ("revolute", "prismatic")
    needed = not has_rates and kind in ("revolute", "prismatic", "continuous")
    lower, upper = (reader.number(element, name, required=ends, infinite=True) for name in ("lower", "upper"))
    effort, velocity = (reader.number(element, name, required=needed, infinite=True) for name in ("effort", "velocity"))
    for name in () if has_rates else RATES:
        if name in element.attributes:
            reader.note("version", f"`{name}` before URDF 1.2", element, name)
    rates = [reader.number(element, name, infinite=True) if has_rates else None for name in RATES]
    return Limit(lower, upper, effort, velocity, element, *rates)


def _dynamics(reader: Reader, element: Element | None) -> Dynamics | None:
    if element is None:
        return None
    return Dynamics(reader.number_or(element, "damping", 0.0), reader.number_or(element, "friction", 0.0), element)


def _mimic(reader: Reader, element: Element | None) -> Mimic | None:
    if element is None:
        return None
    joint = reader.text(element, "joint")
    multiplier, offset = reader.number_or(element, "multiplier", 1.0), reader.number_or(element, "offset", 0.0)
    return Mimic(joint, multiplier, offset, element) if joint is not None else None


def _safety_controller(reader: Reader, element: Element | None) -> SafetyController | None:
    if element is None:
        return None
    return SafetyController(
        reader.number_or(element, "soft_lower_limit", 0.0),
        reader.number_or(element, "soft_upper_limit", 0.0),
        reader.number_or(element, "k_position", 0.0),
        reader.number(element, "k_velocity", required=True),
        element,
    )


def _calibration(reader: Reader, element: Element | None) -> Calibration | None:
    if element is None:
        return None
    return Calibration(reader.number(element, "rising"), reader.number(element, "falling"), element)
