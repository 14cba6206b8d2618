"""K969 bridge-misspelt."""

from __future__ import annotations

import re
from collections.abc import Iterator

from urdfkit.defect_message import Suggestion
from urdfkit.description.xml.element import Element
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.controller_joints import Named
from urdfkit.lint.facts.control.ros_gz_bridges import (
    DIRECTIONS,
    KEYS,
    REQUIRED,
    Bridged,
    in_launch,
    in_yaml,
    malformed_in_launch,
    pairs,
)
from urdfkit.lint.facts.gazebo.sensor_topics import published
from urdfkit.lint.facts.ros_packages import is_slip
from urdfkit.lint.finding import Finding
from urdfkit.lint.fix_builders import nearest
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule

_PUBLISHED = frozenset(
    (
        *("Altimeter", "BatteryState", "CameraInfo", "Clock", "Contacts", "FluidPressure", "Image", "IMU", "LaserScan"),
        *("Magnetometer", "Model", "NavSat", "Odometry", "OdometryWithCovariance", "PointCloudPacked"),
        "WorldStatistics",
    )
)
"""Types that only sensors and systems of Gazebo publish."""

_BRIDGES = ("gz_type_name", "gz_topic_name", "ros_type_name", "ign_type_name", "parameter_bridge", "image_bridge")


class BridgeMisspelt(RobotRule):
    """A bridge between Gazebo and ROS uses an unknown type or topic.

    ## What it does
    Checks the configuration of ros_gz_bridge, in YAML and in the arguments of launch files, for:

    - misspelt message types, keys, directions and topics of the robot
    - pairs of types that cannot be converted, and pairs of topics of the left and the right side of the robot
    - topics of commands and sensors that are bridged in the wrong direction
    - topics with the name of a world or model that no world file or launch file has
    - a missing bridge for the clock or the joint states, if nodes need them

    ## Why is this bad?
    The bridge logs "No template specialization for the pair", or waits for a topic that does not exist and logs
    nothing.

    ## Example
    ```diff
     - ros_topic_name: cmd_vel
       gz_topic_name: cmd_vel
       ros_type_name: geometry_msgs/msg/Twist
    -  gz_type_name: gz.msgs.Twits
    +  gz_type_name: gz.msgs.Twist
       direction: ROS_TO_GZ
    ```

    ## Fix safety
    Unsafe: the fix replaces a misspelt name with the nearest known name, which may not be the intended one.
    """

    code = "K969"
    name = "bridge-misspelt"
    severity = "warning"
    fix = "unsafe"
    not_for = NOT_GAZEBO | {"classic", "ros1"}

    def check(self, model: Model) -> Findings:
        """Yield a finding for each invalid key, type, topic or direction."""
        yield from self._worlds_and_models(model)
        sources = [source for source in model.related_files.values() if any(word in source.text for word in _BRIDGES)]
        if not sources:
            return
        from urdfkit.lint.facts.control.yaml_tree import span_of
        from urdfkit.lint.facts.gazebo.unbridged_topics import unbridged

        bridges: list[tuple[Source, Bridged]] = []
        for source in sources:
            if not source.file.endswith((".yaml", ".yml")):
                bridges += ((source, bridge) for bridge in in_launch(source))
                continue
            for bridge, keys in in_yaml(source):
                bridges.append((source, bridge))
                names = [key.text for key in keys]
                for parameter, others in REQUIRED.items():
                    accepted = (parameter, *others)
                    is_misspelt = any(is_slip(name, each) for name in names for each in accepted)
                    if not is_misspelt and not any(nearest(each, names, cutoff=0.85) for each in accepted):
                        message = f"bridge has no `{parameter}`"
                        yield self.at_span(span_of(source, keys[0]), message)
                for key in keys:
                    suggestion = nearest(key.text, KEYS, cutoff=0.7) if key.text not in KEYS else None
                    if suggestion is not None:
                        message = f"unknown key `{key.text}` of ros_gz_bridge" + Suggestion(suggestion, key.text)
                        yield self.at_span(span_of(source, key), message)
        for source in (each for each in sources if not each.file.endswith((".yaml", ".yml"))):
            for word in malformed_in_launch(source):
                yield self._at(source, word, f"`{word.name}` is not of the form `topic@ROS type@Gazebo type`")
        for source, bridge in bridges:
            defect = _type_defect(bridge, model) or _direction_defect(bridge) or _former_type(bridge, model)
            if defect is not None:
                yield self._at(source, *defect)
        for source, topic, message in unbridged(bridges, model):
            yield self._at(source, topic, message, "lacking")
        below: dict[str, set[str]] = {}
        for _, bridge in bridges:
            space, _, last = (bridge.topic.name if bridge.topic is not None else "").strip("/").rpartition("/")
            below.setdefault(space, set()).add(last)
        for source, reference, message in _topic_defects(bridges, model):
            found = self._at(source, reference, message, "topic")
            space = reference.name.strip("/").rpartition("/")[0]
            sensor = _plain_camera(space, model) if below.get(space, set()) & {"depth_image", "points"} else None
            if sensor is not None:
                place = model.span(sensor.origin.position, "type")
                text = f"a sensor of type `camera` has no topic `{reference.name}`, which a bridge reads"
                details = {"other": place, "is_other_wrong": True, "cause": "camera", "message": text, "fix": None}
                help = f"write `rgbd_camera`, which has topics below `{space}`"
                found = Finding(**{**found.__dict__, **details, "help": help, "suggestion": None})
            elif (named := _misnamed_sensor(source, reference, found.meant, model)) is not None:
                place = model.span(named.origin.position)
                text = f"a bridge reads `{reference.name}`, but this sensor publishes on `{found.meant}`"
                details = {"other": place, "is_other_wrong": True, "cause": "topic", "message": text}
                found = Finding(**{**found.__dict__, **details, "suggestion": None})
            yield Finding(**{**found.__dict__, "names": (found.meant,)}) if found.meant else found

    def _worlds_and_models(self, model: Model) -> Findings:
        from urdfkit.lint.facts.gazebo.world_topics import topics_of_other_models, topics_of_other_worlds

        for source, start, world, worlds in topics_of_other_worlds(model):
            near = nearest(world, worlds, cutoff=0.7) or (worlds[0] if len(worlds) == 1 else None)
            message = f"no world file of these packages has a world `{world}`" + Suggestion(near, world)
            yield self.at_span(source.span(start, start + len(world)), message)
        for source, start, name, near in topics_of_other_models(model):
            message = f"no launch file spawns a model `{name}`" + Suggestion(near, name)
            yield self.at_span(source.span(start, start + len(name)), message)

    def _at(self, source: Source, reference: Named, message: str, kind: str = "") -> Finding:
        return self.at_span(source.span(reference.start, reference.end), message, kind=kind)


