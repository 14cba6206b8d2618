"""T203 multiple-roots."""

from __future__ import annotations

from urdfkit.lint.rule import RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.description.robot import Robot
    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model


class MultipleRoots(RobotRule):
    """More than one link has no parent.

    ## What it does
    Looks for links that are nobody's child besides the root of the largest tree. A link that a joint must have meant
    whose child is misspelt is left to child-link-undefined.

    ## Why is this bad?
    A robot is one tree. urdfdom refuses two roots, robot_state_publisher cannot connect the frames, and MuJoCo silently
    welds the second tree to the world.

    ## Example
    ```xml
    <robot name="cart">
      <link name="base"/>
      <link name="lidar"/>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="cart">
      <link name="base"/>
      <link name="lidar"/>
      <joint name="lidar_joint" type="fixed">
        <parent link="base"/>
        <child link="lidar"/>
      </joint>
    </robot>
    ```
    """

    code = "T203"
    name = "multiple-roots"

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each root but the one with the most links below it."""
        robot = model.robot
        roots = robot.roots()
        if len(roots) < 2:
            return
        missed = _missed(robot)
        hidden = model.hidden
        roots = [link for link in roots if link.name not in missed and not hidden.has_child(link.name)]
        if len(roots) < 2:
            return
        main = max(roots, key=lambda link: _links_below(robot, link.name))
        for link in roots:
            if link is not main:
                yield self.at(
                    model,
                    link.element,
                    f"link `{link.name}` has no parent: it is a second root beside `{main.name}`",
                    attribute="name",
                    link=link.name,
                    help=_remedy(robot, link.name, main.name),
                )


def _links_below(robot: Robot, name: str) -> int:
    seen = {name}
    pending = [name]
    while pending:
        for joint in robot.children_of.get(pending.pop(), ()):
            if joint.child is not None and joint.child not in seen:
                seen.add(joint.child)
                pending.append(joint.child)
    return len(seen)


def _missed(robot: Robot) -> set[str]:
    """Return the links that joints must have meant whose child is none."""
    from urdfkit.description.queries import dangling
    from urdfkit.lint.orphans import meant_child

    return {near for _, name, _ in dangling(robot, "child") if (near := meant_child(robot, name)[0]) is not None}


def _remedy(robot: Robot, orphan: str, root: str) -> str:
    from urdfkit.errors import did_you_mean

    for joint in robot.joints:
        if joint.child is not None and joint.child not in robot.link_by_name and did_you_mean(joint.child, [orphan]):
            return f"joint `{joint.name}` has the child `{joint.child}`, which is no link: is `{orphan}` meant?"
    return f"add a joint with child `{orphan}` and parent `{root}` or another link"
