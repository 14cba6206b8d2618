"""L104 launch-name-misspelt."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import lru_cache

from urdfkit.defect_message import Suggestion
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.controller_joints import Named
from urdfkit.lint.facts.control.launch_package_paths import uncommented
from urdfkit.lint.finding import Finding
from urdfkit.lint.rule import Findings, Model, RobotRule

_NAMES = ("use_sim_time", "robot_description")
_PLURAL = ("use_sim_times", "use_sim_time")
_OF_MOVEIT = tuple(f"robot_description_{name}" for name in ("semantic", "planning", "kinematics"))
_TOPICS = (*_NAMES, "joint_states", "controller_manager", *_OF_MOVEIT)
_QUOTED = r"[\"'](?:(?:[\w~/]*/)?(?P<name>[A-Za-z]\w{8,28})|[\w~/]*/(?P<dashed>[A-Za-z][\w-]{8,20}))[\"']"
_KEY = r"(?m)(?<=[\s{,])(?P<name>[A-Za-z]\w{8,20})(?=[ \t]*:)(?P<dashed>)"
_COMMAND = r"(?:\$\(command\s+[\"']?|\bCommand\(\s*\[\s*[\"']|\bfind\s+xacro\)/)(\w+)(?=[\s\"'])"
_WORLD = r"(?<![\w/.-])([A-Za-z]\w+)\.sdf\b"
_WORLDS = ("empty", "shapes", "sensors", "visualize_lidar", "diff_drive", "gpu_lidar_sensor")
"""Worlds of gz-sim (examples/worlds), which need no path."""
_SUBSCRIBED = {
    "controller_manager": "robot_description",
    "joint_state_publisher": "joint_states",
    "joint_state_publisher_gui": "joint_states",
    "moveit_ros_move_group": "joint_states",
    "robot_state_publisher": "joint_states",
}
"""Package → the topic that its node publishes or reads, which remappings name."""


class LaunchNameMisspelt(RobotRule):
    """A launch file or YAML file misspells ``use_sim_time``, ``robot_description`` or another common name.

    ## What it does
    Checks the spelling of these names:

    - quoted words in launch files that resemble ``use_sim_time``, ``robot_description``, ``joint_states``,
      ``controller_manager`` or a MoveIt plugin
    - keys in YAML files that resemble ``use_sim_time`` or ``robot_description``
    - remapped topics and parameters of common nodes, such as ``teleop_twist_joy_node``, ``slam_toolbox`` and
      ``parameter_bridge``, even if the node has another name
    - parameters of nodes of the workspace, if the code of the node does not contain the name
    - namespaces of costmaps, which must be ``local_costmap`` or ``global_costmap``
    - worlds without a path, which must be worlds of Gazebo
    - environment variables of ROS and Gazebo, including those of a Gazebo version that the launch files do not start

    Words that differ by more than one letter, or that the file declares as a launch argument, are accepted.

    ## Why is this bad?
    The node does not use the simulated time, or waits for a description that is never published.

    ## Example
    ```diff
     <launch>
    -  <param name="use_sim_tme" value="true"/>
    +  <param name="use_sim_time" value="true"/>
     </launch>
    ```

    ## Fix safety
    Unsafe: the fix replaces a misspelt name with the nearest known name, which may not be the intended one.
    """

    code = "L104"
    name = "launch-name-misspelt"
    fix = "unsafe"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each misspelt name."""
        from urdfkit.description.packages.related_files import LAUNCH
        from urdfkit.lint.facts.control.exported_plugins import is_exported_plugin
        from urdfkit.lint.facts.control.yaml_tree import span_of
        from urdfkit.lint.facts.launch.actions import actions_of
        from urdfkit.lint.facts.launch.environment_variables import wrong_variables
        from urdfkit.lint.facts.launch.node_parameters import misspelt_in_launch, misspelt_parameters
        from urdfkit.lint.facts.navigation.misspelt import misspelt_navigation
        from urdfkit.lint.facts.parameters.own_parameters import undeclared_parameters

        for source, place, undeclared, near in undeclared_parameters(model):
            message = f"the code of the node does not declare the parameter `{undeclared}`"
            yield self.at_span(
                source.span(*place), message + Suggestion(near, undeclared), severity="warning", names=(undeclared,)
            )
        for source, start, variable, message in wrong_variables(model):
            span = source.span(start, start + len(variable))
            yield self.at_span(span, message, severity="warning", kind="variable")
        for source in model.related_files.values():
            is_launch = source.file.endswith(LAUNCH)
            if not is_launch and not source.file.endswith((".yaml", ".yml")):
                continue
            names = _TOPICS if is_launch else _NAMES
            for word in re.finditer(_QUOTED if is_launch else _KEY, uncommented(source)):
                group = "name" if word["name"] is not None else "dashed"
                written, start = word[group], word.start(group)
                near = _nearest(written, names)
                before = source.text[max(word.start() - 25, 0) : word.start() + 1]
                if near is None or re.search(r"-(?:topic|param)\b", before):  # spawn-argument-misspelt reports these
                    continue
                if not (is_launch and written in actions_of(source).declared):
                    yield self._at(source, written, start, near)
            for key, node, near in () if is_launch else misspelt_parameters(source):
                message = f"unknown parameter `{key.text}` of node `{node}`" + Suggestion(near, key.text)
                yield self.at_span(span_of(source, key), message, severity="warning")
            for key, kind, near in () if is_launch else misspelt_navigation(source):
                if kind == "plugin" and is_exported_plugin(model, key.text):
                    continue
                of = "Nav2" if "ros__parameters" in source.text else "costmap_2d"
                message = f"unknown {kind} `{key.text}` in the parameters of {of}" + Suggestion(near, key.text)
                yield self.at_span(span_of(source, key), message, severity="warning")
            for word in re.finditer(_COMMAND, uncommented(source)) if is_launch else ():
                if _nearest(word[1], ("xacro",)) is not None:
                    yield self._at(source, word[1], word.start(1), "xacro")
            if is_launch and "moveit" in source.text:
                yield from self._of_moveit(source)
            for parameter, package, near in misspelt_in_launch(source) if is_launch else ():
                message = f"unknown parameter `{parameter.name}` of a node of `{package}`" + Suggestion(
                    near, parameter.name
                )
                span = source.span(parameter.start, parameter.end)
                yield self.at_span(span, message, severity="warning", names=(near,) if near is not None else ())
            for world in re.finditer(_WORLD, uncommented(source)) if is_launch and "gz" in source.text else ():
                near = _nearest(world[1], _WORLDS)
                if near is not None and world[1] not in _WORLDS:
                    yield self._at(source, f"{world[1]}.sdf", world.start(1), f"{near}.sdf")
            if is_launch and not source.file.endswith(".py"):
                for topic, near in _remapped(source):
                    yield self._at(source, topic.name, topic.start, near)

    def _of_moveit(self, source: Source) -> Findings:
        """Yield a finding for each misspelt plugin and for each misspelt parameter behind an argument."""
        from urdfkit.lint.facts.moveit.planning import meant_plugin

        text = uncommented(source)
        for word in re.finditer(r"(?<=[\"'\s])[a-z]\w+(?:/|::)[A-Z]\w+(?=[\"'\s])", text):
            plugin = meant_plugin(word[0])
            if plugin is not None:
                yield self._at(source, word[0], word.start(), plugin)
        for word in re.finditer(r"\$\((?:arg|var)\s+robot_description\)(_\w+)", text):
            name = f"robot_description{word[1]}"
            near = _nearest(name, _OF_MOVEIT) or next(
                (each for each in (f"{name}s", name[:-1]) if each in _OF_MOVEIT), None
            )
            if near is not None:
                yield self._at(source, word[1], word.start(1), near.removeprefix("robot_description"))

    def _at(self, source: Source, written: str, start: int, near: str) -> Finding:
        message, span = (
            f"unknown name `{written}`" + Suggestion(near, written),
            source.span(start, start + len(written)),
        )
        return self.at_span(span, message, kind="name", names=(near,))


