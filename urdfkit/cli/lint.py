"""``urdfkit lint``: find and fix the defects of a URDF or xacro."""

from __future__ import annotations

import os
import sys
from pathlib import Path

from urdfkit.cli.lint_output import FORMATS, Progress, show

TYPE_CHECKING = False
if TYPE_CHECKING:
    import argparse
    from collections.abc import Sequence

    from urdfkit.lint.engine.run import Outcome
    from urdfkit.lint.engine.settings import LintSettings
    from urdfkit.lint.finding import Finding
    from urdfkit.lint.fixes.apply import Fixed
    from urdfkit.lint.project.confinement import Confinement
    from urdfkit.lint.project.entry_files import Entry
    from urdfkit.lint.project.options import Options

_EPILOG = """examples:
  urdfkit lint urdf/robot.urdf.xacro use_camera:=true
  urdfkit lint src --fix

exit status: 0 no errors or warnings, 1 errors or warnings, 2 linting failed
suppress in the file:
  <!-- urdfkit: ignore I503 -->       this line (if alone, the next element)
  <!-- urdfkit: ignore-file I503 -->  the whole file
settings: [lint] in urdfkit.toml or [tool.urdfkit.lint] in pyproject.toml, nearest above the first PATH"""


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    from urdfkit.cli.parser import add_package_path, add_time_limit

    add = parser.add_argument
    add(
        "paths",
        nargs="*",
        metavar="PATH",
        help="files, package folders or workspaces (default: the working directory); then key:=value xacro arguments",
    )
    add("--fix", action="store_true", help="apply safe fixes")
    add("--unsafe-fixes", action="store_true", help="with --fix or --diff: apply unsafe fixes too")
    add("--fix-generated", action="store_true", help="with --fix or --diff: change generated files too")
    add("--diff", action="store_true", help="print the changes of --fix without writing them")
    add(
        "--select",
        action="append",
        default=[],
        metavar="CODES",
        help="report only these rules or groups of rules, such as I503,J",
    )
    add("--ignore", action="append", default=[], metavar="CODES", help="do not report these rules or groups of rules")
    add(
        "--target",
        metavar="NAME",
        help="ros1, ros2, gz, classic, mujoco, isaac, drake, moveit or urdfkit, the first four with a release where it "
        "matters (ros2-jazzy, gz-harmonic), or any: only rules for every target (default: guessed from package.xml)",
    )
    add("--format", choices=FORMATS, default="text", help="text (default), json, sarif, github or junit")
    add("--statistics", action="store_true", help="print the number of findings per rule")
    add("--watch", action="store_true", help="lint again whenever a file changes")
    add("--baseline", type=Path, metavar="FILE", help="report only findings that are not in the baseline FILE")
    add("--write-baseline", type=Path, metavar="FILE", help="write the current findings to FILE as a baseline")
    add("--config", type=Path, metavar="FILE", help="read the settings from FILE")
    add("--no-config", action="store_true", help="ignore settings files")
    add_package_path(parser)
    add(
        "--confined",
        action="store_true",
        help="read only the package, its workspace and the package path, and no environment variables: for "
        "untrusted files",
    )
    help = "do not lint robots with the xacro arguments that simulation and display launch files pass"
    add("--no-launch-arguments", action="store_true", help=help)
    help = "instantiate this macro of the file; key:=value arguments also set its parameters"
    add("--macro", metavar="NAME", help=help)
    add("--no-cache", action="store_true", help="lint unchanged files again")
    add("--jobs", type=_count, metavar="N", help="number of processes (default: one per core)")
    add_time_limit(parser)
    parser.epilog = _EPILOG


def _count(text: str) -> int:
    if not text.isdecimal() or int(text) < 1:
        from argparse import ArgumentTypeError

        raise ArgumentTypeError(f"`{text}` is not a number of processes")
    return int(text)


def run(arguments: argparse.Namespace) -> int:
    """Lint, and apply fixes on request.

    Raises:
        UsageError: an argument or a setting is invalid.
        ResourceError: a path does not exist, or a file cannot be read or written.
    """
    _check(arguments)
    if arguments.watch:
        return _watch(arguments)
    return _Run(arguments).run()[0]


