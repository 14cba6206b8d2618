"""K962 controller-settings-misspelt."""

import re
from typing import Any

from urdfkit.defect_message import Suggestion
from urdfkit.description.control.controller_types import TYPES, meant_type
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.controller_settings import (
    INTERFACES,
    misspelt,
    misspelt_names,
    misspelt_sections,
    sections_without_parameters,
)
from urdfkit.lint.facts.control.yaml_tree import documents, groups, span_of, yamls
from urdfkit.lint.finding import Finding, Severity
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule

_PARAMETERS = "ros__parameters"
_LEVEL = r"(?m)^[ \t]+(ros_{1,3}param\w*)[ \t]*:[ \t]*\r?$"
_TAB = r"(?m)^ *\t[ \t]*(?=[^\s#])"


class ControllerSettingsMisspelt(RobotRule):
    """A controller type, section or parameter in YAML is misspelt.

    ## What it does
    Checks the controller parameters in the YAML files of the robot's package and of neighbouring packages that depend
    on it. Errors are:

    - misspelt controller types of ros_controllers and ros2_controllers, and misspelt interfaces
    - a misspelt or missing key ``ros__parameters`` (with two underscores)
    - tabs

    Misspelt parameters and names of controller sections are reported as warnings. Types that a package of the workspace
    exports are accepted. With ``--target urdfkit``, a type of another package is reported if a Gazebo plugin of the
    robot loads the controller, because urdfkit does not simulate such controllers. Unknown parameters of such a
    controller are reported as notes.

    ## Why is this bad?
    The controller fails to load with "Loader for controller not found", or starts without its joints, because ROS
    ignores unknown keys. A YAML parser rejects a file with tabs.

    ## Example
    ```diff
     controller_manager:
       ros__parameters:
         arm_controller:
    -      type: joint_trajectory_controllers/JointTrajectoryController
    +      type: joint_trajectory_controller/JointTrajectoryController
     arm_controller:
       ros__parameters:
         joints: [elbow]
    ```

    ## Fix safety
    Unsafe: the fix replaces a misspelt name with the nearest known name, which may not be the intended one.
    """

    code = "K962"
    name = "controller-settings-misspelt"
    severity = "warning"
    fix = "unsafe"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each misspelt name, and for the first tab of a file."""
        from urdfkit.lint.facts.control.controller_joints import typed
        from urdfkit.lint.facts.control.exported_plugins import is_exported_plugin
        from urdfkit.lint.facts.control.launch_package_paths import uncommented

        yield from self._loaded(model)
        for source in model.related_files.values():
            if not source.file.endswith((".yaml", ".yml")):
                continue
            text = uncommented(source)
            types = list(typed(source))
            if not types and "controller" not in text:
                for level in re.finditer(_LEVEL, text):
                    if level[1] != _PARAMETERS:
                        message = f"unknown key `{level[1]}`" + Suggestion(_PARAMETERS, level[1])
                        yield self._at(source, level.start(1), level[1], message, severity="error")
                continue
            for reference in types:
                suggestion = meant_type(reference.name)
                if suggestion is not None and not is_exported_plugin(model, reference.name):
                    message = f"unknown controller type `{reference.name}`" + Suggestion(suggestion, reference.name)
                    yield self._at(source, reference.start, reference.name, message, severity="error")
            for start, name, meant in misspelt_sections(source):
                is_level = meant == _PARAMETERS
                message = f"unknown {'key' if is_level else 'controller'} `{name}`" + Suggestion(meant, name)
                yield self._at(source, start, name, message, severity="error" if is_level else None)
            yield from self._parameters(source, model)
            yield from self._sections(source)
            if (tab := re.search(_TAB, text)) is not None:
                message = "YAML is indented with a tab"
                yield self._at(source, tab.start(), tab[0], message, help="indent with spaces", severity="error")

    def _loaded(self, model: Model) -> Findings:
        """Yield a finding for each loaded controller of another package, for urdfkit, and for unknown parameters."""
        from urdfkit.description.control.controller_parameters import unknown_parameters
        from urdfkit.lint.facts.control.loaded_controllers import loaded_controllers

        loaded = loaded_controllers(model)
        keys = [(source.file, key.line, key.column) for source in yamls(model) for key, _, _ in misspelt(source)]
        for name, settings, _ in loaded:
            kind = settings.group("type")
            unknown = [(each.place, each.name) for each in unknown_parameters(settings)]
            unknown = [(at, each) for at, each in unknown if (at.file, at.line, at.column) not in keys]
            if unknown:
                names = ", ".join(f"`{each}`" for _, each in unknown)
                message = f"controller `{name}` ignores the unknown parameters {names}"
                yield self.at(model, unknown[0][0], message, severity="note")
            is_defect = model.target == "urdfkit" or "/" not in (kind.value or "")
            if is_defect and kind.value and kind.value not in TYPES and meant_type(kind.value) is None:
                message = f"controller `{name}`: urdfkit does not simulate the type `{kind.value}` of another package"
                yield self.at(model, kind.position, message)

    def _sections(self, source: Source) -> Findings:
        """Yield a finding for each type without package, and each ROS 2 section without ``ros__parameters``."""
        for root in documents(source):
            for _, group in groups(root):
                kind = group.find("type")
                if kind is None or "/" in kind.text or not kind.text:
                    continue
                written = re.sub(r"::|\.", "/", kind.text)
                matches = [name for name in TYPES if written == name or name.endswith(f"/{written}")]
                if matches:
                    message = f"unknown controller type `{kind.text}`" + Suggestion(matches[0], kind.text)
                    yield self.at_span(span_of(source, kind), message, severity="error")
        for key in sections_without_parameters(source):
            message = f"section `{key.text}` has no `{_PARAMETERS}`; ROS 2 rejects the file"
            help = f"write `{_PARAMETERS}:` on the next line and indent the parameters"
            yield self.at_span(span_of(source, key), message, severity="error", help=help)

    def _parameters(self, source: Source, model: Model) -> Findings:
        from urdfkit.lint.facts.control.ros2_controllers import offered

        for node, suggestion, description in misspelt_names(source):
            # hardware-interface-lacking compares interfaces with the hardware.
            if suggestion not in INTERFACES or not offered(model):
                message = description + Suggestion(suggestion, node.text)
                severity: Severity = "error" if suggestion in INTERFACES else self.severity
                yield self.at_span(span_of(source, node), message, severity=severity, names=(node.text,))

        for key, suggestion, controller in misspelt(source):
            message = f"unknown parameter `{key.text}` of controller `{controller.name}`" + Suggestion(
                suggestion, key.text
            )
            yield self.at_span(span_of(source, key), message)

    def _at(self, source: Source, start: int, text: str, message: str, **details: Any) -> Finding:
        return self.at_span(source.span(start, start + len(text)), message, **details)
