"""Add a sensor to a description that is there: a macro in a file of its own, one include, one call."""

from __future__ import annotations

import re
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from urdfkit.description.expand import expand
from urdfkit.description.robot import Robot, Vector
from urdfkit.errors import ResourceError, UsageError
from urdfkit.scaffold.alteration import Alteration
from urdfkit.scaffold.insertion import insert_before_end, xacro_prefix
from urdfkit.scaffold.manifest import bridges, package_of, with_dependency, with_installed
from urdfkit.scaffold.mounting import parent_link, spot
from urdfkit.scaffold.sensor_macro import KINDS, bridge_entries, sensor_macro, topic_of

_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]*")
_TOPIC = re.compile(r"/?[A-Za-z][A-Za-z0-9_]*(/[A-Za-z][A-Za-z0-9_]*)*")


@dataclass(frozen=True, slots=True)
class Request:
    """A sensor as asked for.

    Attributes:
        kind: of `KINDS`.
        name: of the sensor; its links and joints begin with it.
        parent: the link it is mounted on; None: chosen.
        xyz: where, in the parent's frame [m]; None: on top or at the front.
        rpy: how it is turned, roll, pitch and yaw [rad].
        topic: where it publishes; None: after its name.
        update_rate: measurements per second; None: what is usual.
    """

    kind: str
    name: str
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
        generation: of `urdfkit.scaffold.sensor_macro.GENERATIONS`.

    Raises:
        UsageError: the name or topic is none.
        ResourceError: something of that name is there, or there is no such parent, or the file cannot be changed.
    """
    _check(robot, request)
    kind = KINDS[request.kind]
    parent = parent_link(robot, request.parent)
    xyz = request.xyz or spot(parent, kind.spot, kind.offset)
    notes = [f"on `{parent.name}` at {_numbers(xyz or (0, 0, 0.1))}"] if request.xyz is None else []
    if xyz is None:
        notes.append(f"the shapes of `{parent.name}` are meshes: look whether it is inside, and give --xyz")
    topic = request.topic or _namespace(robot) + topic_of(request.kind, request.name)
    _check_topic(robot, topic)
    rate = request.update_rate or kind.rate
    said = f'name="{request.name}" parent="{parent.name}" topic="{topic}" update_rate="{rate:g}"'
    call = [
        f"<xacro:{request.kind}_sensor {said}>",
        f'  <origin xyz="{_numbers(xyz or (0, 0, 0.1))}" rpy="{_numbers(request.rpy)}"/>',
        f"</xacro:{request.kind}_sensor>",
    ]
    macro = sensor_macro(request.kind, generation)
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


def _check(robot: Robot, request: Request) -> None:
    if not _NAME.fullmatch(request.name):
        raise UsageError(f"--name `{request.name}`: letters, digits and underscores, a letter first")
    if request.topic is not None and not _TOPIC.fullmatch(request.topic):
        raise UsageError(
            f"--topic `{request.topic}` is no name of a topic: words of letters, digits and _ with / between"
        )
    new = {f"{request.name}_{end}" for end in ("link", "joint", "optical_frame", "optical_joint")}
    links, joints = ({thing.name for thing in things} for things in (robot.links, robot.joints))
    sensors = {sensor.name for block in robot.gazebo for sensor in block.sensors}
    if taken := sorted(new & (links | joints)) or ([request.name] if request.name in sensors else []):
        raise ResourceError(
            f"robot `{robot.name}` has a `{taken[0]}` already; nothing was changed: another --name, or edit it"
        )


def _namespace(robot: Robot) -> str:
    """Return what the topics of the robot's plugins begin with, where it is one: ``scout/``."""
    elements = (element for block in robot.gazebo for element in block.element.walk())
    found = {element.text.strip("/") for element in elements if element.tag in ("robotNamespace", "namespace")}
    found.discard("")  # of sensors that were added, which have it in their topic
    return f"{found.pop()}/" if len(found) == 1 else ""


def _check_topic(robot: Robot, topic: str) -> None:
    for element in (element for block in robot.gazebo for element in block.element.walk()):
        is_topic = element.tag == "topic" or element.tag.lower().endswith("topicname")
        if is_topic and element.text.strip("/") == topic.strip("/"):
            place = element.origin.position
            raise ResourceError(f"robot `{robot.name}` publishes on `{topic}` already ({place}); another --topic")


def _macro_file(home: Path, macro: str, kind: str) -> Iterator[Alteration]:
    """Yield the file of the macro where it is not there; one that a person has changed since is used as it is."""
    if not home.exists():
        yield Alteration(home, None, macro.encode("utf-8"))
    elif f'name="{kind}_sensor"'.encode() not in _read(home):
        raise ResourceError(f"{home} is already there and has no macro `{kind}_sensor`; nothing was changed")


def _expanded(macro: str, call: list[str]) -> str:
    """Return what a call of the macro comes to."""
    text = macro.replace("</robot>", "\n".join([*call, "</robot>"]))
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "sensor.xacro")
        file.write_text(text, encoding="utf-8")
        xml = expand(file).xml
    inside = xml[xml.index(">", xml.index("<robot")) + 1 : xml.rindex("</robot>")]
    lines = [line for line in inside.splitlines() if line.strip() and not line.strip().startswith("<!--")]
    return "\n".join(line.removeprefix("  ") for line in lines)


def _read(path: Path) -> bytes:
    try:
        return path.read_bytes()
    except OSError as error:
        raise ResourceError(f"{path}: {error.strerror}") from error


def _some(alteration: Alteration | None) -> list[Alteration]:
    return [alteration] if alteration is not None else []


def _numbers(values: Vector) -> str:
    return " ".join(f"{value:.6g}" for value in values)
