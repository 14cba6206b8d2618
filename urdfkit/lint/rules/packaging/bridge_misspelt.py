"""K969 bridge-misspelt."""

from __future__ import annotations

import re

from urdfkit.lint.finding import Finding
from urdfkit.lint.rule import NOT_GAZEBO, RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.description.source import Source
    from urdfkit.lint.bridges import Bridged
    from urdfkit.lint.controllers import Named
    from urdfkit.lint.model import Model

_BRIDGES = ("gz_type_name", "gz_topic_name", "ros_type_name", "ign_type_name", "parameter_bridge")


class BridgeMisspelt(RobotRule):
    """A bridge between Gazebo and ROS passes a type, or a topic, that is not there.

    ## What it does
    Looks at what ros_gz_bridge is told to pass, by its YAML and by arguments in launch files: for types that are nearly
    one of those it knows, types that do not go together, misspelt names of parameters and directions, topics that are
    nearly one of the robot's, and commands and measurements that are passed the wrong way.

    ## Why is this bad?
    "No template specialization for the pair", or silence: the bridge waits on a topic that nobody has.

    ## Example
    ```yaml
    - ros_topic_name: cmd_vel
      gz_topic_name: cmd_vel
      ros_type_name: geometry_msgs/msg/Twist
      gz_type_name: gz.msgs.Twits
      direction: ROS_TO_GZ
    ```

    ## Use instead
    ```yaml
    - ros_topic_name: cmd_vel
      gz_topic_name: cmd_vel
      ros_type_name: geometry_msgs/msg/Twist
      gz_type_name: gz.msgs.Twist
      direction: ROS_TO_GZ
    ```
    """

    code = "K969"
    name = "bridge-misspelt"
    severity = "warning"
    not_for = NOT_GAZEBO | {"classic", "ros1"}

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each name, type, topic or direction that is wrong."""
        sources = [source for source in model.around.values() if any(word in source.text for word in _BRIDGES)]
        if not sources:
            return
        from urdfkit.lint.bridges import KEYS, in_launch, in_yaml
        from urdfkit.lint.edits import nearest
        from urdfkit.lint.yaml_tree import span_of

        every: list[tuple[Source, Bridged]] = []
        for source in sources:
            if not source.file.endswith((".yaml", ".yml")):
                every += ((source, one) for one in in_launch(source))
                continue
            for one, keys in in_yaml(source):
                every.append((source, one))
                for key in keys:
                    near = nearest(key.text, KEYS, likeness=0.7) if key.text not in KEYS else None
                    if near is not None:
                        message = f"the bridge reads no `{key.text}`; did you mean `{near}`?"
                        yield Finding(self.code, self.name, self.severity, message, span_of(source, key))
        for source, one in every:
            wrong = _of_types(one) or _of_direction(one)
            if wrong is not None:
                yield self._at(source, *wrong)
        for source, written, message in _of_topics(every, model):
            yield self._at(source, written, message)

    def _at(self, source: Source, written: Named, message: str) -> Finding:
        span = source.span(written.start, written.start + len(written.name))
        return Finding(self.code, self.name, self.severity, message, span)


def _of_types(one: Bridged) -> tuple[Named, str] | None:
    """Return what is wrong with the types of what is passed; None where nothing is."""
    from urdfkit.lint.bridges import pairs
    from urdfkit.lint.edits import nearest

    known = pairs()
    gazebo = {name for names in known.values() for name in names}
    ros_type = one.ros.name if one.ros is not None else ""
    gz_type = one.gazebo.name.replace("::", ".") if one.gazebo is not None else ""
    if gz_type.startswith("ignition.msgs."):
        gz_type = f"gz.msgs.{gz_type.removeprefix('ignition.msgs.')}"
    if one.ros is not None and ros_type in gazebo:
        return one.ros, f"the type of ROS comes before that of Gazebo, not `{one.ros.name}`"
    if one.ros is not None and ros_type not in known:
        near = nearest(ros_type, known, likeness=0.85)
        return (one.ros, f"the bridge knows no type `{one.ros.name}`; did you mean `{near}`?") if near else None
    if one.gazebo is not None and gz_type not in gazebo:
        near = nearest(gz_type, gazebo, likeness=0.85)
        return (one.gazebo, f"the bridge knows no type `{one.gazebo.name}`; did you mean `{near}`?") if near else None
    if one.gazebo is not None and ros_type and gz_type not in known[ros_type]:
        right = " or ".join(f"`{name}`" for name in known[ros_type])
        return one.gazebo, f"the bridge makes no `{one.gazebo.name}` of `{ros_type}`, but {right}"
    return None


def _of_direction(one: Bridged) -> tuple[Named, str] | None:
    from urdfkit.lint.bridges import DIRECTIONS
    from urdfkit.lint.edits import nearest

    if one.direction is None or one.direction.name in DIRECTIONS:
        return None
    near = nearest(one.direction.name, DIRECTIONS, likeness=0.7)
    return one.direction, f"there is no direction `{one.direction.name}`" + (
        f"; did you mean `{near}`?" if near else ""
    )


def _of_topics(every: list[tuple[Source, Bridged]], model: Model) -> Iterator[tuple[Source, Named, str]]:
    """Yield the topics that are nearly one of the robot's, and the directions that pass nothing."""
    from urdfkit.lint.edits import nearest
    from urdfkit.lint.gazebo import references
    from urdfkit.lint.topics import published

    if model.is_incomplete:
        return
    commands: set[str] = set()
    others = {one.topic.strip("/") for one in published(model)}
    for text, _, parameter, _ in references(model, ("topic",)):
        (commands if parameter.meaning == "command_topic" else others).add(text.strip().strip("/"))
    every_topic = commands | others
    passed = {(source.file, one.topic.name.strip("/")) for source, one in every if one.topic is not None}
    for source, one in every:
        if one.topic is None:
            continue
        topic, way = one.topic.name.strip("/"), one.direction.name if one.direction is not None else ""
        free = [name for name in every_topic if (source.file, name) not in passed]
        near = nearest(topic, sorted(free), likeness=0.75) if topic not in every_topic else None
        if near is not None and _is_meant(topic, near) and not _is_below(topic, model):
            yield source, one.topic, f"the robot has no topic `{one.topic.name}` in Gazebo; did you mean `{near}`?"
        elif one.direction is not None and topic in commands - others and way in ("GZ_TO_ROS", "IGN_TO_ROS"):
            yield source, one.direction, f"`{topic}` commands the robot: it has to pass from ROS to Gazebo"
        elif one.direction is not None and topic in others - commands and way in ("ROS_TO_GZ", "ROS_TO_IGN"):
            yield source, one.direction, f"`{topic}` is published in Gazebo: it has to pass from there to ROS"


def _is_meant(topic: str, near: str) -> bool:
    """Whether a topic must be another: a letter less, more or other in a long name, or two that changed places."""
    kept = [[letter for letter in name if letter.isdigit() or letter == "/"] for name in (topic, near)]
    if kept[0] != kept[1]:
        return False
    return sorted(topic) == sorted(near) or (abs(len(near) - len(topic)) <= 1 and min(len(topic), len(near)) > 5)


def _is_below(topic: str, model: Model) -> bool:
    """Whether a topic, or what stands before its last slash, is written in a description, for other arguments maybe."""
    names = "|".join(re.escape(name) for name in {topic, topic.rpartition("/")[0] or topic})
    pattern = rf"topic>\s*/?(?:{names})\s*<"
    return any(re.search(pattern, source.text) for source in model.expanded.sources.values())
