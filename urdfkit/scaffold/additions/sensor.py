"""Add a sensor to a description that is there: a macro in a file of its own, one include, one call."""

from __future__ import annotations

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
from urdfkit.scaffold.additions.file_changes import Alteration
from urdfkit.scaffold.additions.free_placement import Part
from urdfkit.scaffold.additions.link_boxes import Boxes
from urdfkit.scaffold.additions.mounting import exact, mount, parent_link, written
from urdfkit.scaffold.additions.package_manifest import bridges, package_of, with_dependency, with_installed
from urdfkit.scaffold.additions.sensor_macro import GENERATIONS, KINDS, bridge_entries, sensor_macro, topic_of
from urdfkit.scaffold.additions.xml_insertion import insert_before_end, xacro_prefix
from urdfkit.scaffold.templates.names import free

_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]*")
_BARE = "urdfkit_parent"
_TOPIC = re.compile(r"/?[A-Za-z][A-Za-z0-9_]*(/[A-Za-z][A-Za-z0-9_]*)*")


@dataclass(frozen=True, slots=True)
class Request:
    """A sensor as asked for.

    Attributes:
        kind: of `KINDS`.
        name: of the sensor; its links and joints begin with it; None: its kind, with a number if that is taken.
        parent: the link it is mounted on; None: chosen.
        xyz: where, in the parent's frame [m]; None: on top or at the front, where nothing else is.
        rpy: how it is turned, roll, pitch and yaw [rad].
        topic: where it publishes; None: after its name, and nothing else does.
        update_rate: measurements per second; None: what is usual.
    """

    kind: str
    name: str | None = None
    parent: str | None = None
    xyz: Vector | None = None
    rpy: Vector = (0.0, 0.0, 0.0)
    topic: str | None = None
    update_rate: float | None = None


def add_sensor(robot: Robot, path: Path, request: Request, *, generation: str) -> tuple[list[Alteration], list[str]]:
    """Return the changes that add a sensor, the model's file last, and what to tell about them.

    Args:
        robot: as loaded.
        path: the model's file.
        request: what to add.
        generation: of `urdfkit.scaffold.additions.sensor_macro.GENERATIONS`.

    Raises:
        UsageError: the name or topic is none.
        ResourceError: something of that name is there, or there is no such parent, or the file cannot be changed.
    """
    name = _name(robot, request)
    kind = KINDS[request.kind]
    parent = parent_link(robot, request.parent)
    macro = sensor_macro(request.kind, generation)
    xyz, notes = mount(robot, parent, _part(macro, request, name), request.xyz)
    topic = _topic(robot, request, name)
    told = f"`{name}` on `{parent.name}`{'' if request.xyz else f' at {written(xyz)}'}, topic `{topic}`"
    notes = [told, *notes]
    rate = request.update_rate or kind.rate
    said = f'name="{name}" parent="{parent.name}" topic="{topic}" update_rate="{rate:g}"'
    call = [
        f"<xacro:{request.kind}_sensor {said}>",
        f'  <origin xyz="{exact(xyz) if request.xyz else written(xyz)}" rpy="{exact(request.rpy)}"/>',
        f"</xacro:{request.kind}_sensor>",
    ]
    before = _read(path)
    prefix = xacro_prefix(before) if path.suffix == ".xacro" else None
    alterations: list[Alteration] = []
    if prefix is None:
        after = insert_before_end(before, _expanded(macro, call), path=path)
        if path.suffix == ".xacro":
            notes.append(f"{path.name} does not use xacro: the elements are written out in it")
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
    """Yield the change to the settings of the bridge that carries the sensor's topics to ROS, where there are any."""
    files = bridges(package)
    if len(files) != 1:
        return
    content = _read(files[0])
    entries = bridge_entries(kind, topic, "ignition.msgs" if b"ignition.msgs" in content else "gz.msgs")
    newline = b"\r\n" if b"\r\n" in content else b"\n"
    end = b"" if content.endswith(b"\n") or not content else newline
    yield Alteration(files[0], content, content + end + entries.encode("utf-8").replace(b"\n", newline))


def _part(macro: str, request: Request, name: str) -> Part:
    """Return what the sensor takes up: that of a robot with nothing but it."""
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
    return Part(tuple(boxes), box_around_all(boxes), kind.spot, apart=kind.looks_about)


