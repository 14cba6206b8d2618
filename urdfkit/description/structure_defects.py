"""Structure of a robot: the defects that keep its links from being one valid tree, and a robot without them."""

from collections import Counter
from collections.abc import Iterable
from dataclasses import replace

from urdfkit.description.unusable_values import LEFT_OUT, Defect, unusable_values
from urdfkit.description.urdf.queries import cycles, is_loop, likely_children, repeated
from urdfkit.description.urdf.robot import Joint, Link, Pose, Robot
from urdfkit.description.xml.element import Element
from urdfkit.errors import did_you_mean

_HINTS = 20
"""Number of defects whose messages suggest a similar name."""


def repaired_structure(robot: Robot) -> tuple[Robot, list[Defect]]:
    """Return a robot whose links are one valid tree, and the defects of the robot, the most important one first.

    A link that does not exist becomes an empty link. A link with two parents keeps the first, a loop is cut at its
    last joint, and further roots are fixed to the origin of the largest tree. A valid robot is returned unchanged.

    Args:
        robot: a robot with at least one link.
    """
    defects = unusable_values(robot)
    structure = _Structure(robot, defects)
    structure.name_parts()
    structure.connect_joints()
    structure.cut_loops()
    structure.join_trees()
    structure.release_mimics()
    if not defects:
        return robot, []
    return replace(robot, links=tuple(structure.links), joints=tuple(structure.joints)), defects


class _Structure:
    """Links and joints while they are repaired."""

    def __init__(self, robot: Robot, defects: list[Defect]) -> None:
        self.robot, self.defects = robot, defects
        self.links, self.joints = list(robot.links), list(robot.joints)
        self._detached: dict[str, int] = {}
        """Link without a parent because of a defect that has been reported → index of the defect."""
        self._added: dict[int, str] = {}
        """Index of a defect → the empty link that is added for it."""
        self._left_out = {defect.element: i for i, defect in enumerate(defects) if defect.effect == LEFT_OUT}
        """Element without which a joint is ignored → index of its defect."""
        self._childless: int | None = None
        """Index of the defect of a joint without child, which may be any link without parent."""

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
            message = f"two links are named `{link.name}`; the first is at {at}"
            self._add(message, "this one is ignored", "T206", link.element, link=link.name)
        for joint, original in repeated(self.robot.joints):
            message = f"two joints are named `{joint.name}`; the first is at {original.element.origin.position}"
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
        meant = likely_children(self.robot, most=_HINTS)
        parents = Counter(joint.child for joint in self.joints)
        for joint in self.joints:
            for end, name in (("parent", joint.parent), ("child", joint.child)):
                if name is None and joint.element.find(end) is None:
                    message = f"joint `{joint.name}` lacks <{end} link=…>"
                    self._add(message, LEFT_OUT, "E014", joint.element, joint=joint.name)
                    self._left_out[joint.element] = len(self.defects) - 1
                elif name is not None and name not in names:
                    element = joint.element.find(end) or joint.element
                    message = f"joint `{joint.name}`: its {end} link `{name}` does not exist"
                    code = "T201" if end == "parent" else "T202"
                    hint = self._similar(name, self.robot.link_by_name)
                    effect = f"an empty link `{name}` is added" if name else LEFT_OUT
                    self._add(message + hint, effect, code, element, joint=joint.name)
                    at = len(self.defects) - 1
                    if not name:
                        self._left_out[element] = at
                    elif name not in undefined:
                        undefined[name] = element
                        self._detached[name] = at
                        self._added[at] = name
                    if end == "child" and name in meant:
                        self._detached.setdefault(meant[name], at)
            if not joint.parent or not joint.child:
                parts = (joint.element, joint.element.find("parent"), joint.element.find("child"))
                at = next(self._left_out[part] for part in parts if part in self._left_out)
                self._detached.setdefault(joint.child or "", at)
                if joint.child is None:
                    self._childless = at
                continue
            if is_loop(joint):
                message = f"joint `{joint.name}` connects link `{joint.child}` with itself"
                element = joint.element.find("parent" if parents[joint.child] == 1 else "child") or joint.element
                self._add(message, LEFT_OUT, "T204", element, link=joint.child, joint=joint.name)
                self._detached.setdefault(joint.child, len(self.defects) - 1)
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
                effect = f"joint `{joint.name}` is ignored"
                self._add(message, effect, code, element, link=joint.child, joint=joint.name)
        self.links += [Link(name, None, (), (), element) for name, element in undefined.items()]
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
            effect = f"joint `{last.name}` is ignored"
            self._add(message, effect, "T204", last.element, joint=last.name)
            self._detached.setdefault(last.child or "", len(self.defects) - 1)
        self.joints = [joint for joint in self.joints if joint.name not in cut]

    def join_trees(self) -> None:
        """Fix the roots of all trees to the root of the largest one."""
        children = {joint.child for joint in self.joints}
        roots = [link for link in self.links if link.name not in children]
        if len(roots) < 2:
            return
        if self._childless is not None:
            self._detached = {link.name: self._childless for link in roots} | self._detached
        size = self._tree_sizes(roots)
        written = [link for link in roots if link.name not in self._detached]
        main = max(written or roots, key=lambda link: size[link.name])
        if len(written) > 1:
            self._report_roots([link for link in written if link is not main], main)
        names = Names(joint.name for joint in self.joints)
        fixed: dict[int, list[str]] = {}
        for link in roots:
            if link is not main:
                self.joints.append(_fixed(names.unused(f"{main.name}_to_{link.name}"), main.name, link))
                if link.name in self._detached:
                    fixed.setdefault(self._detached[link.name], []).append(link.name)
        for at, links in fixed.items():
            words = ", fixed" if links == [self._added.get(at)] else f"; {_fixed_words(links)}"
            effect = f"{self.defects[at].effect}{words}"
            self.defects[at] = replace(self.defects[at], effect=f"{effect} to the origin of `{main.name}`")

    def _report_roots(self, others: list[Link], main: Link) -> None:
        names = _listed([link.name for link in others])
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
                message = f"joint `{joint.name}` mimics the unknown joint `{mimic.joint}`" + hint
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


def _listed(links: list[str]) -> str:
    """Return the names of three links, and the number of the others."""
    more = f" and {len(links) - 3} more" if len(links) > 3 else ""
    return ", ".join(f"`{link}`" for link in links[:3]) + more


def _fixed_words(links: list[str]) -> str:
    """Return words for links that are fixed to the origin of another one."""
    return f"{_listed(links)} {'is' if len(links) == 1 else 'are'} fixed"


def _fixed(name: str, parent: str, link: Link) -> Joint:
    """Return a fixed joint at the origin of its parent."""
    return Joint(name, "fixed", parent, link.name, Pose(), (1.0, 0.0, 0.0), None, None, None, None, None, link.element)
