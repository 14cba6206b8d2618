"""Structure of a robot: the defects that keep its links from being one valid tree, and a robot without them."""

from __future__ import annotations

from dataclasses import replace

from urdfkit.description.urdf.queries import cycles, owners, repeated
from urdfkit.description.urdf.repair_record import Repair
from urdfkit.description.urdf.robot import Joint, Link, Pose, Problem, Robot
from urdfkit.description.xacro.evaluation.failures import chain_words
from urdfkit.description.xml.element import Element
from urdfkit.errors import ModelError, did_you_mean, with_effect
from urdfkit.record import field, record

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from urdfkit.description.urdf.queries import Owner
    from urdfkit.position import Position

_HARMLESS = frozenset({"unknown-value", "missing", "zero", "version"})
_NEEDED = {("joint", "type"), ("parent", "link"), ("child", "link"), ("mimic", "joint")}
_UNREAD = frozenset({"mechanicalReduction"})
"""Elements whose text neither urdfkit nor urdfdom uses; only the linter checks them."""
_CODES = {"bad-number": "E010", "wrong-arity": "E011", "not-finite": "E012", "conflict": "E023"}
_SHAPES = frozenset({"box", "cylinder", "sphere", "capsule"})
_HINTS = 20
"""Number of defects whose messages suggest a similar name."""


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


def repaired_structure(robot: Robot) -> tuple[Robot, list[Defect]]:
    """Return a robot whose links are one valid tree, and the defects of the robot, the most important one first.

    A link that does not exist becomes an empty link. A link with two parents keeps the first, a loop is cut at its
    last joint, and further roots are fixed to the origin of the largest tree. A valid robot is returned unchanged.

    Args:
        robot: a robot with at least one link.
    """
    unusable = [problem for problem in robot.problems if _is_unusable(problem)]
    by_element = owners(robot) if unusable else {}
    defects = [_unusable(problem, by_element) for problem in unusable]
    structure = _Structure(robot, defects)
    structure.name_parts()
    structure.connect_joints()
    structure.cut_loops()
    structure.join_trees()
    structure.release_mimics()
    if not defects:
        return robot, []
    return replace(robot, links=tuple(structure.links), joints=tuple(structure.joints)), defects


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
        effect = "the joint is left out"
    elif problem.kind == "conflict":
        effect = f"`{problem.attribute}` is used"
    elif element.tag == "limit" and problem.kind == "missing":
        code, effect = ("E014", "it is 0") if problem.attribute in ("lower", "upper") else ("J404", effect)
    elif element.tag in _SHAPES:
        effect = "the shape is unknown"
    link, joint = by_element.get(element, (None, None))
    return Defect(problem.message, effect, code, element, link, joint, problem.attribute)