_FORMER = "ignition.msgs."
"""Namespace of the messages of Gazebo Fortress."""


def _type_defect(bridge: Bridged, model: Model) -> tuple[Named, str] | None:
    """Return an invalid type with its message; None if both types are valid."""
    compatible_types = pairs()
    gazebo_types = {name for names in compatible_types.values() for name in names}
    ros_type = bridge.ros.name if bridge.ros is not None else ""
    gz_type = bridge.gazebo.name.replace("::", ".") if bridge.gazebo is not None else ""
    space = _FORMER if gz_type.startswith(_FORMER) and _former_type(bridge, model) is None else "gz.msgs."
    gz_type = f"gz.msgs.{gz_type.removeprefix(_FORMER)}" if gz_type.startswith(_FORMER) else gz_type
    if bridge.ros is not None and ros_type in gazebo_types:
        return bridge.ros, f"expected the ROS type before the Gazebo type, found `{bridge.ros.name}`"
    if bridge.ros is not None and ros_type not in compatible_types:
        suggestion = nearest(ros_type, compatible_types, cutoff=0.85)
        return (
            (bridge.ros, f"unknown ROS type `{bridge.ros.name}`" + Suggestion(suggestion, bridge.ros.name))
            if suggestion
            else None
        )
    if bridge.gazebo is not None and gz_type not in gazebo_types:
        suggestion = nearest(gz_type, gazebo_types, cutoff=0.85)
        suggestion = suggestion.replace("gz.msgs.", space) if suggestion is not None else None
        return (
            (bridge.gazebo, f"unknown Gazebo type `{bridge.gazebo.name}`" + Suggestion(suggestion, bridge.gazebo.name))
            if suggestion
            else None
        )
    if bridge.gazebo is not None and ros_type and gz_type not in compatible_types[ros_type]:
        compatible = " or ".join(f"`{name.replace('gz.msgs.', space)}`" for name in compatible_types[ros_type])
        return bridge.gazebo, f"cannot convert between `{ros_type}` and `{bridge.gazebo.name}`; use {compatible}"
    return None


