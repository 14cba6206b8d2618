"""Adding an arm to an existing description: the arm of the robot template, expanded, in a macro of its own."""

import re
import tempfile
import xml.etree.ElementTree as ElementTree
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from urdfkit.description import load
from urdfkit.description.urdf.geometry import box_around_all
from urdfkit.description.urdf.robot import Pose, Robot, Vector
from urdfkit.description.xacro.expand import expand
from urdfkit.errors import ResourceError, UsageError
from urdfkit.resources import templates_dir
from urdfkit.scaffold.additions.file_changes import Alteration
from urdfkit.scaffold.additions.free_placement import Part
from urdfkit.scaffold.additions.link_boxes import Boxes
from urdfkit.scaffold.additions.mounting import exact, extent, mount, parent_link, written
from urdfkit.scaffold.additions.package_manifest import package_of, with_installed
from urdfkit.scaffold.additions.xml_insertion import insert_before_end, xacro_prefix
from urdfkit.scaffold.templates.names import unused_name
from urdfkit.scaffold.templates.template_parser import load_template

_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]*")
_ORDER = ("name", "type", "mass", "radius", "length", "xyz", "rpy", "lower", "upper", "effort", "velocity")
_NUMBER = re.compile(r"(?<![\w.])-?\d+\.\d+(?:e-?\d+)?(?![\w.])")
_ROOMY = 20.0
"""Length of the base in multiples of the arm's reach, so that all checks of the template on the base hold."""


OPTIONS = {"arm_reach": "--reach", "arm_mass": "--mass"}
"""Question of the robot template → option of `urdfkit new arm`, where it is not the name of the question."""


@dataclass(frozen=True, slots=True)
class ArmRequest:
    """A request for an arm.

    Attributes:
        name: name of the arm, and prefix of its links and joints unless it is ``arm``; None: ``arm``, with a number
            if that name is in use.
        answers: answers to questions of the robot template: arm, arm_reach, arm_mass, payload, gripper,
            finger_travel and ros (default ``none``; with ``noetic``, no joint mimics another).
        parent: link that the arm is mounted on; None: chosen automatically.
        xyz: position in the parent's frame [m]; None: a free place on top.
        rpy: orientation: roll, pitch and yaw [rad].
    """

    name: str | None
    answers: Mapping[str, str]
    parent: str | None = None
    xyz: Vector | None = None
    rpy: Vector = (0.0, 0.0, 0.0)


def add_arm(robot: Robot, path: Path, request: ArmRequest) -> tuple[list[Alteration], list[str]]:
    """Return the file changes that add an arm, the model's file last, and notes to print.

    Args:
        robot: the loaded robot.
        path: the model's file.
        request: the arm to add.

    Raises:
        UsageError: the name is invalid, or the sizes contradict each other.
        ResourceError: the name is in use, the parent does not exist, or the file cannot be changed.
    """
    if request.name is not None and not _NAME.fullmatch(request.name):
        raise UsageError(
            f"--name `{request.name}` is not a valid name: use letters, digits and underscores, and start with a letter"
        )
    parent = parent_link(robot, request.parent)
    answers = dict(request.answers)
    answers.setdefault("arm_reach", f"{_reach(extent(robot, parent)):.4g}")
    arm, xml = _alone(answers)
    links, joints = _branch(arm)
    existing = {link.name for link in robot.links} | {joint.name for joint in robot.joints}

    def conflicts(name: str) -> list[str]:
        return [each for each in (*links, *joints) if f"{_prefix(name)}{each}" in existing]

    def is_used(name: str) -> bool:
        return bool(conflicts(name)) or _macro_path(path, name).exists()

    name = request.name or unused_name("arm", is_used)
    if names := conflicts(name):
        conflict = f"{_prefix(name)}{names[0]}"
        raise ResourceError(
            f"robot `{robot.name}` already has a `{conflict}`; nothing was changed; choose another --name"
        )
    xyz, notes = mount(robot, parent, _part(arm, request.rpy), request.xyz)
    summary = f"`{name}` on `{parent.name}` at {written(xyz)}, reaching {answers['arm_reach']} m"
    lines = _elements(xml, {*links, *joints}, _prefix(name))
    position = exact(xyz) if request.xyz else written(xyz)
    origin = f'<origin xyz="{position}" rpy="{exact(request.rpy)}"/>'
    return _changes(path, name, lines, parent.name, origin), [summary, *notes]


def _prefix(name: str) -> str:
    return "" if name == "arm" else f"{name}_"


def _macro_path(path: Path, name: str) -> Path:
    """Return the path of the file with the arm's macro."""
    return path.parent / f"{name}_macro.xacro"


def _part(arm: Robot, rpy: Vector) -> Part:
    """Return the space that an arm needs in its zero position, pointing straight up."""
    boxes = Boxes(arm)
    foot, at = arm.link_by_name["arm_foot"], Pose(rpy=rpy)
    whole_arm = [box for name, box in boxes.seen_from(foot, at) if name in _branch(arm)[0]]
    return Part(tuple(whole_arm), box_around_all(boxes.of(foot, at) or whole_arm))


