"""Adding a sensor to an existing description: a file with a macro, an include and a call."""

import re
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from urdfkit.description import load
from urdfkit.description.urdf.geometry import box_around_all
from urdfkit.description.urdf.robot import Robot, Vector
from urdfkit.description.xacro.expand import expand
from urdfkit.errors import ResourceError, UsageError
from urdfkit.file_replacement import read_bytes
from urdfkit.scaffold.additions.file_changes import Alteration
from urdfkit.scaffold.additions.free_placement import Part
from urdfkit.scaffold.additions.link_boxes import Boxes
from urdfkit.scaffold.additions.mounting import exact, mount, parent_link, written
from urdfkit.scaffold.additions.package_manifest import (
    bridge_configurations,
    package_of,
    with_dependency,
    with_installed,
)
from urdfkit.scaffold.additions.sensor_macro import GENERATIONS, KINDS, bridge_entries, sensor_macro, topic_of
from urdfkit.scaffold.additions.xml_insertion import insert_before_end, xacro_prefix
from urdfkit.scaffold.templates.names import unused_name

_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]*")
_BARE = "urdfkit_parent"
_TOPIC = re.compile(r"/?[A-Za-z][A-Za-z0-9_]*(/[A-Za-z][A-Za-z0-9_]*)*")


@dataclass(frozen=True, slots=True)
class SensorRequest:
    """A request for a sensor.

    Attributes:
        kind: a key of `KINDS`.
        name: name of the sensor, and prefix of its links and joints; None: its kind, with a number if in use.
        parent: link that the sensor is mounted on; None: chosen automatically.
        xyz: position in the parent's frame [m]; None: a free place on top or at the front.
        rpy: orientation: roll, pitch and yaw [rad].
        topic: topic to publish; None: an unused topic derived from the name.
        update_rate: measurements per second; None: the default of the kind.
    """

    kind: str
    name: str | None = None
    parent: str | None = None
    xyz: Vector | None = None
    rpy: Vector = (0.0, 0.0, 0.0)
    topic: str | None = None
    update_rate: float | None = None


def add_sensor(
    robot: Robot, path: Path, request: SensorRequest, *, generation: str
) -> tuple[list[Alteration], list[str]]:
    """Return the file changes that add a sensor, the model's file last, and notes to print.

    Args:
        robot: the loaded robot.
        path: the model's file.
        request: the sensor to add.
        generation: one of `urdfkit.scaffold.additions.sensor_macro.GENERATIONS`.

    Raises:
        UsageError: the name or the topic is invalid.
        ResourceError: the name is in use, the parent does not exist, or the file cannot be changed.
    """
    name = _name(robot, request)
    kind = KINDS[request.kind]
    parent = parent_link(robot, request.parent)
    macro = sensor_macro(request.kind, generation)
    xyz, notes = mount(robot, parent, _part(macro, request, name), request.xyz)
    topic = _topic(robot, request, name)
    summary = f"`{name}` on `{parent.name}`{'' if request.xyz else f' at {written(xyz)}'}, topic `{topic}`"
    notes = [summary, *notes]
    rate = request.update_rate or kind.rate
    attributes = f'name="{name}" parent="{parent.name}" topic="{topic}" update_rate="{rate:g}"'
    call = [
        f"<xacro:{request.kind}_sensor {attributes}>",
        f'  <origin xyz="{exact(xyz) if request.xyz else written(xyz)}" rpy="{exact(request.rpy)}"/>',
        f"</xacro:{request.kind}_sensor>",
    ]
    before = read_bytes(path)
    prefix = xacro_prefix(before) if path.suffix == ".xacro" else None
    alterations: list[Alteration] = []
    if prefix is None:
        after = insert_before_end(before, _expanded(macro, call), path=path)
        if path.suffix == ".xacro":
            notes.append(f"{path.name} does not use xacro, so the elements are written into it without a macro")
    else:
        home = path.parent / f"{request.kind}_sensor.xacro"
        alterations += _macro_file(home, macro, request.kind)
        lines = [line.replace("xacro:", f"{prefix}:", 1) for line in call]
        if not any(home.exists() and home.samefile(file) for file in robot.files if file.exists()):
            lines.insert(0, f'<{prefix}:include filename="{home.name}"/>')
        after = insert_before_end(before, "\n".join(lines), path=path)
        if (package := package_of(path)) is not None:
            alterations += _some(with_installed(package, path, home))
    needs = {"classic": kind.needs, "classic-ros2": kind.needs_ros2}.get(generation)
    if needs is not None and (package := package_of(path)) is not None:
        alterations += _some(with_dependency(package, needs))
    if generation == "gz" and (package := package_of(path)) is not None:
        alterations += _bridged(package, request.kind, topic)
    return [*alterations, Alteration(path, before, after)], notes


def _bridged(package: Path, kind: str, topic: str) -> Iterator[Alteration]:
    """Yield the change that adds the sensor's topics to the bridge configuration, if the package has exactly one."""
    files = bridge_configurations(package)
    if len(files) != 1:
        return
    content = read_bytes(files[0])
    entries = bridge_entries(kind, topic, "ignition.msgs" if b"ignition.msgs" in content else "gz.msgs")
    newline = b"\r\n" if b"\r\n" in content else b"\n"
    end = b"" if content.endswith(b"\n") or not content else newline
    yield Alteration(files[0], content, content + end + entries.encode("utf-8").replace(b"\n", newline))