def _former_type(bridge: Bridged, model: Model) -> tuple[Named, str] | None:
    """Return a type of Gazebo Fortress in a bridge of a robot with plugins of a later release, with its message."""
    if bridge.gazebo is None or not bridge.gazebo.name.startswith(_FORMER):
        return None
    texts = [each.text for each in model.expanded.sources.values()]
    later, former = r"\bgz-sim-|\bgz::sim::|\bgz_ros2_control\b", r"\bign_ros2_control\b"
    if not any(re.search(later, text) for text in texts) or any(re.search(former, text) for text in texts):
        return None
    right = f"gz.msgs.{bridge.gazebo.name.removeprefix(_FORMER)}"
    return bridge.gazebo, f"`{bridge.gazebo.name}` is a type of Gazebo Fortress" + Suggestion(right, bridge.gazebo.name)


def _direction_defect(bridge: Bridged) -> tuple[Named, str] | None:
    """Return an unknown direction with its message; None if it is valid."""
    if bridge.direction is None or bridge.direction.name in DIRECTIONS:
        return None
    suggestion = nearest(bridge.direction.name, DIRECTIONS, cutoff=0.7)
    return bridge.direction, f"unknown direction `{bridge.direction.name}`" + Suggestion(
        suggestion, bridge.direction.name
    )


def _topic_defects(bridges: list[tuple[Source, Bridged]], model: Model) -> Iterator[tuple[Source, Named, str]]:
    """Yield misspelt topics and wrong directions with their messages."""
    from urdfkit.lint.facts.gazebo.plugins import references
    from urdfkit.lint.facts.topics.misspelt import COMMON
    from urdfkit.lint.facts.topics.words import Words
    from urdfkit.lint.facts.twins import mirrored, side_of

    words = Words(model)
    commands: set[str] = set()
    sensors = [] if model.is_incomplete else list(published(model))
    others = {"clock", *(publication.topic.strip("/") for publication in sensors)}
    kinds = [(each.topic.strip("/"), each.type) for each in sensors]
    for text, _, parameter, _ in references(model, ("topic",)) if not model.is_incomplete else ():
        kinds += [(text.strip().strip("/"), "Odometry")] if parameter.meaning == "odometry_topic" else []
        (commands if parameter.meaning == "command_topic" else others).add(text.strip().strip("/"))
    robot_topics = commands | others
    bridged_topics = {
        (source.file, bridge.topic.name.strip("/")) for source, bridge in bridges if bridge.topic is not None
    }
    for source, bridge in bridges:
        if bridge.topic is None:
            continue
        topic, direction = bridge.topic.name.strip("/"), bridge.direction.name if bridge.direction is not None else ""
        ros = bridge.published.name.strip("/") if bridge.published is not None else ""
        sides = side_of(topic), side_of(ros)
        own = [each for each in mirrored(bridge.topic.name) if each.strip("/") in {ros, *robot_topics}]
        if all(sides) and len(set(sides)) > 1 and own:
            message = f"the bridge connects `{ros}` with `{bridge.topic.name}` on the other side"
            yield source, bridge.topic, message + Suggestion(own[0], bridge.topic.name)
            continue
        unbridged = [name for name in robot_topics if (source.file, name) not in bridged_topics]
        suggestion = nearest(topic, sorted(unbridged), cutoff=0.75) if topic not in robot_topics else None
        if topic in COMMON and suggestion is not None and suggestion not in COMMON:
            continue  # topic-misspelt reports the name in the description
        if suggestion is not None and _is_misspelling(topic, suggestion) and not _is_in_description(topic, model):
            message = f"the robot has no Gazebo topic `{bridge.topic.name}`" + Suggestion(suggestion, bridge.topic.name)
            yield source, bridge.topic, message
        elif bridge.direction is not None and topic in commands - others and direction in ("GZ_TO_ROS", "IGN_TO_ROS"):
            yield source, bridge.direction, f"`{topic}` is a command topic; bridge it from ROS to Gazebo"
        elif bridge.direction is not None and topic in others - commands and direction in ("ROS_TO_GZ", "ROS_TO_IGN"):
            yield source, bridge.direction, f"`{topic}` is published in Gazebo; bridge it from Gazebo to ROS"
        elif bridge.direction is not None and _type(bridge) in _PUBLISHED and direction.startswith("ROS_TO_"):
            message = f"Gazebo publishes `{_type(bridge)}` and does not read it; bridge it from Gazebo to ROS"
            yield source, bridge.direction, message
        elif topic not in robot_topics and not topic.startswith("world/") and "$" not in topic:
            same = [name for name, kind in kinds if kind == _type(bridge)]
            free = sorted({name for name in same if (source.file, name) not in bridged_topics})
            pattern = rf"topic>\s*/?{re.escape(topic)}\s*<"
            if topic.startswith("model/"):  # the defaults of plugins, unless the robot names its own topic in this way
                free = [name for name in free if re.fullmatch(rf"model/[^/]+/{topic.rpartition('/')[2]}", name)]
            texts = [each.text for each in model.expanded.sources.values()]
            is_convertible = _type_defect(bridge, model) is None
            if (
                free
                and is_convertible
                and not any(re.search(pattern, text) for text in texts)
                and not words.match(pattern)
            ):
                near = free[0] if len(free) == 1 else None
                what = Suggestion(near) if near is not None else f"; it publishes {_listed(free)}"
                yield source, bridge.topic, f"the robot has no Gazebo topic `{bridge.topic.name}`" + what