def _changes(path: Path, name: str, lines: list[str], parent: str, origin: str) -> list[Alteration]:
    before = path.read_bytes()
    prefix = xacro_prefix(before) if path.suffix == ".xacro" else None
    if prefix is None:
        text = "\n".join(lines).replace("${parent}", parent).replace('<xacro:insert_block name="origin"/>', origin)
        return [Alteration(path, before, insert_before_end(before, text, path=path))]
    home = _macro_path(path, name)
    if home.exists():
        raise ResourceError(f"{home} already exists; nothing was changed")
    body = "\n".join(f"    {line}" if line else "" for line in lines)
    macro = (
        '<?xml version="1.0"?>\n<!-- An arm; at zero it points straight up. Attach tools and payloads to tool0. -->\n'
        '<robot xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
        f'  <xacro:macro name="{name}_macro" params="parent *origin">\n{body}\n  </xacro:macro>\n</robot>\n'
    )
    call = (
        f'<{prefix}:include filename="{home.name}"/>\n<{prefix}:{name}_macro parent="{parent}">\n'
        f"  {origin}\n</{prefix}:{name}_macro>"
    )
    changes = [
        Alteration(home, None, macro.encode()),
        Alteration(path, before, insert_before_end(before, call, path=path)),
    ]
    own = package_of(path)
    installed = with_installed(own, path, home) if own is not None else None
    return [installed, *changes] if installed is not None else changes


def _reach(size: Vector | None) -> float:
    """Return a reach in proportion to the parent link, by the formula of the robot template."""
    return 0.6 if size is None else max(0.05, min(size[0], 1.3 * size[1], 5.0))


def _alone(answers: Mapping[str, str]) -> tuple[Robot, str]:
    """Return a robot that consists of the arm on a base large enough for any arm, and its URDF."""
    template = load_template(templates_dir() / "robot", options=OPTIONS)
    side = f"{_ROOMY * float(answers['arm_reach']):.6g}"
    weight = f"{5000 * float(side) ** 2 * 0.1 * 0.1:.6g}"
    base = {"base_length": side, "base_width": side, "base_height": "0.1", "mass": min(weight, "50000", key=float)}
    full = template.answers({"name": "arm_robot", "ros": "none", "drive": "none", **base, **answers})
    with tempfile.TemporaryDirectory() as folder:
        template.render({**full, "year": "", "into": ""}, Path(folder))
        model = Path(folder, "arm_robot_description/urdf/arm_robot.urdf.xacro")
        return load(model), expand(model).xml


def _elements(xml: str, names: set[str], prefix: str) -> list[str]:
    """Return the links and joints of an arm as lines of XML."""
    root = ElementTree.fromstring(xml)
    colours = {material.get("name"): material for material in root.findall("material")}
    lines: list[str] = []
    for element in (each for each in root if each.tag in ("link", "joint") and each.get("name") in names):
        _renamed(element, prefix, names, colours)
        _tidied(element)
        ElementTree.indent(element)
        text = ElementTree.tostring(element, encoding="unicode").strip().replace(" />", "/>")
        lines += [*([""] if lines else []), *text.replace("<insert_block/>", _BLOCK).splitlines()]
    return lines


_BLOCK = '<xacro:insert_block name="origin"/>'


def _branch(robot: Robot) -> tuple[list[str], list[str]]:
    """Return the links and joints of the arm, starting at its foot."""
    links, joints = ["arm_foot"], ["arm_mount_joint"]
    for link in links:
        for joint in robot.joints:
            if joint.parent == link and joint.child is not None:
                joints.append(joint.name)
                links.append(joint.child)
    return links, joints


def _renamed(
    element: ElementTree.Element, prefix: str, names: set[str], colours: Mapping[str | None, ElementTree.Element]
) -> None:
    """Add the prefix to names, make parent and origin parameters of the macro, and define materials in place."""
    is_mount = element.get("name") == "arm_mount_joint"
    for each in element.iter():
        for attribute in ("name", "link", "joint"):
            if each.tag != "material" and each.get(attribute) in names:
                each.set(attribute, f"{prefix}{each.get(attribute)}")
        if each.tag == "material" and len(each) == 0 and (colour := colours.get(each.get("name"))) is not None:
            each.set("name", f"arm_{each.get('name')}")
            each.extend(list(colour))
    if is_mount:
        parent, origin = element.find("parent"), element.find("origin")
        if parent is not None and origin is not None:
            parent.set("link", "${parent}")
            origin.tag = "insert_block"
            origin.attrib.clear()


def _tidied(element: ElementTree.Element) -> None:
    """Round numbers to nine digits and restore the usual order of attributes, which xacro sorts."""
    for each in element.iter():
        for attribute in sorted(each.attrib, key=lambda name: _ORDER.index(name) if name in _ORDER else -1):
            value = each.attrib.pop(attribute)
            each.set(attribute, _NUMBER.sub(lambda match: f"{float(match[0]):.9g}", value))
