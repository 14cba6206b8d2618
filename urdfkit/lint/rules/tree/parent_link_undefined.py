"""T201 parent-link-undefined."""

import re
from pathlib import Path

from urdfkit.description.urdf.queries import dangling
from urdfkit.lint.fix_builders import meant, new_value
from urdfkit.lint.model.masked_names import unless_masked
from urdfkit.lint.rule import Findings, Model, RobotRule


class ParentLinkUndefined(RobotRule):
    """The parent link of a joint is undefined.

    ## What it does
    Checks for joints whose ``<parent>`` names an undefined link, and suggests the nearest link name. The finding is a
    note for a fragment (a xacro file without a root link) if another description of the package defines the link.

    ## Why is this bad?
    The joint has no parent link: urdfdom, Pinocchio and every viewer reject the robot.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base"/>
       <link name="upper"/>
    -  <joint name="shoulder" type="fixed"><parent link="bsae"/><child link="upper"/></joint>
    +  <joint name="shoulder" type="fixed"><parent link="base"/><child link="upper"/></joint>
     </robot>
    ```

    ## Fix safety
    Unsafe: the fix writes the nearest link name, which may not be the intended one.
    """

    code = "T201"
    name = "parent-link-undefined"
    fix = "unsafe"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each joint with an undefined parent link."""
        for joint, name, element in dangling(model.robot, "parent"):
            suggestion, hint = meant(name, model.robot.link_by_name)
            is_outside = not model.robot.root_by_name and not suggestion and _is_defined_nearby(model, name)
            finding = self.at(
                model,
                element,
                f"undefined parent link `{name}` of joint `{joint.name}`" + hint,
                attribute="link",
                joint=joint.name,
                names=(name, suggestion) if suggestion in model.robot.root_by_name else (name,),
                fix=new_value(model, element, "link", suggestion, "unsafe"),
                help="a file that includes this one has to define it" if is_outside else None,
                severity="note" if is_outside else None,
            )
            is_repaired = model.target == "urdfkit"
            yield from unless_masked(model, name, suggestion, finding, is_repaired=is_repaired)


def _is_defined_nearby(model: Model, name: str) -> bool:
    """Return whether another description of the package defines a link, for a xacro file."""
    from urdfkit.lint.project.description_files import SUFFIXES, near_descriptions

    if model.expanded.path.suffix != ".xacro":
        return False
    model.watch(*SUFFIXES)
    own = {str(Path(file).absolute()) for file in model.expanded.sources}
    link = re.compile(rf"<link\s+name\s*=\s*[\"']{re.escape(name)}[\"']")
    texts = (text for path, text in near_descriptions(model.package, model.expanded.path) if str(path) not in own)
    return any(link.search(text) for text in texts)
