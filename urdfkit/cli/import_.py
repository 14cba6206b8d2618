"""``urdfkit import``: wrap a bare URDF, such as a CAD export, into packages."""

from __future__ import annotations

import argparse
import shlex
from datetime import datetime, timezone
from pathlib import Path

from urdfkit.cli.parser import Parser
from urdfkit.errors import ResourceError, UsageError
from urdfkit.missing_files import expanded_path, missing_path

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

    from urdfkit.scaffold.templates.template import Template

_SUFFIXES = ("_description", "_gazebo", "_bringup", "_urdf", ".sldasm", ".SLDASM")

_MESH = "a mesh: import the URDF that names it"
_OTHER_FORMATS = {
    ".sdf": "SDF: the option `--world` of the simulator accepts it; import a URDF instead",
    ".world": "a world: the option `--world` of the simulator accepts it; import a URDF instead",
    ".zip": "an archive: unpack it, and import the URDF in it",
    **dict.fromkeys((".stl", ".dae", ".obj", ".gltf", ".glb", ".ply"), _MESH),
    **dict.fromkeys((".step", ".stp", ".sldasm", ".sldprt", ".f3d", ".fcstd"), "CAD: import the URDF exported from it"),
}
"""Suffix of a file that is not a URDF → kind of the file, and the alternative."""


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser.epilog = (
        "examples:\n  urdfkit import arm.urdf\n  urdfkit import export/arm.urdf --name arm --ros noetic --into src"
    )
    if isinstance(parser, Parser):
        parser.elsewhere = _suggestion
    parser.add_argument("file", metavar="FILE", help="the URDF file, which stays unchanged")
    parser.add_argument("--name", help="prefix of the packages' names (default: the robot's name)")
    parser.add_argument(
        "--ros", default="jazzy", help="ROS distribution: humble, jazzy, kilted, lyrical, noetic, or none"
    )
    parser.add_argument(
        "--into", metavar="DIR", default=".", help="folder to write to (default: the working directory)"
    )
    parser.add_argument(
        "--meshes", action="append", default=[], metavar="DIR", help="search this folder for meshes first (repeatable)"
    )
    parser.add_argument(
        "--repository",
        action=argparse.BooleanOptionalAction,
        help="write README, CI, pre-commit and dev container next to the packages (default: for a new or empty folder)",
    )
    parser.add_argument("--maintainer", help="maintainer in package.xml (default: from git config)")
    parser.add_argument("--email", help="e-mail address of the maintainer in package.xml (default: from git config)")
    parser.add_argument("--license", help="licence in package.xml")


def _suggestion(unknown: str) -> str:
    """Return the option that an unknown word probably stands for, as the end of a message."""
    if unknown in ("-o", "--out", "--output", "--dir", "--dest"):
        return "; did you mean `--into`?"
    return "" if unknown.startswith("-") else f"; did you mean `--into {unknown}`?"


def run(arguments: argparse.Namespace) -> int:
    """Find the meshes, render the packages, apply safe fixes, move the packages into place.

    Raises:
        UrdfkitError: the import failed; nothing was written.
    """
    from urdfkit.app.termination import ended_by_signals
    from urdfkit.cli.new.git_identity import identity
    from urdfkit.resources import templates_dir
    from urdfkit.scaffold import load_template
    from urdfkit.scaffold.wrap.package_creation import wrap

    file = _file(arguments.file)
    template = load_template(templates_dir() / "package")
    answers = identity(template)
    for name in ("ros", "maintainer", "email", "license"):
        if (value := getattr(arguments, name)) is not None:
            answers[name] = value if (name, value) == ("ros", "none") else template.question(name).accept(value)
    name = _name(template, arguments.name, file)
    folders = [_folder(word) for word in arguments.meshes]
    answers |= {"year": str(datetime.now(timezone.utc).year), "into": Path(arguments.into).as_posix()}
    with ended_by_signals():
        wrapped = wrap(
            file,
            name,
            Path(arguments.into),
            answers,
            mesh_folders=folders,
            fix=_apply_fixes,
            repository=arguments.repository,
        )
    for folder, count in zip(wrapped.folders, wrapped.files, strict=True):
        print(f"{folder.as_posix()}  {count} files")
    if wrapped.others:
        print(f"next to them: {', '.join(wrapped.others)}")
    if not arguments.quiet:
        if wrapped.meshes:
            print(f"\n{wrapped.meshes} mesh{'es' if wrapped.meshes > 1 else ''} copied; {file} is unchanged")
        for line in wrapped.notes:
            print(line)
        where = shlex.quote(wrapped.folders[0].as_posix())
        print(f"\nnext:\n  urdfkit lint {where}\n  urdfkit view {where}\n  urdfkit sim teleop {where}")
    return 0


def _file(word: str) -> Path:
    path = expanded_path(word)
    if path.is_dir():
        from urdfkit.robot_files import models_in

        models = models_in(path)
        if len(models) != 1:
            if not models:
                raise ResourceError(f"no robot description in folder {word}; pass the URDF file")
            listed = ", ".join(each.name for each in models[:8])
            raise ResourceError(f"{word} is a folder with {len(models)} descriptions; name the file: {listed}")
        path = models[0]
    if not path.is_file():
        raise ResourceError(missing_path(word))
    if (instead := _OTHER_FORMATS.get(path.suffix.lower())) is not None:
        raise UsageError(f"{word} is {instead}")
    if path.suffix == ".xacro":
        raise UsageError(f"{path} is a xacro file: run urdfkit expand {path} -o FILE.urdf, and import FILE.urdf")
    return path


def _folder(word: str) -> Path:
    path = expanded_path(word)
    if not path.is_dir():
        raise ResourceError(f"--meshes: {missing_path(word, 'folder')}")
    return path


def _name(template: Template, requested: str | None, file: Path) -> str:
    """Return the requested name, checked, or the robot's name as a valid ROS package name."""
    from urdfkit.description.xacro.expand import expand_leniently
    from urdfkit.scaffold import check_package_name, sanitised

    if requested is not None:
        return check_package_name(requested, suffixes=("_description", "_gazebo", "_bringup"))
    root = expand_leniently(file).root
    name = (root.get("name") if root is not None else None) or file.stem
    for suffix in _SUFFIXES:
        name = name.removesuffix(suffix)
    return check_package_name(sanitised(name))


def _apply_fixes(folder: Path) -> Sequence[str]:
    """Apply the safe fixes of the linter in a folder; return one line per rule with fixed or remaining findings."""
    from urdfkit.lint.fixes.apply import fix
    from urdfkit.lint.project.entry_files import find_entries
    from urdfkit.lint.project.options import Options

    fixed = fix(find_entries([folder]), Options(package_path=(folder,), guess_target=True), within=[folder])
    for change in fixed.changes:
        change.write()
    lines = [f"fixed: {count} × {code}" for code, count in sorted(fixed.fixed.items())]
    remaining = [finding for finding in fixed.outcome.findings if finding.severity != "note"]
    codes: dict[str, int] = {}
    for finding in remaining:
        codes[finding.code] = codes.get(finding.code, 0) + 1
    first = {finding.code: finding for finding in reversed(remaining)}
    lines += [
        f"remaining: {count} × {code}, e.g. line {first[code].line}: {first[code].message}"
        for code, count in codes.items()
    ]
    if remaining:
        lines.append("the package's lint test fails until these findings are fixed, or ignored with a comment")
    return lines
