"""M105 srdf-group-inconsistent."""

from __future__ import annotations

from urdfkit.description.xml.element import Element
from urdfkit.lint.rule import Findings, Model, RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from urdfkit.lint.finding import Severity


class SrdfGroupInconsistent(RobotRule):
    """A chain, subgroup, end effector or virtual joint of an SRDF contradicts the tree of the robot.

    ## What it does
    Checks that the tip of a chain is below its base, that groups do not contain themselves, that parent link and parent
    group of an end effector are not its own group, and that a virtual joint ends at the root link.

    ## Why is this bad?
    The group lacks its joints, and planning fails; MoveIt skips a virtual joint whose child is not the root link.

    ## Example
    ```xml
    <robot name="arm">
      <group name="arm">
        <chain base_link="hand" tip_link="base"/>
      </group>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm">
      <group name="arm">
        <chain base_link="base" tip_link="hand"/>
      </group>
    </robot>
    ```
    """

    code = "M105"
    name = "srdf-group-inconsistent"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each contradiction."""
        from urdfkit.lint.facts.moveit.srdf import groups, path_between, semantics_of, severity_for

        if model.is_incomplete:
            return
        roots = model.robot.roots()
        root_link = roots[0].name if len(roots) == 1 else ""
        for root in semantics_of(model):
            by_name, severity = groups(root), severity_for(root, model)
            for name, group in by_name.items():
                empty = severity_for(root, model, "error")  # MoveIt has no joints to plan for
                for chain in group.find_all("chain"):
                    yield from self._chain(chain, model, empty)
                for below in group.find_all("group"):
                    if _contains(below.get("name") or "", name, by_name):
                        yield self.at(model, below, f"group `{name}` contains itself", attribute="name", severity=empty)
            for joint in root.find_all("virtual_joint"):
                child = joint.get("child_link") or ""
                if root_link and child != root_link and child in model.robot.link_by_name:
                    message = (
                        f"virtual joint `{joint.get('name')}` ends at `{child}`, but the root link is `{root_link}`"
                    )
                    help = f"write `{root_link}`"
                    yield self.at(model, joint, message, attribute="child_link", help=help, severity=severity)
            for effector in root.find_all("end_effector"):
                name, parent = effector.get("group") or "", effector.get("parent_link") or ""
                links = [link.get("name") for link in by_name[name].find_all("link")] if name in by_name else []
                for chain in by_name[name].find_all("chain") if name in by_name else ():
                    ends = (chain.get("base_link") or "", chain.get("tip_link") or "")
                    links += [joint.child for joint in path_between(*ends, model.robot) or ()]
                if name and name == effector.get("parent_group"):
                    message = f"group `{name}` of end effector `{effector.get('name')}` is its own parent group"
                    yield self.at(model, effector, message, attribute="parent_group", severity=severity)
                if parent in links:
                    message = f"parent link `{parent}` of end effector `{effector.get('name')}` is in group `{name}`"
                    help = "write the link of the arm that carries the group"
                    yield self.at(model, effector, message, attribute="parent_link", help=help, severity=severity)

    def _chain(self, chain: Element, model: Model, severity: Severity | None) -> Findings:
        from urdfkit.lint.facts.moveit.srdf import path_between

        robot = model.robot
        base, tip = chain.get("base_link") or "", chain.get("tip_link") or ""
        if base not in robot.link_by_name or tip not in robot.link_by_name:
            return
        if base == tip:
            message = f"the chain from `{base}` to `{tip}` has no joint"
            yield self.at(model, chain, message, attribute="tip_link", severity=severity)
        elif path_between(base, tip, robot) is None:
            swapped = path_between(tip, base, robot) is not None
            help = "swap base_link and tip_link" if swapped else None
            message = f"tip link `{tip}` is not below base link `{base}`"
            yield self.at(model, chain, message, help=help, severity=severity)


def _contains(name: str, wanted: str, by_name: dict[str, Element]) -> bool:
    """Return whether a group is, or contains, another group."""
    pending, seen = [name], set[str]()
    while pending:
        name = pending.pop()
        if name == wanted:
            return True
        if name not in seen and name in by_name:
            seen.add(name)
            pending += [child.get("name") or "" for child in by_name[name].find_all("group")]
    return False
