"""Files related to a description: launch files, YAML and SRDF of its package and of the packages that depend on it."""

import os
import re
from collections.abc import Iterator
from pathlib import Path

from urdfkit.description.packages.existence import is_file
from urdfkit.description.packages.kept_files import kept
from urdfkit.errors import similar

LAUNCH = (".launch", ".launch.xml", ".launch.py", ".launch.yaml", "_launch.xml", "_launch.py", "_launch.yaml")
"""Suffixes of launch files."""

YAML = (".yaml", ".yml")
SRDF = (".srdf", ".srdf.xacro")
BUILD = ("package.xml", "CMakeLists.txt", "setup.py", "setup.cfg")
"""Files in the folder of a package that describe its build."""

CODE = (".cpp", ".cc", ".cxx", ".hpp", ".h", ".py", ".cfg", ".gitignore")
"""Suffixes of files that rules search for plugins, executables and modules."""

_SKIPPED = frozenset(("build", "install", "devel", "log", "node_modules", "__pycache__", "test", "tests"))
_MAX_DEPTH = 4
_MAX_FILES = 200
"""Maximum number of files read per package."""

_MAX_NEIGHBOURS = 100
_MAX_BYTES = 100_000
_MAX_LISTED = 20_000
_MAX_SRDF_BYTES = 1_000_000
"""A robot of 100 links can have thousands of disabled pairs of links."""


def package_of(path: Path) -> Path | None:
    """Return the enclosing folder of a file that has a package.xml."""
    return next((folder for folder in path.absolute().parents if is_file(folder / "package.xml")), None)


_UTF_16 = (b"\xff\xfe", b"\xfe\xff")
"""First bytes of a text in UTF-16."""


@kept
def manifest(package: Path) -> str:
    """Return the package.xml of a package, without comments; empty if it cannot be read."""
    file = package / "package.xml"
    try:
        content = file.read_bytes() if is_file(file) else b""
        return uncommented(content.decode("utf-16" if content[:2] in _UTF_16 else "utf-8", "replace"))
    except OSError:
        return ""


def uncommented(text: str) -> str:
    """Return the text of an XML file without comments."""
    return re.sub(r"(?s)<!--.*?(?:-->|\Z)", "", text)


def name_in(text: str, fallback: str = "") -> str:
    """Return the name in the text of a package.xml."""
    written = re.search(r"<name>\s*([\w.-]+)\s*</name>", text)
    return written[1] if written else fallback


def dependencies_in(text: str) -> set[str]:
    """Return the packages that the text of a package.xml depends on in any way; misspelt elements are accepted."""
    return set(re.findall(r"<\w*depen\w*[^>]*>\s*([\w.-]+)\s*(?=<)", text))


def neighbours(package: Path) -> dict[str, Path]:
    """Return the packages in the same folder, itself included, by name."""
    return dict(_neighbours(package))


@kept
def _neighbours(package: Path) -> dict[str, Path]:
    found: dict[str, Path] = {}
    try:
        folders = sorted(child.path for child in os.scandir(package.parent) if child.is_dir(follow_symlinks=False))
    except OSError:
        folders = []
    for folder in (str(package), *folders[:_MAX_NEIGHBOURS]):
        if os.path.isfile(f"{folder}/package.xml"):  # noqa: PTH113
            found.setdefault(name_in(manifest(Path(folder)), Path(folder).name), Path(folder))
    return found


def state_of(folder: str, endings: tuple[str, ...]) -> str:
    """Return a checksum of the names of the files in a folder, and of size and time of those with one of the endings.

    Without endings, of the manifests of the packages in the folder.
    """
    from binascii import crc32

    found: list[str] = []
    for place, folders, files in os.walk(folder):
        folders[:] = sorted(name for name in folders if name[0] != "." and name != "__pycache__")
        if not endings:
            found += filter(None, (_version(f"{place}/{name}/package.xml") for name in folders[:_MAX_NEIGHBOURS]))
            break
        paths = (f"{place}/{name}" for name in sorted(files))
        found += (_version(path) if path.endswith(endings) else path for path in paths)
        if len(found) > _MAX_LISTED:
            break
    return f"{crc32(chr(0).join(found).encode('utf-8', 'surrogateescape')):x}"


