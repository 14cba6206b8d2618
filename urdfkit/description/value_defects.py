"""Values that readers of URDF ignore or replace: rotations, the version, limits and coefficients of joints."""

from __future__ import annotations

from dataclasses import replace
from math import isfinite

from urdfkit.defect_message import with_effect
from urdfkit.description.urdf.queries import owners
from urdfkit.description.urdf.repair_record import Repair
from urdfkit.description.urdf.robot import Joint, Robot
from urdfkit.description.urdf.version import FIRST_VERSIONS, RATES, VERSIONS, shown, version_of, written_version
from urdfkit.description.xacro.evaluation.failures import chain_words
from urdfkit.description.xml.element import Element
from urdfkit.description.xml.start_tag import WrittenAttributes
from urdfkit.errors import ModelError
from urdfkit.record import record

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator
    from typing import Literal

    from urdfkit.description.urdf.repair_record import RepairKind
    from urdfkit.description.urdf.version import Version
    from urdfkit.position import Position

_EFFECTS = {
    "lower": ("J405", "the two limits are swapped"),
    "damping": ("J419", "it is ignored"),
    "friction": ("J419", "it is ignored"),
}
"""Code of the finding and effect of the repair, by attribute."""


@record(eq=False)
class _Defect:
    """An ignored or replaced value; see `Repair`."""

    kind: RepairKind
    code: str
    message: str
    effect: str
    element: Element
    attribute: str
    link: str | None = None
    joint: str | None = None
    is_note: bool = False

    def repair(self, sources: WrittenAttributes) -> Repair:
        """Return the repair; `sources` reads the files."""
        message = with_effect(self.message, self.effect) + chain_words(self.element.origin.expansions)
        severity: Literal["warning", "note"] = "note" if self.is_note else "warning"
        return Repair(self.kind, self.code, message, self.position(sources), self.link, self.joint, severity)

    def position(self, sources: WrittenAttributes) -> Position:
        """Return the position of the attribute, or of the tag if the source has no such attribute."""
        position = self.element.origin.position
        written = sources.at(position, self.attribute)
        return position if written is None else written.name.start


def repaired_values(robot: Robot) -> tuple[Robot, list[Repair]]:
    """Return a robot without limits and coefficients that no joint can have, and a repair for each value.

    The repairs include values that the parser ignored or replaced: a quaternion of zero, an unknown version of URDF,
    and quaternions and capsules in a robot of a version without them. The position of a repair is that of its
    attribute.
    """
    defects = list(_defects(robot))
    if not defects:
        return robot, []
    sources = WrittenAttributes()
    joints = tuple([_with_possible_values(joint) for joint in robot.joints])
    return replace(robot, joints=joints), [defect.repair(sources) for defect in defects]


def require_valid_values(robot: Robot) -> None:
    """Refuse a robot with values that `repaired_values` repairs with a warning.

    Raises:
        ModelError: the first such value.
    """
    for defect in _defects(robot):
        if not defect.is_note:
            message = defect.message + chain_words(defect.element.origin.expansions)
            raise ModelError(message, position=defect.position(WrittenAttributes()))


def _defects(robot: Robot) -> Iterator[_Defect]:
    yield from _version(robot)
    yield from _quaternions(robot)
    unlimited = {name for name in ("effort", "velocity", *RATES) if is_minus_one_everywhere(robot, name)}
    for joint in robot.joints:
        for name, message, element in invalid_values(joint):
            code, effect = _EFFECTS.get(name, ("J410", "the limit is ignored"))
            attribute = "upper" if name == "lower" and name not in element.attributes else name
            is_note = name in unlimited
            yield _Defect("joint", code, message, effect, element, attribute, joint=joint.name, is_note=is_note)


