"""Completion: elements, attributes, existing names, values, files, plugin parameters."""

import re
from collections.abc import Iterable, Iterator
from pathlib import Path

from urdfkit.description.urdf.robot import JOINT_TYPES
from urdfkit.lint.editor.cursor import Cursor
from urdfkit.lint.editor.plugin_parameters import described, plugin_around
from urdfkit.lint.model.model import Model
from urdfkit.lint.model.tags import Document, Tag
from urdfkit.lint.model.xacro_prefix import URDF_ATTRIBUTES, URDF_CHILDREN
from urdfkit.record import record

_DIRECTIVES = {
    "xacro:macro": ("name", "params"),
    "xacro:property": ("name", "value", "default", "scope"),
    "xacro:include": ("filename", "ns", "optional"),
    "xacro:arg": ("name", "default"),
    "xacro:if": ("value",),
    "xacro:unless": ("value",),
    "xacro:insert_block": ("name",),
}
_ON_LINKS = "mu1 mu2 kp kd maxVel minDepth selfCollide gravity material sensor preserveFixedJoint fdir1 laserRetro"
_SUFFIXES = {"include": (".xacro", ".urdf", ".gazebo"), "mesh": (".stl", ".dae", ".obj", ".glb", ".gltf", ".ply")}
_OPEN = r"<([^\s/>=<!?\"']*)((?:[^<>\"']|\"[^\"<]*\"|'[^'<]*')*)([\"'][^\"'<>]*)?\Z"


@record
class Fit:
    """One completion item.

    Attributes:
        label: the displayed and inserted text.
        kind: ``element``, ``attribute``, ``name``, ``value``, ``file`` or ``parameter``.
        detail: a short description.
        typed: number of characters before the cursor that the item replaces.
    """

    label: str
    kind: str
    detail: str = ""
    typed: int = 0


def fits(model: Model, cursor: Cursor) -> list[Fit]:
    """Return the completion items at the cursor."""
    text = cursor.document.source.text[: cursor.offset]
    opened = text.rfind("<")
    tail = text[opened:] if opened >= 0 else ""
    within = re.search(r"\$\{[^{}]*\Z", text[max(opened, 0) :])
    if within is not None:
        word = re.search(r"[A-Za-z_]\w*\Z|\Z", within[0])
        typed = len(word[0]) if word is not None else 0
        return [Fit(name, "name", detail, typed) for name, detail in _properties(model, cursor)]
    if (arg := re.search(r"\$\(arg\s+([\w-]*)\Z", tail)) is not None:
        return [Fit(name, "name", "argument", len(arg[1])) for name in _arguments(model)]
    if (end := re.fullmatch(r"</([^<>\s]*)", tail)) is not None:
        closes = "" if cursor.document.source.text[cursor.offset : cursor.offset + 1] == ">" else ">"
        return [Fit(f"{name}{closes}", "element", "end tag", len(end[1])) for name in _open_at(text[:opened])]
    start = re.match(_OPEN, tail)
    if start is None:
        return list(_in_text(model, cursor, tail))
    name, attributes, value = start[1], start[2], start[3]
    if value is not None:
        attribute = re.search(r"([^\s=\"']+)\s*=\s*\Z", attributes)
        return list(_values(model, cursor, name, attribute[1] if attribute else "", value[1:]))
    if not attributes:
        return list(_elements(model, cursor, len(name)))
    last = re.search(r"[^\s=\"']*\Z", attributes)
    return list(_attributes(model, name, attributes, len(last[0]) if last is not None else 0))


def _around(cursor: Cursor) -> Tag | None:
    """Return the element that encloses the text being typed."""
    start = cursor.document.source.text.rfind("<", 0, cursor.offset)
    tag = cursor.tag
    while tag is not None and tag.start >= start:
        tag = tag.parent
    return tag


def _open_at(text: str) -> Iterator[str]:
    """Yield the name of the element that is open at the end of a text, if any."""
    from urdfkit.description.xml.source import Source

    found, tags = "", Document(Source("", text)).roots
    while tags and not tags[-1].empty and tags[-1].close is None and tags[-1].close_end == len(text):
        found, tags = tags[-1].name, tags[-1].children
    if found:
        yield found


def _elements(model: Model, cursor: Cursor, typed: int) -> Iterator[Fit]:
    around = _around(cursor)
    for spec in plugin_around(around):
        for parameter in spec.parameters:
            detail = f"{spec.kind} ({spec.generation}): {described(parameter)}"
            yield Fit(parameter.tag, "parameter", detail, typed)
    if around is not None and around.name == "plugin":
        return
    place = around.name if around is not None else ""
    if place.removeprefix("xacro:") in ("macro", "if", "unless", "robot"):
        place = "robot"
    for name in sorted(URDF_CHILDREN.get(place, ("robot",) if around is None else ())):
        yield Fit(name, "element", f"in <{place}>" if place else "", typed)
    if place == "gazebo":
        for name in ("plugin", *_ON_LINKS.split()):
            yield Fit(name, "element", "in <gazebo>", typed)
    if "xacro" in cursor.document.source.text:
        for name in _DIRECTIVES:
            yield Fit(name, "element", "xacro", typed)
        for name, macro in model.expanded.macros.items():
            yield Fit(f"xacro:{name}", "element", f"macro {' '.join(macro.parameters)}".strip(), typed)


