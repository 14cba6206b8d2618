"""Steps that the commands share that change a description: find it, lint the change, print or write it."""

from __future__ import annotations

import argparse
import math
import shlex
import sys
from contextlib import nullcontext
from pathlib import Path

from urdfkit.cli.parser import add_package_path
from urdfkit.errors import ResourceError, UsageError, did_you_mean
from urdfkit.missing_files import expanded_path

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

    from urdfkit.description.urdf.robot import Robot
    from urdfkit.lint.finding import Finding
    from urdfkit.resources import ModelArgument
    from urdfkit.scaffold.additions.file_changes import Alteration

SIMULATORS = ("gz", "classic")


def add_description(parser: argparse.ArgumentParser) -> None:
    """Add the arguments that select the description and the treatment of the change."""
    parser.add_argument(
        "--into",
        metavar="DESCRIPTION",
        help="a .urdf or .xacro file or a package folder (default: the working directory)",
    )
    parser.add_argument("--arg", action="append", default=[], metavar="KEY:=VALUE", help="xacro argument (repeatable)")
    add_package_path(parser)
    parser.add_argument(
        "--sim",
        choices=SIMULATORS,
        help="simulator to write the plugins for: gz or classic (default: inferred from package.xml and the model)",
    )
    parser.add_argument("--diff", "--dry-run", action="store_true", help="print the changes without writing them")
    parser.add_argument("-y", "--yes", action="store_true", help=argparse.SUPPRESS)


def description(arguments: argparse.Namespace) -> tuple[ModelArgument, Robot, str]:
    """Return the model, its robot, and the generation of its plugins.

    Raises:
        ResourceError: the description does not exist, or is a bundled robot.
        DescriptionError: the description cannot be loaded.
    """
    from urdfkit.description import load
    from urdfkit.resources import find_model

    into = arguments.into
    if not arguments.diff:
        _revert_killed_changes(expanded_path(into or "."))
    if into is not None and not expanded_path(into).exists():
        siblings = sorted(path.name for path in Path.cwd().iterdir())
        completions = [name for name in siblings if name.startswith(into) and name.endswith("_description")]
        near = did_you_mean(into, siblings) or (f"; did you mean `{completions[0]}`?" if completions else "")
        raise ResourceError(f"--into {into}: no such file or folder{near}")
    model = find_model([*([into] if into is not None else []), *arguments.arg], package_path=arguments.package_path)
    robot = load(model.path, arguments=model.arguments, package_path=model.package_path)
    return model, robot, _generation(model.path, robot, arguments.sim)


def _revert_killed_changes(into: Path) -> None:
    """Revert the unfinished changes of killed programs, so that the same command starts from the same files."""
    from urdfkit.atomic import clean_up

    above = into.absolute().parent
    for folder in sorted(
        {path.parent for depth in ("", "*/", "*/*/", "*/*/*/") for path in above.glob(f"{depth}.urdfkit-*")}
    ):
        clean_up(folder)


def _generation(path: Path, robot: Robot, sim: str | None) -> str:
    """Return ``gz``, ``classic`` (ROS 1) or ``classic-ros2``, by option `--sim`, package and plugins."""
    from urdfkit.lint.project.target_platform import guess

    target = guess(path).target
    text = "".join(file.read_text("utf-8", "replace") for file in robot.files if file.is_file())
    of_classic, of_new = "libgazebo_ros" in text, "gz-sim-" in text or "ignition-gazebo-" in text or "gpu_lidar" in text
    if sim is None:
        sim = "classic" if of_classic and not of_new else "gz"
        if target == "ros1" and not of_new:
            sim = "classic"
    if sim == "gz":
        return "gz"
    ros2 = target == "ros2" or (target is None and "<ros>" in text)
    return "classic-ros2" if ros2 else "classic"


