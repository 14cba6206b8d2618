"""M110 srdf-adjacent-pair-missing."""

from __future__ import annotations

from urdfkit.lint.rule import Findings, Model, RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from urdfkit.description.urdf.robot import Joint
    from urdfkit.description.xml.element import Element

    Pair = tuple[Joint, frozenset[str]]

_MIN_SHARE = 2
"""Number of adjacent pairs that an SRDF disables for each missing one, at least."""

_MIN_PAIRS = 4
"""Number of adjacent pairs of a robot from which on a single missing one is reported, whatever links it has."""


class SrdfAdjacentPairMissing(RobotRule):
    """An SRDF disables the collisions of adjacent links, except for one pair.

    ## What it does
    Checks pairs of links that have collision geometry and are connected by a joint, if the SRDF disables most of these
    pairs. A pair is reported if both links occur in other disabled pairs, or if all other adjacent pairs are disabled.
    If both links occur in disabled pairs, two other kinds of pairs are also reported:

    - links that overlap with every joint at zero and are separated only by fixed or prismatic joints, such as the first
      and the last stage of a telescope
    - the only pair of a limb, with one link in between, that is not disabled although its counterpart on the other side
      of the robot is disabled

    If the SRDF disables the child link together with another link as adjacent, the finding is at the parent link of the
    joint in two cases: the joint of the other side of the robot has the other link as its parent, or the other link is
    carried by the same parent and carries nothing.

    SRDFs with ``enable_collisions`` or ``disable_default_collisions`` are not checked.

    ## Why is this bad?
    The shapes of adjacent links often overlap at the joint. MoveIt then reports every state as a collision and finds no
    plan.

    ## Example
    ```diff
     <robot name="arm">
       <group name="arm">
         <chain base_link="base" tip_link="hand"/>
       </group>
       <disable_collisions link1="base" link2="upper" reason="Adjacent"/>
       <disable_collisions link1="base" link2="lower" reason="Never"/>
    +  <disable_collisions link1="upper" link2="lower" reason="Adjacent"/>
       <disable_collisions link1="lower" link2="hand" reason="Adjacent"/>
     </robot>
    ```
    """

    code = "M110"
    name = "srdf-adjacent-pair-missing"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each pair of adjacent links that is missing."""
        from urdfkit.lint.facts.moveit.missing_pairs import overlapping, unlike_other_side
        from urdfkit.lint.facts.moveit.srdf import near_links, semantics_of, severity_for
        from urdfkit.lint.facts.root_cause import parent_at

        if model.is_incomplete:
            return
        for root in semantics_of(model):
            if root.find_all("enable_collisions") or root.find_all("disable_default_collisions"):
                continue
            links = set(model.robot.link_by_name)
            disabled = {frozenset(_links(pair)): pair for pair in root.find_all("disable_collisions")}
            mentioned = {link for pair in disabled for link in pair}
            every = {link.name for link in model.robot.links if link.collisions}
            adjacent, missing = _adjacent(model, every, disabled)
            if len(missing) != 1 or len(adjacent) < _MIN_PAIRS:
                adjacent, missing = _adjacent(model, every & mentioned, disabled)
            if len(adjacent) < (1 + _MIN_SHARE) * len(missing):
                missing = []
            for missed, near, reason in (*overlapping(model, disabled), *unlike_other_side(model, disabled)):
                if any(len(each) < 2 or not each <= links for each in disabled):
                    break  # Other rules report a pair that names one link twice, or a link that does not exist.
                if any(pair == frozenset(missed) for _, pair in missing):
                    continue
                message = f"links `{missed[0]}` and `{missed[1]}` {reason}, but their collisions are not disabled"
                help = f'add <disable_collisions link1="{missed[0]}" link2="{missed[1]}" reason="Default"/>'
                yield self.at(
                    model, near, message, help=help, severity=severity_for(root, model), names=missed, kind="pair"
                )
            # Other rules report a pair that names one link twice, or a link that does not exist.
            wrong = [each for each in disabled if len(each) < 2 or not each <= links]
            missing = [(joint, pair) for joint, pair in missing if not any(pair & each for each in wrong)]
            distant = {
                each: element
                for each, element in disabled.items()
                if element.get("reason") == "Adjacent" and each <= links and len(each) == 2
                if not each <= near_links(next(iter(each)), model)
            }
            for joint, pair in missing:
                confused = next((each for each in distant if each & pair), None)
                near = next((element for links, element in disabled.items() if links & pair), root)
                near = distant[confused] if confused is not None else near
                message = (
                    f"links `{joint.parent}` and `{joint.child}` are adjacent, but their collisions are not disabled"
                )
                if confused is not None:
                    one, other = _links(near)
                    message += f"; the SRDF disables those of `{one}` and `{other}`, which are not adjacent"
                names = tuple({*pair, *(confused or ())})
                written = f'<disable_collisions link1="{joint.parent}" link2="{joint.child}" reason="Adjacent"/>'
                severity = severity_for(root, model)
                wrong_side = parent_at(model, joint) if confused is not None else None
                reason = _why_parent(confused, joint, model) if confused is not None else ""
                if confused is not None and reason and wrong_side is not None:
                    [right] = confused - {joint.child or ""}
                    message = f"joint `{joint.name}` has the parent link `{joint.parent}`, but the SRDF disables the "
                    message += f"collisions of `{right}` and `{joint.child}` as adjacent links, and {reason}"
                    severity, names = severity_for(root, model), (*names, *_joint_to(right, model))
                    help = f"write `{right}`"
                    yield self.at_span(
                        wrong_side, message, severity, help=help, joint=joint.name, names=names, kind="parent"
                    )
                    continue
                help = f"add {written}"
                yield self.at(
                    model, near, message, help=help, severity=severity, names=names, other=wrong_side, kind="pair"
                )


def _adjacent(model: Model, solid: set[str], disabled: dict[frozenset[str], Element]) -> tuple[list[Pair], list[Pair]]:
    """Return the pairs of links that a joint connects, and those among them whose collisions are not disabled."""
    adjacent = [
        (joint, frozenset((joint.parent, joint.child)))
        for joint in model.robot.joints
        if joint.parent in solid and joint.child in solid
    ]
    return adjacent, [(joint, pair) for joint, pair in adjacent if pair not in disabled]


def _why_parent(pair: frozenset[str], joint: Joint, model: Model) -> str:
    """Return why the parent link of a joint is wrong and a pair of the SRDF with its child link right; else empty.

    The counterpart of the joint on the other side has the other link of the pair as its parent, or this link has the
    same parent as the child link and carries nothing.
    """
    from urdfkit.lint.facts.twins import mirrored

    robot = model.robot
    if joint.child not in pair:
        return ""
    [right] = pair - {joint.child}
    twins = (robot.joint_by_name.get(name) for name in mirrored(joint.name))
    twin = next((twin for twin in twins if twin is not None and twin.parent == right), None)
    if twin is not None:
        return f"joint `{twin.name}` has the parent link `{right}` too"
    carriers = [each for each in robot.joints if each.child == right and each.parent == joint.parent]
    if carriers and carriers[0].is_movable and not robot.children_of.get(right):
        return f"`{right}` carries no link"
    return ""


def _joint_to(link: str, model: Model) -> tuple[str, ...]:
    """Return the name of the joint that carries a link."""
    return tuple(joint.name for joint in model.robot.joints if joint.child == link)


def _links(pair: Element) -> tuple[str, str]:
    return pair.get("link1") or "", pair.get("link2") or ""
