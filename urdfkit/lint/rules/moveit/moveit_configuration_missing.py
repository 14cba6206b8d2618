"""M111 moveit-configuration-missing."""

from __future__ import annotations

from urdfkit.defect_message import Suggestion
from urdfkit.lint.rule import Findings, Model, RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from urdfkit.lint.facts.moveit.configuration import Builder


class MoveitConfigurationMissing(RobotRule):
    """A launch file or ``.setup_assistant`` names a MoveIt package, robot or description that does not exist.

    ## What it does
    Checks ``MoveItConfigsBuilder`` in launch files for:

    - a package (by default ``<robot>_moveit_config``) that misspells a package of the workspace
    - a robot that misspells a robot of these packages
    - misspelt methods and keywords, files that do not exist in the package, and planning pipelines without a file

    Also checks the paths of the URDF and the SRDF in the ``.setup_assistant`` file of that package, if the packages of
    these paths are in the workspace.

    ## Why is this bad?
    The launch stops: "package not found" or "No such file or directory".

    ## Example
    ```diff title="robot.launch.py"
     from launch import LaunchDescription
     from moveit_configs_utils import MoveItConfigsBuilder


     def generate_launch_description():
    -    config = MoveItConfigsBuilder("cart", package_name="cart_descripton").to_moveit_configs()
    +    config = MoveItConfigsBuilder("cart", package_name="cart_description").to_moveit_configs()
         return LaunchDescription([config])
    ```

    ## Fix safety
    Unsafe: the fix replaces a misspelt name with the nearest known name, which may not be the intended one.
    """

    code = "M111"
    name = "moveit-configuration-missing"
    fix = "unsafe"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each package, robot and path that does not exist."""
        from urdfkit.description.packages.related_files import neighbours
        from urdfkit.lint.facts.control.yaml_tree import span_of
        from urdfkit.lint.facts.moveit.builder_methods import wrong_methods
        from urdfkit.lint.facts.moveit.configuration import builders, missing_paths

        if model.package is None:
            return
        near = neighbours(model.package)
        used = list(builders(model))
        for builder in used:
            yield from self._builder(builder, model, list(near))
            folder = near.get(builder.package)
            for span, message in wrong_methods(builder.source, builder.tree, builder.call, folder, model):
                yield self.at_span(span, message)
        for package in dict.fromkeys(builder.package for builder in used):
            replaced = frozenset.intersection(*(each.replaced for each in used if each.package == package))
            for source, node, message in missing_paths(near.get(package), replaced, near, model):
                yield self.at_span(span_of(source, node), message)

    def _builder(self, builder: Builder, model: Model, packages: list[str]) -> Findings:
        import re

        from urdfkit.lint.facts.moveit.srdf import robot_names
        from urdfkit.lint.facts.ros_packages import is_slip
        from urdfkit.lint.fix_builders import nearest

        near = nearest(builder.package, packages, cutoff=0.7) if builder.package not in packages else None
        stems = [name.partition("_moveit")[0] for name in (builder.package, near or "")]
        if near is not None and (stems[0] == stems[1] or is_slip(builder.package, near)):
            message = f"unknown package `{builder.package}`" + Suggestion(near, builder.package)
            yield self.at_span(builder.place, message, names=(builder.package,))
            return
        names = robot_names(model)
        if any(re.fullmatch(name, builder.robot) for name in names):
            return
        near = nearest(builder.robot, [name for name in names if name.isidentifier()], cutoff=0.7)
        if near is not None:
            message = f"no robot has the name `{builder.robot}`" + Suggestion(near, builder.robot)
            yield self.at_span(builder.robot_place, message, severity="warning")