class _Structure:
    """Links and joints while they are repaired."""

    def __init__(self, robot: Robot, defects: list[Defect]) -> None:
        self.robot, self.defects = robot, defects
        self.links, self.joints = list(robot.links), list(robot.joints)
        self._detached: set[str] = set()
        """Links without a parent because of a defect that has been reported."""

    def _add(
        self,
        message: str,
        effect: str,
        code: str,
        element: Element,
        *,
        link: str | None = None,
        joint: str | None = None,
    ) -> None:
        self.defects.append(Defect(message, effect, code, element, link, joint))

    def _similar(self, name: str, names: Iterable[str]) -> str:
        return did_you_mean(name, names) if len(self.defects) < _HINTS else ""

    def name_parts(self) -> None:
        """Give names to parts without one, keep the first of links with the same name, and rename such joints."""
        nameless = [part.element for part in self.links if not part.name]
        for element in nameless + [part.element for part in self.joints if not part.name]:
            self._add(f"a <{element.tag}> has no name", f"it is called `unnamed_{element.tag}`", "E014", element)
        first = self.robot.link_by_name
        for link, other in repeated(self.robot.links):
            at = other.element.origin.position
            message = f"two links are called `{link.name}`; the first is at {at}"
            self._add(message, "this one is left out", "T206", link.element, link=link.name)
        for joint, original in repeated(self.robot.joints):
            message = f"two joints are called `{joint.name}`; the first is at {original.element.origin.position}"
            self._add(message, "this one is renamed", "T207", joint.element, joint=joint.name)
        if not self.defects:
            return
        names, kept = Names(first), []
        for link in self.links:
            if not link.name:
                kept.append(replace(link, name=names.unused("unnamed_link")))
            elif first[link.name] is link:
                kept.append(link)
        self.links = kept
        names = Names(self.robot.joint_by_name)
        for i, joint in enumerate(self.joints):
            if not joint.name:
                self.joints[i] = replace(joint, name=names.unused("unnamed_joint"))
            elif self.robot.joint_by_name[joint.name] is not joint:
                self.joints[i] = replace(joint, name=names.unused(joint.name))

    def connect_joints(self) -> None:
        """Give each joint a parent and a child, a type, an axis, and each link at most one parent."""
        names = {link.name for link in self.links}
        undefined: dict[str, Element] = {}
        kept: dict[str, Joint] = {}
        for joint in self.joints:
            for end, name in (("parent", joint.parent), ("child", joint.child)):
                if name is None and joint.element.find(end) is None:
                    message = f"joint `{joint.name}` lacks <{end} link=…>"
                    self._add(message, "the joint is left out", "E014", joint.element, joint=joint.name)
                elif name is not None and name not in names:
                    element = joint.element.find(end) or joint.element
                    if name:
                        undefined.setdefault(name, element)
                    message = f"joint `{joint.name}`: its {end} link `{name}` does not exist"
                    code = "T201" if end == "parent" else "T202"
                    hint = self._similar(name, self.robot.link_by_name)
                    effect = f"an empty link `{name}` is added" if name else "the joint is left out"
                    self._add(message + hint, effect, code, element, joint=joint.name)
            if not joint.parent or not joint.child:
                self._detached.add(joint.child or "")
                continue
            joint = self._movable(joint)
            if (other := kept.setdefault(joint.child or "", joint)) is not joint:
                message = (
                    f"link `{joint.child}` is the child of two joints, `{other.name}` "
                    f"({other.element.origin.position}) and `{joint.name}`"
                )
                is_repeated = joint.element.get("name") == other.element.get("name")
                child = joint.element.find("child") or joint.element
                code, element = ("T207", joint.element) if is_repeated else ("T205", child)
                effect = f"joint `{joint.name}` is left out"
                self._add(message, effect, code, element, link=joint.child, joint=joint.name)
        self.links += [Link(name, None, (), (), element) for name, element in undefined.items()]
        self._detached.update(undefined)
        if self.defects:
            self.joints = list(kept.values())

    def _movable(self, joint: Joint) -> Joint:
        """Return a joint with a usable type and axis."""
        if joint.type in ("revolute", "prismatic") and joint.limit is None:
            wanted = '<limit lower="…" upper="…" effort="…" velocity="…"/>'
            message = f"{joint.type} joint `{joint.name}` lacks {wanted}"
            self._add(message, "it moves without limits", "J403", joint.element, joint=joint.name)
        if joint.is_movable and joint.type != "floating" and not joint.has_axis:
            element = joint.element.find("axis") or joint.element
            size = "zero" if max(map(abs, joint.axis)) < 1.0 else "too large"
            self._add(f"the axis of joint `{joint.name}` is {size}", "it is 1 0 0", "J411", element, joint=joint.name)
            return replace(joint, axis=(1.0, 0.0, 0.0))
        return joint if joint.is_movable or joint.type == "fixed" else replace(joint, type="fixed")

    def cut_loops(self) -> None:
        """Remove the last joint of each kinematic loop."""
        robot = self.robot
        if self.defects:
            robot = replace(robot, links=tuple(self.links), joints=tuple(self.joints))
        order = {joint.name: i for i, joint in enumerate(self.joints)}
        cut = set()
        for loop in cycles(robot):
            last = max(loop, key=lambda joint: order[joint.name])
            cut.add(last.name)
            names = [joint.parent or "" for joint in loop]
            message = f"the joints form a loop: {' → '.join([*names, names[0]])}"
            effect = f"joint `{last.name}` is left out"
            self._add(message, effect, "T204", last.element, joint=last.name)
            self._detached.add(last.child or "")
        self.joints = [joint for joint in self.joints if joint.name not in cut]

    def join_trees(self) -> None:
        """Fix the roots of all trees to the root of the largest one."""
        children = {joint.child for joint in self.joints}
        roots = [link for link in self.links if link.name not in children]
        if len(roots) < 2:
            return
        size = self._tree_sizes(roots)
        written = [link for link in roots if link.name not in self._detached]
        main = max(written or roots, key=lambda link: size[link.name])
        if len(written) > 1:
            self._report_roots([link for link in written if link is not main], main)
        names = Names(joint.name for joint in self.joints)
        for link in roots:
            if link is not main:
                self.joints.append(_fixed(names.unused(f"{main.name}_to_{link.name}"), main.name, link))

    def _report_roots(self, others: list[Link], main: Link) -> None:
        more = f" and {len(others) - 3} more" if len(others) > 3 else ""
        names = ", ".join(f"`{link.name}`" for link in others[:3]) + more
        verb = "has" if len(others) == 1 else "have"
        message = (
            f"{len(others) + 1} root links: {names} {verb} no parent joint; a joint to the tree of `{main.name}` "
            f"({main.element.origin.position}) is missing"
        )
        fixed = f"{names} is fixed" if len(others) == 1 else "they are fixed"
        effect = f"{fixed} to the origin of `{main.name}`"
        self._add(message, effect, "T203", others[0].element, link=others[0].name)

    def _tree_sizes(self, roots: list[Link]) -> dict[str, int]:
        """Return the number of links in the tree of each root."""
        below: dict[str, list[str]] = {}
        for joint in self.joints:
            below.setdefault(joint.parent or "", []).append(joint.child or "")
        sizes = {}
        for root in roots:
            count, stack = 0, [root.name]
            while stack:
                count += 1
                stack += below.get(stack.pop(), ())
            sizes[root.name] = count
        return sizes

    def release_mimics(self) -> None:
        """Remove the <mimic> of joints whose master does not exist."""
        names, by_name = {joint.name for joint in self.joints}, self.robot.joint_by_name
        for i, joint in enumerate(self.joints):
            mimic = joint.mimic
            if mimic is None or mimic.joint in names:
                continue
            if mimic.joint not in by_name:  # else the joint was left out
                hint = self._similar(mimic.joint, (name for name in by_name if name != joint.name))
                message = f"joint `{joint.name}` mimics the unknown joint `{mimic.joint}`{hint}"
                self._add(message, "it moves by itself", "J416", mimic.element, joint=joint.name)
            self.joints[i] = replace(joint, mimic=None)


class Names:
    """Names in use.

    Args:
        taken: the names.
    """

    def __init__(self, taken: Iterable[str]) -> None:
        self._taken = set(taken)
        self._last: dict[str, int] = {}

    def unused(self, name: str) -> str:
        """Return a name, with a number if it is in use already."""
        found, number = name, self._last.get(name, 1)
        while found in self._taken:
            number += 1
            found = f"{name}_{number}"
        self._last[name] = number
        self._taken.add(found)
        return found


def _fixed(name: str, parent: str, link: Link) -> Joint:
    """Return a fixed joint at the origin of its parent."""
    return Joint(name, "fixed", parent, link.name, Pose(), (1.0, 0.0, 0.0), None, None, None, None, None, link.element)
