"""``urdfkit lint``: find and mend the defects of a URDF or xacro."""

from __future__ import annotations

import os
import sys
from pathlib import Path

TYPE_CHECKING = False
if TYPE_CHECKING:
    import argparse
    from collections.abc import Sequence

    from urdfkit.lint.engine import Options, Outcome
    from urdfkit.lint.entries import Entry
    from urdfkit.lint.fix import Fixed

_EPILOG = """examples:
  urdfkit lint urdf/robot.urdf.xacro use_camera:=true
  urdfkit lint src --fix

exit: 0 nothing but notes found, 1 errors or warnings found, 2 could not lint
suppress in the file:
  <!-- urdfkit: ignore I503 -->       after an element: this line; alone on a line: the next element
  <!-- urdfkit: ignore-file I503 -->  the whole file"""


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser.add_argument(
        "paths",
        nargs="*",
        metavar="PATH",
        help="files, package folders or workspaces (left out: where you stand); then key:=value xacro arguments",
    )
    parser.add_argument("--fix", action="store_true", help="mend what has a safe fix")
    parser.add_argument("--unsafe-fixes", action="store_true", help="with --fix or --diff: apply unsafe fixes too")
    parser.add_argument("--diff", action="store_true", help="show what --fix would change, and change nothing")
    parser.add_argument("--select", action="append", default=[], metavar="CODES", help="only these: I503,J or I,X1")
    parser.add_argument("--ignore", action="append", default=[], metavar="CODES", help="not these")
    parser.add_argument(
        "--target",
        metavar="NAME",
        help="ros1, ros2, gz, classic, mujoco, isaac, drake, moveit, or any: what holds for all of them "
        "(default: guessed from package.xml)",
    )
    parser.add_argument("--format", choices=("text", "json"), default="text", help="text (default) or json")
    parser.add_argument("--statistics", action="store_true", help="count by rule instead of listing")
    parser.add_argument(
        "--package-path", action="append", default=[], metavar="DIR", help="look for packages here too (repeatable)"
    )
    parser.add_argument("--no-cache", action="store_true", help="lint again what has not changed")
    parser.add_argument("--jobs", type=_count, metavar="N", help="lint in so many processes (default: one per core)")
    parser.epilog = _EPILOG


def _count(text: str) -> int:
    if not text.isdecimal() or int(text) < 1:
        from argparse import ArgumentTypeError

        raise ArgumentTypeError(f"`{text}` is no number of processes")
    return int(text)


def run(arguments: argparse.Namespace) -> int:
    """Lint, and fix where asked to.

    Raises:
        UsageError: an argument makes no sense.
        ResourceError: a path is not there, or a file cannot be read or written.
    """
    from urdfkit.lint.engine import run as lint
    from urdfkit.lint.entries import find_entries

    paths, options = _read(arguments)
    entries = find_entries(paths)
    if arguments.fix or arguments.diff:
        return _fix(arguments, paths, entries, options)
    jobs = arguments.jobs or _cores()
    return _report(arguments, lint(entries, options, cached=not arguments.no_cache, jobs=jobs))


def _cores() -> int:
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def _read(arguments: argparse.Namespace) -> tuple[list[str], Options]:
    from urdfkit.errors import UsageError
    from urdfkit.lint.engine import Options

    if arguments.unsafe_fixes and not (arguments.fix or arguments.diff):
        raise UsageError("--unsafe-fixes goes with --fix or --diff")
    paths, xacro_arguments = [], {}
    for word in arguments.paths:
        key, separator, value = word.partition(":=")
        if not separator:
            paths.append(word)
        elif key:
            xacro_arguments[key] = value
        else:
            raise UsageError(f"`{word}` lacks its key: xacro arguments are key:=value")
    folders = tuple(_folder(word) for word in arguments.package_path)
    select, ignore = tuple(arguments.select), tuple(arguments.ignore)
    target = None if arguments.target == "any" else arguments.target
    guess = arguments.target is None
    return paths or ["."], Options(select, ignore, target, xacro_arguments, folders, guess_target=guess)


def _folder(word: str) -> Path:
    folder = Path(word).expanduser()
    if not folder.is_dir():
        from urdfkit.description.packages import near_path
        from urdfkit.errors import ResourceError

        raise ResourceError(f"--package-path {word}: no such folder{near_path(folder)}")
    return folder


def _fix(arguments: argparse.Namespace, paths: Sequence[str], entries: Sequence[Entry], options: Options) -> int:
    from urdfkit.lint.fix import fix, may_be_changed

    within = may_be_changed(Path(path) for path in paths)
    fixed = fix(entries, options, within=within, unsafe=arguments.unsafe_fixes)
    for note in () if arguments.quiet else fixed.notes:
        print(f"urdfkit: {note}", file=sys.stderr)
    if arguments.diff:
        return _show(fixed)
    for change in fixed.changes:
        change.write()
    if fixed.changes and not arguments.quiet:
        count = sum(fixed.fixed.values())
        by_code = ", ".join(f"{number} × {code}" for code, number in sorted(fixed.fixed.items()))
        files = f"{len(fixed.changes)} file{'s' if len(fixed.changes) > 1 else ''}"
        print(f"Fixed {count} finding{'s' if count > 1 else ''} in {files} ({by_code}).", file=sys.stderr)
    return _report(arguments, fixed.outcome)


def _show(fixed: Fixed) -> int:
    for change in fixed.changes:
        sys.stdout.write(change.diff())
    left = sum(finding.severity != "info" for finding in fixed.outcome.findings)
    if left:
        print(f"{left} finding{'s' if left > 1 else ''} would be left; nothing was written.", file=sys.stderr)
    return 1 if fixed.changes or left else 0


def _report(arguments: argparse.Namespace, outcome: Outcome) -> int:
    findings = outcome.findings
    for note in () if arguments.quiet else outcome.notes:
        print(f"urdfkit: {note}", file=sys.stderr)
    if arguments.format == "json":
        from urdfkit.lint.report.json import as_json

        print(as_json(findings))
    else:
        from urdfkit.cli.parser import columns
        from urdfkit.lint.report.text import TextReport, statistics, summary

        if arguments.statistics:
            print("\n".join([*statistics(findings), summary(findings)]))
        else:
            report = TextReport(
                outcome.sources, colour=_colour(arguments.color), width=columns() if sys.stdout.isatty() else None
            )
            for finding in findings:
                print(report.finding(finding), end="\n\n")
            print(summary(findings))
    return 1 if any(finding.severity != "info" for finding in findings) else 0


def _colour(choice: str) -> bool:
    if choice != "auto":
        return choice == "always"
    return sys.stdout.isatty() and not os.environ.get("NO_COLOR") and os.environ.get("TERM") != "dumb"
