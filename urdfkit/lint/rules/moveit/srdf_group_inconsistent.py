"""M105 srdf-group-inconsistent."""

from __future__ import annotations

from urdfkit.defect_message import Suggestion
from urdfkit.description.xml.element import Element
from urdfkit.lint.facts.moveit.srdf import groups, joints_of, path_between, semantics_of, severity_for
from urdfkit.lint.finding import Severity
from urdfkit.lint.rule import Findings, Model, RobotRule


class SrdfGroupInconsistent(RobotRule):
    """A chain, subgroup, end effector or virtual joint of an SRDF contradicts the tree of the robot.

    ## What it does
    Checks that

    - the tip of a chain is below its base, and a group does not contain itself
    - a chain of a group with `left` or `right` in its name does not end on the other side of the robot
    - the parent link of an end effector is above the end effector in the tree, is in the parent group, and is not in
      the group of the end effector
    - the parent group of an end effector is not its own group, nor a part of it
    - no other joint mimics a passive joint, and no controller moves it
    - a joint without a group is passive if its counterpart on the other side of the robot is passive
    - a virtual joint ends at the root link, begins at a frame outside the robot, and is not fixed to ``odom`` or
      ``map`` if the robot has drive wheels

    ## Why is this bad?
    The group lacks its joints, so planning fails. MoveIt skips a virtual joint whose child is not the root link.

    ## Example
    ```diff
     <robot name="arm">
       <group name="arm">
    -    <chain base_link="hand" tip_link="base"/>
    +    <chain base_link="base" tip_link="hand"/>
       </group>
     </robot>
    ```
    """

    code = "M105"
    name = "srdf-group-inconsistent"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each contradiction."""
        from urdfkit.lint.facts.moveit.group_joints import repeated_groups

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
                    yield from self._side(chain, name, model, severity)
                for below in group.find_all("group"):
                    if _contains(below.get("name") or "", name, by_name):
                        yield self.at(model, below, f"group `{name}` contains itself", attribute="name", severity=empty)
            for group, message in repeated_groups(root, model.robot):
                place, names = group.find("chain") or group, (group.get("name") or "",)
                yield self.at(model, place, message, severity=severity, kind="repeated", names=names)
            for joint in root.find_all("virtual_joint"):
                child = joint.get("child_link") or ""
                if root_link and child != root_link and child in model.robot.link_by_name:
                    message = (
                        f"virtual joint `{joint.get('name')}` ends at `{child}`, but the root link is `{root_link}`"
                    )
                    help = f"write `{root_link}`"
                    yield self.at(model, joint, message, attribute="child_link", help=help, severity=severity)
                yield from self._frame(joint, model, severity)
            for effector in root.find_all("end_effector"):
                name, parent = effector.get("group") or "", effector.get("parent_link") or ""
                links = [link.get("name") for link in by_name[name].find_all("link")] if name in by_name else []
                for chain in by_name[name].find_all("chain") if name in by_name else ():
                    ends = (chain.get("base_link") or "", chain.get("tip_link") or "")
                    links += [joint.child for joint in path_between(*ends, model.robot) or ()]
                joints = model.robot.joint_by_name
                listed = by_name[name].find_all("joint") if name in by_name else ()
                links += [joints[each].child for part in listed if (each := part.get("name") or "") in joints]
                if name and name == effector.get("parent_group"):
                    message = f"group `{name}` of end effector `{effector.get('name')}` is its own parent group"
                    yield self.at(model, effector, message, attribute="parent_group", severity=severity)
                is_own = parent in links
                if is_own and name != effector.get("parent_group"):
                    message = f"parent link `{parent}` of end effector `{effector.get('name')}` is in group `{name}`"
                    help = "name the link of the arm that carries the group"
                    yield self.at(model, effector, message, attribute="parent_link", help=help, severity=severity)
                carrier = effector.get("parent_group") or ""
                within = joints_of(carrier, root, model.robot) if carrier and carrier != name else None
                if within and within <= (joints_of(name, root, model.robot) or set()):
                    message = f"group `{name}` of end effector `{effector.get('name')}` contains its parent group"
                    help = "name a group that contains only the end effector"
                    yield self.at(model, effector, message, attribute="group", help=help, severity=severity)
                    continue
                links = [link.get("name") for link in by_name[carrier].find_all("link")] if within else []
                links += [joints[each].child for each in within or () if each in joints]
                if within and not is_own and parent in model.robot.link_by_name and parent not in links:
                    message = (
                        f"parent link `{parent}` of end effector `{effector.get('name')}` is not in its parent group"
                    )
                    help = f"name a link of group `{carrier}`"
                    yield self.at(
                        model,
                        effector,
                        message,
                        attribute="parent_link",
                        help=help,
                        severity=severity,
                        kind="group",
                        names=(carrier,),
                    )
                elif not is_own and parent in model.robot.link_by_name and name != effector.get("parent_group"):
                    yield from self._carried(effector, root, model, severity)
            wrong = list(self._passive(root, model, severity))
            # A name in place of another one leaves the other joint without an entry.
            yield from wrong or self._not_passive(root, model, severity)

    def _frame(self, joint: Element, model: Model, severity: Severity | None) -> Findings:
        """Yield a finding for a virtual joint that begins in the robot, or that is fixed although the robot drives."""
        from urdfkit.lint.facts.gazebo.rolling_wheels import pairs_of_wheels
        from urdfkit.lint.facts.ros_packages import is_slip

        name, frame = joint.get("name") or "", joint.get("parent_frame") or ""
        near = next((each for each in ("odom", "map", "world") if is_slip(frame, each)), None)
        if near is not None and frame not in ("odom", "map", "world"):
            message = f"unknown parent frame `{frame}` of virtual joint `{name}`" + Suggestion(near, frame)
            yield self.at(model, joint, message, attribute="parent_frame", severity=severity)
        if name in model.robot.joint_by_name:
            message = f"virtual joint `{name}` has the name of a joint of the robot"
            yield self.at(model, joint, message, attribute="name", joint=name, severity=severity)
        if frame in model.robot.link_by_name:
            message = f"parent frame `{frame}` of virtual joint `{name}` is a link of the robot"
            help = "write a frame outside the robot, such as `world`"
            yield self.at(model, joint, message, attribute="parent_frame", help=help, severity=severity)
        elif joint.get("type") == "fixed" and frame in ("odom", "map") and pairs_of_wheels(model):
            message = f"virtual joint `{name}` is fixed to `{frame}`, but the robot has drive wheels"
            yield self.at(model, joint, message, attribute="type", help="write `planar`", severity=severity)

    def _carried(self, effector: Element, root: Element, model: Model, severity: Severity | None) -> Findings:
        """Yield a finding for a parent link that moving joints separate from the group of an end effector."""
        from urdfkit.description.urdf.attached_bodies import AttachedBodies
        from urdfkit.lint.facts.root_cause import parent_at

        robot, group, parent = model.robot, effector.get("group") or "", effector.get("parent_link") or ""
        members = [
            robot.joint_by_name[name] for name in joints_of(group, root, robot) or () if name in robot.joint_by_name
        ]
        inside = {joint.child for joint in members if joint.child}
        carriers = sorted({joint.parent for joint in members if joint.parent and joint.parent not in inside})
        body_of = AttachedBodies(robot).body_of
        near = {body_of(each) for each in (*carriers, *inside)}
        if carriers and body_of(parent) not in near:  # Pinocchio's SRDF names the tip of the group.
            message = f"parent link `{parent}` of end effector `{effector.get('name')}` does not carry group `{group}`"
            help = f"write `{carriers[0]}`, or a link that is fixed to it"
            names = (parent, *carriers, *sorted(inside))
            other = parent_at(model, next(iter(robot.parents_of.get(parent, ())), None))
            yield self.at(
                model,
                effector,
                message,
                attribute="parent_link",
                help=help,
                severity=severity,
                names=names,
                other=other,
            )

    def _passive(self, root: Element, model: Model, severity: Severity | None) -> Findings:
        """Yield a finding for each passive joint that a mimic joint follows, or that a MoveIt controller moves."""
        from urdfkit.lint.facts.control.yaml_tree import yamls
        from urdfkit.lint.facts.moveit.settings import entries

        joints = model.robot.joint_by_name
        followed = {joint.mimic.joint: joint.name for joint in joints.values() if joint.mimic is not None}
        controllers = [entry for source in yamls(model) for entry in entries(source) if entry.kind == "controller"]
        listed = [(entry.name.text, entry.settings.find("joints")) for entry in controllers]
        moved = {joint: name for name, each in listed if each is not None for joint in each.texts()}
        for passive in root.find_all("passive_joint"):
            name = passive.get("name") or ""
            if name not in joints or joints[name].mimic is not None:
                continue
            reason = f"joint `{followed[name]}` follows it" if name in followed else ""
            reason = reason or (f"controller `{moved[name]}` moves it" if name in moved else "")
            if reason:
                message = f"joint `{name}` is passive, but {reason}"
                yield self.at(model, passive, message, attribute="name", joint=name, severity=severity)

    def _not_passive(self, root: Element, model: Model, severity: Severity | None) -> Findings:
        """Yield a finding at a passive joint whose counterpart on the other side is in no group and not passive."""
        from urdfkit.lint.facts.twins import mirrored

        passive = {element.get("name") or "": element for element in root.find_all("passive_joint")}
        if any(name not in model.robot.joint_by_name for name in passive):
            return  # The unknown joint may be the counterpart.
        within = {joint for name in groups(root) for joint in joints_of(name, root, model.robot) or ()}
        for name, element in passive.items():
            for other in mirrored(name):
                joint = model.robot.joint_by_name.get(other)
                is_free = joint is not None and joint.is_movable and joint.mimic is None
                if is_free and other not in passive and other not in within:
                    message = f"joint `{name}` is passive, but joint `{other}`, which is in no group, is not"
                    help = f'add <passive_joint name="{other}"/>'
                    yield self.at(
                        model,
                        element,
                        message,
                        attribute="name",
                        joint=other,
                        help=help,
                        severity=severity,
                        kind="passive",
                    )

    def _chain(self, chain: Element, model: Model, severity: Severity | None) -> Findings:
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

    def _side(self, chain: Element, group: str, model: Model, severity: Severity | None) -> Findings:
        """Yield a finding for an end of a chain on the side of the robot that the name of the group contradicts."""
        from urdfkit.lint.facts.twins import mirrored, side_of

        robot, side = model.robot, side_of(group)
        ends = {name: chain.get(name) or "" for name in ("base_link", "tip_link")}
        if not side or path_between(ends["base_link"], ends["tip_link"], robot) is None:
            return
        own = {
            name: next((each for each in mirrored(link) if each in robot.link_by_name), None)
            for name, link in ends.items()
            if side_of(link) not in ("", side)
        }
        meant = {**ends, **{name: link or "" for name, link in own.items()}}
        if not own or path_between(meant["base_link"], meant["tip_link"], robot) is None:
            return
        name, link = next(iter(own.items()))
        message = f"{name.replace('_', ' ')} `{ends[name]}` of group `{group}` is on the other side of the robot"
        help = f"write `{link}`"
        yield self.at(model, chain, message, attribute=name, help=help, severity=severity, kind="side", names=(group,))


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
