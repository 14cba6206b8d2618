"""``urdfkit inertia``: compute mass, centre of mass and inertia of links from their shapes."""

from __future__ import annotations

import sys
from pathlib import Path

from urdfkit.cli.parser import add_package_path
from urdfkit.errors import ModelError, UrdfkitError, UsageError, did_you_mean, short_lines

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
        help="a .urdf or .xacro file, a package folder or a robot name, then key:=value xacro arguments, then the link "
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
    from urdfkit.cli.inertia_rows import row_of, text_of
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
        row, value = row_of(arguments, model, link, wrong.get(link.name, []), alone=name is not None)
        rows.append(row)
        if value is not None and arguments.write and (name is not None or row["findings"]):
            writes.append((link, value, row))
    if arguments.write:
        _write(Entry(path), options, model, writes, alone=name is not None)
    if arguments.json:
        import json

        print(json.dumps(rows[0] if name is not None else rows, ensure_ascii=False))
    else:
        print(short_lines("\n\n".join(map(text_of, rows))))
    for row in rows:
        if row["written"] and not arguments.quiet:
            print(f"urdfkit: wrote the inertia of `{row['link']}` into {', '.join(row['written'])}", file=sys.stderr)
    return 1 if any(row["findings"] and not row["written"] for row in rows) else 0


def _chosen(model: Model, name: str | None) -> list[Link]:
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
            message = f"the inertia of link `{link.name}` would differ from the computed values; nothing was written"
            raise UrdfkitError(message, position=link.element.origin.position)
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