def apply(
    alterations: Sequence[Alteration],
    model: ModelArgument,
    arguments: argparse.Namespace,
    *,
    staged: Path | None = None,
    folder: Path | None = None,
) -> int:
    """Lint the changed description, then print the difference or write it.

    Args:
        alterations: changes to existing files, and new files.
        model: the changed model.
        arguments: from the command line.
        staged: folder with new packages to move into `folder`.
        folder: destination of the new packages.

    Raises:
        ResourceError: the change adds findings, or cannot be written.
    """
    from urdfkit.atomic import replace_and_move, staging
    from urdfkit.scaffold.additions.file_changes import Alteration

    if new := _new_findings(alterations, model, staged):
        more = f" (and {len(new) - 1} more)" if len(new) > 1 else ""
        raise ResourceError(f"nothing was changed: the change would add {new[0].code} {new[0].message}{more}")
    if arguments.diff:
        for alteration in alterations:
            sys.stdout.write(alteration.diff())
        if staged is not None and folder is not None:
            for path in (each for each in sorted(staged.rglob("*")) if each.is_file() and each.name != "LICENSE"):
                sys.stdout.write(Alteration(folder / path.relative_to(staged), None, path.read_bytes()).diff())
        return 0
    with staging(model.path.parent) if staged is None else nullcontext(staged) as place:
        moved = replace_and_move(alterations, place, folder or model.path.parent)
    for path in moved:
        print(f"{shown(path)}  new")
    for alteration in alterations:
        print(f"{shown(alteration.path)}  {'new' if alteration.before is None else 'changed'}")
    if not arguments.quiet:
        where = shlex.quote(arguments.into or ".")
        print(f"\nnext:\n  urdfkit view {where}\n  urdfkit sim teleop {where}")
    return 0


def _new_findings(alterations: Sequence[Alteration], model: ModelArgument, staged: Path | None) -> list[Finding]:
    """Return the findings that the change adds to the description."""
    from urdfkit.lint.engine.run import run
    from urdfkit.lint.project.entry_files import find_entries
    from urdfkit.lint.project.options import Options
    from urdfkit.scaffold.additions.file_changes import texts

    entries = find_entries([model.path])
    folders = (*([staged] if staged is not None else []), *model.package_path)

    def findings_with(overlay: dict[str, str]) -> list[Finding]:
        # The rule about dependencies reads package.xml from disk, not its new text. The placement reports overlaps,
        # and the user may choose a place inside of a body or next to it.
        adds_dependency = any(alteration.path.name == "package.xml" for alteration in alterations)
        options = Options(
            ignore=("J427", "S915", "K956") if adds_dependency else ("J427", "S915"),
            arguments=model.arguments,
            package_path=folders,
            texts=overlay,
            guess_target=True,
        )
        return [finding for finding in run(entries, options).findings if finding.severity != "note"]

    before, after = findings_with({}), findings_with(dict(texts(alterations)))
    counts: dict[tuple[str, str], int] = {}
    for finding in before:
        counts[finding.code, finding.message] = counts.get((finding.code, finding.message), 0) + 1
    new = []
    for finding in after:
        counts[finding.code, finding.message] = counts.get((finding.code, finding.message), 0) - 1
        if counts[finding.code, finding.message] < 0:
            new.append(finding)
    return new


def vector(words: Sequence[str], option: str) -> tuple[float, float, float]:
    """Return the three numbers of an option.

    Raises:
        UsageError: one of the words is not a number.
    """
    x, y, z = (number(word, option) for word in words)
    return x, y, z


def number(word: str, option: str) -> float:
    """Return the number of an option.

    Raises:
        UsageError: the word is not a finite number.
    """
    try:
        value = float(word)
    except ValueError:
        raise UsageError(f"{option}: `{word}` is not a number") from None
    if not math.isfinite(value):
        raise UsageError(f"{option}: `{word}` is not finite")
    return value


def shown(path: Path) -> str:
    """Return a path relative to the working directory, or absolute where it is elsewhere.

    Args:
        path: absolute path.
    """
    try:
        return path.relative_to(Path.cwd()).as_posix()
    except ValueError:
        return str(path)