def _attributes(model: Model, name: str, written: str, typed: int) -> Iterator[Fit]:
    names: Iterable[str] = _DIRECTIVES.get(name, URDF_ATTRIBUTES.get(name, ()))
    if name == "gazebo":
        names = ("reference",)
    elif name in ("plugin", "sensor"):
        names = ("name", "filename") if name == "plugin" else ("name", "type")
    macro = model.expanded.macros.get(name.removeprefix("xacro:"))
    if macro is not None and name not in _DIRECTIVES:
        names = [parameter for parameter in macro.parameters if not parameter.startswith("*")]
    present = set(re.findall(r"([^\s=\"']+)\s*=", written))
    for attribute in names:
        if attribute not in present:
            optional = macro is not None and attribute in macro.defaults
            yield Fit(attribute, "attribute", "has a default" if optional else "", typed)


def _values(model: Model, cursor: Cursor, tag: str, attribute: str, typed: str) -> Iterator[Fit]:
    robot = model.robot
    around = _around(cursor)
    inside = around.name if around is not None else ""
    if (tag, attribute) in (("parent", "link"), ("child", "link")) or (tag, attribute) == ("gazebo", "reference"):
        yield from (Fit(name, "name", "link", len(typed)) for name in robot.link_by_name)
    if (tag, attribute) in (("mimic", "joint"), ("gazebo", "reference")) or (
        (tag, attribute) == ("joint", "name") and inside in ("transmission", "ros2_control")
    ):
        yield from (Fit(name, "name", f"{joint.type} joint", len(typed)) for name, joint in robot.joint_by_name.items())
    if (tag, attribute) == ("joint", "type"):
        yield from (Fit(name, "value", "", len(typed)) for name in JOINT_TYPES)
    if (tag, attribute) == ("material", "name"):
        names = dict.fromkeys(material.name for material in robot.materials if material.name)
        yield from (Fit(name, "name", "material", len(typed)) for name in names)
    if (tag, attribute) == ("plugin", "filename"):
        from urdfkit.description.plugins import ALL_SPECS

        for spec in ALL_SPECS:
            for stem in spec.filenames:
                label = stem if spec.generation == "gz" else f"lib{stem}.so"
                yield Fit(label, "value", f"{spec.kind} ({spec.generation})", len(typed))
    kind = tag.removeprefix("xacro:")
    if attribute == "filename" and kind in _SUFFIXES:
        yield from _files(model, cursor, typed, _SUFFIXES[kind])


def _files(model: Model, cursor: Cursor, typed: str, suffixes: tuple[str, ...]) -> Iterator[Fit]:
    from urdfkit.errors import ResourceError

    if (scheme := re.fullmatch(r"(?:package|model)://([^/]*)", typed)) is not None:
        yield from (Fit(f"{name}/", "file", "package", len(scheme[1])) for name in _packages(model))
        return
    folder, _, last = typed.rpartition("/")
    here = Path(cursor.document.source.file).absolute().parent
    try:
        if found := re.match(r"(?:package|model)://([^/]+)|\$\(find\s+([^()]+)\)", folder):
            place = model.expanded.packages.find((found[1] or found[2]).strip()) / folder[found.end() :].lstrip("/")
        else:
            place = here / folder
        children = sorted(place.iterdir())
    except (OSError, ResourceError):
        return
    for child in children:
        if not child.name.startswith(".") and (child.is_dir() or child.suffix.lower() in suffixes):
            yield Fit(child.name + ("/" if child.is_dir() else ""), "file", "", len(last))


def _packages(model: Model) -> list[str]:
    """Return the names of the package and of neighbouring packages."""
    from urdfkit.description.packages.related_files import neighbours

    return sorted(neighbours(model.package)) if model.package is not None else []


def _in_text(model: Model, cursor: Cursor, tail: str) -> Iterator[Fit]:
    """Yield the names that the parameter of a plugin accepts as its value."""
    tag = cursor.tag
    if tag is None or tag.parent is None:
        return
    typed = tail.rpartition(">")[2].lstrip()
    names = {parameter.names for spec in plugin_around(tag.parent) if (parameter := spec.parameter(tag.name))}
    if "joint" in names:
        yield from (Fit(name, "name", "joint", len(typed)) for name in model.robot.joint_by_name)
    if "link" in names or "frame" in names:
        yield from (Fit(name, "name", "link", len(typed)) for name in model.robot.link_by_name)


def _properties(model: Model, cursor: Cursor) -> Iterator[tuple[str, str]]:
    from urdfkit.lint.editor.symbol_occurrences import parameters_around

    for name in parameters_around(cursor.tag):
        yield name, "parameter of the macro"
    for name, position in model.expanded.properties.items():
        yield name, f"property, {position.file}:{position.line}"


def _arguments(model: Model) -> list[str]:
    found: dict[str, None] = {}
    for source in model.expanded.sources.values():
        found.update(dict.fromkeys(re.findall(r"<xacro:arg\s[^<>]*?\bname\s*=\s*[\"']([^\"'<>]+)", source.text)))
    return list(found)
