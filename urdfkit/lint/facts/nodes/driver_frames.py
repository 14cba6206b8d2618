"""Frames that launch files give to drivers of sensors and to localization, and that the robot does not have."""

import ast
import re
from collections.abc import Iterator

from urdfkit.description.launch.python_constants import launch_reader, name_of, parsed
from urdfkit.description.packages.related_files import LAUNCH
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.controller_joints import Named
from urdfkit.lint.facts.control.launch_package_paths import place
from urdfkit.lint.facts.launch.actions import all_elements
from urdfkit.lint.facts.topics.node_topics import topics_of
from urdfkit.lint.facts.topics.words import Words
from urdfkit.lint.model.model import Model

_FRAME = r"(?:laser_|lidar_|imu_|scan_|sensor_|gps_)?frame(?:_id)?"
_BASE = r"(?:robot_)?base_(?:link_)?frame(?:_id)?"
_OF_BASE = ("amcl", "gmapping", "hector_mapping", "nav2_amcl", "robot_localization", "slam_toolbox")
"""Packages whose nodes need the frame of the base in a parameter that `_BASE` matches."""

_TRANSFORMS = r"static_transform_publisher|TransformBroadcaster"
_FIXED = ("map", "odom", "world", "earth", "utm")
_SENSORS = ("LaserScan", "Imu", "NavSatFix", "PointCloud2", "Image")


def unknown_frames(model: Model) -> Iterator[tuple[Source, Named]]:
    """Yield launch file and frame of each driver of a sensor whose frame no file of the packages mentions again."""
    links = model.robot.link_by_name
    if not links or model.is_incomplete:
        return
    # The other frames of the packages are those of static transforms and of the nodes' own code.
    texts = [source.text for source in model.related_files.values() if re.search(_TRANSFORMS, source.text)]
    words = Words(model)
    for file, source in model.related_files.items():
        if not file.endswith(LAUNCH) or "frame" not in source.text:
            continue
        seen = set[int]()
        for frame in _in_python(source) if file.endswith(".py") else _in_elements(source):
            name = frame.name.strip("/")
            if name in links or name in _FIXED or frame.start in seen or not re.fullmatch(r"\w+", name):
                continue
            pattern = rf"(?<![\w/-]){name}(?![\w-])"
            is_other = any(len(re.findall(pattern, text)) > (text is source.text) for text in texts)
            if (
                not is_other
                and not words.match(rf"[\"']{name}[\"']")
                and not model.neighbouring_descriptions.define("link", name)
            ):
                seen.add(frame.start)
                yield source, frame


def _is_frame(package: str, program: str, name: str) -> bool:
    """Return whether a parameter of a node is the frame of a sensor or of the base."""
    if package in _OF_BASE:
        return re.fullmatch(_BASE, name) is not None
    return _is_driver(package, program) and re.fullmatch(_FRAME, name) is not None


def _is_driver(package: str, program: str) -> bool:
    topics = topics_of(package, program)
    return topics is not None and not topics.read and not {*topics.published.values()}.isdisjoint(_SENSORS)


def _in_python(source: Source) -> Iterator[Named]:
    tree = parsed(source)
    reader = launch_reader(tree) if tree is not None else None
    for call in (each for each in ast.walk(tree) if isinstance(each, ast.Call)) if tree is not None else ():
        words = {word.arg: word.value for word in call.keywords}
        if reader is None or name_of(call.func) not in ("Node", "LifecycleNode") or "parameters" not in words:
            continue
        package, program = (reader.text(words[key]) or "" if key in words else "" for key in ("package", "executable"))
        for group in (each for each in ast.walk(words["parameters"]) if isinstance(each, ast.Dict)):
            for key, value in zip(group.keys, group.values, strict=True):
                name, text = reader.text(key) if key is not None else None, reader.text(value)
                if name is not None and text and _is_frame(package, program, name):
                    yield Named(text, place(source, value)[0] + isinstance(value, ast.Constant))


def _in_elements(source: Source) -> Iterator[Named]:
    for element in all_elements(source):
        at = element.attributes
        program = at.get("exec") or at.get("type")
        if element.tag != "node" or "pkg" not in at or program is None:
            continue
        for child in element.children:
            parts = child.attributes
            is_value = child.tag == "param" and {"name", "value"} <= parts.keys()
            if is_value and _is_frame(at["pkg"].name, program.name, parts["name"].name):
                yield parts["value"]
