"""What the commands that change a description have in common: which one, is it still clean, show or write."""

from __future__ import annotations

import argparse
import math
import shlex
import shutil
import sys
from pathlib import Path

from urdfkit.errors import ResourceError, UsageError, did_you_mean

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

    from urdfkit.description.urdf.robot import Robot
    from urdfkit.lint.finding import Finding
    from urdfkit.resources import ModelArgument
    from urdfkit.scaffold.additions.file_changes import Alteration

SIMULATORS = ("gz", "classic")


def add_description(parser: argparse.ArgumentParser) -> None:
    """Add the arguments that say which description, and what is done with the change."""
    parser.add_argument(
        "--into", metavar="DESCRIPTION", help="a .urdf or .xacro file or a package folder (default: where you stand)"
    )
    parser.add_argument("--arg", action="append", default=[], metavar="KEY:=VALUE", help="xacro argument (repeatable)")
    parser.add_argument(
        "--package-path", action="append", default=[], metavar="DIR", help="look for packages here too (repeatable)"
    )
    parser.add_argument(
        "--sim", choices=SIMULATORS, help="gz or classic: whose plugins (default: as in package.xml and the model)"
    )
    parser.add_argument("--diff", "--dry-run", action="store_true", help="show what would change, and change nothing")
    parser.add_argument("-y", "--yes", action="store_true", help=argparse.SUPPRESS)


def description(arguments: argparse.Namespace) -> tuple[ModelArgument, Robot, str]:
    """Return the model, the robot that it describes, and whose plugins it has.

    Raises:
        ResourceError: there is no such description, or it is one of those we ship.
        DescriptionError: it cannot be loaded.
    """
    from urdfkit.description import load
    from urdfkit.resources import find_model

    into = arguments.into
    if into is not None and not Path(into).expanduser().exists():
        there = sorted(path.name for path in Path.cwd().iterdir())
        begun = [name for name in there if name.startswith(into) and name.endswith("_description")]
        near = did_you_mean(into, there) or (f"; did you mean `{begun[0]}`?" if begun else "")
        raise ResourceError(f"--into {into}: no such file or folder{near}")
    try:
        model = find_model([*([into] if into is not None else []), *arguments.arg], package_path=arguments.package_path)
    except ResourceError as error:
        raise ResourceError(str(error).replace("no MODEL given", "no --into given")) from error
    robot = load(model.path, arguments=model.arguments, package_path=model.package_path)
    return model, robot, _generation(model.path, robot, arguments.sim)


def _generation(path: Path, robot: Robot, sim: str | None) -> str:
    """Return ``gz``, ``classic`` (ROS 1) or ``classic-ros2``, by what is asked for, the package and the plugins."""
    from urdfkit.lint.project.target import guess

    found = guess(path).target
    text = "".join(file.read_text("utf-8", "replace") for file in robot.files if file.is_file())
    of_classic, of_new = "libgazebo_ros" in text, "gz-sim-" in text or "ignition-gazebo-" in text or "gpu_lidar" in text
    if sim is None:
        sim = "classic" if of_classic and not of_new else "gz"
        if found == "ros1" and not of_new:
            sim = "classic"
    if sim == "gz":
        return "gz"
    ros2 = found == "ros2" or (found is None and "<ros>" in text)
    return "classic-ros2" if ros2 else "classic"


def apply(
    alterations: Sequence[Alteration],
    model: ModelArgument,
    arguments: argparse.Namespace,
    *,
    stage: Path | None = None,
    folder: Path | None = None,
) -> int:
    """Lint what would be, then show the difference or write.

    Args:
        alterations: of files that are there, and new ones beside them.
        model: what is changed.
        arguments: from the command line.
        stage: new packages that go with it, which are moved into `folder`.
        folder: where they go.

    Raises:
        ResourceError: something would be worse than it was, or cannot be written.
    """
    from urdfkit.atomic import move_into_place
    from urdfkit.scaffold.additions.file_changes import Alteration, write_all

    if new := _new_findings(alterations, model, stage):
        more = f" (and {len(new) - 1} more)" if len(new) > 1 else ""
        raise ResourceError(f"nothing was changed: that would bring {new[0].code} {new[0].message}{more}")
    if arguments.diff:
        for alteration in alterations:
            sys.stdout.write(alteration.diff())
        if stage is not None and folder is not None:
            for path in (each for each in sorted(stage.rglob("*")) if each.is_file() and each.name != "LICENSE"):
                sys.stdout.write(Alteration(folder / path.relative_to(stage), None, path.read_bytes()).diff())
        return 0
    moved = move_into_place(stage, folder) if stage is not None and folder is not None else []
    try:
        write_all(alterations)
    except BaseException:
        for path in moved:
            shutil.rmtree(path, ignore_errors=True)
        raise
    for path in moved:
        print(f"{shown(path)}  new")
    for alteration in alterations:
        print(f"{shown(alteration.path)}  {'new' if alteration.before is None else 'changed'}")
    if not arguments.quiet:
        where = shlex.quote(arguments.into or ".")
        print(f"\nnext:\n  urdfkit view {where}\n  urdfkit sim teleop {where}")
    return 0


def _new_findings(alterations: Sequence[Alteration], model: ModelArgument, stage: Path | None) -> list[Finding]:
    """Return what the linter has against the description as it would be, and not as it is."""
    from urdfkit.lint.engine.run import run
    from urdfkit.lint.project.entry_files import find_entries
    from urdfkit.lint.project.options import Options
    from urdfkit.scaffold.additions.file_changes import texts

    entries = find_entries([model.path])
    folders = (*([stage] if stage is not None else []), *model.package_path)

    def found(overlay: dict[str, str]) -> list[Finding]:
        # The rule about dependencies reads package.xml where it lies, not as it will be.
        told = any(alteration.path.name == "package.xml" for alteration in alterations)
        options = Options(
            ignore=("K956",) if told else (),
            arguments=model.arguments,
            package_path=folders,
            texts=overlay,
            guess_target=True,
        )
        return [finding for finding in run(entries, options).findings if finding.severity != "note"]

    before, after = found({}), found(dict(texts(alterations)))
    known: dict[tuple[str, str], int] = {}
    for finding in before:
        known[finding.code, finding.message] = known.get((finding.code, finding.message), 0) + 1
    new = []
    for finding in after:
        known[finding.code, finding.message] = known.get((finding.code, finding.message), 0) - 1
        if known[finding.code, finding.message] < 0:
            new.append(finding)
    return new


def vector(words: Sequence[str], option: str) -> tuple[float, float, float]:
    """Return the three numbers of an option.

    Raises:
        UsageError: one of them is none.
    """
    x, y, z = (number(word, option) for word in words)
    return x, y, z


def number(word: str, option: str) -> float:
    """Return the number of an option.

    Raises:
        UsageError: it is none.
    """
    try:
        found = float(word)
    except ValueError:
        raise UsageError(f"{option}: `{word}` is no number") from None
    if not math.isfinite(found):
        raise UsageError(f"{option}: `{word}` is not finite")
    return found


def shown(path: Path) -> str:
    """Return a path as seen from where one stands, or whole where it is elsewhere.

    Args:
        path: absolute.
    """
    try:
        return path.relative_to(Path.cwd()).as_posix()
    except ValueError:
        return str(path)
