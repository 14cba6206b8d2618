"""Cache of findings per entry file, valid as long as no input of the lint run has changed.

Each cache entry is one file. The hash in its name covers the description, the lint options, and the versions of urdfkit
and its dependencies. The file stores the states of all files read (a digest, or size and times of a large file), the
answers to all package and mesh queries, and the findings. States and answers are verified before the findings are used.
A damaged entry counts as missing. Entries are replaced atomically, so concurrent writers do not conflict.
"""

from __future__ import annotations

import marshal
import os
import sys
import time
from functools import cached_property
from pathlib import Path

from urdfkit.defect_message import Suggestion
from urdfkit.description.xml.source import content_of
from urdfkit.lint.finding import Edit, EntryResult, Finding, Fix

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable
    from typing import Any

    from urdfkit.description.packages.resolver import Packages
    from urdfkit.description.xacro.expanded import Expanded
    from urdfkit.lint.project.entry_files import Entry
    from urdfkit.lint.project.options import Options

_VARIABLES = (
    *("ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH", "CMAKE_PREFIX_PATH", "COLCON_PREFIX_PATH", "GZ_SIM_RESOURCE_PATH"),
    *("IGN_GAZEBO_RESOURCE_PATH", "GAZEBO_MODEL_PATH", "SDF_PATH", "ROS_DISTRO"),
)
_MANIFESTS = ("package.xml", "CMakeLists.txt", "setup.py")
_UNTRACKED = ".gltf"
"""Ending of meshes whose other files the cache does not track; robots with them are linted every time."""

_STATUS = "="
"""First character of the state of a file that is not a digest."""
_LARGE = 32 * 1024
"""Size of files, such as meshes, that are not read again to see whether they have changed [byte]."""
_JUST_CHANGED = 2_000_000_000
"""[ns]"""

_MAX_FILES = 64
"""Maximum number of files in each of the 256 cache folders; the oldest files are deleted first."""


def folder() -> Path:
    """Return the cache folder: ``URDFKIT_CACHE_DIR``, else the user's cache folder of the operating system."""
    named = os.environ.get("URDFKIT_CACHE_DIR")
    if named:
        from urdfkit.missing_files import expanded_path

        return expanded_path(named) / "lint"
    home = Path.home()
    if sys.platform == "darwin":
        return home / "Library" / "Caches" / "urdfkit" / "lint"
    place = os.environ.get("LOCALAPPDATA" if sys.platform == "win32" else "XDG_CACHE_HOME")
    return (Path(place) if place and Path(place).is_absolute() else home / ".cache") / "urdfkit" / "lint"


def cache_for(options: Options) -> Cache | None:
    """Return the cache of a lint run; None if inputs are unknown to it: unsaved texts, rules and plugins of others."""
    from urdfkit.entry_points import PLUGIN_GROUPS, entry_points

    return None if options.texts or entry_points("urdfkit.rules", *PLUGIN_GROUPS) else Cache(options)


def packages_of(options: Options) -> Packages:
    """Return the package resolver of a lint run; results that need no search of packages do not load it."""
    from urdfkit.description.packages.resolver import Packages

    confinement = options.confinement
    return Packages(options.package_path, permits=None if confinement is None else confinement.permits)