def _check(arguments: argparse.Namespace) -> None:
    from urdfkit.errors import UsageError

    changes = arguments.fix or arguments.diff
    if not changes and (arguments.unsafe_fixes or arguments.fix_generated):
        raise UsageError(f"--{'unsafe-fixes' if arguments.unsafe_fixes else 'fix-generated'} requires --fix or --diff")
    if arguments.watch and (changes or arguments.write_baseline):
        raise UsageError("--watch cannot be combined with --fix, --diff or --write-baseline")
    if arguments.write_baseline and changes:
        raise UsageError("--write-baseline cannot be combined with --fix or --diff")
    if arguments.statistics and arguments.format not in ("text", "json"):
        raise UsageError(f"--statistics supports the formats text and json, not {arguments.format}")
    if arguments.macro is not None and changes:
        raise UsageError("--macro cannot be combined with --fix or --diff; fix the file without --macro")
    if arguments.config and arguments.no_config:
        raise UsageError("--config cannot be combined with --no-config")


def _watch(arguments: argparse.Namespace) -> int:
    from urdfkit.cli.lint_watch import watch
    from urdfkit.errors import UrdfkitError

    def once() -> Outcome | None:
        try:
            return _Run(arguments).run()[1]
        except UrdfkitError as error:  # e.g. a file that is half written
            print(f"urdfkit: {error}", file=sys.stderr)
            return None

    watch(once, [Path(word) for word in arguments.paths if ":=" not in word] or [Path()])
    return 0


