"""K960 spawned-controller-undefined."""

from __future__ import annotations

import re

from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.yaml_tree import span_of
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule


class SpawnedControllerUndefined(RobotRule):
    """A launch file spawns a controller that no parameter file defines.

    ## What it does
    Checks the controllers that launch files pass to the spawner. Reports:

    - misspellings of a controller with a type in the YAML files of these packages
    - in ROS 2, controllers without a type, if the file with their parameters sets the type of other controllers
    - in ROS 1, controllers that the same launch file loads in a namespace other than that of the spawner
    - the only controller of a file that no launch file spawns, if no other controller moves its joints
    - in ROS 1, spawners in a namespace other than that of ``gazebo_ros_control``

    Python launch files are parsed, not executed.

    ## Why is this bad?
    The spawner waits for the controller and then fails, and the robot does not move.

    ## Example
    ```diff
     <launch>
       <rosparam command="load" file="$(find cart_description)/config/controllers.yaml"/>
    -  <node name="spawner" pkg="controller_manager" type="spawner" args="arm_controler"/>
    +  <node name="spawner" pkg="controller_manager" type="spawner" args="arm_controller"/>
     </launch>
    ```

    ## Fix safety
    Unsafe: the fix replaces a misspelt name with the nearest known name, which may not be the intended one.
    """

    code = "K960"
    name = "spawned-controller-undefined"
    severity = "warning"
    fix = "unsafe"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each misspelt name of a spawned controller."""
        from urdfkit.errors import did_you_mean
        from urdfkit.lint.facts.control.controller_joints import controllers
        from urdfkit.lint.facts.control.launched_nodes import started
        from urdfkit.lint.facts.control.ros2_controllers import declared
        from urdfkit.lint.facts.control.spawned_namespaces import plugins_in_other_namespace
        from urdfkit.lint.facts.control.spawned_together import SPAWNERS, left_out, spawned, untyped

        launches = [file for file in model.related_files.values() if re.search(r"spawner|load_controller", file.text)]
        parameter_files = [file for file in model.related_files.values() if file.file.endswith((".yaml", ".yml"))]
        if not launches or not parameter_files:
            return
        for element, message in plugins_in_other_namespace(model):
            yield self.at(model, element, message)
        defined = [name for file in parameter_files for name in controllers(file)]
        for source, key, launch in untyped(model):
            message = f"controller `{key.text}` has no `type`, but {launch.file} spawns it"
            help = "add it here, to the parameters of `controller_manager`"
            place = span_of(source, declared(source)[-1].kind)
            span = span_of(source, key)
            yield self.at_span(span, message, help=help, other=place, is_other_wrong=True, cause=message)
        for source, word, name in left_out(model):
            message = f"no launch file spawns controller `{name}`, unlike the other controllers of its file"
            yield self.at_span(source.span(word.start, word.end), message, names=(name,), kind="left out")
        for source in launches:
            if source.file.endswith(".launch"):
                yield from self._namespaces(source, model)
            nodes = (node for node in started(source) if node.program in SPAWNERS)
            for reference in (word for node in nodes for word in spawned(node)):
                key_pattern = rf"(?<![\w-]){re.escape(reference.name)}[\"']?\s*:"
                hint = did_you_mean(reference.name, defined)
                if (
                    reference.name in defined
                    or not hint
                    or any(re.search(key_pattern, file.text) for file in parameter_files)
                ):
                    continue
                message = f"unknown controller `{reference.name}`" + hint
                yield self.at_span(source.span(reference.start, reference.end), message, kind="unknown")

    def _namespaces(self, source: Source, model: Model) -> Findings:
        from urdfkit.lint.facts.control.spawned_namespaces import misplaced_controllers

        for one in misplaced_controllers(source, model):
            found, expected = (f"namespace `{name}`" if name else "no namespace" for name in (one.found, one.expected))
            spawner = f"{source.file}:{one.line}"
            message = f"`{one.controller}` is in {found}, but its spawner in {spawner} is in {expected}"
            span = source.span(*one.loaded_at) if one.loaded_at is not None else span_of(one.source, one.key)
            yield self.at_span(span, message)