class Cache:
    """Findings of earlier lint runs.

    Args:
        options: options of this lint run.
    """

    def __init__(self, options: Options) -> None:
        self.options = options
        self._digests: dict[str, str] = {}

    @cached_property
    def packages(self) -> Packages:
        """The resolver that repeats the stored package queries, relative to each entry file."""
        return packages_of(self.options)

    def get(self, entry: Entry) -> EntryResult | None:
        """Return the cached result; None if none is stored or an input has changed."""
        path = self._path(entry)
        try:
            content = path.read_bytes()
            if content[:32] != _digest(content[32:]).encode():
                return None
            kept = marshal.loads(
                content[32:]
            )  # written by urdfkit, complete, and by this Python version, as marshal requires
            if not self._holds(kept, entry):
                return None
            parts = {name: kept[name] for name in ("files", "note", "used", "unused", "without_robot", "target")}
            found = EntryResult(tuple(map(_finding, kept["findings"])), **parts)
        except (OSError, ValueError, EOFError, KeyError, TypeError, RuntimeError):
            return None
        return found

    def _holds(self, kept: Any, entry: Entry) -> bool:
        for path, state in kept["states"].items():
            if (_status_of(path) if state[:1] == _STATUS else self._digest_of(path)) != state:
                return False
        if not kept["answers"]:
            return True
        packages = self.packages.near_file(entry.path)
        return all(packages.answer(tuple(question)) == answer for question, answer in kept["answers"])

    def put(self, entry: Entry, found: EntryResult, *expanded: Expanded) -> None:
        """Store a result. Do nothing if the cache folder is not writable or not all inputs are known.

        Args:
            entry: the entry file.
            found: the result to store.
            expanded: the expansions that the result belongs to.
        """
        packages = expanded[0].packages
        answers_by_question = {
            question: answer for each in expanded for question, answer in each.packages.answers.items()
        }
        if any(_UNTRACKED in source.text for each in expanded for source in each.sources.values()):
            return
        read = dict.fromkeys((*found.files.values(), *(str(file) for each in expanded for file in each.files)))
        package = next((f for f in entry.path.absolute().parents if (f / "package.xml").is_file()), None)
        for name in _MANIFESTS if package is not None else ():
            read[str(package / name)] = None  # type: ignore[operator]
        for (kind, *_), answer in answers_by_question.items():
            if kind == "resolve" and not answer.startswith("!"):
                read[answer] = None
        states = {path: self._state_of(path) for path in read}
        answers = [
            [list(question), answer]
            for question, answer in answers_by_question.items()
            if not (states.get(answer) and packages.is_as_written(question, answer))
        ]
        self._store(
            self._path(entry),
            {
                "states": states,
                "answers": answers,
                "findings": [_row(finding) for finding in found.findings],
                "files": dict(found.files),
                "note": found.note,
                "used": found.used,
                "unused": found.unused,
                "without_robot": found.without_robot,
                "target": found.target,
            },
        )

    def _store(self, path: Path, kept: dict[str, Any]) -> None:
        temporary = path.with_suffix(f".{os.getpid()}.tmp")  # importing tempfile takes as long as linting a file
        try:
            content = marshal.dumps(kept)
            path.parent.mkdir(parents=True, exist_ok=True)
            temporary.write_bytes(_digest(content).encode() + content)
            temporary.replace(path)
            others = sorted((file.stat().st_mtime, file) for file in path.parent.iterdir())
            for _, old in others[: max(len(others) - _MAX_FILES, 0)]:
                old.unlink(missing_ok=True)
        except (OSError, RuntimeError, ValueError):
            return

    def _digest_of(self, path: str) -> str:
        if path not in self._digests:
            try:
                # A mesh can be a pipe or device, which might never end.
                self._digests[path] = _digest(content_of(Path(path))) if os.path.isfile(path) else ""  # noqa: PTH113
            except OSError:
                self._digests[path] = ""
        return self._digests[path]

    def _state_of(self, path: str) -> str:
        """Return what changes when a file does: of a large file its size and times, otherwise a digest."""
        status = _status_of(path)
        return status if status else self._digest_of(path)

    def _path(self, entry: Entry) -> Path:
        parts = (str(entry.path.absolute()), *map(str, entry.only), str(entry.is_library), str(Path.cwd()), *self._way)
        name = _digest("\0".join(parts).encode("utf-8", "surrogateescape"))
        return folder() / name[:2] / f"{name[2:]}.found"

    @cached_property
    def _way(self) -> tuple[str, ...]:
        """The lint options and the versions of the software."""
        options = self.options
        return (
            *(str(sorted(words)) for words in (options.select, options.ignore)),
            str(options.target),
            str(options.guess_target),
            str(sorted(options.arguments.items())),
            str(options.launch_arguments),
            *map(str, options.package_path),
            *(os.environ.get(name, "") for name in _VARIABLES),
            sys.version,
            *_versions(),
        )


