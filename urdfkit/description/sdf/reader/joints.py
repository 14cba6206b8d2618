"""Joints of SDF."""

from math import inf

from urdfkit.description.sdf.frame_graph import Scope
from urdfkit.description.sdf.model import WorldAxis, WorldJoint, WorldMimic
from urdfkit.description.sdf.reader.reading_state import Context
from urdfkit.description.sdf.reader.vocabulary import note_unknown_elements
from urdfkit.description.sdf.shapes import keep
from urdfkit.description.sdf.values import boolean, name_of, raw_pose, scalar, text, vector, wrong
from urdfkit.description.urdf.geometry import compose, rotate, rotation_of, transpose
from urdfkit.description.urdf.robot import Pose, Vector
from urdfkit.description.xml.element import Element
from urdfkit.errors import did_you_mean

TYPES = ("revolute", "continuous", "prismatic", "fixed", "ball", "universal", "revolute2", "screw", "gearbox")
"""The joint types of SDF (joint.sdf)."""

UNLIMITED = 1e16
"""sdformat's value for no limit."""

_READ = {"axis", "axis2", "child", "parent", "pose"}


def read_joint(context: Context, element: Element, scope: Scope) -> WorldJoint:
    """Read a ``<joint>``.

    Args:
        context: the file.
        element: the joint.
        scope: the frames of the model that contains the joint.

    Raises:
        DescriptionError: the joint cannot be read, or its parent or child link is unknown.
    """
    note_unknown_elements(context, element)
    name, kind = name_of(element), element.get("type") or ""
    if kind not in TYPES:
        raise wrong(element, f"unknown type `{kind}` of joint `{name}`" + did_you_mean(kind, TYPES))
    parent, child = (_link(element, tag, scope) for tag in ("parent", "child"))
    if child == "world":
        raise wrong(element, f"the child of joint `{name}` is the world; make the world the parent")
    if parent == child:
        raise wrong(element, f"joint `{name}` connects link `{child}` to itself")
    pose = scope.place(raw_pose(element), text(element, "child"), child)
    axes = [_axis(context, axis, scope, child, pose) for axis in element.children if axis.tag in ("axis", "axis2")]
    if kind in ("revolute", "continuous", "prismatic", "screw", "universal", "revolute2") and not axes:
        raise wrong(element, f"joint `{name}` has no <axis>")
    return WorldJoint(
        name,
        kind,
        parent,
        child,
        pose,
        tuple(axes[:2]),
        tuple([keep(other) for other in element.children if other.tag not in _READ]),
        element.origin.position,
    )


def _link(joint: Element, tag: str, scope: Scope) -> str:
    child = joint.find(tag)
    if child is None or not child.text:
        raise wrong(joint, f"joint `{joint.get('name')}` has no <{tag}>")
    return scope.link_of(child.text, child.origin.position)


def _axis(context: Context, element: Element, scope: Scope, child: str, pose: Pose) -> WorldAxis:
    note_unknown_elements(context, element)
    limit, dynamics = element.find("limit"), element.find("dynamics")
    lower, upper = (
        _limit(scalar(limit, tag, sign * inf, infinite=True)) for tag, sign in (("lower", -1), ("upper", 1))
    )
    if lower > upper:
        raise wrong(limit or element, f"limits of a joint: lower {lower:g} is above upper {upper:g}")
    return WorldAxis(
        _direction(context, element, scope, child, pose),
        lower,
        upper,
        _largest(scalar(limit, "effort", -1.0, infinite=True)),
        _largest(scalar(limit, "velocity", -1.0, infinite=True)),
        scalar(dynamics, "damping", 0.0),
        scalar(dynamics, "friction", 0.0),
        scalar(dynamics, "spring_stiffness", 0.0),
        scalar(dynamics, "spring_reference", 0.0),
        None if (mimic := element.find("mimic")) is None else _mimic(mimic),
    )


def _mimic(element: Element) -> WorldMimic:
    """Read a ``<mimic>``; the equation is sdformat's (1.11/joint.sdf)."""
    leader = element.get("joint") or ""
    if not leader:
        raise wrong(element, 'a <mimic> names no joint to follow; write joint="NAME"')
    if (axis := element.get("axis") or "axis") != "axis":
        raise wrong(element, f"a <mimic> follows `{axis}` of joint `{leader}`; only <axis> can be followed")
    return WorldMimic(
        leader, scalar(element, "multiplier", 1.0), scalar(element, "offset", 0.0), scalar(element, "reference", 0.0)
    )


def _direction(context: Context, element: Element, scope: Scope, child: str, pose: Pose) -> Vector:
    xyz = vector(element, "xyz", (0.0, 0.0, 1.0))
    written = element.find("xyz")
    if not any(xyz):
        raise wrong(written or element, "the axis of a joint is zero")
    base = "" if written is None else written.get("expressed_in") or ""
    # In the model frame in SDF 1.4, and in 1.5 and 1.6 with <use_parent_model_frame> (1_4.convert, 1_6.convert).
    if context.version < (1, 7) and boolean(element, "use_parent_model_frame", context.version < (1, 5)):
        base = scope.root
    if not base:
        return xyz
    joint = compose(scope.pose(child), pose)
    turned = rotate(rotation_of(scope.pose(base, (written or element).origin.position).rpy), xyz)
    return rotate(transpose(rotation_of(joint.rpy)), turned)


def _limit(value: float) -> float:
    return value if abs(value) < UNLIMITED else inf if value > 0 else -inf


def _largest(value: float) -> float:
    return inf if value < 0 or value >= UNLIMITED else value
