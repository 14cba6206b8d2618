"""Creation of packages for a URDF file: description with its meshes, Gazebo, bringup, and repository files."""

import json
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from urdfkit.atomic import clean_up, move_into_place, staging
from urdfkit.description import load
from urdfkit.description.urdf.robot import Robot
from urdfkit.errors import DescriptionError, ResourceError
from urdfkit.file_replacement import read_bytes
from urdfkit.resources import templates_dir
from urdfkit.scaffold.templates.computed_answers import computed
from urdfkit.scaffold.templates.placeholders import fill
from urdfkit.scaffold.templates.template_parser import load_template
from urdfkit.scaffold.update.rendering import created, is_fresh
from urdfkit.scaffold.wrap.mesh_assets import URI, Meshes
from urdfkit.scaffold.wrap.readme_picture import drawing_of
from urdfkit.scaffold.wrap.renaming import in_utf8, renamed, renaming_note
from urdfkit.scaffold.wrap.repository_files import placeholders_of_tests, render_repository_files

KINDS = ("description", "gazebo", "bringup")


@dataclass(frozen=True, slots=True)
class Wrapped:
    """Result of creating packages for a URDF file.

    Attributes:
        folders: the folders of the packages.
        files: number of files of each package.
        meshes: number of copied meshes and textures.
        notes: notes to print, including those of the fixes.
        others: names of files and folders written outside the packages.
    """

    folders: tuple[Path, ...]
    files: tuple[int, ...]
    meshes: int
    notes: Sequence[str]
    others: tuple[str, ...] = ()


def wrap(
    file: Path,
    name: str,
    folder: Path,
    answers: Mapping[str, str],
    *,
    mesh_folders: Sequence[Path] = (),
    fix: Callable[[Path], Sequence[str]] = lambda _: (),
    repository: bool | None = None,
) -> Wrapped:
    """Write the packages of a robot from its URDF file, which is not changed.

    Args:
        file: the URDF file.
        name: name of the robot, with which the packages' names begin.
        folder: the output folder; created if it does not exist.
        answers: answers of the package template: ros (``none``: only the description package), maintainer, email and
            license, and the placeholders year and into.
        mesh_folders: folders that are searched for meshes first.
        fix: called with the folder of the packages before they are moved into place; may change files, and returns
            notes to print.
        repository: whether to write CI and other repository files; None: if the folder is new, empty or a fresh
            clone. Existing files are kept.

    Raises:
        ResourceError: a mesh is missing, a package exists, or a file cannot be read or written.
        DescriptionError: the file is not a valid robot.
    """
    clean_up(folder)
    kinds = KINDS if answers["ros"] != "none" else KINDS[:1]
    folder_names = [f"{name}_{kind}" for kind in kinds]
    for target in (folder / each for each in folder_names):
        if target.exists() or target.is_symlink():
            raise ResourceError(f"{target} already exists; nothing was overwritten")
    meshes = Meshes(file, mesh_folders)
    text, new = renamed(in_utf8(read_bytes(file)).decode("utf-8", "surrogateescape"), name)
    content = rewritten(
        text.encode("utf-8", "surrogateescape"), meshes, f"{name}_description" if len(kinds) > 1 else ""
    )
    _check(meshes, file, text)
    repository = is_fresh(folder) if repository is None else repository
    existing = {path.name for path in folder.iterdir()} if folder.is_dir() else set()
    with created(folder), staging(folder) as staged:
        model = staged / f"{name}_description/urdf/{name}.urdf.xacro"
        placeholders = {"model": model.name, "folders": " meshes" if meshes.copies else "", "root": "base_link"}
        for kind in kinds:
            _render(staged, kind, name, {**answers, **placeholders})
        model.parent.mkdir(parents=True, exist_ok=True)
        model.write_bytes(content)
        meshes.copy(staged / f"{name}_description")
        skipped = (f"not copied: {path}: {why}" for path, why in meshes.left.items())
        notes = [*renaming_note(new), *skipped, *fix(staged)]
        robot = _loaded(model, staged, file)
        picture = _drawn(robot, staged / f"{name}_description", name)
        origin = f"imported from `{file.name}`"
        values = {**answers, "picture": picture}
        render_repository_files(staged, name, origin, values, repository=repository, without=existing)
        _named(staged / f"{name}_description", name, robot)
        counts = tuple(sum(path.is_file() for path in (staged / each).rglob("*")) for each in folder_names)
        others = tuple(sorted({path.name for path in staged.iterdir()} - set(folder_names)))
        move_into_place(staged, folder)
    return Wrapped(tuple(folder / each for each in folder_names), counts, len(meshes.copies), notes, others)