def _part(macro: str, request: SensorRequest, name: str) -> Part:
    """Return the space that the sensor needs, measured on a robot with this sensor only."""
    call = [
        f'<link name="{_BARE}"/>',
        f'<xacro:{request.kind}_sensor name="{name}" parent="{_BARE}" topic="t" update_rate="1">',
        f'  <origin xyz="0 0 0" rpy="{exact(request.rpy)}"/>',
        f"</xacro:{request.kind}_sensor>",
    ]
    with tempfile.TemporaryDirectory() as folder:
        robot = load(_called(macro, call, folder))
    boxes = [box for _, box in Boxes(robot).seen_from(robot.link_by_name[_BARE])]
    kind = KINDS[request.kind]
    return Part(tuple(boxes), box_around_all(boxes), kind.spot, far_from_others=kind.needs_free_view)


def _name(robot: Robot, request: SensorRequest) -> str:
    """Return the name of the sensor.

    Raises:
        UsageError: the requested name is invalid.
        ResourceError: the requested name is in use.
    """
    names = {element.name for elements in (robot.links, robot.joints) for element in elements}
    sensors = {sensor.name for block in robot.gazebo for sensor in block.sensors}

    def conflicts(name: str) -> list[str]:
        own = {f"{name}_{end}" for end in ("link", "joint", "optical_frame", "optical_joint")}
        return sorted(own & names) or ([name] if name in sensors else [])

    if request.name is None:
        return unused_name(request.kind, lambda name: bool(conflicts(name)))
    if not _NAME.fullmatch(request.name):
        raise UsageError(
            f"--name `{request.name}` is not a valid name: use letters, digits and underscores, and start with a letter"
        )
    if used := conflicts(request.name):
        raise ResourceError(
            f"robot `{robot.name}` already has a `{used[0]}`; nothing was changed; choose another --name, "
            "or edit the existing sensor"
        )
    return request.name


def _topic(robot: Robot, request: SensorRequest, name: str) -> str:
    """Return the topic of the sensor.

    Raises:
        UsageError: the requested topic is invalid.
        ResourceError: the robot already publishes the requested topic.
    """
    used = dict(_topics(robot))
    if request.topic is None:
        first = _namespace(robot) + topic_of(request.kind, name)
        if first not in used:
            return first
        return unused_name(f"{_namespace(robot)}{name}/{KINDS[request.kind].topic}", used.__contains__)
    if not _TOPIC.fullmatch(request.topic):
        raise UsageError(
            f"--topic `{request.topic}` is not a valid topic: use letters, digits and underscores, separated by /"
        )
    if place := used.get(request.topic.strip("/")):
        raise ResourceError(
            f"robot `{robot.name}` already publishes `{request.topic}` ({place}); choose another --topic"
        )
    return request.topic


def _topics(robot: Robot) -> Iterator[tuple[str, str]]:
    """Yield the topics that the robot's sensors and plugins publish, each with its place in the source."""
    for element in (element for block in robot.gazebo for element in block.element.walk()):
        tag = element.tag.lower()
        if tag in ("topic", "cameraname", "camera_name") or tag.endswith("topicname"):
            yield element.text.strip("/"), str(element.origin.position)
        elif tag == "remapping" and ":=" in element.text:
            yield element.text.rpartition(":=")[2].strip("/ "), str(element.origin.position)


def _namespace(robot: Robot) -> str:
    """Return the namespace of the robot's plugins as a prefix, if they all have the same: ``scout/``."""
    elements = (element for block in robot.gazebo for element in block.element.walk())
    namespaces = {element.text.strip("/") for element in elements if element.tag in ("robotNamespace", "namespace")}
    namespaces.discard("")  # added sensors, whose topics contain the namespace
    return f"{namespaces.pop()}/" if len(namespaces) == 1 else ""


def _macro_file(home: Path, macro: str, kind: str) -> Iterator[Alteration]:
    """Yield the change of the macro file if it is missing, or unchanged since it was written for another Gazebo.

    A file that was edited is used as it is.
    """
    if not home.exists():
        yield Alteration(home, None, macro.encode("utf-8"))
        return
    existing = read_bytes(home)
    if existing in {sensor_macro(kind, other).encode("utf-8") for other in GENERATIONS} - {macro.encode("utf-8")}:
        yield Alteration(home, existing, macro.encode("utf-8"))
    elif f'name="{kind}_sensor"'.encode() not in existing:
        raise ResourceError(f"{home} already exists and has no macro `{kind}_sensor`; nothing was changed")


def _expanded(macro: str, call: list[str]) -> str:
    """Return the expansion of a call of the macro."""
    with tempfile.TemporaryDirectory() as folder:
        xml = expand(_called(macro, call, folder)).xml
    inside = xml[xml.index(">", xml.index("<robot")) + 1 : xml.rindex("</robot>")]
    lines = [line for line in inside.splitlines() if line.strip() and not line.strip().startswith("<!--")]
    return "\n".join(line.removeprefix("  ") for line in lines)


def _called(macro: str, call: list[str], folder: str) -> Path:
    """Write a file with the macro and a call, and return its path."""
    file = Path(folder, "sensor.xacro")
    text = macro.replace("</robot>", "\n".join([*call, "</robot>"])).replace("<robot ", '<robot name="sensor" ', 1)
    file.write_text(text, encoding="utf-8")
    return file


def _some(alteration: Alteration | None) -> list[Alteration]:
    return [alteration] if alteration is not None else []
