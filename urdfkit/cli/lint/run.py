"""One run of ``urdfkit lint``: lint, apply fixes, print the remaining findings."""

from __future__ import annotations

import os
import sys
from pathlib import Path

from urdfkit.cli.lint.inputs import Inputs
from urdfkit.cli.lint.output import show
from urdfkit.cli.progress_line import ProgressLine

TYPE_CHECKING = False
if TYPE_CHECKING:
    import argparse
    from collections.abc import Sequence

    from urdfkit.lint.engine.run import Outcome
    from urdfkit.lint.fixes.apply import Fixed
    from urdfkit.lint.project.entry_files import Entry


class Run:
    """Lints the inputs of a command line once.

    Args:
        arguments: the parsed command line.

    Raises:
        UsageError: an argument or a setting is invalid.
        ResourceError: a folder or a file does not exist.
    """

    def __init__(self, arguments: argparse.Namespace) -> None:
        self._arguments = arguments
        self._inputs = Inputs(arguments)
        self._refused: tuple[str, ...] = ()

    def run(self) -> tuple[int, Outcome]:
        """Lint, and apply fixes on request; return the exit code and the remaining findings."""
        from urdfkit.lint.engine.run import run as lint

        arguments = self._arguments
        entries, self._refused = self._inputs.entries()
        if arguments.fix or arguments.diff:
            return self._fix(entries)
        jobs = arguments.jobs or _cores()
        cached = not (arguments.no_cache or arguments.confined)
        with ProgressLine(quiet=arguments.quiet, period=0.5) as line:

            def progress(done: int, total: int) -> None:
                line(f"urdfkit: linted {done} of {total} files")

            outcome = lint(entries, self._inputs.options, cached=cached, jobs=jobs, keep_going=True, progress=progress)
        return self._report(outcome), outcome

    def _fix(self, entries: Sequence[Entry]) -> tuple[int, Outcome]:
        from urdfkit.lint.fixes.apply import fix
        from urdfkit.lint.fixes.file_changes import editable_folders

        arguments = self._arguments
        within = editable_folders(Path(path) for path in self._inputs.paths)
        only = self._inputs.is_wanted if self._inputs.settings is not None else None
        unsafe, generated = arguments.unsafe_fixes, arguments.fix_generated
        fixed = fix(entries, self._inputs.options, within=within, unsafe=unsafe, generated=generated, only=only)
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
        from urdfkit.cli.colors import colored_diff

        for change in fixed.changes:
            sys.stdout.write(colored_diff(change.diff(), self._arguments.color))
        refused = self._refuse(fixed.outcome)
        remaining = sum(finding.severity != "note" for finding in self._left(fixed.outcome).findings)
        if remaining:
            print(
                f"{remaining} finding{'s' if remaining > 1 else ''} would remain; nothing was written.", file=sys.stderr
            )
        return 2 if refused else 1 if fixed.changes or remaining else 0

    def _refuse(self, outcome: Outcome) -> bool:
        """Print the paths that could not be linted, one line each; return whether there are any."""
        reasons = (*self._refused, *outcome.refused)
        for reason in reasons:
            print(f"urdfkit: {reason}", file=sys.stderr)
        return bool(reasons)

    def _left(self, outcome: Outcome) -> Outcome:
        """Return the outcome without findings that the settings exclude or the baseline contains."""
        from urdfkit.lint.engine.run import Outcome

        arguments, settings = self._arguments, self._inputs.settings
        file = arguments.baseline or (settings.baseline if settings is not None else None)
        if settings is None and file is None:
            return outcome
        findings = [finding for finding in outcome.findings if self._inputs.is_wanted(finding)]
        if file is not None and arguments.write_baseline is None:
            from urdfkit.lint.engine.baseline import read, unknown

            findings, matched, obsolete = unknown(findings, read(file))
            if not arguments.quiet:
                hint = f"; {obsolete} no longer occur: remove them with --write-baseline {file}" if obsolete else ""
                print(
                    f"urdfkit: {matched} finding{'s' if matched != 1 else ''} matched by {file}{hint}", file=sys.stderr
                )
        return Outcome(**{**outcome.__dict__, "findings": tuple(findings)})

    def _unused_arguments(self, outcome: Outcome) -> list[str]:
        """Return a warning for each xacro argument of the command line that no description has."""
        if not self._inputs.xacro_arguments or not outcome.files:
            return []
        from urdfkit.description.packages.related_files import LAUNCH
        from urdfkit.description.xacro.declared_arguments import unused_arguments

        others = (*LAUNCH, ".srdf", ".yaml", ".yml", ".txt", ".py", "package.xml")
        found = (outcome.sources.get(name) for name in outcome.files if not name.endswith(others))
        sources = [source for source in found if source is not None]
        unused = unused_arguments(self._inputs.xacro_arguments, sources, self._arguments.macro)
        return [f"warning: {line}" for line in unused]

    def _report(self, whole: Outcome) -> int:
        arguments = self._arguments
        outcome = self._left(whole)
        for note in () if arguments.quiet else (*outcome.notes, *self._unused_arguments(whole)):
            print(f"urdfkit: {note}", file=sys.stderr)
        refused = self._refuse(outcome)
        if arguments.write_baseline is not None:
            from urdfkit.lint.engine.baseline import write

            count = write(arguments.write_baseline, outcome.findings)
            if not arguments.quiet:
                message = f"urdfkit: wrote {count} finding{'s' if count != 1 else ''} to {arguments.write_baseline}"
                print(message, file=sys.stderr)
            return 2 if refused else 0
        if refused and not whole.files and arguments.format == "text":
            return 2  # nothing was linted
        if not refused or outcome.findings or arguments.format != "text":  # "All checks passed" would not be true
            show(outcome, arguments.format, self._inputs.paths, statistics=arguments.statistics, color=arguments.color)
        if refused:
            return 2
        return 1 if any(finding.severity != "note" for finding in outcome.findings) else 0


def _cores() -> int:
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
