"""Lint findings in the viewer: source lines, page of the rule, and the fix."""

import re
from pathlib import Path
from typing import Any

from urdfkit.app.viewer.source_links import SourceLinks
from urdfkit.description.urdf.robot import Robot
from urdfkit.description.xml.source import Expansion, Source, Span
from urdfkit.errors import ResourceError, UrdfkitError, UsageError
from urdfkit.lint.engine.run import Outcome, run
from urdfkit.lint.engine.settings import LintSettings, find
from urdfkit.lint.finding import Finding, Fix
from urdfkit.lint.project.entry_files import Entry
from urdfkit.lint.project.options import TIME_LIMIT, Options
from urdfkit.resources import ModelArgument

LINES = 12
"""Maximum number of source lines shown per finding."""


class FindingsPanel:
    """The findings of one model, numbered; a number is not reused.

    Args:
        model: the model to lint.
        may_write: whether fixes may be applied.
    """

    def __init__(self, model: ModelArgument, *, may_write: bool = True) -> None:
        self.model = model
        self.may_write = may_write
        self._findings: dict[int, Finding] = {}
        self._next = 1

    def lint(self, robot: Robot | None = None) -> dict[str, Any]:
        """Lint the current files.

        Args:
            robot: robot expanded from these files; assigns findings in the text to links and joints.

        Returns:
            ``findings``, one object each; ``rules``, code → the rule's page as Markdown; ``fault``, the error that
            prevented the lint or some of its rules, or None.
        """
        self._findings = {}
        places = None if robot is None else SourceLinks(robot)
        try:
            settings = self._settings()
            outcome = run(self._entries(), self._options(settings), keep_going=True)
        except UrdfkitError as error:
            return {"findings": [], "rules": {}, "fault": str(error)}
        rows = []
        for finding in outcome.findings:
            if _is_ignored(finding, settings):
                continue
            self._findings[self._next] = finding
            rows.append(self._row(self._next, finding, outcome, places))
            self._next += 1
        return {
            "findings": rows,
            "rules": _pages({row["code"] for row in rows}),
            "fault": next(iter(outcome.refused), None),
        }

    def apply_fix(self, number: int) -> str:
        """Apply the safe fix of one finding: verified in memory first, then each file is replaced atomically.

        Args:
            number: number of a finding of the last lint.

        Returns:
            The applied change, one line.

        Raises:
            UsageError: the finding is outdated or has no safe fix, or writing is not allowed.
            ResourceError: the fix does not remove the finding, or a file cannot be written.
        """
        from urdfkit.lint.fixes.apply import fix
        from urdfkit.lint.fixes.file_changes import editable_folders

        wanted = self._findings.get(number)
        if wanted is None:
            raise UsageError("this finding is outdated: the files have changed since")
        if wanted.fix is None or wanted.fix.safety != "safe":
            raise UsageError(f"{wanted.code} has no safe fix here; run `urdfkit rule {wanted.code}` for instructions")
        if not self.may_write:
            raise UsageError(
                "this page is reachable from other machines and cannot change files; run `urdfkit lint --fix`"
            )
        fixed = fix(
            self._entries(),
            self._options(self._settings()),
            within=editable_folders([self.model.path]),
            only=lambda finding: finding == wanted,
        )
        if not fixed.changes:
            raise ResourceError(next(iter(fixed.notes), f"{wanted.code} no longer occurs"))
        for change in fixed.changes:
            change.write()
        files = ", ".join(change.shown for change in fixed.changes)
        return f"{wanted.code}: {wanted.fix.title}, in {files}"

    def _entries(self) -> list[Entry]:
        here, path = Path.cwd(), self.model.path.absolute()
        return [Entry(path.relative_to(here) if path.is_relative_to(here) else path)]

    def _settings(self) -> LintSettings:
        return find(self.model.path)

    def _options(self, settings: LintSettings) -> Options:
        """Return the options of ``urdfkit lint`` for this model, with its xacro arguments."""
        target, folders = settings.target, tuple(Path(folder) for folder in self.model.package_path)
        return Options(
            settings.select,
            settings.ignore,
            None if target == "any" else target,
            self.model.arguments,
            (*folders, *settings.package_path),
            self._texts(),
            guess_target=target is None,
            time_limit=TIME_LIMIT,
        )

    def _texts(self) -> dict[str, str]:
        """Return the text of the file with a call of the model's macro."""
        if self.model.macro is None:
            return {}
        from urdfkit.description.packages.resolver import Packages
        from urdfkit.description.xacro.macro_call import text_with_call

        model = self.model
        packages = Packages(model.package_path, model.path)
        return text_with_call(model.path, self.model.macro, model.arguments, packages)

    def _row(self, number: int, finding: Finding, outcome: Outcome, places: SourceLinks | None) -> dict[str, Any]:
        source = outcome.sources.get(finding.file)
        row = finding.to_json()
        row["number"] = number
        row["lines"] = _lines(source, finding.span)
        row["about"] = []
        if places is not None and finding.link is None and finding.joint is None:
            parts = places.of(finding.span)
            row["about"] = [{owner: name} for owner, name, _ in parts]
            chains = dict.fromkeys(chain for _, _, chain in parts if chain)
            row["chains"] = row["chains"] or [[_call(call) for call in chain] for chain in chains]
        if finding.fix is not None:
            row["fix"] = {
                "safety": finding.fix.safety,
                "title": finding.fix.title,
                "diff": _difference(finding.fix, outcome),
                "may": self.may_write and finding.fix.safety == "safe",
            }
        return row


