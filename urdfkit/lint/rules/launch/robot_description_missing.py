"""L113 robot-description-missing."""

from pathlib import Path

from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.launch.spawned_controllers import is_mentioned_elsewhere, ros1_files, tags
from urdfkit.lint.model.tags import Tag
from urdfkit.lint.rule import Findings, Model, RobotRule

_SLIDERS = {"joint_state_publisher", "joint_state_publisher_gui"}


class RobotDescriptionMissing(RobotRule):
    """A launch file starts robot_state_publisher or a spawner without a description of the robot.

    ## What it does
    In ROS 2, ``robot_state_publisher`` needs the parameter ``robot_description``, a parameter file or arguments. In ROS
    1, the rule checks launch files that start Gazebo and its spawner, or RViz and joint_state_publisher. The parameter
    ``robot_description`` must be set in the launch file, in a file that it includes, or in a file that includes it.

    ## Why is this bad?
    The node stops, or the robot does not appear.

    ## Example
    ```diff title="robot.launch.py"
     from launch import LaunchDescription
     from launch_ros.actions import Node


     def generate_launch_description():
    -    return LaunchDescription([Node(package="robot_state_publisher", executable="robot_state_publisher")])
    +    description = {"robot_description": "<robot name='cart'><link name='base'/></robot>"}
    +    return LaunchDescription([
    +        Node(package="robot_state_publisher", executable="robot_state_publisher", parameters=[description])
    +    ])
    ```
    """

    code = "L113"
    name = "robot-description-missing"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each node that has no description."""
        from urdfkit.lint.facts.launch.started_nodes import started_nodes
        from urdfkit.lint.facts.ros_packages import is_slip

        for node in started_nodes(model):
            is_publisher = node.program == node.package == "robot_state_publisher"
            names = node.parameters
            if not is_publisher or names is None or node.has_arguments or "robot_description" in names:
                continue
            if not any(is_slip(name, "robot_description") for name in names):  # launch-name-misspelt reports these
                message = "`robot_state_publisher` is started without the parameter `robot_description`"
                yield self.at_span(node.source.span(node.start, node.end), message, names=("robot_description",))
        yield from self._in_ros1(model)

    def _in_ros1(self, model: Model) -> Findings:
        from urdfkit.lint.facts.launch.actions import actions_of
        from urdfkit.lint.facts.launch.receivers import OUTSIDE, included_files

        files = ros1_files(model)
        below: dict[str, list[Source] | None] = {}
        for file in files:
            inner = list(included_files(actions_of(file), model))
            calls = [call for each in inner if each is not None for call in each.includes]
            outside = [call for call in calls if (call.package, call.path.rpartition("/")[2]) in OUTSIDE]
            is_whole = inner.count(None) <= len(outside)
            below[file.file] = [each.source for each in inner if each is not None] if is_whole else None
        for file in files:
            own = below[file.file]
            user = _user(file)
            if user is None or own is None or not _is_complete(own) or any(_sets(tag) for _, tag in tags(own, "param")):
                continue
            above = [each for each in below.values() if each is None or (each is not own and file in each)]
            if any(each is None or any(_sets(tag, True) for _, tag in tags(each, "param")) for each in above):
                continue
            if is_mentioned_elsewhere(Path(file.file).name, model):
                continue
            message = "the parameter `robot_description` is not set by this launch file or its includes"
            yield self.at_span(file.span(user.start, user.end), message)


def _user(file: Source) -> Tag | None:
    """Return the first node of a launch file that reads ``robot_description``."""
    for _, tag in tags([file], "node"):
        values = {name: each.value for name, each in tag.attributes.items()}
        words = values.get("args", "").split()
        is_spawner = values.get("type") == "spawn_model" and "robot_description" in words and "-param" in words
        if is_spawner or values.get("type") == "robot_state_publisher":
            children = [child.attributes for child in tag.children]
            if not any("robot_description" in each["from"].value for each in children if "from" in each):
                return tag
    return None


def _is_complete(files: list[Source]) -> bool:
    """Return whether launch files start a whole robot: Gazebo or RViz with sliders."""
    programs = {tag.attributes["type"].value for _, tag in tags(files, "node") if "type" in tag.attributes}
    includes = [tag.attributes["file"].value for _, tag in tags(files, "include") if "file" in tag.attributes]
    if "spawn_model" in programs and any("gazebo_ros)" in file for file in includes):
        return True
    return {"rviz", "robot_state_publisher"} <= programs and not _SLIDERS.isdisjoint(programs)


def _sets(tag: Tag, is_always: bool = False) -> bool:
    """Return whether a <param> sets the description, perhaps only under a condition."""
    name = tag.attributes["name"].value if "name" in tag.attributes else ""
    has_condition = any("if" in each.attributes or "unless" in each.attributes for each in (tag, *tag.ancestors()))
    is_description = name.endswith("robot_description") or (name.startswith("$") and "semantic" not in name)
    return is_description and not (is_always and has_condition)
