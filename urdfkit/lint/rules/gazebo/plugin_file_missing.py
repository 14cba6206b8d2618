"""Z828 plugin-file-missing."""

import re
from pathlib import Path

from urdfkit.lint.facts.gazebo.plugins import plugins, specs
from urdfkit.lint.finding import Severity
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule


class PluginFileMissing(RobotRule):
    """The parameter file of a Gazebo plugin does not exist.

    ## What it does
    Checks that the file in ``<parameters>`` of gz_ros2_control and gazebo_ros2_control exists. Files outside known
    packages, and files that the build may generate, are reported as notes, because `urdfkit sim` ignores a plugin whose
    file is missing.

    ## Why is this bad?
    The controller manager starts without controllers, or crashes the simulator.

    ## Example
    ```diff
     <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
       <link name="base"/>
       <gazebo>
         <plugin name="gz_ros2_control::GazeboSimROS2ControlPlugin" filename="gz_ros2_control-system">
    -      <parameters>$(find rrbot_control)/config/rrbot.yaml</parameters>
    +      <parameters>$(find rrbot_control)/config/rrbot_control.yaml</parameters>
         </plugin>
       </gazebo>
     </robot>
    ```
    """

    code = "Z828"
    name = "plugin-file-missing"
    severity = "warning"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each parameter file that does not exist; a note if it may be installed elsewhere."""
        from urdfkit.description.control.parameter_files import parameter_file
        from urdfkit.errors import ResourceError

        folder = model.expanded.path.absolute().parent
        for plugin, _, _ in plugins(model.robot):
            for element in plugin.element.find_all("parameters"):
                text = element.text.strip()
                if not text or re.search(r"\$(?!\(find)", text) or model.is_unresolved(element):
                    continue
                try:
                    parameter_file(text, model.expanded.packages, folder)
                except ResourceError as error:
                    message, severity = _described(Path(text)) or (error.message, "note")
                    if severity == "warning" or any(spec.kind == "ros2_control" for spec in specs(plugin)):
                        tag = model.tag(element.origin.position)
                        written = model.document(element.origin.position.file).source.text
                        is_passed = tag is not None and "$(arg" in written[tag.end : tag.close_end]
                        kind = "argument" if is_passed else ""
                        names = (Path(text).name,)
                        yield self.at(model, element, message, severity=severity, kind=kind, names=names)


def _described(path: Path) -> tuple[str, Severity] | None:
    """Return the message about a missing file of a package in the workspace; None for other files."""
    from urdfkit.description.packages.related_files import package_of
    from urdfkit.description.packages.similar_names import near_path

    package = package_of(path) if path.is_absolute() else None
    if package is None:
        return None
    build_files = [file for name in ("CMakeLists.txt", "setup.py") if (file := package / name).is_file()]
    is_generated = any(path.name in file.read_text("utf-8", "replace") for file in build_files)
    message = f"`{path.relative_to(package)}` does not exist in package {package.name}" + near_path(path)
    return message, "note" if is_generated else "warning"
