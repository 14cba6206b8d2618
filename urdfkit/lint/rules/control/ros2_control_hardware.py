"""C709 ros2-control-plugin-vs-distro."""

from urdfkit.description.hardware_defects import MOCKS
from urdfkit.lint.facts.control.exported_plugins import is_exported_plugin
from urdfkit.lint.facts.gazebo.plugins import plugins, runs_ros2_control, simulated_hardware
from urdfkit.lint.finding import Edit, Fix, Severity
from urdfkit.lint.fix_builders import nearest, new_text
from urdfkit.lint.project.target_platform import WITHOUT_CLASSIC
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule

HARDWARE = {
    "gazebo_ros2_control": "gazebo_ros2_control/GazeboSystem",
    "gz_ros2_control": "gz_ros2_control/GazeboSimSystem",
    "ign_ros2_control": "ign_ros2_control/IgnitionSystem",
}
"""Package of the plugin → its hardware (the plugin descriptions of gazebo_ros2_control and gz_ros2_control)."""

_ARGUMENT = "pass the xacro argument that selects the hardware of the simulator, if the robot has one"


class HardwareMismatch(RobotRule):
    """The hardware of ``<ros2_control>`` does not match the Gazebo plugin of the robot.

    ## What it does
    Each plugin that runs the controller manager in Gazebo has its own hardware class:
    ``gazebo_ros2_control/GazeboSystem`` for gazebo_ros2_control, ``gz_ros2_control/GazeboSimSystem`` for
    gz_ros2_control, and ``ign_ros2_control/IgnitionSystem`` for ign_ros2_control. The rule reports the hardware class
    of another plugin, and misspellings of these classes and of ``mock_components/GenericSystem``. Branches of
    ``xacro:if`` that are not expanded are checked too. Other hardware is reported as a note if the robot has such a
    plugin, because Gazebo does not control the joints of that hardware.

    ROS 2 from Jazzy on (``--target ros2-jazzy``) and Gazebo Sim (``--target gz``) have no
    ``gazebo_ros2_control/GazeboSystem``; Gazebo Classic (``--target classic``) has only that hardware. After Humble,
    gz_ros2_control still accepts the plugin name of ign_ros2_control but no longer its hardware (see
    gz_hardware_plugins.xml).

    ## Why is this bad?
    pluginlib does not find the class, and the controller manager stops.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base"/>
       <ros2_control name="arm" type="system">
    -    <hardware><plugin>gz_ros2_control/GazeboSystem</plugin></hardware>
    +    <hardware><plugin>gz_ros2_control/GazeboSimSystem</plugin></hardware>
       </ros2_control>
       <gazebo>
         <plugin filename="gz_ros2_control-system" name="gz_ros2_control::GazeboSimROS2ControlPlugin"/>
       </gazebo>
     </robot>
    ```

    ## Fix safety
    Unsafe: the fix writes the hardware of the Gazebo plugin, but the plugin itself may be wrong.
    """

    code = "C709"
    name = "ros2-control-plugin-vs-distro"
    fix = "unsafe"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each hardware that the Gazebo plugin of the robot does not have."""
        if not model.robot.ros2_control:
            return
        yield from self._unexpanded(model)
        files = {(plugin.filename or "").strip() for plugin, _, _ in plugins(model.robot)}
        is_run = runs_ros2_control(model.robot)
        hosts = {package for package in HARDWARE if any(package in file for file in files)}
        for block in model.robot.ros2_control:
            hardware = block.element.find("hardware")
            element = hardware.find("plugin") if hardware is not None else None
            text = element.text if element is not None else ""
            if element is None or "$" in text:
                continue
            package = text.partition("/")[0]
            if text in MOCKS or (not text and not is_run):
                continue
            if text == HARDWARE["gazebo_ros2_control"] and model.release in WITHOUT_CLASSIC:
                expected, message = HARDWARE["gz_ros2_control"], f"hardware `{text}` does not exist for {model.release}"
            elif text == HARDWARE["ign_ros2_control"] and hosts == {"gz_ros2_control"} and model.release != "humble":
                expected = HARDWARE["gz_ros2_control"]
                if model.release not in WITHOUT_CLASSIC:
                    message = f"hardware `{text}` exists in Humble only; later releases have `{expected}`"
                    yield self.at(model, element, message, help=f"write `{expected}`", severity="note")
                    continue
                message = f"hardware `{text}` does not exist for {model.release}"
            elif text in HARDWARE.values():
                if not hosts and (supported := simulated_hardware(model)) is not None and package not in supported:
                    hosts = {supported[0]}
                # In Humble, gz_ros2_control provides the hardware under both names.
                if len(hosts) != 1 or package in hosts or {package, *hosts} == {"gz_ros2_control", "ign_ros2_control"}:
                    continue
                expected = HARDWARE[next(iter(hosts))]
                message = f"hardware `{text}` does not belong to {next(iter(hosts))}"
            else:
                suggestion = HARDWARE.get(package) or nearest(text, (*HARDWARE.values(), *MOCKS), cutoff=0.9)
                if suggestion is None or is_exported_plugin(model, text):
                    if is_run:
                        message = f"hardware `{text}` is not simulated; its joints are not controlled in Gazebo"
                        severity: Severity | None = "warning" if model.target == "urdfkit" else "note"
                        yield self.at(model, element, message, help=_ARGUMENT, severity=severity)
                    continue
                expected, message = suggestion, f"unknown hardware `{text}`"
            help = f"write `{expected}`"
            yield self.at(model, element, message, help=help, fix=new_text(model, element, expected, "unsafe"))

    def _unexpanded(self, model: Model) -> Findings:
        """Yield a finding for each misspelt hardware in the files of the robot that its conditions leave out."""
        expanded = {element.text for block in model.robot.ros2_control for element in block.element.find_all("plugin")}
        usual = (*HARDWARE.values(), *MOCKS)
        for file, source in model.expanded.sources.items():
            if "<hardware" not in source.text or (":if" not in source.text and ":unless" not in source.text):
                continue
            for tag in model.document(file).walk():
                if tag.name != "plugin" or tag.close is None or not any(a.name == "hardware" for a in tag.ancestors()):
                    continue
                text = source.text[tag.end : tag.close].strip()
                if text in usual or text in expanded or "$" in text or is_exported_plugin(model, text):
                    continue
                expected = nearest(text, usual, cutoff=0.9)
                if expected is not None:
                    edit = Edit(source.span(tag.end, tag.close), expected)
                    message = f"unknown hardware `{text}`"
                    fix = Fix("unsafe", f"Replace with `{expected}`", (edit,))
                    yield self.at(model, source.position(tag.start), message, help=f"write `{expected}`", fix=fix)