def _versions() -> Iterable[str]:
    """Yield version strings and modification times of urdfkit, xacro and the mesh libraries."""
    from urdfkit import __version__

    yield __version__
    here = Path(__file__).parents[1]
    if (here.parents[1] / "pyproject.toml").is_file():  # a checkout, whose files change without the version
        for room in (here, here.parent / "description"):
            yield from _times_below(str(room))
    for folder in sys.path:
        for package in ("xacro", "trimesh", "numpy"):
            try:
                yield f"{package}{os.stat(f'{folder}/{package}/__init__.py').st_mtime_ns}"  # noqa: PTH116
            except OSError:
                continue


def _times_below(folder: str) -> Iterable[str]:
    """Yield name and modification time of each file below a folder; os.walk takes twice as long."""
    with os.scandir(folder) as children:
        for child in children:
            if not child.is_dir(follow_symlinks=False):
                yield f"{child.name}{child.stat().st_mtime_ns}"
            elif child.name != "__pycache__":
                yield from _times_below(child.path)


def _status_of(path: str) -> str:
    """Return size, inode and times of a large file; empty for other files, and for files that just changed.

    A file that changes twice within the resolution of the clock of the file system has the same times.
    """
    try:
        status = os.stat(path)  # noqa: PTH116
    except OSError:
        return ""
    newest = max(status.st_mtime_ns, status.st_ctime_ns)
    if status.st_size < _LARGE or time.time_ns() - newest < _JUST_CHANGED:
        return ""
    return f"{_STATUS}{status.st_size} {status.st_ino} {status.st_mtime_ns} {status.st_ctime_ns}"


def _digest(content: bytes) -> str:
    from _blake2 import blake2b  # importing hashlib takes longer than linting a file

    return str(blake2b(content, digest_size=16).hexdigest())


def _row(finding: Finding) -> list[Any]:
    """Return a finding as a list of values that marshal supports."""
    fix = finding.fix
    edits = fix and [[*_values(edit.span), edit.text] for edit in fix.edits]
    chains = [[[call.macro, *_values(call.position)] for call in chain] for chain in finding.chains]
    head = [finding.code, finding.name, finding.severity, finding.message, *_values(finding.span)]
    return [
        *head,
        finding.link,
        finding.joint,
        finding.help,
        fix and [fix.safety, fix.title, edits],
        chains,
        finding.cause,
        finding.variant,
        finding.suggestion and [finding.suggestion.meant, finding.suggestion.written],
        finding.kind,
        finding.names,
        [_row(each) for each in finding.related],
        [_values(each) for each in finding.trail],
    ]


def _values(item: Any) -> tuple[Any, ...]:
    return tuple(item.__dict__[name] for name in type(item).__match_args__)


def _finding(row: list[Any]) -> Finding:
    from urdfkit.description.xml.source import Expansion, Position, Span

    code, name, severity, message = row[:4]
    link, joint, help, fix, chains, cause, variant, suggestion, kind, names, related, trail = row[9:]
    return Finding(
        code,
        name,
        severity,
        message,
        Span(*row[4:9]),
        link,
        joint,
        help,
        fix and Fix(fix[0], fix[1], tuple(Edit(Span(*edit[:5]), edit[5]) for edit in fix[2])),
        tuple(tuple(Expansion(call[0], Position(*call[1:])) for call in chain) for chain in chains),
        cause,
        kind,
        names,
        suggestion=suggestion and Suggestion(*suggestion),
        variant=variant,
        related=tuple(map(_finding, related)),
        trail=tuple(Span(*each) for each in trail),
    )
