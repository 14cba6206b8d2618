"""Defects of a robot's structure, and the values of its elements that no reader can use."""

from collections.abc import Mapping

from urdfkit.defect_message import with_effect
from urdfkit.description.urdf.queries import Owner, owners
from urdfkit.description.urdf.repair_record import Repair
from urdfkit.description.urdf.robot import Problem, Robot
from urdfkit.description.xacro.evaluation.failures import chain_words
from urdfkit.description.xml.element import Element
from urdfkit.errors import ModelError
from urdfkit.position import Position
from urdfkit.record import field, record

LEFT_OUT = "the joint is ignored"
"""Effect of the repair of a joint without a parent or a child."""

_HARMLESS = frozenset({"unknown-value", "missing", "zero", "version"})
_NEEDED = {("joint", "type"), ("parent", "link"), ("child", "link"), ("mimic", "joint")}
_UNREAD = frozenset({"mechanicalReduction"})
"""Elements whose text neither urdfkit nor urdfdom uses; only the linter checks them."""
_CODES = {"bad-number": "E010", "wrong-arity": "E011", "not-finite": "E012", "conflict": "E023"}
_SHAPES = frozenset({"box", "cylinder", "sphere", "capsule"})


@record(eq=False)
class Defect:
    """A defect of a robot's structure, and its repair by `repaired_structure`.

    Attributes:
        message: description of the defect.
        effect: description of the repair.
        code: code of the lint rule that reports the defect.
        element: the element that has the defect.
        link: name of the affected link.
        joint: name of the affected joint.
        attribute: attribute that has the defect; None if it depends on the code.
    """

    message: str
    effect: str
    code: str
    element: Element = field(repr=False)
    link: str | None = None
    joint: str | None = None
    attribute: str | None = None

    @property
    def position(self) -> Position:
        """Source position of the element."""
        return self.element.origin.position

    @property
    def error(self) -> ModelError:
        """The error of a reader that repairs nothing."""
        return ModelError(self.message + self._chain, position=self.position)

    @property
    def repair(self) -> Repair:
        """The repair."""
        message = with_effect(self.message, self.effect) + self._chain
        place = self.position
        return Repair("structure", self.code, message, place, self.link, self.joint, attribute=self.attribute)

    @property
    def _chain(self) -> str:
        return chain_words(self.element.origin.expansions)


def unusable_values(robot: Robot) -> list[Defect]:
    """Return the defects of values that are invalid, or missing without a valid default."""
    unusable = [problem for problem in robot.problems if _is_unusable(problem)]
    by_element = owners(robot) if unusable else {}
    return [_unusable(problem, by_element) for problem in unusable]


def _is_unusable(problem: Problem) -> bool:
    """Return whether a value is invalid, or missing without a valid default (urdfdom rejects these too)."""
    tag = problem.element.tag
    if tag in _UNREAD:
        return False
    if problem.kind not in _HARMLESS:
        return True
    if problem.kind in ("zero", "version"):
        return False  # see `repaired_values`
    if problem.kind == "unknown-value":
        return tag == "joint"
    return tag in ("limit", "inertia", "mass") or (tag, problem.attribute) in _NEEDED


def _unusable(problem: Problem, by_element: Mapping[Element, Owner]) -> Defect:
    element = problem.element
    code, effect = _CODES.get(problem.kind, "E014"), "the value is ignored"
    if element.tag == "joint":
        code, effect = "J402" if problem.kind == "unknown-value" else "J401", "the joint is fixed"
    elif element.tag in ("parent", "child"):
        effect = LEFT_OUT
    elif problem.kind == "conflict":
        effect = f"`{problem.attribute}` is used"
    elif element.tag == "limit" and problem.kind == "missing":
        code, effect = ("E014", "it is 0") if problem.attribute in ("lower", "upper") else ("J404", effect)
    elif element.tag in _SHAPES:
        effect = "the shape is unknown"
    link, joint = by_element.get(element, (None, None))
    return Defect(problem.message, effect, code, element, link, joint, problem.attribute)
