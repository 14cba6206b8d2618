"""``urdfkit lint``: find and fix defects in URDF and xacro files.

Arguments and settings go in; findings are printed in one of five formats, and fixes are written on request.
"""

from __future__ import annotations

import sys
from pathlib import Path

from urdfkit.cli.lint.output import FORMATS
from urdfkit.cli.lint.run import Run

TYPE_CHECKING = False
if TYPE_CHECKING:
    import argparse

    from urdfkit.lint.engine.run import Outcome

_EPILOG = """examples:
  urdfkit lint urdf/robot.urdf.xacro use_camera:=true
  urdfkit lint src --fix

exit status: 0 no errors or warnings, 1 errors or warnings, 2 linting failed
suppress in the file:
  <!-- urdfkit: ignore I503 -->       this line (if alone, the next element)
  <!-- urdfkit: ignore-file I503 -->  the whole file
settings: [lint] in urdfkit.toml or [tool.urdfkit.lint] in pyproject.toml, nearest above the first PATH"""


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    from urdfkit.cli.parser import add_package_path, add_time_limit, count

    add = parser.add_argument
    add(
        "paths",
        nargs="*",
        metavar="PATH",
        help="files, package folders or workspaces (default: the working directory); then key:=value xacro arguments",
    )
    add("--fix", action="store_true", help="apply safe fixes")
    add("--unsafe-fixes", action="store_true", help="with --fix or --diff: apply unsafe fixes too")
    add("--fix-generated", action="store_true", help="with --fix or --diff: change generated files too")
    add("--diff", action="store_true", help="print the changes of --fix without writing them")
    add(
        "--select",
        action="append",
        default=[],
        metavar="CODES",
        help="report only these rules or groups of rules, such as I503,J",
    )
    add("--ignore", action="append", default=[], metavar="CODES", help="do not report these rules or groups of rules")
    add(
        "--target",
        metavar="NAME",
        help="ros1, ros2, gz, classic (each optionally with a release: ros2-jazzy, gz-harmonic), mujoco, isaac, drake, "
        "moveit, urdfkit, or any to check only the rules that hold for all targets (default: guessed from package.xml)",
    )
    add("--format", choices=FORMATS, default="text", help="text (default), json, sarif, github or junit")
    add("--statistics", action="store_true", help="print the number of findings per rule")
    add("--watch", action="store_true", help="lint again whenever a file changes")
    add("--baseline", type=Path, metavar="FILE", help="report only findings that are not in the baseline FILE")
    add("--write-baseline", type=Path, metavar="FILE", help="write the current findings to FILE as a baseline")
    add("--config", type=Path, metavar="FILE", help="read the settings from FILE")
    add("--no-config", action="store_true", help="ignore settings files")
    add_package_path(parser)
    add(
        "--confined",
        action="store_true",
        help="for untrusted files: read only the package, its workspace and the package path, and ignore environment "
        "variables",
    )
    help = "do not lint robots again with xacro arguments of launch files, or for branches of conditions"
    add("--no-launch-arguments", action="store_true", help=help)
    help = "instantiate this macro of the file; key:=value arguments also set its parameters"
    add("--macro", metavar="NAME", help=help)
    add("--no-cache", action="store_true", help="lint unchanged files again")
    jobs = count("number of processes; use 1 or more")
    add("--jobs", type=jobs, metavar="N", help="number of processes (default: one per core)")
    add_time_limit(parser)
    parser.epilog = _EPILOG


def run(arguments: argparse.Namespace) -> int:
    """Lint, and apply fixes on request.

    Raises:
        UsageError: an argument or a setting is invalid.
        ResourceError: a path does not exist, or a file cannot be read or written.
    """
    _check(arguments)
    if arguments.watch:
        return _watch(arguments)
    return Run(arguments).run()[0]


def _check(arguments: argparse.Namespace) -> None:
    from urdfkit.errors import UsageError

    changes = arguments.fix or arguments.diff
    if not changes and (arguments.unsafe_fixes or arguments.fix_generated):
        raise UsageError(f"--{'unsafe-fixes' if arguments.unsafe_fixes else 'fix-generated'} requires --fix or --diff")
    if arguments.watch and (changes or arguments.write_baseline):
        raise UsageError("--watch cannot be combined with --fix, --diff or --write-baseline")
    if arguments.write_baseline and changes:
        raise UsageError("--write-baseline cannot be combined with --fix or --diff")
    if arguments.statistics and arguments.format not in ("text", "json"):
        raise UsageError(f"--statistics supports the formats text and json, not {arguments.format}")
    if arguments.macro is not None and changes:
        raise UsageError("--macro cannot be combined with --fix or --diff; fix the file without --macro")
    if arguments.config and arguments.no_config:
        raise UsageError("--config cannot be combined with --no-config")


def _watch(arguments: argparse.Namespace) -> int:
    from urdfkit.cli.lint.watch import watch
    from urdfkit.errors import UrdfkitError

    def once() -> Outcome | None:
        try:
            return Run(arguments).run()[1]
        except UrdfkitError as error:  # e.g. a file that is half written
            print(f"urdfkit: {error}", file=sys.stderr)
            return None

    watch(once, [Path(word) for word in arguments.paths if ":=" not in word] or [Path()])
    return 0