def _plain_camera(topic: str, model: Model) -> Element | None:
    """Return the sensor of type ``camera`` with this topic, below which only cameras with depth have topics."""
    for block in model.robot.gazebo:
        for sensor in block.sensors:
            written = sensor.element.find("topic")
            if sensor.type == "camera" and written is not None and (written.text or "").strip().strip("/") == topic:
                return sensor.element
    return None


def _misnamed_sensor(source: Source, reference: Named, meant: str, model: Model) -> Element | None:
    """Return the element that names another topic than a bridge with equal names on both sides; None without one.

    A slip in the bridge would make its names differ.
    """
    from urdfkit.lint.facts.control.yaml_tree import documents, yamls

    entries = [item for root in documents(source) for item in root.items] if source in yamls(model) else []
    used, named = reference.name.strip("/"), meant.strip("/")
    for entry in entries if named and not is_slip(used, named) and not used.startswith(f"{named}/") else ():
        gazebo, ros = entry.find("gz_topic_name") or entry.find("ign_topic_name"), entry.find("ros_topic_name")
        if gazebo is None or source.offset(gazebo.line, gazebo.column) != reference.start:
            continue
        if ros is not None and gazebo.text == ros.text == reference.name:
            elements = [each.element for each in published(model) if each.topic.strip("/") == named]
            return elements[0] if len(elements) == 1 and elements[0].tag == "topic" else None
    return None


def _type(bridge: Bridged) -> str:
    """Return the Gazebo type of a bridge without its package."""
    return re.split(r"[.:]", bridge.gazebo.name)[-1] if bridge.gazebo is not None else ""


def _listed(names: list[str]) -> str:
    return ", ".join(f"`{name}`" for name in names[:3])


def _is_misspelling(topic: str, suggestion: str) -> bool:
    """Return whether two topics differ by swapped letters or, in a long name, by one letter."""
    fixed_characters = [
        [letter for letter in name if letter.isdigit() or letter == "/"] for name in (topic, suggestion)
    ]
    if fixed_characters[0] != fixed_characters[1]:
        return False
    return sorted(topic) == sorted(suggestion) or (
        abs(len(suggestion) - len(topic)) <= 1 and min(len(topic), len(suggestion)) > 5
    )


def _is_in_description(topic: str, model: Model) -> bool:
    """Return whether a topic or its namespace occurs in the description, possibly under other arguments."""
    names = "|".join(re.escape(name) for name in {topic, topic.rpartition("/")[0] or topic})
    pattern = rf"topic>\s*/?(?:{names})\s*<"
    return any(re.search(pattern, source.text) for source in model.expanded.sources.values())