@lru_cache(maxsize=4096)
def _nearest(written: str, names: tuple[str, ...]) -> str | None:
    from urdfkit.lint.facts.ros_packages import is_slip

    others = (name for name in names if written != name)
    return next((name for name in others if is_slip(written, name) or (written, name) == _PLURAL), None)


def _remapped(source: Source) -> Iterator[tuple[Named, str]]:
    """Yield the topics in remappings in XML that differ from a topic by a final ``s`` or by ``-``, and namespaces."""
    from urdfkit.lint.model.tags import Document

    for tag in (tag for root in Document(source).roots for tag in root.walk() if tag.name in ("remap", "rosparam")):
        space = tag.attributes.get("ns") if tag.name == "rosparam" else None
        meant = _nearest(space.value, ("global_costmap", "local_costmap")) if space is not None else None
        if space is not None and meant is not None:
            yield Named(space.value, space.value_start), meant
        if tag.name == "rosparam":
            continue
        for value in tag.attributes.values():
            last = value.value.rpartition("/")[2]
            if "-" in last and last.replace("-", "_") in _TOPICS:
                yield Named(last, value.value_start + len(value.value) - len(last)), last.replace("-", "_")
        node, replaced = tag.parent, tag.attributes.get("from")
        package = node.attributes.get("pkg") if node is not None else None
        topic = _SUBSCRIBED.get(package.value) if package is not None else None
        if replaced is None or topic is None:
            continue
        written = replaced.value.rpartition("/")[2]
        if {written, topic} in ({topic, f"{topic}s"}, {topic, topic[:-1]}) and written != topic:
            yield Named(written, replaced.value_start + len(replaced.value) - len(written)), topic
