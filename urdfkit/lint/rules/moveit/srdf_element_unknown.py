"""M102 srdf-element-unknown."""

from __future__ import annotations

from urdfkit.defect_message import Suggestion
from urdfkit.description.xml.element import Element
from urdfkit.lint.fix_builders import nearest
from urdfkit.lint.rule import Findings, Model, RobotRule

_TYPES = ("fixed", "floating", "planar")
_REASONS = ("Never", "Default", "Adjacent", "Always", "User")
"""Reasons of the MoveIt Setup Assistant; it reads other reasons as ``User``."""


class SrdfElementUnknown(RobotRule):
    """An SRDF has a misspelt element, a misspelt or missing attribute, an empty group, or a wrong ``reason``.

    ## What it does
    Compares elements and attributes with the names that srdfdom reads. Elements of other programs are accepted unless
    their names nearly match one of the names that srdfdom reads. A misspelt ``reason`` of a disabled pair is reported
    as a note. The reason ``Adjacent`` is reported as a note if there are several moving joints between the links.

    ## Why is this bad?
    srdfdom ignores the element: the group does not exist, or the links collide.

    ## Example
    ```diff
     <robot name="arm">
       <group name="arm">
    -    <chain base_link="base" tip="hand"/>
    +    <chain base_link="base" tip_link="hand"/>
       </group>
     </robot>
    ```

    ## Fix safety
    Unsafe: the fix replaces a misspelt name with the nearest known name, which may not be the intended one.
    """

    code = "M102"
    name = "srdf-element-unknown"
    fix = "unsafe"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each element or attribute that srdfdom does not read."""
        from urdfkit.lint.facts.moveit.srdf import ELEMENTS, OPTIONAL, elements, semantics_of, severity_for

        for root in semantics_of(model):
            severity, weaker = (severity_for(root, model, each) for each in (self.severity, "warning"))
            for key, element in elements(root):
                attributes = ELEMENTS.get(key)
                if attributes is None:
                    parent, _, tag = key.rpartition("/")
                    tags = [other.rpartition("/")[2] for other in ELEMENTS if other.rpartition("/")[0] == parent]
                    suggestion = nearest(tag, tags, cutoff=0.8)
                    if suggestion is not None:
                        message = f"unknown element <{tag}> of SRDF" + Suggestion(f"<{suggestion}>", f"<{tag}>")
                        yield self.at(model, element, message, severity=severity, kind=suggestion)
                    continue
                missing = [name for name in attributes if name not in element.attributes and name not in OPTIONAL]
                for name in element.attributes:
                    suggestion = nearest(name, missing, cutoff=0.5) if name not in attributes else None
                    if suggestion is not None:
                        missing.remove(suggestion)
                        message = f"unknown attribute `{name}` of <{element.tag}>" + Suggestion(suggestion, name)
                        yield self.at(model, element, message, attribute=name, severity=severity, kind=element.tag)
                for name in missing:
                    message = f"<{element.tag}> has no attribute `{name}`"
                    yield self.at(model, element, message, severity=severity, kind=element.tag)
                if key == "group" and not element.children:
                    yield self.at(model, element, f"group `{element.get('name')}` is empty", severity=weaker)
                if key == "disable_collisions":
                    yield from self._reason(element, model)
                if key == "virtual_joint" and (kind := element.get("type")) not in (None, *_TYPES):
                    suggestion = nearest(kind or "", _TYPES)
                    hint = Suggestion(suggestion, kind)
                    message = f"unknown type `{kind}` of virtual joint `{element.get('name')}`" + hint
                    help = f"use one of {', '.join(_TYPES)}"
                    yield self.at(model, element, message, attribute="type", help=help, severity=severity)

    def _reason(self, pair: Element, model: Model) -> Findings:
        """Yield a finding for a disabled pair with a misspelt or wrong reason."""
        from urdfkit.lint.facts.moveit.srdf import near_links
        from urdfkit.lint.facts.root_cause import parent_at

        reason = pair.get("reason") or ""
        one, other = pair.get("link1") or "", pair.get("link2") or ""
        links = model.robot.link_by_name
        near = nearest(reason, _REASONS, cutoff=0.7) if reason not in _REASONS else None
        if near is not None and near.lower() != reason.lower():
            message = f"unknown reason `{reason}`" + Suggestion(near, reason)
            yield self.at(model, pair, message, attribute="reason", severity="note")
        elif reason == "Never" and (
            joint := next(
                (
                    each
                    for link in (one, other)
                    for each in model.robot.parents_of.get(link, ())
                    if {each.parent, each.child} == {one, other} and each.type != "fixed"
                ),
                None,
            )
        ):
            message = f"the reason is `Never`, but a joint connects links `{one}` and `{other}`"
            help, place = "write `Adjacent`", parent_at(model, joint)
            yield self.at(
                model,
                pair,
                message,
                attribute="reason",
                help=help,
                severity="note",
                kind="reason",
                other=place,
                cause="never",
            )
        elif reason != "Adjacent" or one not in links or other not in links or model.is_incomplete:
            return
        elif other not in near_links(one, model):
            message = f"the reason is `Adjacent`, but several joints separate links `{one}` and `{other}`"
            robot = model.robot
            last = next((joint for joint in reversed(robot.joints) if joint.child in (one, other)), None)
            place, names = parent_at(model, last), (one, other)
            yield self.at(
                model, pair, message, attribute="reason", severity="note", kind="reason", names=names, other=place
            )
