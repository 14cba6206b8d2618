"""Drives with wheels on two sides: their joints and the wheel positions at zero joint positions."""

from collections.abc import Iterable, Iterator

from urdfkit.description.plugins import PluginSpec
from urdfkit.description.urdf.geometry import rotate, rotation_of
from urdfkit.description.urdf.robot import Cylinder, Joint, Plugin, Sphere, Vector
from urdfkit.description.xml.element import Element
from urdfkit.description.xml.numbers import number
from urdfkit.lint.facts.gazebo.plugins import is_foreign, plugins, spec_of
from urdfkit.lint.finding import Finding
from urdfkit.lint.fix_builders import nearest, new_text
from urdfkit.lint.model.model import Model
from urdfkit.lint.model.placement import Frame, shapes_of
from urdfkit.lint.rule import Rule
from urdfkit.record import record

_SIDES = {
    "diff_drive": (("left_joint",), ("right_joint",)),
    "skid_steer": (("left_front_joint", "left_rear_joint"), ("right_front_joint", "right_rear_joint")),
    "mecanum_drive": (("front_left_joint", "back_left_joint"), ("front_right_joint", "back_right_joint")),
}
"""Kind of drive → meanings of the parameters that name the joints of each side."""

_SAME = 1e-6
"""Lengths that differ by less are equal [m]."""


@record(eq=False)
class Wheel:
    """A wheel joint of a drive.

    Attributes:
        joint: the joint; the most similar name if the drive's parameter names an undefined joint.
        element: the parameter that names the joint; None for the default.
        named: name of the joint in the parameter.
        place: origin of the joint in the root link [m].
        axis: axis of the joint in the root link.
        radii: radii of the cylinders and spheres of the joint's child link [m]; empty if the link has other shapes.
        middles: origins of the joint and of every shape of its child link, in the root link [m].
    """

    joint: Joint
    element: Element | None
    named: str
    place: Vector
    axis: Vector
    radii: tuple[float, ...]
    middles: tuple[Vector, ...]


@record(eq=False)
class TwoSided:
    """A drive with wheels on two sides."""

    plugin: Plugin
    spec: PluginSpec
    left: tuple[Wheel, ...]
    right: tuple[Wheel, ...]


def drives(model: Model) -> Iterator[TwoSided]:
    """Yield every drive of the robot with wheels on two sides whose wheels all exist."""
    for plugin, _, _ in plugins(model.robot):
        spec = spec_of(plugin, model.target)
        if spec is None or spec.kind not in _SIDES or is_foreign(plugin, model):
            continue
        left, right = (
            [wheel for meaning in side for wheel in _wheels(model, plugin, spec, meaning)] for side in _SIDES[spec.kind]
        )
        if left and right and len(left) == len(right):
            yield TwoSided(plugin, spec, tuple(left), tuple(right))


def written(model: Model, drive: TwoSided, meaning: str) -> tuple[float, Element, str] | None:
    """Return the value of a parameter, its element and its tag; the default and the plugin if it is not set.

    None if the value is unknown, or set by a misspelt parameter, which is reported separately.
    """
    from urdfkit.description.plugins import values

    parameter = drive.spec.by_meaning(meaning)
    if parameter is None:
        return None
    for text, element in values(drive.plugin, parameter):
        value = number(text)
        return None if value is None or model.is_unresolved(element) else (value, element, parameter.tag)
    if parameter.default is None or _is_meant(drive, meaning, parameter.tag):
        return None
    return float(parameter.default), drive.plugin.element, parameter.tag


def further(model: Model, drive: TwoSided, meaning: str) -> Iterator[tuple[int, tuple[float, Element, str]]]:
    """Yield the values of a parameter for the second pair of wheels and those after it, with the index of the pair."""
    from urdfkit.description.plugins import values

    parameter = drive.spec.by_meaning(meaning)
    for pair, (text, element) in enumerate(values(drive.plugin, parameter) if parameter is not None else ()):
        value = number(text)
        is_resolved = value is not None and not model.is_unresolved(element)
        if parameter is not None and value is not None and is_resolved and 0 < pair < len(drive.left):
            yield pair, (value, element, parameter.tag)


