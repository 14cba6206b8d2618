"""Add an arm to a description that is there: the arm of new robots, written out, in a macro of its own."""

from __future__ import annotations

import re
import tempfile
import xml.etree.ElementTree as ElementTree
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from urdfkit.description import load
from urdfkit.description.expand import expand
from urdfkit.description.robot import Robot, Vector
from urdfkit.errors import ResourceError, UsageError
from urdfkit.resources import templates_dir
from urdfkit.scaffold.alteration import Alteration
from urdfkit.scaffold.insertion import insert_before_end, xacro_prefix
from urdfkit.scaffold.manifest import package_of, with_installed
from urdfkit.scaffold.mounting import extent, parent_link, spot
from urdfkit.scaffold.reading import load_template

_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]*")
_ORDER = ("name", "type", "mass", "radius", "length", "xyz", "rpy", "lower", "upper", "effort", "velocity")
_NUMBER = re.compile(r"(?<![\w.])-?\d+\.\d+(?:e-?\d+)?(?![\w.])")
_ROOMY = 20.0
"""A base that many times as long as the arm reaches carries any, so that the template's checks of it hold."""


@dataclass(frozen=True, slots=True)
class ArmRequest:
    """An arm as asked for.

    Attributes:
        name: of it; what its links and joints begin with, unless it is ``arm``.
        answers: to the questions of the template of robots: arm, arm_reach, arm_mass, payload, gripper, finger_travel.
        parent: the link it stands on; None: chosen.
        xyz: where, in the parent's frame [m]; None: on top.
        rpy: how it is turned, roll, pitch and yaw [rad].
    """

    name: str
    answers: Mapping[str, str]
    parent: str | None = None
    xyz: Vector | None = None
    rpy: Vector = (0.0, 0.0, 0.0)


def add_arm(robot: Robot, path: Path, request: ArmRequest) -> tuple[list[Alteration], list[str]]:
    """Return the changes that add an arm, the model's file last, and what to tell about them.

    Args:
        robot: as loaded.
        path: the model's file.
        request: what to add.

    Raises:
        UsageError: the name is none, or the sizes do not go together.
        ResourceError: something of that name is there, or no such parent, or the file cannot be changed.
    """
    if not _NAME.fullmatch(request.name):
        raise UsageError(f"--name `{request.name}`: letters, digits and underscores, a letter first")
    parent = parent_link(robot, request.parent)
    answers = dict(request.answers)
    answers.setdefault("arm_reach", f"{_reach(extent(parent)):.4g}")
    xyz = request.xyz or spot(parent, "top", (0.0, 0.0))
    notes = [f"on `{parent.name}` at {_numbers(xyz or (0, 0, 0))}, reaching {answers['arm_reach']} m"]
    if xyz is None:
        notes.append(f"the shapes of `{parent.name}` are meshes: look whether it is inside, and give --xyz")
    lines, names = _elements(answers, "" if request.name == "arm" else f"{request.name}_")
    here = {link.name for link in robot.links} | {joint.name for joint in robot.joints}
    if taken := [name for name in names if name in here]:
        raise ResourceError(f"robot `{robot.name}` has a `{taken[0]}` already; nothing was changed: another --name")
    origin = f'<origin xyz="{_numbers(xyz or (0, 0, 0))}" rpy="{_numbers(request.rpy)}"/>'
    return _changes(path, request.name, lines, parent.name, origin), notes


def _changes(path: Path, name: str, lines: list[str], parent: str, origin: str) -> list[Alteration]:
    before = path.read_bytes()
    prefix = xacro_prefix(before) if path.suffix == ".xacro" else None
    if prefix is None:
        text = "\n".join(lines).replace("${parent}", parent).replace('<xacro:insert_block name="origin"/>', origin)
        return [Alteration(path, before, insert_before_end(before, text, path=path))]
    home = path.parent / f"{name}_macro.xacro"
    if home.exists():
        raise ResourceError(f"{home} is already there; nothing was changed")
    body = "\n".join(f"    {line}" if line else "" for line in lines)
    macro = (
        '<?xml version="1.0"?>\n<!-- An arm; at zero it points straight up. What it carries goes on tool0. -->\n'
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
    """Return how far an arm reaches that goes with what it stands on, as the template has it."""
    return 0.6 if size is None else max(0.05, min(size[0], 1.3 * size[1], 5.0))


def _elements(answers: Mapping[str, str], prefix: str) -> tuple[list[str], list[str]]:
    """Return the links and joints of an arm as lines of XML, and their names."""
    template = load_template(templates_dir() / "robot")
    side = f"{_ROOMY * float(answers['arm_reach']):.6g}"
    weight = f"{5000 * float(side) ** 2 * 0.1 * 0.1:.6g}"
    base = {"base_length": side, "base_width": side, "base_height": "0.1", "mass": min(weight, "50000", key=float)}
    full = template.answers({"name": "arm_robot", "ros": "none", "drive": "none", **base, **answers})
    with tempfile.TemporaryDirectory() as folder:
        template.render({**full, "year": "", "into": ""}, Path(folder))
        model = Path(folder, "arm_robot_description/urdf/arm_robot.urdf.xacro")
        robot, xml = load(model), expand(model).xml
    root = ElementTree.fromstring(xml)
    colours = {material.get("name"): material for material in root.findall("material")}
    links, joints = _branch(robot)
    found = [each for each in root if each.tag in ("link", "joint") and each.get("name") in {*links, *joints}]
    for element in found:
        _renamed(element, prefix, {*links, *joints}, colours)
        _tidied(element)
    lines: list[str] = []
    for element in found:
        ElementTree.indent(element)
        text = ElementTree.tostring(element, encoding="unicode").strip().replace(" />", "/>")
        lines += [*([""] if lines else []), *text.replace("<insert_block/>", _BLOCK).splitlines()]
    return lines, [str(element.get("name")) for element in found]


_BLOCK = '<xacro:insert_block name="origin"/>'


def _branch(robot: Robot) -> tuple[list[str], list[str]]:
    """Return the links and joints from the arm's foot on."""
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
    """Give the arm's things their names, its foot its place, and its materials their colours."""
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
    """Write numbers to nine digits, and attributes in the order of a person: xacro sorts them."""
    for each in element.iter():
        for attribute in sorted(each.attrib, key=lambda name: _ORDER.index(name) if name in _ORDER else -1):
            value = each.attrib.pop(attribute)
            each.set(attribute, _NUMBER.sub(lambda match: f"{float(match[0]):.9g}", value))


def _numbers(values: Vector) -> str:
    return " ".join(f"{value:.10g}" for value in values)