def _version(file: str) -> str:
    """Return path, size and time of a file; empty if it does not exist."""
    try:
        status = os.stat(file)  # noqa: PTH116
    except OSError:
        return ""
    return f"{file} {status.st_size} {status.st_mtime_ns}"


def around(package: Path) -> list[Path]:
    """Return the launch files, YAML, SRDF and build files of a package, and of neighbours that depend on it.

    Of a folder without a package.xml, only the SRDF files in it and in the folder ``srdf`` next to it.
    """
    if not (package / "package.xml").is_file():
        folders = (package, package.parent / "srdf")
        found = (file for folder in folders for end in SRDF for file in folder.glob(f"*{end}") if file.is_file())
        return sorted(found)[:_MAX_FILES]
    near = neighbours(package)
    own = packages_around(package, near, {other: dependencies_in(manifest(folder)) for other, folder in near.items()})
    files = [file for folder in own for file in list(_files(folder, 0))[:_MAX_FILES]]
    return [*files, *(file for folder in own for name in BUILD if (file := folder / name).is_file())]


def packages_around(package: Path, near: dict[str, Path], needed: dict[str, set[str]]) -> list[Path]:
    """Return a package and its neighbours that depend on it, or that belong to the same robot.

    Args:
        package: the package.
        near: its `neighbours`.
        needed: name of each neighbour → the packages that it depends on.
    """
    name = name_in(manifest(package), package.name)
    users = {name, *(other for other, names in needed.items() if name in names or _misspelt(name, names - {*near}))}
    # Packages of the same robot that use these, such as bringup; their dependency on the description may be missing.
    stem = f"{name.partition('_')[0]}_"
    users |= {other for other, names in needed.items() if other.startswith(stem) and names & (users - {name})}
    own = name.removesuffix("description")
    if own.endswith("_"):  # amr_navigation and amr_description, if it uses the description of no other robot
        others = {other for other, names in needed.items() if any(each.endswith("_description") for each in names)}
        named = {other for other, folder in near.items() if other.startswith(own) and folder.name.startswith(own)}
        users |= named - others
    # Packages that only these packages use, such as controllers, belong to the same robot.
    folders = {other: {other, folder.name} for other, folder in near.items()}
    used_by = {part: {other for other, names in needed.items() if names & folders[part]} - {part} for part in near}
    parts = {part for part, others in used_by.items() if others and others <= users and others != {name}}
    parts -= needed.get(name, set())
    return [folder for other, folder in near.items() if folder == package or other in users | parts]


def _misspelt(name: str, others: set[str]) -> bool:
    """Return whether one of several unknown names differs from a name by one or two letters."""
    alike = [other for other in others if abs(len(other) - len(name)) <= 1 and other[:1] == name[:1] and len(name) > 8]
    digits = [letter for letter in name if letter.isdigit()]
    alike = [other for other in alike if [letter for letter in other if letter.isdigit()] == digits]
    return bool(alike) and bool(similar(name, alike, cutoff=0.93))


def _files(folder: Path, depth: int) -> Iterator[Path]:
    try:
        with os.scandir(folder) as scan:
            children = sorted(scan, key=lambda child: child.name)
    except OSError:
        return
    for child in children:
        if child.is_dir(follow_symlinks=False):
            inner = child.name in _SKIPPED or child.name.startswith(".")
            if depth < _MAX_DEPTH and not inner and not os.path.isfile(f"{child.path}/package.xml"):  # noqa: PTH113
                yield from _files(folder / child.name, depth + 1)
        elif child.name.endswith((*LAUNCH, *YAML, *SRDF)) and child.is_file():
            most = _MAX_SRDF_BYTES if child.name.endswith(SRDF) else _MAX_BYTES
            if child.stat().st_size <= most:
                yield folder / child.name
