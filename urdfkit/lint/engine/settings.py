"""Settings files: ``urdfkit.toml``, or ``[tool.urdfkit]`` in pyproject.toml, nearest above the linted files.

::

    [lint]                                  # in pyproject.toml: [tool.urdfkit.lint]
    target = "ros2"
    select = ["E", "T"]
    ignore = ["J413"]
    exclude = ["third_party/*"]             # below the folder of this file
    package-path = ["../common_ws/src"]
    baseline = "lint-baseline.json"
    arguments = {use_camera = "true"}       # values for $(arg …)
    [lint.per-file-ignores]
    "urdf/generated/*" = ["E008", "I"]
    [format]                                # in pyproject.toml: [tool.urdfkit.format]
    indent = 4                              # spaces for each level; 2 by default
"""

from __future__ import annotations

from pathlib import Path

from urdfkit.description.xml.formatting import INDENT, MAX_INDENT
from urdfkit.errors import UsageError, did_you_mean
from urdfkit.missing_files import expanded_path, missing_path
from urdfkit.record import field, record

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from typing import Any

_KINDS = {"list": "a list", "dict": "a table", "str": "a string", "int": "an integer"}
_MARKS = (".git", ".hg", ".catkin_workspace", ".colcon")


@record
class LintSettings:
    """Settings of one file; all empty if there is no file.

    Attributes:
        file: the settings file.
        target: see ``--target``.
        select: codes to report.
        ignore: codes not to report.
        exclude: patterns of files to skip, relative to the folder of `file`.
        package_path: folders to search for packages.
        baseline: the baseline file.
        arguments: values for ``$(arg …)``.
        per_file: pattern of files → codes not to report in them.
        indent: number of spaces for each level, for `urdfkit format`.
    """

    file: Path | None = None
    target: str | None = None
    select: tuple[str, ...] = ()
    ignore: tuple[str, ...] = ()
    exclude: tuple[str, ...] = ()
    package_path: tuple[Path, ...] = ()
    baseline: Path | None = None
    arguments: Mapping[str, str] = field(default_factory=dict)
    per_file: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    indent: int = INDENT

    def matches(self, path: Path, pattern: str) -> bool:
        """Return whether a pattern of this file matches `path` or a folder above it."""
        from fnmatch import fnmatch

        folder = self.file.parent if self.file is not None else Path.cwd()
        resolved = path.resolve()
        if not resolved.is_relative_to(folder.resolve()):
            return False
        inside = resolved.relative_to(folder.resolve())
        wanted = pattern.rstrip("/")
        return any(fnmatch(part.as_posix(), wanted) for part in (inside, *inside.parents[:-1]))


def find(start: Path) -> LintSettings:
    """Return the settings that apply to `start`.

    Raises:
        UsageError: the file is not valid TOML or has an unknown setting.
    """
    start = start.absolute()
    for folder in (start, *start.parents) if start.is_dir() else start.parents:
        own, project = folder / "urdfkit.toml", folder / "pyproject.toml"
        if own.is_file():
            return read(own)
        if project.is_file() and b"[tool.urdfkit" in project.read_bytes():
            return read(project)
        if any((folder / mark).exists() for mark in _MARKS) or folder == Path.home():
            break
    return LintSettings()


def read(file: Path) -> LintSettings:
    """Return the settings of a file.

    Raises:
        UsageError: the file cannot be read, is not valid TOML, or has an unknown setting.
    """
    import sys

    if sys.version_info >= (3, 11):
        import tomllib
    else:
        import tomli as tomllib  # type: ignore[import-not-found, unused-ignore]

    try:
        table: Any = tomllib.loads(file.read_text("utf-8"))
    except FileNotFoundError as error:
        raise UsageError(missing_path(file)) from error
    except (OSError, UnicodeDecodeError) as error:
        raise UsageError(f"cannot read {file}: {getattr(error, 'strerror', None) or 'it is not UTF-8'}") from error
    except tomllib.TOMLDecodeError as error:
        raise UsageError(f"{file} is not valid TOML: {error}") from error
    if file.name == "pyproject.toml":
        table = table.get("tool", {}).get("urdfkit", {})
    _check(file, "", table, {"lint": dict, "format": dict})
    lint: dict[str, Any] = table.get("lint", {})
    _check(file, "lint.", lint, {key: kind for key, (kind, _) in _KEYS.items()})
    values: dict[str, Any] = {"file": file}
    for key, value in lint.items():
        _, convert = _KEYS[key]
        name = {"per-file-ignores": "per_file"}.get(key, key.replace("-", "_"))
        values[name] = convert(file, f"lint.{key}", value)
    layout: dict[str, Any] = table.get("format", {})
    _check(file, "format.", layout, {"indent": int})
    values["indent"] = layout.get("indent", INDENT)
    if not 1 <= values["indent"] <= MAX_INDENT:
        raise UsageError(f"{file}: `format.indent` is {values['indent']}; use 1 to {MAX_INDENT} spaces")
    settings = LintSettings(**values)
    _check_words(settings)
    return settings


