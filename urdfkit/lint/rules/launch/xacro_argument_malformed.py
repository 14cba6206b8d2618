"""L114 xacro-argument-malformed."""

from urdfkit.lint.rule import Findings, Model, RobotRule


class XacroArgumentMalformed(RobotRule):
    """A launch file passes an argument to xacro with ``=`` instead of ``:=``.

    ## What it does
    Checks the words ``name=value`` of xacro commands in launch files. Options, such as ``--xacro-ns``, are not checked.

    ## Why is this bad?
    xacro treats the word as a second input file and stops: "expected exactly one input file as argument".

    ## Example
    ```diff
     <launch>
    -  <param name="robot_description" command="xacro $(find cart_description)/urdf/cart.urdf.xacro length=2"/>
    +  <param name="robot_description" command="xacro $(find cart_description)/urdf/cart.urdf.xacro length:=2"/>
     </launch>
    ```
    """

    code = "L114"
    name = "xacro-argument-malformed"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each argument without a colon."""
        from urdfkit.lint.facts.launch.actions import launch_files

        for file in launch_files(model):
            for word in (word for call in file.xacro for word in call.without_colon):
                end = word.end
                message = f"`{word.name}=` is not an argument of xacro; write `{word.name}:=`"
                yield self.at_span(file.source.span(word.start, end + 1), message)