def rewritten(content: bytes, meshes: Meshes, package: str) -> bytes:
    """Return a URDF that refers to the meshes of the new package; all other bytes are unchanged.

    Args:
        content: the bytes of the URDF.
        meshes: the meshes of the description.
        package: name of the new package; empty: URIs are relative to the file.
    """
    text = content.decode("utf-8", "surrogateescape")
    text = URI.sub(lambda match: f"{match[1]}{match[2]}{meshes.uri(match[3], package)}{match[2]}", text)
    return text.encode("utf-8", "surrogateescape")


def _check(meshes: Meshes, file: Path, text: str) -> None:
    """Report the line of a mesh that is missing or must not be copied."""
    for uri, why in meshes.refused.items():
        line = text.count("\n", 0, max(text.find(uri), 0)) + 1
        raise ResourceError(f"{file}:{line}: the mesh `{uri}` {why}; nothing was written")
    if meshes.missing:
        more = f" and {len(meshes.missing) - 1} more" if len(meshes.missing) > 1 else ""
        raise ResourceError(
            f"{file}: no file for `{meshes.missing[0]}`{more}; nothing was written; add its folder with --meshes DIR"
        )


def _render(staged: Path, kind: str, name: str, answers: Mapping[str, str]) -> None:
    template = load_template(templates_dir() / "package")
    if answers["ros"] == "none":
        readme = template.folder / "readme/no-ros/README.md"
        (staged / f"{name}_{kind}").mkdir()
        text = fill(readme.read_text(encoding="utf-8"), {"name": f"{name}_{kind}", "robot": name}, where=str(readme))
        (staged / f"{name}_{kind}/README.md").write_text(text, encoding="utf-8")
        return
    names = {question.name for question in template.questions}
    user_answers = {key: value for key, value in answers.items() if key in names}
    full = template.answers({**user_answers, "name": f"{name}_{kind}", "kind": kind})
    full |= computed("package", full) | placeholders_of_tests(kind, full["ros"])
    template.render({**full, **answers, "name": f"{name}_{kind}", "kind": kind}, staged)


def _loaded(model: Path, staged: Path, file: Path) -> Robot:
    try:
        return load(model, package_path=[staged])
    except DescriptionError:
        load(file)  # reports the same error for the file of the user
        raise


def _named(package: Path, name: str, robot: Robot) -> None:
    """Use the root of the robot as RViz's fixed frame, and its name in the test."""
    root = robot.roots()[0].name
    for path in package.glob("rviz/*.rviz"):
        text = path.read_text(encoding="utf-8")
        path.write_text(re.sub(r"((?:Fixed|Target) Frame: )base_link", rf"\g<1>{root}", text), encoding="utf-8")
    test = package / "test/test_description.py"
    text = test.read_text(encoding="utf-8")
    test.write_text(text.replace(f'== "{name}"', f"== {json.dumps(robot.name)}"), encoding="utf-8")


def _drawn(robot: Robot, package: Path, name: str) -> str:
    """Write the picture for the README; return ``no`` if the robot consists of meshes only."""
    picture = drawing_of(robot)
    if picture is None:
        return "no"
    (package / "docs").mkdir()
    (package / f"docs/{name}.svg").write_text(picture, encoding="utf-8")
    return "yes"
