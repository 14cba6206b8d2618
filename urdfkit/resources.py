"""Find templates and bundled robots, and resolve a robot argument to a file."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Sequence
from pathlib import Path

from urdfkit.defect_message import Suggestion
from urdfkit.errors import ResourceError, UsageError, did_you_mean
from urdfkit.missing_files import expanded_path, missing_path
from urdfkit.record import record
from urdfkit.robot_files import MODEL_SUFFIXES, children, models_in, robot_name, stem

TYPE_CHECKING = False
if TYPE_CHECKING:
    from urdfkit.robot_descriptions_cache import CachedDescription

_WORLD_SUFFIXES = (".sdf", ".world")
_WORKSPACE_MARKS = (".git", ".catkin_workspace", ".catkin_tools", "src", ".colcon")
_LISTED = 8

_URI = re.compile(r"([a-z][a-z0-9+.-]*)://")
_DESCRIPTION = re.compile(r"[a-z]\w*_description")


@record
class ModelArgument:
    """Resolved robot argument of a command, with the xacro arguments after it.

    Attributes:
        path: the file to load, absolute.
        arguments: xacro arguments, from ``key:=value`` words.
        package_path: folders to search for packages first.
        name: name of the robot before it is loaded: the one in the file if it is literal, else the file's stem.
        macro: macro of the file to instantiate; None for the robot that the file describes.
    """

    path: Path
    arguments: dict[str, str]
    package_path: tuple[Path, ...]
    name: str
    macro: str | None = None


def robots_dir() -> Path:
    """Return the folder of the bundled robots.

    Raises:
        ResourceError: the installation is incomplete.
    """
    return _shipped("robots")


def templates_dir() -> Path:
    """Return the folder of the templates of ``urdfkit new``.

    Raises:
        ResourceError: the installation is incomplete.
    """
    return _shipped("templates")


def robot_names() -> list[str]:
    """Return the names of the bundled robots and of their variants, sorted.

    Raises:
        ResourceError: the installation is incomplete.
    """
    return sorted(_shipped_robots())


def _shipped_robots() -> dict[str, Path]:
    """Return name → folder of every robot, and name → file of every further model in such a folder."""
    home = robots_dir()
    folders = {path.name: path for path in home.iterdir() if path.is_dir() and not path.name.startswith(".")}
    variants = {stem(path): path for path in home.glob("*/*_description/urdf/*.urdf.xacro")}
    return variants | folders


def _shipped_model(name: str) -> Path:
    """Return the model of a bundled robot; of several in its folder, the one named like the folder."""
    path = _shipped_robots()[name]
    if path.is_file():
        return path
    entries = models_in(path)
    own = [entry for entry in entries if stem(entry) == name]
    return own[0] if own else _the_one(entries, f"robot `{name}`")


def find_model(words: Sequence[str], *, package_path: Iterable[str | Path] = ()) -> ModelArgument:
    """Turn the words of a ROBOT argument into a file.

    Args:
        words: ROBOT (a path to a file or package folder, or the name of a bundled robot), if given, and ``key:=value``
            xacro arguments. Without ROBOT it is the only robot of the package or workspace of the working directory.
        package_path: folders to search for packages.

    Raises:
        UsageError: more than one ROBOT, or an argument without a key.
        ResourceError: no robot is found, or several are.
    """
    models = [word for word in words if ":=" not in word]
    if len(models) > 1:
        key, equals, value = models[-1].partition("=")
        meant = f"{key}:={value}" if equals else None
        hint = Suggestion(meant) or "; xacro arguments are key:=value"
        raise UsageError(f"one ROBOT at a time, not {len(models)}: {' '.join(models)}{hint}")
    arguments: dict[str, str] = {}
    for word in words:
        key, separator, value = word.partition(":=")
        if separator and not key:
            raise UsageError(f"`{word}` has no key: xacro arguments are key:=value")
        if separator:
            arguments[key] = value
    folders = tuple(_existing_folder(folder) for folder in package_path)
    if models and (described := _cached_description(models[0])) is not None:
        own = {**described.arguments, **arguments}
        return ModelArgument(described.path, own, (*folders, *described.packages), models[0])
    path = _find(models[0]) if models else _find_here(Path.cwd())
    return ModelArgument(path, arguments, folders, robot_name(path) or stem(path))


def _cached_description(word: str) -> CachedDescription | None:
    """Return the robot of the package robot_descriptions that a word names; None for other words.

    Raises:
        ResourceError: the package is installed and does not have it.
    """
    if not _DESCRIPTION.fullmatch(word) or Path(word).exists() or word in robot_names():
        return None
    from urdfkit.robot_descriptions_cache import cached_description

    return cached_description(word)


def _shipped(kind: str) -> Path:
    package = Path(__file__).resolve().parent
    for folder in (package.parent / kind, package / "_data" / kind):
        # A checkout has pyproject.toml next to it; a folder of that name in site-packages belongs to another package.
        if folder.is_dir() and (folder.parent.name == "_data" or (package.parent / "pyproject.toml").is_file()):
            return folder
    raise ResourceError(
        f"urdfkit is installed without its {kind}: reinstall it with pip install --force-reinstall urdfkit"
    )


def _existing_folder(folder: str | Path) -> Path:
    path = expanded_path(folder)
    if not path.is_dir():
        raise ResourceError(f"--package-path: {missing_path(folder, 'folder')}")
    return path.resolve()


def _find(word: str) -> Path:
    if reason := no_path(word):
        raise ResourceError(reason)
    path = expanded_path(word)
    if path.is_file():
        if path.suffix.lower() in _WORLD_SUFFIXES:
            raise ResourceError(f"{word} is an SDF file, not a robot description; a world goes after --world")
        return path.resolve()
    if path.is_dir():
        entries = models_in(path)
        if not entries and word in robot_names():
            return _shipped_model(word)
        return _the_one(entries, f"folder {word}")
    if word in robot_names():
        return _shipped_model(word)
    if path.exists():
        raise ResourceError(f"{word} is neither a file nor a folder")
    if _looks_like_a_path(word):
        raise ResourceError(missing_path(word, "file or folder"))
    here = [p.name for p in children(Path.cwd()) if p.is_dir() or p.suffix.lower() in MODEL_SUFFIXES]
    names = robot_names()
    hint = did_you_mean(word, [*names, *here])
    if not hint:
        from urdfkit.robot_descriptions_cache import how_to_get

        hint = how_to_get(word)
    raise ResourceError(f"no robot, file or folder `{word}`{hint or '; bundled robots: ' + ', '.join(names)}")


def no_path(word: str) -> str | None:
    """Return why a word names no file or folder; None if it may name one."""
    if not word:
        return "the name of the robot is empty; pass a file, a package folder or a robot name"
    if (uri := _URI.match(word)) is not None:
        advice = "download it, and name the file" if uri[1].startswith("http") else "name the file by its path"
        return f"{word} is a URI, not a path; {advice}"
    path = expanded_path(word)
    if path.is_symlink() and not path.exists():
        return f"{word} is a symbolic link to {path.readlink()}, which does not exist or leads back to the link"
    return None


def _looks_like_a_path(word: str) -> bool:
    return (
        "/" in word
        or os.sep in word
        or word.startswith((".", "~"))
        or Path(word).suffix.lower() in (*MODEL_SUFFIXES, ".xml")
    )


def _find_here(start: Path) -> Path:
    """Return the one model of the nearest enclosing folder that has any."""
    home = Path.home()
    for folder in (start, *start.parents):
        if folder != start and (folder in (home, folder.parent) or not _is_package_or_workspace(folder)):
            continue
        if entries := models_in(folder):
            return _the_one(entries, "the current folder" if folder == start else str(folder))
    raise ResourceError(
        f"no robot is named, and there is no robot description in or above {start}; "
        f"bundled robots: {', '.join(robot_names())}"
    )


def _is_package_or_workspace(folder: Path) -> bool:
    return any((folder / mark).exists() for mark in ("package.xml", *_WORKSPACE_MARKS))


def _the_one(entries: list[Path], where: str) -> Path:
    if not entries:
        raise ResourceError(f"no robot description (.urdf or .xacro with <robot name=…>) in {where}")
    if len(entries) > 1:
        shown = ", ".join(_shortest(path) for path in entries[:_LISTED])
        more = f" and {len(entries) - _LISTED} more" if len(entries) > _LISTED else ""
        raise ResourceError(f"{len(entries)} robot descriptions in {where}; pass one of them: {shown}{more}")
    return entries[0]


def _shortest(path: Path) -> str:
    relative = os.path.relpath(path)
    return relative if len(relative) < len(str(path)) else str(path)
