"""Z828 plugin-file-missing."""

from pathlib import Path

from urdfkit.lint.facts.gazebo.plugins import plugins
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule


class PluginFileMissing(RobotRule):
    """The parameter file of a Gazebo plugin does not exist.

    ## What it does
    Checks the file in ``<parameters>`` of gz_ros2_control and gazebo_ros2_control if ``$(find …)`` resolves to an
    existing package. Files that the build generates, and files of missing packages, are not checked.

    ## Why is this bad?
    The controller manager starts without controllers, or crashes the simulator.

    ## Example
    ```xml
    <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
      <link name="base"/>
      <gazebo>
        <plugin name="gz_ros2_control::GazeboSimROS2ControlPlugin" filename="gz_ros2_control-system">
          <parameters>$(find rrbot_control)/config/rrbot.yaml</parameters>
        </plugin>
      </gazebo>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
      <link name="base"/>
      <gazebo>
        <plugin name="gz_ros2_control::GazeboSimROS2ControlPlugin" filename="gz_ros2_control-system">
          <parameters>$(find rrbot_control)/config/rrbot_control.yaml</parameters>
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
        """Yield a finding for each parameter file that does not exist."""
        from urdfkit.description.packages.related_files import package_of
        from urdfkit.description.packages.resolver import near_path

        for plugin, _, _ in plugins(model.robot):
            for element in plugin.element.find_all("parameters"):
                text = element.text.strip()
                if not text.startswith("/") or "$" in text or model.is_unresolved(element):
                    continue
                path = Path(text)
                package = package_of(path)
                if package is None or model.expanded.packages.whereabouts(path):
                    continue
                build_files = [file for name in ("CMakeLists.txt", "setup.py") if (file := package / name).is_file()]
                if any(path.name in file.read_text("utf-8", "replace") for file in build_files):
                    continue
                shown = path.relative_to(package)
                yield self.at(model, element, f"`{shown}` does not exist in package {package.name}{near_path(path)}")
