"""M104 srdf-name-undefined."""

from __future__ import annotations

from urdfkit.defect_message import Suggestion
from urdfkit.lint.facts.moveit.srdf import fits, groups, references, semantics_of, severity_for, virtual_joints
from urdfkit.lint.model.masked_names import unless_masked
from urdfkit.lint.rule import Findings, Model, RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

    from urdfkit.description.xml.element import Element
    from urdfkit.lint.facts.moveit.srdf import NameUse
    from urdfkit.lint.finding import Finding


class SrdfNameUndefined(RobotRule):
    """An SRDF names a link, joint or group that does not exist.

    ## What it does
    Compares the names in groups, chains, states, end effectors, virtual and passive joints and disabled collisions with
    the links and joints of the robot and the groups of the SRDF. A link or joint is accepted if another description in
    these packages, or an argument, may define it.

    ## Why is this bad?
    MoveIt ignores the group, state or end effector, and planning for it fails. Unknown links in
    ``<disable_collisions>`` leave the collision check on: the robot collides with itself in every state.

    ## Example
    ```diff
     <robot name="arm">
       <group name="arm">
    -    <chain base_link="base" tip_link="hnad"/>
    +    <chain base_link="base" tip_link="hand"/>
       </group>
     </robot>
    ```

    ## Fix safety
    Unsafe: the fix replaces a misspelt name with the nearest known name, which may not be the intended one.
    """

    code = "M104"
    name = "srdf-name-undefined"
    fix = "unsafe"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each undefined name."""
        from urdfkit.lint.facts.moveit.group_joints import group_of_states
        from urdfkit.lint.facts.ros_packages import is_slip
        from urdfkit.lint.fix_builders import meant

        robot = model.robot
        for root in semantics_of(model):
            if not fits(root, robot):
                continue
            joints = (*robot.joint_by_name, *virtual_joints(root), "root_joint")  # the free joint of Pinocchio
            existing = {"link": tuple(robot.link_by_name), "joint": joints, "group": tuple(groups(root))}
            uses: dict[tuple[str, str], list[NameUse]] = {}
            for reference in references(root):
                uses.setdefault((reference.kind, reference.name), []).append(reference)
            for (kind, name), places in uses.items():
                if name in existing[kind]:
                    continue
                other = {"link": "joint", "joint": "link"}.get(kind, "")
                if name in existing.get(other, ()) and places[0].element.tag == kind:
                    hint = f"; it is a {other}: write <{other}>"
                    yield self._undefined(places[0], root, model, hint, len(places))
                    continue
                is_accepted = kind != "group" and not _lacks_a_prefix(root, places, existing[kind])
                if is_accepted and model.neighbouring_descriptions.define(kind, name):
                    continue
                suggestion, hint = meant(name, existing[kind])
                # A group that has the name of another one, which srdf-duplicate reports, leaves its own undefined.
                if kind == "group" and len(groups(root)) < len(root.find_all("group")):
                    continue
                if kind == "group" and suggestion is None:  # short names such as `arm`
                    slip = next((each for each in existing[kind] if is_slip(name, each)), None)
                    hint = Suggestion(slip, name)
                unused = [each for each in groups(root) if kind == "group" and (kind, each) not in uses]
                misnamed = suggestion if suggestion in unused else group_of_states(name, unused, root, robot)
                if misnamed is not None and len(places) > 1:
                    message = f"group `{misnamed}` is not used; did you mean `{name}`, which is used but undefined?"
                    group, severity = groups(root)[misnamed], severity_for(root, model)
                    yield self.at(
                        model, group, message, attribute="name", severity=severity, kind="unused", names=(name,)
                    )
                    continue
                finding = self._undefined(places[0], root, model, hint, len(places))
                yield from (finding,) if kind == "group" else unless_masked(model, name, suggestion, finding)

    def _undefined(self, reference: NameUse, root: Element, model: Model, hint: str, count: int) -> Finding:
        kind, name, tag = reference.kind, reference.name, reference.element.tag
        owner = f"robot `{model.robot.name}`" if kind != "group" else "this SRDF"
        others = f" (used {count} times)" if count > 1 else ""
        return self.at(
            model,
            reference.element,
            f"{kind} `{name}` of <{tag}> does not exist in {owner}{others}" + hint,
            attribute=reference.attribute,
            link=name if kind == "link" else None,
            joint=name if kind == "joint" else None,
            names=(name,) if kind == "group" else (),
            kind=kind,
            severity=severity_for(root, model, "warning" if tag.endswith("_collisions") else self.severity),
        )


def _lacks_a_prefix(root: Element, places: Sequence[NameUse], existing: Sequence[str]) -> bool:
    """Return whether a name is a defined one without its prefix, which all other names around it have."""
    use = places[0]
    longer = [each for each in existing if each.endswith(f"_{use.name}")]
    if len(longer) != 1 or len(places) != 1:
        return False
    prefix = longer[0].removesuffix(use.name)
    around = next((each for each in root.children if use.element in each.children), root)
    others = [each.get(use.attribute) for each in around.children if each.tag == use.element.tag]
    others = [each for each in others if each != use.name]
    return len(others) > 1 and all(each in existing and each.startswith(prefix) for each in others if each is not None)