def _is_ignored(finding: Finding, settings: LintSettings) -> bool:
    path = Path(finding.file)
    rules = settings.per_file.items()
    return any(finding.code.startswith(codes) and settings.matches(path, pattern) for pattern, codes in rules)


def _call(call: Expansion) -> dict[str, Any]:
    return {"macro": call.macro, "file": call.position.file, "line": call.position.line}


def _lines(source: Source | None, span: Span) -> list[str]:
    if source is None:
        return []
    last = max(span.line, span.end_line - (span.end_column == 1))
    numbers = range(span.line, min(last, span.line + LINES - 1) + 1)
    return [source.excerpt(number, span.column if number == span.line else 1) for number in numbers]


def _difference(fix: Fix, outcome: Outcome) -> list[str]:
    """Return the changes of a fix as the lines of a unified diff without context."""
    from difflib import unified_diff

    lines: list[str] = []
    for file in dict.fromkeys(edit.span.file for edit in fix.edits):
        source = outcome.sources[file]
        edits = sorted((e for e in fix.edits if e.span.file == file), key=lambda e: e.span, reverse=True)
        # Only the lines from the first to the last edit are compared: a file may have a fix in every line.
        first, last = edits[-1].span.line, max(edit.span.end_line for edit in edits)
        start = source.offset(first, 1)
        text = before = source.text[start : source.offset(last + 1, 1)]
        for edit in edits:
            at = source.offset(edit.span.line, edit.span.column) - start
            end = source.offset(edit.span.end_line, edit.span.end_column) - start
            text = text[:at] + edit.text + text[end:]
        changed = unified_diff(before.splitlines(), text.splitlines(), lineterm="", n=0)
        lines += [_moved(line, first - 1) for line in changed if not line.startswith(("---", "+++"))]
    return lines


def _moved(line: str, by: int) -> str:
    """Return a line of a diff, with the line numbers of a heading increased."""
    if not line.startswith("@@"):
        return line
    return re.sub(r"([-+])(\d+)", lambda number: f"{number[1]}{int(number[2]) + by}", line)


def _pages(codes: set[str]) -> dict[str, str]:
    from urdfkit.lint.catalogue import page, rules

    return {rule.code: page(rule) for rule in rules() if rule.code in codes}
