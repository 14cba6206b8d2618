"""Wrap a bare URDF into packages: description with the meshes it uses, Gazebo, bringup, and what goes with them."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from urdfkit.atomic import move_into_place, staging
from urdfkit.description import load
from urdfkit.description.urdf.robot import Robot
from urdfkit.errors import DescriptionError, ResourceError
from urdfkit.resources import templates_dir
from urdfkit.scaffold.templates.computed_answers import computed
from urdfkit.scaffold.templates.placeholders import fill
from urdfkit.scaffold.templates.template_parser import load_template
from urdfkit.scaffold.update.rendering import is_fresh, made
from urdfkit.scaffold.wrap.mesh_assets import URI, Meshes
from urdfkit.scaffold.wrap.readme_picture import drawing_of
from urdfkit.scaffold.wrap.renaming import in_utf8, renamed, told
from urdfkit.scaffold.wrap.repository_files import accompany, told_to_test

KINDS = ("description", "gazebo", "bringup")


@dataclass(frozen=True, slots=True)
class Wrapped:
    """What came of wrapping.

    Attributes:
        folders: the packages, where they are now.
        files: how many files each has.
        meshes: how many meshes and pictures were copied.
        said: what the mender said.
        beside: what was written beside the packages.
    """

    folders: tuple[Path, ...]
    files: tuple[int, ...]
    meshes: int
    said: Sequence[str]
    beside: tuple[str, ...] = ()


def wrap(
    file: Path,
    name: str,
    folder: Path,
    answers: Mapping[str, str],
    *,
    mesh_folders: Sequence[Path] = (),
    mend: Callable[[Path], Sequence[str]] = lambda _: (),
    repository: bool | None = None,
) -> Wrapped:
    """Write the packages of a robot whose URDF is there; the file itself is only read.

    Args:
        file: the URDF.
        name: what the packages' names begin with.
        folder: to write to; made if it is not there.
        answers: to the questions of the template of packages: ros (or none: the description alone), maintainer, email,
            license; and year, into.
        mesh_folders: where to look for meshes first.
        mend: is given the folder with the packages before they are moved, may change them, and says what it did.
        repository: whether to write CI and the like beside the packages; None: where the folder is new, empty or a
            fresh clone. What is there stays.

    Raises:
        ResourceError: a mesh is not found, a package is there already, or something cannot be read or written.
        DescriptionError: the file is no robot.
    """
    kinds = KINDS if answers["ros"] != "none" else KINDS[:1]
    folder_names = [f"{name}_{kind}" for kind in kinds]
    for target in (folder / each for each in folder_names):
        if target.exists() or target.is_symlink():
            raise ResourceError(f"{target} is already there; nothing is overwritten")
    meshes = Meshes(file, mesh_folders)
    text, new = renamed(in_utf8(_read(file)).decode("utf-8", "surrogateescape"), name)
    content = rewritten(
        text.encode("utf-8", "surrogateescape"), meshes, f"{name}_description" if len(kinds) > 1 else ""
    )
    _check(meshes, file, text)
    repository = is_fresh(folder) if repository is None else repository
    there = {path.name for path in folder.iterdir()} if folder.is_dir() else set()
    with made(folder), staging(folder) as stage:
        model = stage / f"{name}_description/urdf/{name}.urdf.xacro"
        given = {"model": model.name, "folders": " meshes" if meshes.copies else ""}
        for kind in kinds:
            _render(stage, kind, name, {**answers, **given, "root": "base_link"})
        model.parent.mkdir(parents=True, exist_ok=True)
        model.write_bytes(content)
        meshes.copy(stage / f"{name}_description")
        said = [*told(new), *(f"not copied: {path}: {why}" for path, why in meshes.left.items()), *mend(stage)]
        robot = _loaded(model, stage, file)
        picture = _drawn(robot, stage / f"{name}_description", name)
        origin = f"imported from `{file.name}`"
        accompany(stage, name, origin, {**answers, "picture": picture}, repository=repository, without=there)
        _named(stage / f"{name}_description", name, robot)
        counts = tuple(sum(path.is_file() for path in (stage / each).rglob("*")) for each in folder_names)
        beside = tuple(sorted({path.name for path in stage.iterdir()} - set(folder_names)))
        move_into_place(stage, folder)
    return Wrapped(tuple(folder / each for each in folder_names), counts, len(meshes.copies), said, beside)


def rewritten(content: bytes, meshes: Meshes, package: str) -> bytes:
    """Return a URDF whose meshes are those of the new package; all else stays, byte for byte.

    Args:
        content: of the file.
        meshes: finds them.
        package: the name of the new package; empty: they are relative to the file.
    """
    text = content.decode("utf-8", "surrogateescape")
    text = URI.sub(lambda match: f"{match[1]}{match[2]}{meshes.uri(match[3], package)}{match[2]}", text)
    return text.encode("utf-8", "surrogateescape")


def _check(meshes: Meshes, file: Path, text: str) -> None:
    """Raise with the place of a mesh that is not there or not to be copied."""
    for uri, why in meshes.refused.items():
        line = text.count("\n", 0, max(text.find(uri), 0)) + 1
        raise ResourceError(f"{file}:{line}: the mesh `{uri}` {why}; nothing was written")
    if meshes.missing:
        more = f" and {len(meshes.missing) - 1} more" if len(meshes.missing) > 1 else ""
        raise ResourceError(f"{file}: no file for `{meshes.missing[0]}`{more}; nothing was written: --meshes DIR?")


def _render(stage: Path, kind: str, name: str, answers: Mapping[str, str]) -> None:
    template = load_template(templates_dir() / "package")
    if answers["ros"] == "none":
        readme = template.folder / "readme/no-ros/README.md"
        (stage / f"{name}_{kind}").mkdir()
        text = fill(readme.read_text(encoding="utf-8"), {"name": f"{name}_{kind}", "robot": name}, where=str(readme))
        (stage / f"{name}_{kind}/README.md").write_text(text, encoding="utf-8")
        return
    asked = {question.name for question in template.questions}
    given = {key: value for key, value in answers.items() if key in asked}
    full = template.answers({**given, "name": f"{name}_{kind}", "kind": kind})
    full |= computed("package", full) | told_to_test(kind, full["ros"])
    template.render({**full, **answers, "name": f"{name}_{kind}", "kind": kind}, stage)


def _loaded(model: Path, stage: Path, file: Path) -> Robot:
    try:
        return load(model, package_path=[stage])
    except DescriptionError:
        load(file)  # says the same of the file that there will be afterwards
        raise


def _named(package: Path, name: str, robot: Robot) -> None:
    """Let RViz stand on the root of the robot, and the tests know its name."""
    root = robot.roots()[0].name
    for path in package.glob("rviz/*.rviz"):
        text = path.read_text(encoding="utf-8")
        path.write_text(re.sub(r"((?:Fixed|Target) Frame: )base_link", rf"\g<1>{root}", text), encoding="utf-8")
    test = package / "test/test_description.py"
    text = test.read_text(encoding="utf-8")
    test.write_text(text.replace(f'== "{name}"', f"== {json.dumps(robot.name)}"), encoding="utf-8")


def _drawn(robot: Robot, package: Path, name: str) -> str:
    """Draw the robot for its README; return ``no`` where there is nothing but meshes."""
    picture = drawing_of(robot)
    if picture is None:
        return "no"
    (package / "docs").mkdir()
    (package / f"docs/{name}.svg").write_text(picture, encoding="utf-8")
    return "yes"


def _read(path: Path) -> bytes:
    try:
        return path.read_bytes()
    except OSError as error:
        raise ResourceError(f"{path}: {error.strerror}") from error