class _Run:
    """One run: the options of the command line merged with the settings."""

    def __init__(self, arguments: argparse.Namespace) -> None:
        self.arguments = arguments
        self.paths, xacro_arguments = _split(arguments.paths)
        self.confinement = self._confinement()
        self.settings = self._settings()
        self.refused: tuple[str, ...] = ()
        self.options = self._options(xacro_arguments)

    def run(self) -> tuple[int, Outcome]:
        """Lint, and apply fixes on request; return the exit code and the remaining findings."""
        from urdfkit.lint.engine.run import run as lint

        arguments = self.arguments
        entries = self._entries()
        if arguments.fix or arguments.diff:
            return self._fix(entries)
        jobs = arguments.jobs or _cores()
        cached, progress = not (arguments.no_cache or arguments.confined), Progress(quiet=arguments.quiet)
        outcome = lint(entries, self.options, cached=cached, jobs=jobs, keep_going=True, progress=progress)
        return self._report(outcome), outcome

    def _confinement(self) -> Confinement | None:
        """Return the confinement, started; settings cannot widen it."""
        if not self.arguments.confined:
            return None
        from urdfkit.lint.project.confinement import confinement_of

        arguments = self.arguments
        found = confinement_of(self.paths, map(_folder, arguments.package_path))
        named = (arguments.config, arguments.baseline, arguments.write_baseline)
        found.folders = (*found.folders, *(os.path.realpath(file) for file in named if file is not None))
        found.start()
        return found

    def _settings(self) -> LintSettings | None:
        """Return the settings file; None without one. Most runs have none, and then the module is not imported."""
        arguments = self.arguments
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

        arguments, settings = self.arguments, self.settings
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
            confinement=self.confinement,
        )

    def _text_with_macro(self, xacro_arguments: dict[str, str], folders: tuple[Path, ...]) -> dict[str, str]:
        """Return the text of the file with a call of the macro of the command line; empty without one."""
        macro = self.arguments.macro
        if macro is None:
            return {}
        if len(self.paths) != 1 or not Path(self.paths[0]).is_file():
            from urdfkit.errors import UsageError

            raise UsageError("--macro requires one file as PATH")
        from urdfkit.description.packages.resolver import Packages
        from urdfkit.description.xacro.macro_call import text_with_call

        path = Path(self.paths[0])
        permits = None if self.confinement is None else self.confinement.permits
        return text_with_call(path, macro, xacro_arguments, Packages(folders, path, permits=permits))

    def _entries(self) -> list[Entry]:
        from urdfkit.lint.project.entry_files import Entry, find_each

        if self.arguments.macro is not None:
            return [Entry(Path(self.paths[0]))]
        entries, self.refused = find_each(self.paths)
        settings = self.settings
        if settings is None or not settings.exclude:
            return entries
        named = {Path(path).resolve() for path in self.paths}
        return [entry for entry in entries if entry.path.resolve() in named or not self._is_excluded(entry.path)]

    def _is_excluded(self, path: Path) -> bool:
        settings = self.settings
        return settings is not None and any(settings.matches(path, pattern) for pattern in settings.exclude)

    def _is_wanted(self, finding: Finding) -> bool:
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

    def _fix(self, entries: Sequence[Entry]) -> tuple[int, Outcome]:
        from urdfkit.lint.fixes.apply import fix
        from urdfkit.lint.fixes.file_changes import editable_folders

        arguments = self.arguments
        within = editable_folders(Path(path) for path in self.paths)
        only = self._is_wanted if self.settings is not None else None
        unsafe, generated = arguments.unsafe_fixes, arguments.fix_generated
        fixed = fix(entries, self.options, within=within, unsafe=unsafe, generated=generated, only=only)
        for note in () if arguments.quiet else fixed.notes:
            print(f"urdfkit: {note}", file=sys.stderr)
        if arguments.diff:
            return self._show(fixed), fixed.outcome
        for change in fixed.changes:
            change.write()
        if fixed.changes and not arguments.quiet:
            count = sum(fixed.fixed.values())
            by_code = ", ".join(f"{number} × {code}" for code, number in sorted(fixed.fixed.items()))
            files = f"{len(fixed.changes)} file{'s' if len(fixed.changes) > 1 else ''}"
            print(f"Fixed {count} finding{'s' if count > 1 else ''} in {files} ({by_code}).", file=sys.stderr)
        return self._report(fixed.outcome), fixed.outcome

    def _show(self, fixed: Fixed) -> int:
        for change in fixed.changes:
            sys.stdout.write(change.diff())
        refused = self._refuse(fixed.outcome)
        remaining = sum(finding.severity != "note" for finding in self._left(fixed.outcome).findings)
        if remaining:
            print(
                f"{remaining} finding{'s' if remaining > 1 else ''} would remain; nothing was written.", file=sys.stderr
            )
        return 2 if refused else 1 if fixed.changes or remaining else 0

    def _refuse(self, outcome: Outcome) -> bool:
        """Print the paths that could not be linted, one line each; return whether there are any."""
        reasons = (*self.refused, *outcome.refused)
        for reason in reasons:
            print(f"urdfkit: {reason}", file=sys.stderr)
        return bool(reasons)

    def _left(self, outcome: Outcome) -> Outcome:
        """Return the outcome without findings that the settings exclude or the baseline contains."""
        from urdfkit.lint.engine.run import Outcome

        arguments = self.arguments
        file = arguments.baseline or (self.settings.baseline if self.settings is not None else None)
        if self.settings is None and file is None:
            return outcome
        findings = [finding for finding in outcome.findings if self._is_wanted(finding)]
        if file is not None and arguments.write_baseline is None:
            from urdfkit.lint.engine.baseline import read, unknown

            findings, matched, obsolete = unknown(findings, read(file))
            if not arguments.quiet:
                hint = f"; {obsolete} no longer occur: remove them with --write-baseline {file}" if obsolete else ""
                print(
                    f"urdfkit: {matched} finding{'s' if matched != 1 else ''} matched by {file}{hint}", file=sys.stderr
                )
        return Outcome(**{**outcome.__dict__, "findings": tuple(findings)})

    def _report(self, whole: Outcome) -> int:
        arguments = self.arguments
        outcome = self._left(whole)
        for note in () if arguments.quiet else outcome.notes:
            print(f"urdfkit: {note}", file=sys.stderr)
        refused = self._refuse(outcome)
        if arguments.write_baseline is not None:
            from urdfkit.lint.engine.baseline import write

            count = write(arguments.write_baseline, outcome.findings)
            if not arguments.quiet:
                print(
                    f"urdfkit: wrote {count} finding{'s' if count != 1 else ''} to {arguments.write_baseline}",
                    file=sys.stderr,
                )
            return 2 if refused else 0
        if refused and not whole.files and arguments.format == "text":
            return 2  # nothing was linted
        if not refused or outcome.findings or arguments.format != "text":  # "All checks passed" would not be true
            show(outcome, arguments.format, self.paths, statistics=arguments.statistics, color=arguments.color)
        if refused:
            return 2
        return 1 if any(finding.severity != "note" for finding in outcome.findings) else 0


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
    folder = Path(word).expanduser()
    if not folder.is_dir():
        from urdfkit.description.packages.similar_names import near_path
        from urdfkit.errors import ResourceError

        raise ResourceError(f"--package-path {word}: no such folder{near_path(folder)}")
    return folder


def _has_settings(start: Path) -> bool:
    """Whether a settings file may exist above a path; `urdfkit.lint.project.settings` reads it."""
    folder = os.path.abspath(start)  # noqa: PTH100 - a dozen look-ups before every run
    while True:
        if os.path.exists(f"{folder}/urdfkit.toml") or os.path.exists(f"{folder}/pyproject.toml"):  # noqa: PTH110
            return True
        above = os.path.dirname(folder)  # noqa: PTH120
        if above == folder:
            return False
        folder = above


def _cores() -> int:
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
