"""Inputs of one ``urdfkit lint``: paths, settings, options and entry files."""

from __future__ import annotations

import os
from pathlib import Path

TYPE_CHECKING = False
if TYPE_CHECKING:
    import argparse
    from collections.abc import Sequence

    from urdfkit.lint.engine.settings import LintSettings
    from urdfkit.lint.finding import Finding
    from urdfkit.lint.project.confinement import Confinement
    from urdfkit.lint.project.entry_files import Entry
    from urdfkit.lint.project.options import Options


class Inputs:
    """The arguments of the command line merged with the settings.

    Args:
        arguments: the parsed command line.

    Attributes:
        paths: files, package folders or workspaces, as named.
        settings: the settings file; None without one.
        options: what to lint for.
        xacro_arguments: the xacro arguments of the command line.

    Raises:
        UsageError: an argument or a setting is invalid.
        ResourceError: a folder or a file does not exist.
    """

    def __init__(self, arguments: argparse.Namespace) -> None:
        self._arguments = arguments
        self.paths, self.xacro_arguments = _split(arguments.paths)
        self._confinement = self._confine()
        self.settings = self._read_settings()
        self.options = self._options(self.xacro_arguments)

    def entries(self) -> tuple[list[Entry], tuple[str, ...]]:
        """Return the entry files that the settings do not exclude, and a line for each path without any.

        Raises:
            ResourceError: the only path has no entry file.
        """
        from urdfkit.lint.project.entry_files import Entry, find_each

        if self._arguments.macro is not None:
            return [Entry(Path(self.paths[0]))], ()
        entries, refused = find_each(self.paths)
        settings = self.settings
        if settings is None or not settings.exclude:
            return entries, refused
        named = {Path(path).resolve() for path in self.paths}
        kept = [entry for entry in entries if entry.path.resolve() in named or not self._is_excluded(entry.path)]
        return kept, refused

    def is_wanted(self, finding: Finding) -> bool:
        """Whether the settings do not exclude a finding in its file."""
        settings = self.settings
        if settings is None:
            return True
        path = Path(finding.file)
        if (
            settings.exclude
            and self._is_excluded(path)
            and path.resolve() not in map(Path.resolve, map(Path, self.paths))
        ):
            return False
        return not any(
            finding.code.startswith(codes) and settings.matches(path, pattern)
            for pattern, codes in settings.per_file.items()
        )

    def _is_excluded(self, path: Path) -> bool:
        settings = self.settings
        return settings is not None and any(settings.matches(path, pattern) for pattern in settings.exclude)

    def _confine(self) -> Confinement | None:
        """Return the confinement, started; settings cannot widen it."""
        if not self._arguments.confined:
            return None
        from urdfkit.lint.project.confinement import confinement_of

        arguments = self._arguments
        found = confinement_of(self.paths, map(_folder, arguments.package_path))
        named = (arguments.config, arguments.baseline, arguments.write_baseline)
        found.folders = (*found.folders, *(os.path.realpath(file) for file in named if file is not None))
        found.start()
        return found

    def _read_settings(self) -> LintSettings | None:
        """Return the settings file; None without one. Most runs have none, and then the module is not imported."""
        arguments = self._arguments
        if arguments.no_config:
            return None
        if arguments.config is not None:
            from urdfkit.lint.engine.settings import read

            return read(arguments.config)
        start = Path(self.paths[0]) if Path(self.paths[0]).exists() else Path.cwd()
        if not _has_settings(start):
            return None
        from urdfkit.lint.engine.settings import find

        return find(start)

    def _options(self, xacro_arguments: dict[str, str]) -> Options:
        from urdfkit.lint.project.options import Options

        arguments, settings = self._arguments, self.settings
        folders = tuple(_folder(word) for word in arguments.package_path)
        select, ignore, target = tuple(arguments.select), tuple(arguments.ignore), arguments.target
        if settings is not None:
            select = select or settings.select
            ignore = (*settings.ignore, *ignore)
            target = target or settings.target
            folders = (*folders, *settings.package_path)
            xacro_arguments = {**settings.arguments, **xacro_arguments}
        named = None if target is not None and target.lower() == "any" else target
        limit = arguments.time_limit
        return Options(
            select,
            ignore,
            named,
            xacro_arguments,
            folders,
            self._text_with_macro(xacro_arguments, folders),
            guess_target=target is None,
            launch_arguments=not (arguments.no_launch_arguments or arguments.macro),
            time_limit=limit,
            confinement=self._confinement,
        )

    def _text_with_macro(self, xacro_arguments: dict[str, str], folders: tuple[Path, ...]) -> dict[str, str]:
        """Return the text of the file with a call of the macro of the command line; empty without one."""
        macro = self._arguments.macro
        if macro is None:
            return {}
        if len(self.paths) != 1 or not Path(self.paths[0]).is_file():
            from urdfkit.errors import UsageError

            raise UsageError("--macro requires one file as PATH")
        from urdfkit.description.packages.resolver import Packages
        from urdfkit.description.xacro.macro_call import text_with_call

        path = Path(self.paths[0])
        permits = None if self._confinement is None else self._confinement.permits
        return text_with_call(path, macro, xacro_arguments, Packages(folders, path, permits=permits))


def _split(words: Sequence[str]) -> tuple[list[str], dict[str, str]]:
    from urdfkit.errors import UsageError

    paths, xacro_arguments = [], {}
    for word in words:
        key, separator, value = word.partition(":=")
        if not separator:
            paths.append(word)
        elif key:
            xacro_arguments[key] = value
        else:
            raise UsageError(f"`{word}` has no key: write xacro arguments as key:=value")
    return paths or ["."], xacro_arguments


def _folder(word: str) -> Path:
    from urdfkit.missing_files import expanded_path, missing_path

    folder = expanded_path(word)
    if not folder.is_dir():
        from urdfkit.errors import ResourceError

        raise ResourceError(f"--package-path: {missing_path(word, 'folder')}")
    return folder


def _has_settings(start: Path) -> bool:
    """Whether a settings file may exist above a path; `urdfkit.lint.engine.settings` reads it."""
    folder = os.path.abspath(start)  # noqa: PTH100 - a dozen look-ups before every run
    while True:
        if os.path.exists(f"{folder}/urdfkit.toml") or os.path.exists(f"{folder}/pyproject.toml"):  # noqa: PTH110
            return True
        above = os.path.dirname(folder)  # noqa: PTH120
        if above == folder:
            return False
        folder = above