def _is_meant(drive: TwoSided, meaning: str, tag: str) -> bool:
    """Return whether a parameter is misspelt, or spelt as in another generation of the plugin."""
    from urdfkit.description.plugins.unread_parameters import tables, unread

    others = (other.by_meaning(meaning) for other in tables(drive.plugin))
    if any(drive.plugin.element.find(other.tag) is not None for other in others if other is not None):
        return True
    return any(each.meant == tag for each in unread(drive.plugin, drive.spec))


def mismatch(
    rule: Rule, model: Model, drive: TwoSided, parameter: tuple[float, Element, str], *, actual: float, comparison: str
) -> Finding:
    """Return the finding for a drive parameter that contradicts the robot's geometry.

    Args:
        rule: the reporting rule.
        model: the linted model.
        drive: the drive.
        parameter: the length [m], its element and its tag, as `written` returns them.
        actual: the length in the robot [m].
        comparison: text that states the actual length, with ``{}`` for its value.
    """
    number, element, tag = parameter
    text = f"{actual:.6g}"
    return rule.at(
        model,
        element,
        f"<{tag}> is {number:g} m{'' if element.tag == tag else ' by default'}, but {comparison.format(text)}",
        joint=drive.left[0].joint.name,
        fix=new_text(model, element, text, "unsafe", f"Write {text}") if element.tag == tag else None,
    )


def _wheels(model: Model, plugin: Plugin, spec: PluginSpec, meaning: str) -> Iterator[Wheel]:
    from urdfkit.description.plugins import values

    parameter = spec.by_meaning(meaning)
    if parameter is None:
        return
    named: list[tuple[str, Element | None]] = [(text, element) for text, element in values(plugin, parameter) if text]
    if not named and parameter.default is not None:
        named = [(parameter.default, None)]
    joints = model.robot.joint_by_name
    for text, element in named:
        name = text if text in joints else nearest(text.strip("\"'"), joints)
        wheel = wheel_of(model, joints[name], element, named=text) if name is not None else None
        if wheel is not None:
            yield wheel


def wheel_of(model: Model, joint: Joint, element: Element | None, *, named: str | None = None) -> Wheel | None:
    """Return the wheel of a joint; None if its position is unknown.

    Args:
        model: the linted model.
        joint: the joint.
        element: the element that names the joint.
        named: the name in that element; by default the joint's name.
    """
    parent = model.frames.get(joint.parent or "")
    if parent is None:
        return None
    frame = parent.moved(joint.origin)
    link = model.robot.link_by_name.get(joint.child or "")
    shapes = shapes_of(link) if link is not None else ()
    round_ones = tuple(shape.geometry.radius for shape in shapes if isinstance(shape.geometry, (Cylinder, Sphere)))
    middles = tuple(frame.moved(shape.origin).translation for shape in shapes)
    return Wheel(
        joint,
        element,
        joint.name if named is None else named,
        frame.translation,
        rotate(frame.rotation, joint.axis),
        round_ones if len(round_ones) == len(shapes) else (),
        (frame.translation, *middles),
    )


def collision_radii(wheel: Wheel, model: Model) -> list[float]:
    """Return the radii of the collision shapes of a wheel [m], or of its visual shapes if it has no round ones."""
    link = model.robot.link_by_name.get(wheel.joint.child or "")
    for shapes in (link.collisions, link.visuals) if link is not None else ():
        radii = [each.geometry.radius for each in shapes if isinstance(each.geometry, (Cylinder, Sphere))]
        if radii:
            return radii
    return []


def track(left: Wheel, right: Wheel, distances: Iterable[float]) -> tuple[float, str]:
    """Return the distance of two wheels [m], and its endpoints: their shapes if those agree, else their joints.

    Args:
        left: the left wheel.
        right: the right wheel.
        distances: distances between the `middles` of the wheels: of the joints, then of the shapes [m].
    """
    joints, *shapes = distances
    names = f"`{left.joint.name}` and `{right.joint.name}`"
    if not shapes or max(shapes) - min(shapes) > _SAME or abs(shapes[0] - joints) <= _SAME:
        return joints, names
    return shapes[0], f"the wheels at {names}"


def same_turn(first: Vector, second: Vector) -> float:
    """Return the largest difference between the entries of the rotation matrices of two roll-pitch-yaw triples."""
    return max(
        abs(a - b)
        for rows in zip(rotation_of(first), rotation_of(second), strict=True)
        for a, b in zip(*rows, strict=True)
    )


__all__ = ["Frame", "TwoSided", "Wheel", "drives", "further", "mismatch", "same_turn", "track", "wheel_of", "written"]
