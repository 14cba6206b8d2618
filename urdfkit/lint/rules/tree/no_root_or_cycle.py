"""T204 no-root-or-cycle."""

import re

from urdfkit.description.urdf.queries import cycles, is_loop
from urdfkit.lint.rule import Findings, Model, RobotRule


class NoRootOrCycle(RobotRule):
    """The joints of the robot form a loop.

    ## What it does
    Follows the joints from child to parent and checks for loops, and for joints that connect a link with itself.

    ## Why is this bad?
    A URDF robot is a tree, and a loop has no root. check_urdf and Pinocchio reject a robot that consists only of a
    loop, and silently drop a loop next to a tree. Some other tools never stop following the loop.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base"/>
       <link name="upper"/>
       <joint name="shoulder" type="fixed"><parent link="base"/><child link="upper"/></joint>
    -  <joint name="back" type="fixed"><parent link="upper"/><child link="base"/></joint>
     </robot>
    ```
    """

    code = "T204"
    name = "no-root-or-cycle"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each loop, at the last of its joints in the file."""
        robot = model.robot
        loops = cycles(robot)
        found = {id(loop[0]) for loop in loops}
        loops += [[joint] for joint in robot.joints if is_loop(joint) and id(joint) not in found]
        for loop in loops:
            last = max(loop, key=robot.joints.index)
            links = [str(joint.parent) for joint in loop]
            message = f"the joints form a loop: {' → '.join([*links, links[0]])}"
            if len(loop) == 1:
                message = f"joint `{last.name}` connects link `{links[0]}` with itself"
            stem = re.sub(r"_?joint$", "", last.name)
            rootless = [link.name for link in robot.roots() if re.sub(r"_?link$", "", link.name) == stem != ""]
            is_parent_wrong = len(robot.parents_of.get(links[0], ())) == 1
            end = "parent" if is_parent_wrong else "child"
            place = last.element.find(end) if len(loop) == 1 else None
            attribute = "link" if place is not None else "name"
            names = tuple(rootless) if len(loop) == 1 else ()
            help = "remove one of the joints: each link has at most one parent" if len(loop) > 1 else None
            element = place or last.element
            yield self.at(model, element, message, attribute=attribute, joint=last.name, names=names, help=help)
