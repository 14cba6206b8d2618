"""Single-defect mutants of clean robots: is each found at its line?

Run it as ``python tests/bench/mutants.py [COUNT] [SEED]``. From the robots we ship, which are clean, it makes defective
ones by changing one thing in one place that is part of the expanded robot, and lints them. A mutant counts as found
when an error or a warning covers the line of the change (one line more or less) or names it: of two joints of one name
the second is found and the first named, and a tag that is not closed is named where the next one does not fit. What was
taken out of an element is missing at its start tag. Exit 1 below 98 in a hundred.
"""

from __future__ import annotations

import random
import re
import sys
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from urdfkit.lint.engine.checker import model_of
from urdfkit.lint.engine.run import run
from urdfkit.lint.model.model import Model
from urdfkit.lint.model.tags import Document, Tag
from urdfkit.lint.project.entry_files import Entry
from urdfkit.lint.project.options import Options
from urdfkit.resources import find_model

ROBOTS = (
    "artoo",
    "bot",
    "diff_wheeled_robot",
    "diff_wheeled_robot_with_laser",
    "gem_e2",
    "heterogeneous",
    "mybot",
    "rrbot",
    "seven_dof_arm",
    "simpleton",
)
WANTED = 0.98


@dataclass(frozen=True)
class Mutant:
    """One change: what rule it is meant for, and the text from `start` to `end` of a file that is replaced."""

    code: str
    robot: str
    file: str
    start: int
    end: int
    text: str


Change = tuple[str, int, int, str]


