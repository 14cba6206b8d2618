"""``urdfkit import``: wrap a bare URDF, e.g. what a CAD program wrote, into packages."""

from __future__ import annotations

import argparse
import shlex
from datetime import datetime, timezone
from pathlib import Path

from urdfkit.cli.parser import Parser
from urdfkit.errors import ResourceError, UsageError, did_you_mean

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

    from urdfkit.scaffold.templates.template import Template

_SUFFIXES = ("_description", "_gazebo", "_bringup", "_urdf", ".sldasm", ".SLDASM")

_MESH = "a mesh: import the URDF that names it"
_OTHER = {
    ".sdf": "SDF: `--world` of the simulator takes it, import takes URDF",
    ".world": "a world: `--world` of the simulator takes it, import takes URDF",
    ".zip": "an archive: unpack it, and import the URDF in it",
    **dict.fromkeys((".stl", ".dae", ".obj", ".gltf", ".glb", ".ply"), _MESH),
    **dict.fromkeys((".step", ".stp", ".sldasm", ".sldprt", ".f3d", ".fcstd"), "CAD: import the URDF exported from it"),
}
"""What is no URDF, by the end of its name."""


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser.epilog = (
        "examples:\n  urdfkit import arm.urdf\n  urdfkit import export/arm.urdf --name arm --ros noetic --into src"
    )
    if isinstance(parser, Parser):
        parser.elsewhere = _meant
    parser.add_argument("file", metavar="FILE", help="the URDF; it is only read")
    parser.add_argument("--name", help="what the packages' names begin with (default: the robot's)")
    parser.add_argument(
        "--ros", default="jazzy", help="ROS distribution: humble, jazzy, kilted, lyrical, noetic, or none"
    )
    parser.add_argument("--into", metavar="DIR", default=".", help="folder to write to (default: where you stand)")
    parser.add_argument(
        "--meshes", action="append", default=[], metavar="DIR", help="look for meshes here first (repeatable)"
    )
    parser.add_argument(
        "--repository",
        action=argparse.BooleanOptionalAction,
        help="README, CI, pre-commit, dev container beside the packages (default: where that folder is new or empty)",
    )
    for name in ("maintainer", "email", "license"):
        parser.add_argument(
            f"--{name}", help=f"for package.xml{' (default: as git knows)' if name != 'license' else ''}"
        )


def _meant(unknown: str) -> str:
    """Return what to say of a word that is no option: that it is where to write to, or of which name."""
    if unknown in ("-o", "--out", "--output", "--dir", "--dest"):
        return "; did you mean `--into`?"
    return "" if unknown.startswith("-") else f"; did you mean `--into {unknown}`?"


def run(arguments: argparse.Namespace) -> int:
    """Find the meshes, render, mend, move into place.

    Raises:
        UrdfkitError: it could not be done; nothing was written then.
    """
    from urdfkit.app.termination import ended_by_signals
    from urdfkit.cli.git_identity import identity
    from urdfkit.resources import templates_dir
    from urdfkit.scaffold import load_template
    from urdfkit.scaffold.wrap.urdf_packages import wrap

    file = _file(arguments.file)
    template = load_template(templates_dir() / "package")
    given = identity(template)
    for name in ("ros", "maintainer", "email", "license"):
        if (value := getattr(arguments, name)) is not None:
            given[name] = value if (name, value) == ("ros", "none") else template.question(name).accept(value)
    name = _name(template, arguments.name, file)
    folders = [_folder(word) for word in arguments.meshes]
    given |= {"year": str(datetime.now(timezone.utc).year), "into": Path(arguments.into).as_posix()}
    with ended_by_signals():
        wrapped = wrap(
            file, name, Path(arguments.into), given, mesh_folders=folders, mend=_mended, repository=arguments.repository
        )
    for folder, count in zip(wrapped.folders, wrapped.files, strict=True):
        print(f"{folder.as_posix()}  {count} files")
    if wrapped.beside:
        print(f"beside them: {', '.join(wrapped.beside)}")
    if not arguments.quiet:
        if wrapped.meshes:
            print(f"\n{wrapped.meshes} mesh{'es' if wrapped.meshes > 1 else ''} copied; {file} is as it was")
        for line in wrapped.said:
            print(line)
        where = shlex.quote(wrapped.folders[0].as_posix())
        print(f"\nnext:\n  urdfkit lint {where}\n  urdfkit view {where}\n  urdfkit sim teleop {where}")
    return 0


def _file(word: str) -> Path:
    path = Path(word).expanduser()
    if path.is_dir():
        from urdfkit.resources import models_in

        found = models_in(path)
        if len(found) != 1:
            listed = f": {', '.join(each.name for each in found[:8])}" if found else ""
            raise ResourceError(f"{word} is a folder with {len(found)} descriptions; name the file{listed}")
        path = found[0]
    if not path.is_file():
        there = [each.name for each in path.parent.iterdir()] if path.parent.is_dir() else []
        raise ResourceError(f"no such file: {word}{did_you_mean(path.name, there)}")
    if (instead := _OTHER.get(path.suffix.lower())) is not None:
        raise UsageError(f"{word} is {instead}")
    if path.suffix == ".xacro":
        raise UsageError(
            f"{path} is a xacro, which may have files beside it: urdfkit expand {path} -o FILE.urdf, and import that"
        )
    return path


def _folder(word: str) -> Path:
    path = Path(word).expanduser()
    if not path.is_dir():
        raise ResourceError(f"--meshes {word}: no such folder")
    return path


def _name(template: Template, asked: str | None, file: Path) -> str:
    """Return the name asked for, checked, or the robot's as ROS would have it."""
    from urdfkit.description.xacro.expand import expand_leniently
    from urdfkit.scaffold import check_package_name, sanitised

    if asked is not None:
        return check_package_name(asked, suffixes=("_description", "_gazebo", "_bringup"))
    root = expand_leniently(file).root
    name = (root.get("name") if root is not None else None) or file.stem
    for suffix in _SUFFIXES:
        name = name.removesuffix(suffix)
    return check_package_name(sanitised(name))


def _mended(stage: Path) -> Sequence[str]:
    """Apply the safe fixes of the linter in a folder; return what was mended and what is left, a line each."""
    from urdfkit.lint.fixes.apply import fix
    from urdfkit.lint.project.entry_files import find_entries
    from urdfkit.lint.project.options import Options

    fixed = fix(find_entries([stage]), Options(package_path=(stage,), guess_target=True), within=[stage])
    for change in fixed.changes:
        change.write()
    said = [f"mended: {count} × {code}" for code, count in sorted(fixed.fixed.items())]
    left = [finding for finding in fixed.outcome.findings if finding.severity != "note"]
    codes: dict[str, int] = {}
    for finding in left:
        codes[finding.code] = codes.get(finding.code, 0) + 1
    first = {finding.code: finding for finding in reversed(left)}
    said += [
        f"left: {count} × {code}, e.g. line {first[code].line}: {first[code].message}" for code, count in codes.items()
    ]
    if left:
        said.append("the package's own test of the linter fails until these are mended, or ignored with a comment")
    return said
