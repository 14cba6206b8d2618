"""Entry files: models, the models that include a fragment, and macro libraries that no file includes."""

import os
import re
from collections.abc import Iterable
from pathlib import Path

from urdfkit.description.packages.related_files import (
    BUILD,
    LAUNCH,
    SRDF,
    YAML,
    dependencies_in,
    manifest,
    neighbours,
    package_of,
)
from urdfkit.errors import ResourceError
from urdfkit.lint.project.description_files import MAX_FILES, SUFFIXES, text_of, walk, written_text
from urdfkit.lint.project.inclusion import INCLUDE, above, included_files, includers, matches
from urdfkit.lint.project.robot_text import (
    NAMED,
    ROOT,
    begins_with_robot,
    is_broken,
    is_fragment,
    is_library_text,
    is_robot,
    is_well_formed,
    may_be_library,
)
from urdfkit.lint.project.unrelated_packages import unrelated_packages
from urdfkit.record import record

_TO_MERGE = (".urdf.new", ".xacro.new")
"""Suffixes of merge candidates that `urdfkit new --update` writes next to an edited robot."""


@record(order=True)
class Entry:
    """One file to expand and lint.

    Attributes:
        path: the file.
        only: report findings in these files, and in files below these folders, only; in all files if empty.
        is_library: the file only defines macros, or it is a fragment whose include is commented out; including files
            may define the names it lacks.
    """

    path: Path
    only: tuple[Path, ...] = ()
    is_library: bool = False

    @property
    def has_robot(self) -> bool:
        """Whether the file describes a robot; the package.xml of a package without a robot stands for its files."""
        return self.path.name != "package.xml"


def find_entries(paths: Iterable[str | Path]) -> list[Entry]:
    """Return the entry files for the paths a user named.

    Args:
        paths: files, package folders, workspaces, or names of bundled robots.

    Raises:
        ResourceError: a path does not exist or has no robot description.
    """
    found: dict[Entry, None] = {}
    for path in paths:
        named = Path(path)
        if not named.exists() or not str(path):
            found.update(dict.fromkeys(_of_name(str(path))))
        elif named.is_file():
            found.update(dict.fromkeys(_of_file(named)))
        elif named.is_dir():
            found.update(dict.fromkeys(_of_folder(named)))
        else:
            raise ResourceError(f"{path} is neither a file nor a folder")
    return list(found)


def find_each(paths: Iterable[str | Path]) -> tuple[list[Entry], tuple[str, ...]]:
    """Return the entry files for the paths a user named, and one line with the reason for each path without any.

    Raises:
        ResourceError: the only path has no entry file.
    """
    paths = list(paths)
    found: dict[Entry, None] = {}
    refused: dict[str, None] = {}
    for path in paths:
        try:
            found.update(dict.fromkeys(find_entries([path])))
        except ResourceError as error:
            if len(paths) == 1:
                raise
            refused[str(error)] = None
    return list(found), tuple(refused)


def _of_name(name: str) -> list[Entry]:
    from urdfkit.resources import find_model, robot_names, robots_dir

    if name in robot_names() and (robots_dir() / name).is_dir():
        return _of_folder(robots_dir() / name)
    # A variant of a bundled robot; else the error names the nearest match.
    return [Entry(find_model([name]).path)]


def _of_folder(folder: Path) -> list[Entry]:
    found = _robots_in(folder)
    if found:
        robots = (entry.path for entry in found if not entry.is_library)
        return [*found, *(Entry(path / "package.xml", (path,)) for path in unrelated_packages(folder, robots))]
    if (package := package_of(folder / "package.xml")) is not None and _has_related_files(folder):
        return _robots_of(package / "package.xml", folder)
    manifests = sorted((*folder.glob("*/package.xml"), *folder.glob("*/*/package.xml")))
    found = [entry for file in manifests for entry in _robots_of(file, file.parent)]
    if not found:
        raise ResourceError(f"no robot description (a .urdf or .xacro file with a <robot> element) in {folder}")
    return found


def _has_related_files(folder: Path) -> bool:
    """Return whether a folder is a package, or has launch, YAML or SRDF files."""
    endings = (*LAUNCH, *YAML, *SRDF)
    return (folder / "package.xml").is_file() or any(file.name.endswith(endings) for file in folder.rglob("*"))


def _robots_in(folder: Path) -> list[Entry]:
    texts = {path: text_of(path) for path in walk(folder)}
    robots = {path: text for path, text in texts.items() if is_robot(text) or is_broken(text)}
    included = included_files(robots)
    alone = [path for path in robots if path not in included]
    if candidates := _to_merge(alone):
        alone = [path for path in alone if not any(matches(text, path) for text in candidates.values())] or alone
    alone = _without_misnamed(alone, texts)
    unused = {path for path in alone if is_fragment(robots[path])}
    unused &= included_files({path: written_text(path) for path in robots}) if unused else unused
    found = [
        Entry(path, (), path in unused or (is_robot(text := robots[path]) and is_library_text(text))) for path in alone
    ]
    return [*found, *(Entry(path, (), is_library=True) for path in _unreached(included, robots))]