def changes(model: Model, document: Document, tag: Tag) -> Iterator[Change]:
    """Yield the defects that an element of the expanded robot can get: rule, start, end, text."""
    text = document.source.text
    attributes = tag.attributes
    parent = tag.parent.name if tag.parent is not None else ""

    def value(name: str, new: str, code: str, *, literal: bool = False) -> Iterator[Change]:
        written = attributes.get(name)
        if written is not None and not (literal and "$" in written.value) and written.value != new:
            yield code, written.value_start, written.value_end, new

    def without(name: str, code: str) -> Iterator[Change]:
        written = attributes.get(name)
        if written is not None:
            yield code, len(text[: written.start].rstrip()), written.end, ""

    def called(name: str, new: str, code: str) -> Iterator[Change]:
        written = attributes.get(name)
        if written is not None:
            yield code, written.start, written.start + len(name), new

    literal = {name: written.value for name, written in attributes.items() if "$" not in written.value}
    if tag.name == "link":
        yield from (
            value("name", f"{literal['name']} b", "N302", literal=True)
            if "name" in literal and not _named(model, literal["name"])
            else ()
        )
        if tag.close is not None:
            yield "E001", tag.close, tag.close_end, ""
    elif tag.name == "joint" and parent in ("robot", "xacro:macro", "xacro:if", "xacro:unless"):
        yield from without("type", "J401")
        yield from value("type", "hinge", "J402")
        other = next((j.name for j in model.robot.joints if j.name != literal.get("name") and "name" in literal), None)
        if other is not None and literal["name"] in model.robot.joint_by_name:
            yield from value("name", other, "T207")
        kind = attributes["type"].value if "type" in attributes else ""
        limit = next((child for child in tag.children if child.name == "limit"), None)
        if limit is not None and kind in ("revolute", "prismatic"):
            yield "J403", limit.start, limit.close_end, ""
    elif tag.name == "parent" and "link" in attributes:
        yield from value("link", f"{attributes['link'].value}x", "T201")
        yield from without("link", "E014")
    elif tag.name == "child" and "link" in attributes:
        yield from value("link", f"{attributes['link'].value}_", "T202")
    elif tag.name == "axis" and "xyz" in attributes:
        yield from value("xyz", "0 0 0", "J411")
        yield from value("xyz", "0 1 1", "J412")
        yield from value("xyz", "0 1", "E011")
        yield from called("xyz", "xzy", "E009")
    elif tag.name == "limit" and parent == "joint":
        kind = tag.parent.attributes["type"].value if tag.parent is not None and "type" in tag.parent.attributes else ""
        yield from without("effort", "J404")
        yield from called("velocity", "velocty", "E009")
        yield from value("effort", "-5", "J410")
        if kind == "revolute" and "lower" in literal and "upper" in literal:
            yield from value("upper", "180", "J407")
            yield from value("lower", str(float(literal["upper"]) + 1.0), "J405")
    elif tag.name == "origin":
        if len(literal.get("xyz", "").split()) == 3:
            yield from value("xyz", ", ".join(literal["xyz"].split()), "E010")
            yield from value("xyz", " ".join(literal["xyz"].split()[:2]), "E011")
        yield from value("rpy", "0 0 90", "J408")
        yield from called("rpy", "ryp", "E009")
        if parent == "inertial":
            yield from value("xyz", "9 0 0", "I513") if _is_seen(model, tag) else ()
    elif tag.name == "mass":
        yield from value("value", "-1", "I501")
        yield from value("value", "nan", "E012")
        yield from without("value", "E014")
        yield "E013", tag.close_end, tag.close_end, '<mass value="7"/>'
    elif tag.name == "inertia":
        yield from value("ixx", "-0.5", "I502")
        yield from value("izz", "900", "I503")
        yield from without("iyy", "E014")
    elif tag.name in ("cylinder", "sphere"):
        yield from value("radius", "-0.1", "G610")
        yield from without("radius", "E014")
        yield from called("radius", "radus", "E009")
    elif tag.name == "box":
        yield from value("size", "1", "E011")
        yield from value("size", "0 1 1", "G610")
    elif tag.name == "visual" and tag.close is not None:
        yield "E008", tag.start + 1, tag.start + 7, "visaul"
        yield "E007", tag.end, tag.end, "robot"
    elif tag.name == "material" and parent == "visual" and not tag.children and "name" in literal:
        yield from value("name", f"{literal['name']}zz", "G612")
    elif tag.name == "color":
        yield from value("rgba", "255 0 0 1", "G614")
    elif tag.name == "mesh":
        yield from value("filename", "package://nowhere/a.stl", "G602")
    elif tag.name == "gazebo" and "reference" in attributes:
        yield from value("reference", f"{attributes['reference'].value}x", "Z801")
    elif tag.name == "plugin" and "filename" in literal:
        name = literal["filename"]
        yield from value("filename", name.replace(".so", " .so"), "Z809") if name.endswith(".so") else ()
        left = next((c for c in tag.children if c.name in ("leftJoint", "left_joint") and c.close), None)
        right = next((c for c in tag.children if c.name in ("rightJoint", "right_joint") and c.close), None)
        if left is not None and right is not None and left.close is not None and right.close is not None:
            a, b = text[left.end : left.close], text[right.end : right.close]
            yield "Z802", left.end, left.close, f"{a}x"
            if left.start < right.start:
                yield "S903", left.end, right.close, f"{b}{text[left.close : right.end]}{a}"
    elif parent == "plugin" and tag.close is not None:
        if tag.name in ("wheelSeparation", "wheel_separation"):
            yield "S901", tag.end, tag.close, "9"
        elif tag.name in ("wheelDiameter", "wheel_diameter"):
            yield "S902", tag.end, tag.close, "9"
        elif tag.name in ("frameName", "frame_name", "robotBaseFrame", "robot_base_frame"):
            yield "Z803", tag.end, tag.close, f"{text[tag.end : tag.close]}x"
    elif tag.name == "hardwareInterface" and tag.close is not None:
        yield "C703", tag.end, tag.close, "hardware_interface/EffortJoinInterface"


def calls(model: Model, document: Document, tag: Tag) -> Iterator[Change]:
    """Yield the defects that a xacro directive or macro call can get."""
    attributes = tag.attributes
    name = tag.name.removeprefix("xacro:")
    macro = model.expanded.macros.get(name)
    if macro is not None:
        yield "X103", tag.start + 1, tag.start + 1 + len(tag.name), f"{tag.name}x"
        if tag.close is None:
            yield "X102", tag.start + 1, tag.start + 7, ""
        for parameter, written in attributes.items():
            if parameter not in macro.defaults:
                start = len(document.source.text[: written.start].rstrip())
                yield "X107", start, written.end, ""
            yield "X107", written.start, written.start + len(parameter), f"{parameter}q"
    elif name == "include" and "filename" in attributes:
        end = attributes["filename"].value_end
        yield "X113", end, end, "x"
    elif name in ("if", "unless") and "value" in attributes:
        yield "X122", attributes["value"].value_start, attributes["value"].value_end, "perhaps"


def expressions(model: Model, document: Document, tag: Tag) -> Iterator[Change]:
    """Yield the defects that the expressions of an element can get."""
    text = document.source.text[tag.start : tag.end]
    for found in re.finditer(r"\$\{([^{}]*)\}", text):
        start = tag.start + found.start()
        yield "X110", start, start + 2, "{$"
        word = re.search(r"(?<![\w.'])[a-z]\w{2,}(?![\w('])", found[1])
        if word is not None and word[0] not in ("pi", "xacro"):
            at = start + 2 + word.end()
            yield "X104", at, at, "q"
    for found in re.finditer(r"\$\(arg (\w+)\)", text):
        at = tag.start + found.end(1)
        yield "X106", at, at, "q"


