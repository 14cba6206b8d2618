"""L112 controller-parameters-missing."""

import re
from pathlib import Path

from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.yaml_tree import documents, yamls
from urdfkit.lint.facts.launch.spawned_controllers import (
    Spawner,
    definitions,
    is_mentioned_elsewhere,
    loaders,
    ros1_files,
    spawners,
    tags,
)
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule

_OTHER_WAYS = r"--?param-file|--?controller-type|[\"' ]-[pt][\"' ]|load_controller"


class ControllerParametersMissing(RobotRule):
    """A launch file starts controllers without their parameters.

    ## What it does
    In ROS 1, compares the controllers that the launch files spawn with the YAML files that define them. A launch file
    must load the YAML file into the namespace of the spawner; K960 reports a wrong namespace if the same launch file
    starts the spawner. MoveIt's simple controller manager needs a file with ``controller_list``. In ROS 2,
    ``ros2_control_node`` needs the parameters unless the spawners pass them.

    ## Why is this bad?
    The spawner fails, because the controller has no type, and the robot does not move.

    ## Example
    ```diff
     <launch>
    +  <rosparam command="load" file="$(find cart_description)/config/controllers.yaml"/>
       <node name="spawner" pkg="controller_manager" type="spawner" args="wheel_controller"/>
     </launch>
    ```

    ## References
    In the package of this example, config/controllers.yaml defines ``wheel_controller`` without a namespace.
    """

    code = "L112"
    name = "controller-parameters-missing"
    severity = "warning"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each spawner, controller manager and MoveIt setting without parameters."""
        files = ros1_files(model)
        defined = definitions(model) if files else {}
        for spawner in spawners(files):
            message = _message(spawner, files, defined, model)
            if message:
                yield self.at_span(spawner.source.span(spawner.tag.start, spawner.tag.end), message)
        yield from self._controller_list(model, files)
        yield from self._controller_manager(model)

    def _controller_list(self, model: Model, files: list[Source]) -> Findings:
        from urdfkit.description.packages.related_files import package_of

        for source, tag in tags(files, "param"):
            value = tag.attributes.get("value")
            if value is None or value.value != "moveit_simple_controller_manager/MoveItSimpleControllerManager":
                continue
            lists = [file for file in yamls(model) if any(root.find("controller_list") for root in documents(file))]
            own = [file for file in lists if package_of(Path(file.file)) == package_of(Path(source.file))]
            is_unread = all(loaders(files, file) == [] for file in lists)
            if any(_is_misspelt(Path(file.file).name, files, model) for file in lists):
                continue
            if own and is_unread and not any(is_mentioned_elsewhere(Path(file.file).name, model) for file in lists):
                message = f"no launch file loads {Path(own[0].file).name}, which defines `controller_list`"
                yield self.at_span(source.span(tag.start, tag.end), message)

    def _controller_manager(self, model: Model) -> Findings:
        from urdfkit.description.packages.related_files import LAUNCH
        from urdfkit.lint.facts.launch.started_nodes import started_nodes

        texts = [source.text for name, source in model.related_files.items() if name.endswith(LAUNCH)]
        if any(re.search(_OTHER_WAYS, text) for text in texts):
            return
        for node in started_nodes(model):
            is_manager = node.program == "ros2_control_node" and node.package == "controller_manager"
            is_bare = node.parameters is not None and {*node.parameters} <= {"robot_description", "use_sim_time"}
            if is_manager and is_bare and not node.has_arguments:
                lacks = "no controller parameters" if node.parameters else "no parameters"
                message = f"`ros2_control_node` has {lacks}, so the types of its controllers are unknown"
                yield self.at_span(node.source.span(*node.settings_place), message)


def _message(spawner: Spawner, files: list[Source], defined: dict[str, list[tuple[Source, str]]], model: Model) -> str:
    """Return the message for a spawner whose controllers lack parameters; empty for the others."""
    for name in spawner.names:
        of_name = defined.get(name, [])
        if len(of_name) != 1:
            continue
        source, inner = of_name[0]
        namespaces = loaders(files, source)
        if namespaces is None or any(
            is_mentioned_elsewhere(Path(each.file).name, model) for each in (source, spawner.source)
        ):
            continue
        if not namespaces and _is_misspelt(Path(source.file).name, files, model):
            continue
        if not namespaces:
            return f"no launch file loads {Path(source.file).name}, which defines `{name}`"
        is_here = Path(source.file).name in spawner.source.text  # spawned-controller-undefined reports this file
        if len(namespaces) == 1 and not is_here:
            there = f"{namespaces[0]}/{inner}".strip("/")
            if there != spawner.namespace:
                here = f"namespace `{spawner.namespace}`" if spawner.namespace else "no namespace"
                there = f"namespace `{there}`" if there else "no namespace"
                return f"`{name}` is spawned in {here}, but its parameters are in {there}"
    return ""


def _is_misspelt(name: str, files: list[Source], model: Model) -> bool:
    """Return whether a launch file names a missing YAML file with nearly that name, which is reported there."""
    from urdfkit.lint.fix_builders import nearest

    existing = {Path(file.file).name for file in yamls(model)}
    named = {word for source in files for word in re.findall(r"[\w-]+\.ya?ml\b", source.text)}
    return nearest(name, named - existing, cutoff=0.85) is not None
