"""T203 multiple-roots."""

from urdfkit.lint.model.placement import links_below
from urdfkit.lint.rule import Findings, Model, RobotRule


class MultipleRoots(RobotRule):
    """More than one link has no parent.

    ## What it does
    Checks for links without a parent other than the root of the largest tree. If a joint names an undefined child link
    that is probably a misspelling of such a link, the link is not reported, because T202 reports the joint.

    ## Why is this bad?
    A robot is a single tree. urdfdom rejects a second root, robot_state_publisher cannot connect the frames, and MuJoCo
    silently welds the second tree to the world.

    ## Example
    ```diff
     <robot name="cart">
       <link name="base"/>
       <link name="lidar"/>
    +  <joint name="lidar_joint" type="fixed">
    +    <parent link="base"/>
    +    <child link="lidar"/>
    +  </joint>
     </robot>
    ```
    """

    code = "T203"
    name = "multiple-roots"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each root except that of the largest tree."""
        from urdfkit.description.urdf.queries import dangling, likely_children

        robot = model.robot
        roots = robot.roots()
        if len(roots) < 2:
            return
        joint_by_unknown_child: dict[str, str] = {}
        for joint, name, _ in dangling(robot, "child"):
            joint_by_unknown_child.setdefault(name, joint.name)
        meant = set(likely_children(robot).values())
        masked = model.masked_names
        roots = [link for link in roots if link.name not in meant and not masked.has_child(link.name)]
        if len(roots) < 2:
            return
        main = max(roots, key=lambda link: len(links_below(robot, link.name)))
        for link in roots:
            if link is not main:
                label = f"link `{link.name}`" if link.name else "a link without a name"
                message = f"{label} has no parent, but `{main.name}` is already the root"
                help = _suggested_change(joint_by_unknown_child, link.name, main.name) if link.name else None
                yield self.at(model, link.element, message, attribute="name", link=link.name, help=help)


def _suggested_change(joint_by_unknown_child: dict[str, str], name: str, root: str) -> str:
    from urdfkit.errors import nearest

    child = nearest(name, joint_by_unknown_child)
    if child is not None:
        return f"write `{name}` as the child of joint `{joint_by_unknown_child[child]}` if `{child}` is a misspelling"
    return f"add a joint with child `{name}` and parent `{root}`, or another link"
