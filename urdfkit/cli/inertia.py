"""``urdfkit inertia``: compute mass, centre of mass and inertia of links from their shapes."""

from __future__ import annotations

import sys
from pathlib import Path

from urdfkit.cli.parser import add_package_path
from urdfkit.errors import UrdfkitError, UsageError, short_lines

TYPE_CHECKING = False
if TYPE_CHECKING:
    import argparse
    from collections.abc import Sequence
    from typing import Any

    from urdfkit.description.urdf.robot import Inertial, Link
    from urdfkit.lint.finding import Finding
    from urdfkit.lint.fixes.inertia_edits import ComputedInertial
    from urdfkit.lint.model.model import Model
    from urdfkit.lint.project.entry_files import Entry
    from urdfkit.lint.project.options import Options

MAX_RATIO = 10.0
"""Ratio to the moments of shapes of uniform density above which a moment is reported; motors explain smaller ones."""


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of ``urdfkit inertia``."""
    parser.usage = (
        "urdfkit inertia ROBOT [key:=value ...] [LINK] [--mass KG | --density KG/M3] [--from collision|visual]\n"
        "                       [--write] [--json]"
    )
    parser.epilog = (
        "examples:\n"
        "  urdfkit inertia simpleton chassis\n"
        "  urdfkit inertia urdf/arm.urdf.xacro forearm --density 2700 --write\n\n"
        "solids have uniform density; the overlap of primitives counts once; --write changes the source file\n"
        "exit status: 0 no defects, 1 defects found, 2 could not compute or write"
    )
    parser.add_argument(
        "words",
        nargs="*",
        metavar="ROBOT [LINK]",
        help="a .urdf or .xacro file, a package folder or a robot name; key:=value xacro arguments; then the link "
        "(default: all links with a mass)",
    )
    weight = parser.add_mutually_exclusive_group()
    weight.add_argument("--mass", type=_positive, metavar="KG", help="mass of the link (default: the mass in the file)")
    weight.add_argument(
        "--density", type=_positive, metavar="KG/M3", help="density of the material, e.g. 2700 for aluminium"
    )
    parser.add_argument("--from", dest="kind", choices=("collision", "visual"), help="shapes to use")
    parser.add_argument(
        "--write", action="store_true", help="write the values into the file; without LINK only for links with defects"
    )
    parser.add_argument("--json", action="store_true", help="print one JSON value")
    add_package_path(parser)


def _positive(text: str) -> float:
    from argparse import ArgumentTypeError
    from math import isfinite

    try:
        value = float(text)
    except ValueError:
        value = -1.0
    if not isfinite(value) or value <= 0.0:
        raise ArgumentTypeError(f"`{text}` is not a positive number")
    return value


def run(arguments: argparse.Namespace) -> int:
    """Compute, print and, on request, write the inertia.

    Raises:
        UsageError: an argument is invalid.
        UrdfkitError: the model or link is unknown, or its inertia cannot be computed or written.
    """
    from urdfkit.lint.engine.checker import model_of
    from urdfkit.lint.project.entry_files import Entry
    from urdfkit.lint.project.options import Options
    from urdfkit.resources import find_model

    plain = [word for word in arguments.words if ":=" not in word]
    if len(plain) > 2:
        raise UsageError(f"inertia: expected one ROBOT and one LINK, got {len(plain)} words: {' '.join(plain)}")
    name = plain[1] if len(plain) == 2 else None
    words = [*plain[:1], *(word for word in arguments.words if ":=" in word)]
    found = find_model(words, package_path=arguments.package_path)
    if arguments.mass is not None and name is None:
        raise UsageError("inertia: --mass needs a LINK")
    here = Path.cwd()
    path = found.path.relative_to(here) if found.path.is_relative_to(here) else found.path
    options = Options(("I",), (), None, found.arguments, found.package_path)
    model = model_of(path, options)
    links = _chosen(model, name)
    wrong = _wrong(path, options)
    rows, writes = [], []
    for link in links:
        row, value = _row(arguments, model, link, wrong.get(link.name, []), alone=name is not None)
        rows.append(row)
        if value is not None and arguments.write and (name is not None or row["findings"]):
            writes.append((link, value, row))
    if arguments.write:
        _write(Entry(path), options, model, writes, alone=name is not None)
    if arguments.json:
        import json

        print(json.dumps(rows[0] if name is not None else rows, ensure_ascii=False))
    else:
        print(short_lines("\n\n".join(map(_text, rows))))
    for row in rows:
        if row["written"] and not arguments.quiet:
            print(f"urdfkit: wrote the inertia of `{row['link']}` into {', '.join(row['written'])}", file=sys.stderr)
    return 1 if any(row["findings"] and not row["written"] for row in rows) else 0


def _chosen(model: Model, name: str | None) -> list[Link]:
    from urdfkit.errors import ModelError, did_you_mean

    links = list(model.robot.link_by_name_in_order())
    if not links:
        fault = next(iter(model.expanded.faults), None)
        raise ModelError(
            fault.message if fault else "the robot has no links", position=fault.position if fault else None
        )
    if name is None:
        return [link for link in links if link.inertial is not None]
    if name not in model.robot.link_by_name:
        raise ModelError(
            f"no link `{name}` in robot `{model.robot.name}`{did_you_mean(name, model.robot.link_by_name)}"
        )
    return [model.robot.link_by_name[name]]


def _wrong(path: Path, options: Options) -> dict[str, list[Finding]]:
    """Return the errors and warnings of the linter about mass and inertia, by link."""
    from urdfkit.lint.engine.run import run as lint
    from urdfkit.lint.project.entry_files import Entry

    by_link: dict[str, list[Finding]] = {}
    for finding in lint([Entry(path)], options).findings:
        if finding.link and finding.severity != "note":
            by_link.setdefault(finding.link, []).append(finding)
    return by_link


def _row(
    arguments: argparse.Namespace, model: Model, link: Link, findings: list[Finding], *, alone: bool
) -> tuple[dict[str, Any], ComputedInertial | None]:
    from urdfkit.lint.facts.inertia.inertia_from_shapes import COMPONENTS
    from urdfkit.lint.fixes.inertia_edits import compute_inertial

    at = (link.inertial.element if link.inertial is not None else link.element).origin.position
    row: dict[str, Any] = {
        "link": link.name,
        "file": at.file,
        "line": at.line,
        "present": _present(link.inertial),
        "computed": None,
        "shapes": None,
        "findings": [{"code": f.code, "severity": f.severity, "message": f.message} for f in findings],
        "notes": [],
        "written": [],
    }
    try:
        value = compute_inertial(model, link, mass=arguments.mass, density=arguments.density, kind=arguments.kind)
    except UrdfkitError as error:
        if alone:
            raise
        row["notes"] = [error.message]
        return row, None
    row["computed"] = {
        "mass": value.mass,
        "xyz": list(value.xyz),
        "rpy": list(link.inertial.origin.rpy) if link.inertial is not None else [0.0, 0.0, 0.0],
        "inertia": dict(zip(COMPONENTS, value.tensor, strict=True)),
    }
    row["findings"] += _deviations(row["present"], row["computed"])
    row["shapes"] = {"kind": value.kind, "count": value.count, "volume": value.volume, "shared": value.shared}
    row["notes"] = list(value.notes)
    return row, value


def _deviations(present: dict[str, Any] | None, computed: dict[str, Any]) -> list[dict[str, Any]]:
    """Return findings about moments that differ from those of the shapes by more than `MAX_RATIO`."""
    tensor = (present or {}).get("inertia")
    if tensor is None:
        return []
    findings = []
    for name in ("ixx", "iyy", "izz"):
        ratio = tensor[name] / computed["inertia"][name]
        if not 1.0 / MAX_RATIO < ratio < MAX_RATIO:
            message = f"{name} is {ratio:.3g} times that of the shapes"
            findings.append({"code": None, "severity": "warning", "message": message})
    return findings


def _present(inertial: Inertial | None) -> dict[str, Any] | None:
    from urdfkit.lint.facts.inertia.inertia_from_shapes import COMPONENTS

    if inertial is None:
        return None
    tensor = inertial.inertia
    return {
        "mass": inertial.mass,
        "xyz": list(inertial.origin.xyz),
        "rpy": list(inertial.origin.rpy),
        "inertia": {name: getattr(tensor, name) for name in COMPONENTS} if tensor is not None else None,
    }


def _write(
    entry: Entry,
    options: Options,
    model: Model,
    writes: Sequence[tuple[Link, ComputedInertial, dict[str, Any]]],
    *,
    alone: bool,
) -> None:
    """Write the computed values: verified in memory first, then each file replaced atomically."""
    from urdfkit.lint.engine.checker import model_of
    from urdfkit.lint.fixes.file_changes import changes, editable_folders
    from urdfkit.lint.fixes.inertia_edits import compute_inertial, edits
    from urdfkit.lint.project.options import Options

    wanted = []
    for link, value, row in writes:
        try:
            made = edits(model, link, value)
        except UrdfkitError as error:
            if alone:
                raise
            row["notes"].append(f"not written: {error}")
            continue
        wanted += made
        if not made:
            row["notes"].append("not written: the file has these values already, to six digits")
        row["written"] = sorted({f"{edit.span.file}:{edit.span.line}" for edit in made})
    changed = changes(wanted, model.expanded.sources, within=editable_folders([entry.path]))
    texts = {str(change.path): change.text for change in changed}
    again = model_of(entry.path, Options(**{**options.__dict__, "texts": texts}))
    for link, value, row in writes:
        fixed_link = again.robot.link_by_name.get(link.name)
        if not row["written"]:
            continue
        if fixed_link is None or not _agree(
            fixed_link.inertial, compute_inertial(again, fixed_link, mass=value.mass, kind=value.kind)
        ):
            raise UrdfkitError(
                f"the inertia of link `{link.name}` would differ from the computed values; nothing was written",
                position=link.element.origin.position,
            )
    for change in changed:
        change.write()


def _agree(inertial: Inertial | None, value: ComputedInertial) -> bool:
    from urdfkit.lint.facts.inertia.inertia_from_shapes import COMPONENTS

    if inertial is None or inertial.inertia is None or inertial.mass is None:
        return False
    own = [inertial.mass, *(getattr(inertial.inertia, name) for name in COMPONENTS)]
    size = max(value.tensor)
    return all(
        abs(a - b) <= 1e-4 * scale
        for a, b, scale in zip(own, (value.mass, *value.tensor), (value.mass, *[size] * 6), strict=True)
    )


def _text(row: dict[str, Any]) -> str:
    present, computed, shapes = row["present"], row["computed"], row["shapes"]
    lines = [f"{row['link']}  {row['file']}:{row['line']}"]
    if computed is not None:
        shared = f", of which {shapes['shared']:.4g} m³ are overlaps, counted once" if shapes["shared"] else ""
        plural = "s" if shapes["count"] > 1 else ""
        lines.append(f"  {shapes['count']} {shapes['kind']} shape{plural}, {shapes['volume']:.6g} m³ in total{shared}")
        lines.append(f"  {'':14}{'present':>16}{'computed':>16}")
        pairs = [("mass [kg]", present and present["mass"], computed["mass"])]
        middle = present["xyz"] if present else [None] * 3
        pairs += [(f"{axis} [m]", a, b) for axis, a, b in zip("xyz", middle, computed["xyz"], strict=True)]
        tensor = (present or {}).get("inertia") or {}
        pairs += [(f"{name} [kg·m²]", tensor.get(name), b) for name, b in computed["inertia"].items()]
        scale = max(computed["inertia"].values())
        lines += [
            f"  {name:14}{_number(a, scale):>16}{_number(b, scale):>16}{_times(a, b, scale)}" for name, a, b in pairs
        ]
    lines += [
        f"  {finding['severity']}: {finding['code'] or ''}{' ' if finding['code'] else ''}{finding['message']}"
        for finding in row["findings"]
    ]
    lines += [f"  note: {note}" for note in row["notes"]]
    return "\n".join(lines)


def _number(value: float | None, scale: float) -> str:
    return "-" if value is None else "0" if abs(value) < 1e-9 * scale else f"{value:.6g}"


def _times(present: float | None, computed: float, scale: float) -> str:
    """Return how many times too large or small a value is; empty where the ratio is less than 1.5."""
    if present is None or present <= 0.0 or computed <= 1e-9 * scale:
        return ""
    ratio = present / computed
    return f"  {ratio:.3g} times" if not 2.0 / 3.0 < ratio < 1.5 else ""
