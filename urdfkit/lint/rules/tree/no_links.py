"""T211 no-links."""

from urdfkit.lint.rule import Findings, Model, RobotRule


class NoLinks(RobotRule):
    """A URDF file has no link.

    ## What it does
    Checks for robots without links, in files that use no xacro and have the suffix ``.urdf`` (in upper or lower case).
    Other files without links are fragments that a robot includes.

    ## Why is this bad?
    urdfdom rejects the file: "No link elements found in urdf file".

    ## Example
    ```diff
     <robot name="cart">
    +  <link name="base"/>
     </robot>
    ```
    """

    code = "T211"
    name = "no-links"

    def check(self, model: Model) -> Findings:
        """Yield a finding at the root element of a robot without links."""
        robot = model.robot
        if model.expanded.faults or not str(model.expanded.path).lower().endswith(".urdf"):
            return
        # A misspelt link has its own finding, and gazebo extensions alone are a fragment.
        if not robot.element.children and not any("xacro" in one.text for one in model.expanded.sources.values()):
            yield self.at(model, robot.element, f"robot `{robot.name or ''}` has no link")