def invalid_values(joint: Joint) -> Iterator[tuple[str, str, Element]]:
    """Yield the attribute, a message and the element for each limit and each coefficient that no joint can have."""
    if not joint.is_movable:
        return
    unit, force = ("m", "N") if joint.type == "prismatic" else ("rad", "N·m")
    limit, dynamics = joint.limit, joint.dynamics
    if limit is not None and joint.type in ("revolute", "prismatic"):
        lower, upper = limit.lower or 0.0, limit.upper or 0.0
        if lower > upper:
            yield (
                "lower",
                f"joint `{joint.name}`: its lower limit {lower:g} {unit} is above its upper limit {upper:g} {unit}",
                limit.element,
            )
    if limit is not None:
        second = f"{unit}/s²"
        units = (force, f"{unit}/s", second, second, f"{unit}/s³")
        for name, its in zip(("effort", "velocity", *RATES), units, strict=True):
            value = getattr(limit, name)
            if value is not None and value < 0.0:
                message = f"joint `{joint.name}`: {name} limit {value:g} {its}; it must not be negative"
                yield name, message, limit.element
    if dynamics is not None:
        damping = ("damping", dynamics.damping, f"{force}·s/{unit}")
        for name, value, its in (damping, ("friction", dynamics.friction, force)):
            if not (isfinite(value) and value >= 0.0):
                message = f"joint `{joint.name}`: {name} {value:g} {its}; it must not be negative"
                yield name, message, dynamics.element


def is_minus_one_everywhere(robot: Robot, name: str) -> bool:
    """Return whether all movable joints with limits, at least two, have the limit -1: exporters mean no limit."""
    limits = [joint.limit for joint in robot.joints if joint.limit is not None and joint.is_movable]
    return len(limits) > 1 and all(getattr(limit, name) == -1.0 for limit in limits)


def later_features(robot: Robot) -> dict[str, list[Element]]:
    """Return the elements that use a later version of URDF than the robot's, by attribute or tag, in order."""
    found: dict[str, list[Element]] = {}
    for problem in robot.problems:
        if problem.kind == "version":
            found.setdefault(problem.attribute or problem.element.tag, []).append(problem.element)
    return {name: sorted(elements, key=lambda one: one.origin.position) for name, elements in found.items()}


def later_feature(name: str, declared: Version) -> str:
    """Return the description of an attribute or tag of a later version than the robot's."""
    what = "<capsule>" if name == "capsule" else f"`{name}`"
    return f"{what} needs URDF {shown(FIRST_VERSIONS[name])}, but the robot is URDF {shown(declared)}"


def other_uses(elements: list[Element]) -> str:
    """Return the number of uses of an attribute or tag after the first, in parentheses; empty for a single use."""
    more = len(elements) - 1
    return f" (also in {more} other place{'s' if more > 1 else ''})" if more else ""


def _with_possible_values(joint: Joint) -> Joint:
    """Return a joint with exchanged limits if the lower one is above the upper one, and without `invalid_values`."""
    limit, dynamics = joint.limit, joint.dynamics
    for name, _, _ in invalid_values(joint):
        if limit is not None and name == "lower":
            limit = replace(limit, lower=limit.upper, upper=limit.lower)
        elif dynamics is not None and name in ("damping", "friction"):
            dynamics = replace(dynamics, **{name: 0.0})  # type: ignore[arg-type]
        elif limit is not None:
            limit = replace(limit, **{name: None})  # type: ignore[arg-type]
    if limit is joint.limit and dynamics is joint.dynamics:
        return joint
    return replace(joint, limit=limit, dynamics=dynamics)


def _version(robot: Robot) -> Iterator[_Defect]:
    root = robot.element
    version = version_of(root)
    if root.tag == "robot" and written_version(root) not in VERSIONS:
        message = f"unknown version `{root.attributes['version']}` of URDF"
        yield _Defect("structure", "E020", message, f"it is read as version {shown(version)}", root, "version")
    for name, elements in later_features(robot).items():
        if name in RATES:  # without effect on the robot
            continue
        effect = "it is read as in later versions" if name == "capsule" else "it is ignored"
        message = later_feature(name, version)
        link, joint = owners(robot).get(elements[0], (None, None))
        yield _Defect("structure", "E021", message, effect + other_uses(elements), elements[0], name, link, joint)


def _quaternions(robot: Robot) -> Iterator[_Defect]:
    problems = [problem for problem in robot.problems if problem.kind == "zero"]
    by_element = owners(robot) if problems else {}
    for problem in problems:
        link, joint = by_element.get(problem.element, (None, None))
        effect = "it is read as 0 0 0 1"
        yield _Defect("structure", "E024", problem.message, effect, problem.element, "quat_xyzw", link, joint)
