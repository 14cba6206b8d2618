"""T205 multiple-parents."""

from urdfkit.description.urdf.queries import is_loop, loop_closed_by
from urdfkit.lint.rule import Findings, Model, RobotRule


class MultipleParents(RobotRule):
    """A link is the child of more than one joint.

    ## What it does
    Checks for links that several joints name as their child. A joint that closes a loop is reported with the loop.

    ## Why is this bad?
    A URDF robot is a tree, so each link has at most one parent. check_urdf accepts the robot and silently keeps one of
    the joints; Pinocchio and MuJoCo reject it.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base"/>
       <link name="upper"/>
       <link name="hand"/>
       <joint name="shoulder" type="fixed"><parent link="base"/><child link="upper"/></joint>
       <joint name="wrist" type="fixed"><parent link="upper"/><child link="hand"/></joint>
    -  <joint name="brace" type="fixed"><parent link="base"/><child link="hand"/></joint>
     </robot>
    ```
    """

    code = "T205"
    name = "multiple-parents"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each further joint with the same child."""
        tops = [root.name for root in model.robot.roots()]
        for name, joints in model.robot.parents_of.items():
            joints = [joint for joint in joints if not is_loop(joint)] or joints[:1]  # T204 reports the others.
            first = joints[0]
            for joint in joints[1:]:
                if joint.name == first.name:
                    continue  # Reported by duplicate-joint.
                loop = loop_closed_by(model.robot, joint)
                closes = f"; `{joint.name}` closes the loop {' → '.join([*loop, loop[0]])}" if loop else ""
                child = joint.element.find("child") or joint.element
                roots = {_root(model, each.parent) for each in (joint, first)} - {None}
                message = f"link `{name}` is the child of both joint `{joint.name}` and joint `{first.name}`{closes}"
                names = tuple(sorted(str(root) for root in roots)) if len(roots) == 2 else ()
                alone = [top for top in tops if top not in roots]  # It lost its joint to the link.
                names = names or (tuple(alone) if len(alone) == 1 else ())
                help = f"give `{joint.name}` a separate child link, or remove one of the joints"
                yield self.at(
                    model, child, message, attribute="link", link=name, joint=joint.name, names=names, help=help
                )


def _root(model: Model, name: str | None) -> str | None:
    """Return the topmost link above a link; None if links form a loop."""
    seen: set[str | None] = set()
    while name not in seen:
        seen.add(name)
        above = model.robot.parents_of.get(name or "", ())
        if not above:
            return name
        name = above[0].parent
    return None
