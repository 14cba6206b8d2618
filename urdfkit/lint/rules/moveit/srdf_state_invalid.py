"""M107 srdf-state-invalid."""

from __future__ import annotations

import math
from collections.abc import Iterator

from urdfkit.description.xml.element import Element
from urdfkit.description.xml.source import Span
from urdfkit.lint.finding import Severity
from urdfkit.lint.rule import Findings, Model, RobotRule

_TOLERANCE = 0.005
"""Accepted excess over a limit [rad or m]; angles in SRDF are often rounded to two decimals."""

_MAX_FOREIGN = 1
"""Number of joints of other groups in a state above which they have one finding."""

_SEVERAL = 2
"""Number of states that agree, from which on their group is wrong."""

_COUNT = {"revolute": 1, "continuous": 1, "prismatic": 1, "planar": 3, "floating": 7}
"""Joint type → number of values in a state (moveit_core, JointModel::getVariableCount)."""


class SrdfStateInvalid(RobotRule):
    """A state of a group exceeds the limits of a joint, or contains the wrong joints.

    ## What it does
    Compares the values of each ``<group_state>`` with the limits and types of the joints, and its joints with the
    active joints of its group. If a group has several states, and all of them set a joint that is not in the group, or
    omit a joint of the group, the finding is at the group. A value that MoveIt cannot use is reported as an error.

    ## Why is this bad?
    MoveIt rejects a goal beyond the limits, and ignores values for joints of other groups.

    ## Example
    ```diff
     <robot name="arm">
       <group name="arm">
         <joint name="elbow"/>
       </group>
       <group_state name="folded" group="arm">
    -    <joint name="elbow" value="90"/>
    +    <joint name="elbow" value="1.5708"/>
       </group_state>
     </robot>
    ```
    """

    code = "M107"
    name = "srdf-state-invalid"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each invalid value, and for joints that are missing in a state or in its group."""
        from urdfkit.lint.facts.moveit.reversed_limits import reversed_limits
        from urdfkit.lint.facts.moveit.srdf import fits, joints_of, semantics_of, severity_for
        from urdfkit.lint.fix_builders import nearest

        robot = model.robot
        if model.is_incomplete:
            return
        for root in semantics_of(model):
            severity = severity_for(root, model)
            passive = {element.get("name") for element in root.find_all("passive_joint")}
            wrong = dict(self._exchanged(root, model))
            for group, (element, counterpart) in wrong.items():
                joint = element.get("name")
                message = f"group `{group}` contains joint `{joint}`, but its states have values for `{counterpart}`"
                yield self.at(
                    model,
                    element,
                    message,
                    attribute="name",
                    joint=joint,
                    severity=severity,
                    names=(counterpart, group),
                )
            excluded: set[str] = set()
            for joints, numbers in reversed_limits(root, robot):
                excluded |= {joint.name for joint in joints}
                limit = joints[0].limit
                shown = ", ".join(f"{number:g}" for number in dict.fromkeys(numbers))
                message = f"the limits of joint `{joints[0].name}` exclude all states of the SRDF ({shown})"
                if limit is not None:
                    help = "check the signs of the limits"
                    yield self.at(model, limit.element, message, joint=joints[0].name, severity=severity, help=help)
            is_complete = fits(root, robot)
            common = _in_all_states(root, model) if is_complete else {}
            for group, (element, names, is_foreign) in common.items():
                if group in wrong:
                    continue
                shown = ", ".join(f"`{name}`" for name in names)
                message = f"all states of group `{group}` set {shown}, which the group does not contain"
                if not is_foreign:
                    message = f"no state of group `{group}` has a value for {shown}, which the group contains"
                other, moved = _branch(names[0], joints_of(group, root, robot) or set(), model)
                kind, named = "foreign" if is_foreign else "", (group, *names, *moved)
                yield self.at(
                    model, element, message, joint=names[0], severity=severity, kind=kind, names=named, other=other
                )
            for state in root.find_all("group_state"):
                group, values = state.get("group") or "", state.find_all("joint")
                is_compared = group not in wrong and is_complete
                members = (joints_of(group, root, robot) if is_compared else None) or set()
                for value in (value for value in values if value.get("name") not in excluded):
                    yield from self._value(value, model, severity_for(root, model, "error"))
                shared = common[group][1] if group in common else ()
                foreign = [
                    value for value in values if members and value.get("name") in robot.joint_by_name.keys() - members
                ]
                foreign = [value for value in foreign if value.get("name") not in shared]
                if len(foreign) > _MAX_FOREIGN:
                    listed = [f"`{value.get('name')}`" for value in foreign[:3]] + ["…"] * (len(foreign) > 3)
                    message = f"joints {', '.join(listed)} of state `{state.get('name')}` are not in group `{group}`"
                    yield self.at(model, state, message, severity=severity, kind="foreign", names=(group,))
                for value in foreign if len(foreign) <= _MAX_FOREIGN else ():
                    message = cause = f"joint `{value.get('name')}` is not in group `{group}`"
                    name = value.get("name") or ""
                    other, moved = _branch(name, members, model)
                    yield self.at(
                        model,
                        value,
                        message,
                        attribute="name",
                        joint=name,
                        severity=severity,
                        cause=cause,
                        kind="foreign",
                        names=(group, *moved),
                        other=other,
                    )
                yield from self._mimics(state, model, severity)
                valued = {value.get("name") for value in values}
                missing = [
                    joint.name
                    for joint in robot.joints
                    if joint.name in members and joint.type in _COUNT and joint.mimic is None
                    if joint.name not in valued and joint.name not in passive
                ]
                unknown = [name for name in valued if name and name not in robot.joint_by_name]
                missing = [name for name in missing if name not in shared]
                missing = [name for name in missing if nearest(name, unknown, cutoff=0.7) is None]  # it is misspelt
                if foreign and len(foreign) == len(values) and not shared:
                    continue  # The state is for another group.
                if len(missing) > len(foreign):  # otherwise the foreign joints stand for the missing ones
                    shown = ", ".join(f"`{name}`" for name in missing[:4]) + (" …" if len(missing) > 4 else "")
                    message = f"state `{state.get('name')}` has no value for {shown} of group `{group}`"
                    named = (state.get("name") or "",)
                    yield self.at(model, state, message, joint=missing[0], severity=severity, names=named)

    def _mimics(self, state: Element, model: Model, severity: Severity | None) -> Findings:
        """Yield a finding for each value of a mimic joint that contradicts the value of the joint it follows."""
        from urdfkit.description.xml.numbers import number

        written = {value.get("name"): (value, number(value.get("value") or "")) for value in state.find_all("joint")}
        for name, (value, stated) in written.items():
            joint = model.robot.joint_by_name.get(name or "")
            mimic = joint.mimic if joint is not None else None
            _, followed = written.get(mimic.joint, (None, None)) if mimic is not None else (None, None)
            if mimic is None or stated is None or followed is None:
                continue
            right = mimic.multiplier * followed + mimic.offset
            if abs(stated - right) > max(2.0 * _TOLERANCE, 0.05 * abs(right)):
                message = f"joint `{name}` mimics `{mimic.joint}`, so its value is {right:.4g}, not {stated:g}"
                help = f"remove the value, or write {right:.4g}"
                yield self.at(model, value, message, attribute="value", joint=name, help=help, severity=severity)

    def _exchanged(self, root: Element, model: Model) -> Iterator[tuple[str, tuple[Element, str]]]:
        """Yield each group with a joint whose mirrored joint has a value in all states of the group instead."""
        from urdfkit.lint.facts.moveit.srdf import groups, joints_of
        from urdfkit.lint.facts.twins import mirrored

        for group in root.find_all("group"):
            name = group.get("name") or ""
            elsewhere = {
                joint for each in groups(root) if each != name for joint in joints_of(each, root, model.robot) or ()
            }
            states = [state for state in root.find_all("group_state") if state.get("group") == name]
            valued = [{value.get("name") for value in state.find_all("joint")} for state in states]
            listed = {each.get("name") for each in group.find_all("joint")}
            is_complete = listed <= model.robot.joint_by_name.keys()
            for element in group.find_all("joint") if is_complete else ():  # an undefined joint may be misspelt
                joint = element.get("name") or ""
                for other in mirrored(joint):
                    is_other = other in model.robot.joint_by_name and other not in listed
                    if len(valued) == 1 and other in elsewhere and joint not in elsewhere:
                        continue  # The state is for the other group.
                    if is_other and valued and all(joint not in each and other in each for each in valued):
                        yield name, (element, other)

    def _value(self, value: Element, model: Model, severity: Severity | None) -> Findings:
        from urdfkit.lint.facts.root_cause import type_at

        name, text = value.get("name") or "", value.get("value")
        joint = model.robot.joint_by_name.get(name)
        if joint is None or text is None:
            return

        def found(kind: str, message: str, help: str | None = None) -> Findings:
            of_type = type_at(model, joint) if joint.type == "fixed" else (None, False)
            yield self.at(
                model,
                value,
                message,
                attribute="value",
                joint=name,
                help=help,
                severity=severity,
                kind=kind,
                other=of_type[0],
                is_other_wrong=of_type[1],
            )

        try:
            numbers = [float(word) for word in text.split()]
        except ValueError:
            yield from found("text", f"value `{text}` of joint `{name}` is not a number")
            return
        count = _COUNT.get(joint.type or "")
        if joint.type == "fixed":
            yield from found("fixed", f"joint `{name}` is fixed and has no value")
        elif count is not None and len(numbers) != count:
            yield from found("count", f"joint `{name}` has {len(numbers)} values; a {joint.type} joint has {count}")
        elif joint.type in ("revolute", "prismatic") and joint.limit is not None:
            lower, upper = joint.limit.lower or 0.0, joint.limit.upper or 0.0
            if lower < upper and not lower - _TOLERANCE <= numbers[0] <= upper + _TOLERANCE:
                unit = "rad" if joint.type == "revolute" else "m"
                radians = math.radians(numbers[0])
                in_degrees = unit == "rad" and abs(numbers[0]) > math.tau and lower <= radians <= upper
                limits = f"{lower:g} … {upper:g} {unit}"
                message = f"value {numbers[0]:g} {unit} of joint `{name}` is beyond its limits {limits}"
                help = f"write {radians:.5g} if the value is in degrees" if in_degrees else None
                yield from found(unit, message, help)


def _in_all_states(root: Element, model: Model) -> dict[str, tuple[Element, tuple[str, ...], bool]]:
    """Return the groups of which several states all set joints that it lacks, or all lack joints that it contains.

    The values are the element to edit, the joints, and whether the group lacks them.
    """
    from urdfkit.lint.facts.moveit.srdf import joints_of

    joints = model.robot.joint_by_name
    found: dict[str, tuple[Element, tuple[str, ...], bool]] = {}
    passive = {element.get("name") for element in root.find_all("passive_joint")}
    for group in root.find_all("group"):
        name = group.get("name") or ""
        states = [state for state in root.find_all("group_state") if state.get("group") == name]
        members = joints_of(name, root, model.robot) or set()
        if len(states) < _SEVERAL or not members:
            continue
        valued = [{value.get("name") or "" for value in state.find_all("joint")} for state in states]
        lacking = sorted(set.intersection(*(each & (joints.keys() - members) for each in valued)))
        needed = {each for each in members & joints.keys() if joints[each].type in _COUNT}
        needed = {each for each in needed if joints[each].mimic is None} - passive
        unset = sorted(set.intersection(*(needed - each for each in valued)))
        if not all(each & members and each <= joints.keys() for each in valued) or (lacking and unset):
            continue  # states of another group, or misspelt names
        place = next((each for each in group.children if each.tag == "chain"), group)
        if lacking or unset:
            found[name] = (place, tuple(lacking or unset), bool(lacking))
    return found


def _branch(name: str, members: set[str], model: Model) -> tuple[Span | None, list[str]]:
    """Return the parent of the only joint of a group that is a branch next to a joint outside of the group.

    The second value has the names of the links that the joint of the group carries.
    """
    from urdfkit.lint.facts.root_cause import parent_at
    from urdfkit.lint.model.placement import links_below

    joints = model.robot.joint_by_name
    branch = [each for each in members if name in joints and each in joints]
    branch = [each for each in branch if joints[each].parent == joints[name].parent]
    if len(branch) != 1:
        return None, []
    joint = joints[branch[0]]
    return parent_at(model, joint), sorted(links_below(model.robot, joint.child or ""))