def _name(robot: Robot, request: Request) -> str:
    """Return what the sensor is called.

    Raises:
        UsageError: that is no name.
        ResourceError: something is called so already.
    """
    names = {thing.name for things in (robot.links, robot.joints) for thing in things}
    sensors = {sensor.name for block in robot.gazebo for sensor in block.sensors}

    def taken(name: str) -> list[str]:
        own = {f"{name}_{end}" for end in ("link", "joint", "optical_frame", "optical_joint")}
        return sorted(own & names) or ([name] if name in sensors else [])

    if request.name is None:
        return free(request.kind, lambda name: bool(taken(name)))
    if not _NAME.fullmatch(request.name):
        raise UsageError(f"--name `{request.name}`: letters, digits and underscores, a letter first")
    if there := taken(request.name):
        raise ResourceError(
            f"robot `{robot.name}` has a `{there[0]}` already; nothing was changed: another --name, or edit it"
        )
    return request.name


def _topic(robot: Robot, request: Request, name: str) -> str:
    """Return where the sensor publishes.

    Raises:
        UsageError: that is no topic.
        ResourceError: something publishes there already.
    """
    used = dict(_topics(robot))
    if request.topic is None:
        first = _namespace(robot) + topic_of(request.kind, name)
        if first not in used:
            return first
        return free(f"{_namespace(robot)}{name}/{KINDS[request.kind].topic}", used.__contains__)
    if not _TOPIC.fullmatch(request.topic):
        raise UsageError(
            f"--topic `{request.topic}` is no name of a topic: words of letters, digits and _ with / between"
        )
    if place := used.get(request.topic.strip("/")):
        raise ResourceError(f"robot `{robot.name}` publishes on `{request.topic}` already ({place}); another --topic")
    return request.topic


def _topics(robot: Robot) -> Iterator[tuple[str, str]]:
    """Yield what the sensors and plugins of a robot publish on, and where that is said."""
    for element in (element for block in robot.gazebo for element in block.element.walk()):
        tag = element.tag.lower()
        if tag in ("topic", "cameraname", "camera_name") or tag.endswith("topicname"):
            yield element.text.strip("/"), str(element.origin.position)
        elif tag == "remapping" and ":=" in element.text:
            yield element.text.rpartition(":=")[2].strip("/ "), str(element.origin.position)


def _namespace(robot: Robot) -> str:
    """Return what the topics of the robot's plugins begin with, where it is one: ``scout/``."""
    elements = (element for block in robot.gazebo for element in block.element.walk())
    found = {element.text.strip("/") for element in elements if element.tag in ("robotNamespace", "namespace")}
    found.discard("")  # of sensors that were added, which have it in their topic
    return f"{found.pop()}/" if len(found) == 1 else ""


def _macro_file(home: Path, macro: str, kind: str) -> Iterator[Alteration]:
    """Yield the file of the macro where it is not there, or as it was written for another Gazebo.

    One that a person has changed since is used as it is.
    """
    if not home.exists():
        yield Alteration(home, None, macro.encode("utf-8"))
        return
    there = _read(home)
    if there in {sensor_macro(kind, other).encode("utf-8") for other in GENERATIONS} - {macro.encode("utf-8")}:
        yield Alteration(home, there, macro.encode("utf-8"))
    elif f'name="{kind}_sensor"'.encode() not in there:
        raise ResourceError(f"{home} is already there and has no macro `{kind}_sensor`; nothing was changed")


def _expanded(macro: str, call: list[str]) -> str:
    """Return what a call of the macro comes to."""
    with tempfile.TemporaryDirectory() as folder:
        xml = expand(_called(macro, call, folder)).xml
    inside = xml[xml.index(">", xml.index("<robot")) + 1 : xml.rindex("</robot>")]
    lines = [line for line in inside.splitlines() if line.strip() and not line.strip().startswith("<!--")]
    return "\n".join(line.removeprefix("  ") for line in lines)


def _called(macro: str, call: list[str], folder: str) -> Path:
    """Return a file with the macro and its call."""
    file = Path(folder, "sensor.xacro")
    text = macro.replace("</robot>", "\n".join([*call, "</robot>"])).replace("<robot ", '<robot name="sensor" ', 1)
    file.write_text(text, encoding="utf-8")
    return file


def _read(path: Path) -> bytes:
    try:
        return path.read_bytes()
    except OSError as error:
        raise ResourceError(f"{path}: {error.strerror}") from error


def _some(alteration: Alteration | None) -> list[Alteration]:
    return [alteration] if alteration is not None else []
