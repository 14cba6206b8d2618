"""K981 parameter-out-of-range."""

from __future__ import annotations

from urdfkit.lint.rule import Findings, Model, RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable

    from urdfkit.description.xml.source import Source
    from urdfkit.lint.facts.control.yaml_tree import Node


class ParameterOutOfRange(RobotRule):
    """A time, rate, length, velocity or proportion in YAML is far outside the sensible range.

    ## What it does
    Checks the parameters of controllers, Nav2, move_base, robot_localization, slam_toolbox, gmapping, amcl, twist_mux,
    teleop nodes, maps and MoveIt, in YAML and in XML launch files. The plausible range of each parameter is many times
    wider than the range of values in the examples of its package. Values of zero and below are accepted, because they
    often disable a function.

    ## Why is this bad?
    The nodes accept such a value. Usually a decimal point is misplaced, or the value has another unit, such as
    milliseconds, centimetres or percent.

    ## Example
    ```diff
     drive_controller:
       type: diff_drive_controller/DiffDriveController
    -  cmd_vel_timeout: 500.0
    +  cmd_vel_timeout: 0.5
    ```
    """

    code = "K981"
    name = "parameter-out-of-range"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each parameter outside of its range."""
        from urdfkit.description.packages.related_files import LAUNCH
        from urdfkit.lint.facts.control.yaml_tree import nodes, span_of, yamls
        from urdfkit.lint.facts.parameters.ranges import groups_of_launch, out_of_range

        groups: list[tuple[Source, Iterable[Node]]] = [(source, nodes(source)) for source in yamls(model)]
        launches = [each for name, each in model.related_files.items() if name.endswith(LAUNCH)]
        groups += [(each, groups_of_launch(each)) for each in launches if not each.file.endswith(".py")]
        for source, found in groups:
            for node, message in out_of_range(found):
                yield self.at_span(span_of(source, node), message)