def _named(model: Model, link: str) -> bool:
    return any(link in (joint.parent, joint.child) for joint in model.robot.joints)


def _is_seen(model: Model, origin: Tag) -> bool:
    link = next((tag for tag in origin.ancestors() if tag.name == "link"), None)
    return link is not None and any(child.name == "visual" for child in link.children)


def mutants(robot: str) -> list[Mutant]:
    """Return every mutant of a robot we ship."""
    path = find_model([robot]).path
    model = model_of(path, Options())
    root = model.expanded.root
    assert root is not None
    every = list(root.walk())
    live = {element.origin.position for element in every}
    live |= {call.position for element in every for call in element.origin.expansions}
    found: dict[Mutant, None] = {}
    for file in model.expanded.sources:
        document = model.document(file)
        for tag in document.walk():
            position = document.source.position(tag.start)
            kinds = []
            if position in live:
                kinds = [changes, expressions, calls]
            elif tag.name in ("xacro:include", "xacro:if", "xacro:unless") and tag.parent in document.roots:
                kinds = [calls]
            for kind in kinds:
                for change in kind(model, document, tag):
                    found[Mutant(change[0], robot, file, *change[1:])] = None
    return list(found)


def sample(robots: tuple[str, ...], count: int, seed: int) -> list[Mutant]:
    """Return mutants of all kinds in turn, the places drawn by lot."""
    by_kind: dict[str, list[Mutant]] = {}
    for robot in robots:
        for mutant in mutants(robot):
            by_kind.setdefault(mutant.code, []).append(mutant)
    lot = random.Random(seed)
    for several in by_kind.values():
        lot.shuffle(several)
    chosen: list[Mutant] = []
    while len(chosen) < count and any(by_kind.values()):
        for kind in sorted(by_kind):
            if by_kind[kind] and len(chosen) < count:
                chosen.append(by_kind[kind].pop())
    return chosen


def is_found(mutant: Mutant) -> tuple[bool, list[str]]:
    """Lint a mutant; return whether it is found at its line, and the codes there, or anywhere where it is not."""
    entry = find_model([mutant.robot]).path
    path = Path.cwd() / mutant.file
    text = path.read_text("utf-8")
    line = text.count("\n", 0, mutant.start) + 1
    last = text.count("\n", 0, mutant.end) + 1
    changed = text[: mutant.start] + mutant.text + text[mutant.end :]
    if mutant.code == "J403":
        line = last = text.count("\n", 0, text.rfind("<joint", 0, mutant.start)) + 1
    names = (f"on line {line} ", f"{mutant.file}:{line}")
    if mutant.code == "E001":  # the start tag whose end tag is missing
        line = text.count("\n", 0, text.rfind("<link", 0, mutant.start)) + 1
    findings = run([Entry(entry)], Options(texts={str(path): changed})).findings
    serious = [finding for finding in findings if finding.severity != "note"]
    near = [
        finding.code
        for finding in serious
        if (finding.file == mutant.file and finding.line - 1 <= last and line <= finding.span.end_line + 1)
        or any(name in f"{finding.message} {finding.help or ''} " for name in names)
    ]
    return bool(near), near or sorted({finding.code for finding in serious})


def main() -> int:
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 500
    seed = int(sys.argv[2]) if len(sys.argv) > 2 else 5
    chosen = sample(ROBOTS, count, seed)
    total, hit, named = Counter[str](), Counter[str](), 0
    for mutant in chosen:
        found, codes = is_found(mutant)
        total[mutant.code] += 1
        hit[mutant.code] += found
        named += found and mutant.code in codes
        if not found:
            text = Path(mutant.file).read_text("utf-8")
            line = text.count("\n", 0, mutant.start) + 1
            what = f"{text[mutant.start : mutant.end]!r} -> {mutant.text!r}"
            print(f"missed {mutant.code} {mutant.file}:{line} {what} {codes}")
    for code in sorted(total):
        print(f"{code}  {hit[code]:3d} of {total[code]:3d}")
    share = sum(hit.values()) / len(chosen)
    print(f"{sum(hit.values())} of {len(chosen)} mutants of {len(total)} kinds found at their line: {share:.1%}")
    print(f"{named} of them by the rule they were made for")
    return 0 if share >= WANTED else 1


if __name__ == "__main__":
    sys.exit(main())
