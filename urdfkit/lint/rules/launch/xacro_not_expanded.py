"""L119 xacro-not-expanded."""

from urdfkit.lint.rule import Findings, Model, RobotRule


class XacroNotExpanded(RobotRule):
    """A Python launch file loads a xacro file without expanding it.

    ## What it does
    Checks ``open`` and ``cat`` for files with the suffix ``.xacro``. Launch files that import ``xacro`` are not
    checked.

    ## Why is this bad?
    ``robot_description`` contains macros and expressions instead of links, and every program that reads it fails.

    ## Example
    ```diff title="robot.launch.py"
     from launch.substitutions import Command, PathJoinSubstitution
     from launch_ros.substitutions import FindPackageShare

     path = PathJoinSubstitution([FindPackageShare("cart_description"), "urdf", "cart.urdf.xacro"])
    -description = Command(["cat ", path])
    +description = Command(["xacro ", path])
    ```
    """

    code = "L119"
    name = "xacro-not-expanded"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each xacro file that is loaded as text."""
        from urdfkit.lint.facts.nodes.descriptions_as_text import descriptions_as_text

        for span, name in descriptions_as_text(model):
            message = f"{name} is loaded as text, so its macros and expressions are not expanded"
            yield self.at_span(span, message, help="expand it with `xacro`")