def _without_misnamed(paths: list[Path], texts: dict[Path, str]) -> list[Path]:
    """Leave out fragments that a misspelt include means, or that a missing file may include.

    The include has a finding, and they depend on its robot.
    """
    from difflib import get_close_matches

    roots = {path: re.search(ROOT, texts[path]) for path in paths}
    unnamed = [path for path, root in roots.items() if root is not None and not re.search(NAMED, root[2] or "")]
    if not unnamed or len(unnamed) == len(paths):
        return paths
    includes = {double or single for text in texts.values() for double, single in re.findall(INCLUDE, text)}
    names = {path.name for path in texts}
    missing = {each for each in includes if each.endswith(SUFFIXES) and each.rpartition("/")[2] not in names}
    folders = {folder.name for path in texts for folder in path.absolute().parents}
    if any(_is_below(include, folders) for include in missing):
        return [path for path in paths if path not in unnamed or is_library_text(texts[path])]
    written = {include.rpartition("/")[2] for include in missing}
    return [path for path in paths if path not in unnamed or not get_close_matches(path.name, written, 1, 0.85)]


def _is_below(include: str, folders: set[str]) -> bool:
    """Return whether an include names a file of one of several packages; a relative path does."""
    package = re.match(r"\$\(find(?:-pkg-share)?\s+([\w-]+)\)/[^$]*$", include)
    return package[1] in folders if package is not None else "$" not in include and not include.startswith("/")


def _unreached(included: set[Path], robots: dict[Path, str]) -> list[Path]:
    """Return malformed files that other malformed files include; the expansion may not reach them."""
    broken = {path for path, text in robots.items() if not is_well_formed(text)} if included else set()
    if len(broken) < 2:
        return []
    return [path for path in robots if path in included & broken and (above(path, robots) - {path}) & broken]


def _to_merge(paths: Iterable[Path]) -> dict[Path, str]:
    """Return the merge candidates in the folders of the files and their parent folders, with their texts."""
    folders = dict.fromkeys(folder for path in paths for folder in (path.parent, path.parent.parent))
    candidates = (file for folder in folders for ending in _TO_MERGE for file in sorted(folder.glob(f"*{ending}*")))
    return {file: text for file in candidates if file.is_file() and is_robot(text := text_of(file))}


def _of_file(path: Path) -> list[Entry]:
    """Return the file itself; for a fragment, the models that include it."""
    if path.name.endswith((*LAUNCH, *YAML, *SRDF)) or path.name in BUILD:
        own = [Entry(path)] if path.suffix == ".xacro" else []
        return [*own, *_related_robots(path)]
    text = text_of(path)
    if begins_with_robot(text) and not may_be_library(text):
        return [Entry(path)]
    root = re.search(ROOT, text)
    has_robot = root is not None and root[1] is not None
    is_named = root is not None and has_robot and re.search(NAMED, root[2]) is not None
    if not has_robot or (is_named and not is_library_text(text)):
        return [Entry(path)]
    package = next((folder for folder in path.absolute().parents if (folder / "package.xml").is_file()), None)
    if package is not None:
        place = path.resolve()
        robots = {other: text for other in walk(package) if is_robot(text := text_of(other))}
    else:
        place = Path(os.path.abspath(path))  # noqa: PTH100 - keep symbolic links
        robots = _nearby(place.parent)
    candidates = _to_merge([place])
    above = includers(place, robots | candidates)
    if above := [model for model in above if model not in candidates] or above:
        return [Entry(_relative(model), (path,)) for model in above]
    return [Entry(path, (), not is_named and is_library_text(text))]


def _nearby(folder: Path) -> dict[Path, str]:
    """Return the robots and fragments of a folder, its subfolders and its parent, with their texts."""
    files = (file for place in ("", "*/", "../") for end in SUFFIXES for file in sorted(folder.glob(f"{place}*{end}")))
    near = dict.fromkeys(Path(os.path.normpath(file)) for file in files if file.is_file())
    return {file: text for file in list(near)[:MAX_FILES] if is_robot(text := text_of(file))}


def _related_robots(path: Path) -> list[Entry]:
    """Return the robots that a launch, YAML, SRDF or build file belongs to.

    These are the robots of its package, else of neighbouring dependencies, else its package without a robot; without a
    package, those in its folder.
    """
    package = package_of(path)
    if package is None and path.name.endswith(SRDF):
        robots = [entry for entry in _robots_in(path.absolute().parent) if not entry.path.name.endswith(SRDF)]
        if found := [entry for entry in robots if not entry.is_library]:
            return [Entry(_relative(entry.path), (path,)) for entry in found]
        raise ResourceError(f"{path}: the folder contains no robot description and is not in a package")
    if package is None:
        raise ResourceError(f"{path}: not in a package, so no robot belongs to it")
    return _robots_of(package / "package.xml", path)


def _robots_of(manifest_file: Path, only: Path) -> list[Entry]:
    """Return the robots of a package, else of a neighbouring dependency, else the package without a robot.

    Args:
        manifest_file: package.xml of the package.
        only: the file or folder to report findings in.
    """
    package = manifest_file.absolute().parent
    needed = dependencies_in(manifest(package))
    folders = [package, *(folder for name, folder in neighbours(package).items() if name in needed)]
    for folder in folders:
        robots = [entry for entry in _robots_in(folder) if not entry.path.name.endswith(SRDF)]
        if found := [entry for entry in robots if not entry.is_library]:
            return [Entry(_relative(entry.path), (only,)) for entry in found]
    return [Entry(_relative(manifest_file), (only,))]


def _relative(path: Path) -> Path:
    here = Path.cwd()
    return path.relative_to(here) if path.is_relative_to(here) else path