def _check_words(settings: LintSettings) -> None:
    """Reject unknown codes and targets.

    Raises:
        UsageError: a code or target is unknown; the message names the settings file.
    """
    from urdfkit.lint.engine.rule_runner import every_code
    from urdfkit.lint.project.rule_selection import checked
    from urdfkit.lint.project.target_platform import parse_target

    of = f"{settings.file}: `lint."
    checked(f"{of}select`", settings.select, every_code)
    checked(f"{of}ignore`", settings.ignore, every_code)
    for pattern, codes in settings.per_file.items():
        checked(f"{of}per-file-ignores.{pattern}`", codes, every_code)
    if settings.target is not None and settings.target.lower() != "any":
        parse_target(settings.target, f"{of}target`")


def _check(file: Path, prefix: str, table: Any, kinds: Mapping[str, type]) -> None:
    for key, value in table.items():
        if key not in kinds:
            hint = did_you_mean(key, kinds) or f"; the settings are {', '.join(kinds)}"
            raise UsageError(f"{file}: unknown setting `{prefix}{key}`{hint}")
        if not isinstance(value, kinds[key]):
            kind = _KINDS[kinds[key].__name__]
            raise UsageError(f"{file}: `{prefix}{key}` must be {kind}, not {value!r}")


def _text(_: Path, __: str, value: str) -> str:
    return value


def _texts(file: Path, name: str, value: list[Any]) -> tuple[str, ...]:
    for item in value:
        if not isinstance(item, str):
            raise UsageError(f"{file}: `{name}` must be a list of strings, not of {item!r}")
    return tuple(value)


def _path(file: Path, _: str, value: str) -> Path:
    return file.parent / expanded_path(value)


def _folders(file: Path, name: str, value: list[Any]) -> tuple[Path, ...]:
    folders = tuple(file.parent / expanded_path(text) for text in _texts(file, name, value))
    for folder in folders:
        if not folder.is_dir():
            raise UsageError(f"{file}: `{name}`: {missing_path(folder, 'folder')}")
    return folders


def _arguments(file: Path, name: str, value: dict[str, Any]) -> dict[str, str]:
    words = {True: "true", False: "false"}
    for key, item in value.items():
        if not isinstance(item, (str, int, float)):
            raise UsageError(f"{file}: `{name}.{key}` must be a single value, not {item!r}")
    return {key: words[item] if isinstance(item, bool) else str(item) for key, item in value.items()}


def _by_file(file: Path, name: str, value: dict[str, Any]) -> dict[str, tuple[str, ...]]:
    for pattern, codes in value.items():
        if not isinstance(codes, list):
            raise UsageError(f"{file}: `{name}.{pattern}` must be a list of codes, not {codes!r}")
    return {pattern: _texts(file, f"{name}.{pattern}", codes) for pattern, codes in value.items()}


_KEYS: dict[str, tuple[type, Callable[[Path, str, Any], Any]]] = {
    "target": (str, _text),
    "select": (list, _texts),
    "ignore": (list, _texts),
    "exclude": (list, _texts),
    "package-path": (list, _folders),
    "baseline": (str, _path),
    "arguments": (dict, _arguments),
    "per-file-ignores": (dict, _by_file),
}
"""Setting → its TOML type and its converter."""
