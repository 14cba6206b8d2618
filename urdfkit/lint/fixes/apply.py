"""Fix files: edit literal source text, lint the result, and keep it only if it is not worse.

The result has no regressions (see `regressions`), and the expanded robot changes only where the findings name it (see
`model_changes`).

Files are written only after the fixed text has been linted, and each file is replaced atomically. Files outside the
linted folders, such as installed packages, are never changed.
"""

from collections.abc import Callable, Iterable, Sequence
from pathlib import Path

from urdfkit.description.xacro.expanded import Expanded
from urdfkit.description.xml.element import Element
from urdfkit.errors import UrdfkitError
from urdfkit.lint.engine.run import Outcome, run
from urdfkit.lint.finding import Edit, Finding
from urdfkit.lint.fixes.file_changes import FileChange, FileText, offsets
from urdfkit.lint.fixes.generated_files import reason_if_generated
from urdfkit.lint.fixes.model_changes import unnamed_changes
from urdfkit.lint.fixes.regressions import WrittenText, new_findings, unmatched
from urdfkit.lint.project.entry_files import Entry
from urdfkit.lint.project.options import Options
from urdfkit.record import record

_ROUNDS = 10


@record(eq=False)
class Fixed:
    """Result of fixing.

    Attributes:
        outcome: lint result of the fixed text.
        changes: the files to write.
        fixed: code → number of fixed findings.
        notes: one line for each fix that was not applied, with the reason.
    """

    outcome: Outcome
    changes: tuple[FileChange, ...]
    fixed: dict[str, int]
    notes: tuple[str, ...]


def fix(
    entries: Sequence[Entry],
    options: Options,
    *,
    within: Iterable[Path],
    unsafe: bool = False,
    generated: bool = False,
    only: Callable[[Finding], bool] | None = None,
) -> Fixed:
    """Compute all fixes in memory; `FileChange.write` writes them.

    Args:
        entries: the entry files.
        options: lint options.
        within: folders (or files) whose files may be changed.
        unsafe: apply unsafe fixes too.
        generated: change files that a program wrote too (see `generated_files`).
        only: predicate that selects the findings to fix; None for all.

    Raises:
        UsageError: a code or the target is unknown.
        ResourceError: an entry cannot be read.
    """
    return _Fixer(entries, options, tuple(path.resolve() for path in within), unsafe, generated, only).fix()


class _Fixer:
    """State of one call of `fix`."""

    def __init__(
        self,
        entries: Sequence[Entry],
        options: Options,
        within: tuple[Path, ...],
        unsafe: bool,
        generated: bool,
        only: Callable[[Finding], bool] | None = None,
    ) -> None:
        self.entries, self.options, self.within, self.only = entries, options, within, only
        self.unsafe, self.generated = unsafe, generated
        self.originals: dict[Path, FileText] = {}
        self.contents: dict[Path, bytes] = {}
        self.shown: dict[Path, str] = {}
        self.texts: dict[Path, str] = {}
        self.names: dict[Path, Path] = {}
        self.refused: set[tuple[str, str, str]] = set()
        self.notes: dict[str, None] = {}

    def fix(self) -> Fixed:
        outcome = self._lint(self.texts)
        fixed: dict[str, int] = {}
        for _ in range(_ROUNDS):
            attempt = self._attempt([finding for finding in outcome.findings if self._is_wanted(finding)], outcome)
            if attempt is None:
                break
            left = _counts(attempt[1])
            for code, count in _counts(outcome).items():  # a fix can uncover another defect, which is fixed then
                fixed[code] = fixed.get(code, 0) + max(count - left.get(code, 0), 0)
            self.texts, outcome = attempt
        changes = tuple(
            FileChange(path, self.shown[path], self.contents[path], self.originals[path].encoded(text))
            for path, text in sorted(self.texts.items())
            if text != self.originals[path].text
        )
        fixed = {code: count for code, count in fixed.items() if count > 0} if changes else {}
        return Fixed(outcome, changes, fixed, tuple(self.notes))

    def _lint(self, texts: dict[Path, str]) -> Outcome:
        # Lone surrogates stand for bytes that are not UTF-8; the linter reads U+FFFD instead.
        overlay = {str(path): self.originals[path].overlay(text) for path, text in texts.items()}
        return run(self.entries, Options(**{**self.options.__dict__, "texts": overlay}), keep_going=True)

    def _attempt(self, findings: Sequence[Finding], outcome: Outcome) -> tuple[dict[Path, str], Outcome] | None:
        """Apply all fixes together; if that causes regressions, bisect, and reject the fixes that cause them."""
        texts, written = self._edited(findings, outcome)
        if texts == self.texts:
            return None
        relinted = self._lint(texts)
        new = new_findings(outcome, relinted)
        worse = [finding for finding in new if written.explains(finding, relinted.sources[finding.file])]
        alike = {_key(finding) for finding in findings}  # equal findings elsewhere may remain
        before = [finding for finding in outcome.findings if _key(finding) in alike]
        remains = not any(True for _ in unmatched(before, relinted.findings))
        unnamed = [] if worse or remains else self._unnamed_changes(findings, texts)
        if not worse and not remains and not unnamed:
            return texts, relinted
        if len(findings) == 1:
            cause = "the finding would remain"
            if worse:
                cause = f"the fix would have caused {_listed(worse)}"
            elif unnamed:
                place = unnamed[0].origin.position
                cause = f"the fix would also have changed <{unnamed[0].tag}> at {place.file}:{place.line}"
            self.refused.add(_key(findings[0]))
            self.notes[f"{findings[0].code} at {findings[0].file}:{findings[0].line} was not fixed: {cause}"] = None
            return None
        parts = [self._attempt(part, outcome) for part in _parts(findings)]
        return next((part for part in parts if part is not None), None)

    def _unnamed_changes(self, findings: Sequence[Finding], texts: dict[Path, str]) -> list[Element]:
        """Return the elements of the robots that fixed texts change, and that no finding names."""
        changed = {path for path, text in texts.items() if text != self.texts.get(path, self.originals[path].text)}
        found: list[Element] = []
        for entry in self.entries:
            before = self._expanded(entry, self.texts)
            if before is not None and not changed.isdisjoint(before.files):
                after = self._expanded(entry, texts)
                found += unnamed_changes(before, after, findings) if after is not None else []
        return found

    def _expanded(self, entry: Entry, texts: dict[Path, str]) -> Expanded | None:
        from urdfkit.description.packages.resolver import Packages
        from urdfkit.description.xacro.expand import expand_leniently

        overlay = {str(path): self.originals[path].overlay(text) for path, text in texts.items()}
        packages = Packages(self.options.package_path, near=entry.path)
        try:
            return expand_leniently(entry.path, arguments=self.options.arguments, packages=packages, texts=overlay)
        except UrdfkitError:
            return None

    def _is_wanted(self, finding: Finding) -> bool:
        fix = finding.fix
        if fix is None or _key(finding) in self.refused or not (fix.safety == "safe" or self.unsafe):
            return False
        return self.only is None or self.only(finding)

    def _edited(self, findings: Sequence[Finding], outcome: Outcome) -> tuple[dict[Path, str], WrittenText]:
        """Return the texts after all non-overlapping fixes; overlapping fixes are applied in the next round."""
        written = WrittenText(
            guessed=any(finding.fix is not None and finding.fix.safety != "safe" for finding in findings)
        )
        taken: dict[str, dict[Edit, None]] = {}
        for finding in findings:
            edits = finding.fix.edits if finding.fix is not None else ()
            if all(self._is_editable(edit.span.file, outcome) for edit in edits) and not any(
                _overlaps(edit, other) for edit in edits for other in taken.get(edit.span.file, ())
            ):
                for edit in edits:
                    taken.setdefault(edit.span.file, {})[edit] = None
        texts = dict(self.texts)
        for file, accepted in taken.items():
            path, source = outcome.files[file], outcome.sources[file]
            text = self.texts.get(path, self.originals[path].text)
            changed: list[tuple[int, int, str]] = []
            for edit in sorted(accepted, key=lambda edit: edit.span):
                start, end = offsets(source, edit.span)
                changed.append((start, end, edit.text))
            written.add(file, text, changed)
            for start, end, put in reversed(changed):
                text = text[:start] + put + text[end:]
            texts[path] = text
        return texts, written

    def _is_editable(self, file: str, outcome: Outcome) -> bool:
        path = outcome.files[file]
        real = path.resolve()
        if self.names.setdefault(real, path) != path:
            return False  # The same file under another name; it is fixed under the first name.
        if not any(real == folder or folder in real.parents for folder in self.within):
            self.notes[f"{file} was not fixed: the file is outside the linted folders"] = None
            return False
        if path not in self.originals:
            content = path.read_bytes()
            text = FileText(content)
            if not text.agrees_with(outcome.sources[file]):
                self.notes[f"{file} was not fixed: its encoding is not UTF-8 or UTF-16"] = None
                return False
            reason = "" if self.generated else reason_if_generated(path, text.text)
            if reason:
                self.notes[f"{file} was not fixed: {reason}; fix its source, or use --fix-generated"] = None
                return False
            self.contents[path], self.originals[path], self.shown[path] = content, text, file
        return True


def _overlaps(edit: Edit, other: Edit) -> bool:
    if edit == other:
        return False
    (a, b), (c, d) = (((e.span.line, e.span.column), (e.span.end_line, e.span.end_column)) for e in (edit, other))
    return a == c or (a < d and c < b)


def _key(finding: Finding) -> tuple[str, str, str]:
    """Return the identity of a finding, independent of its line."""
    return finding.code, finding.file, finding.message


def _parts(findings: Sequence[Finding]) -> list[Sequence[Finding]]:
    """Split the findings by rule; findings of a single rule into halves."""
    codes = dict.fromkeys(finding.code for finding in findings)
    if len(codes) > 1:
        return [[finding for finding in findings if finding.code == code] for code in codes]
    middle = len(findings) // 2
    return [findings[:middle], findings[middle:]]


def _counts(outcome: Outcome) -> dict[str, int]:
    counts: dict[str, int] = {}
    for finding in outcome.findings:
        counts[finding.code] = counts.get(finding.code, 0) + 1
    return counts


def _listed(findings: Sequence[Finding]) -> str:
    """Format the first finding of each rule with position and message."""
    firsts = {finding.code: finding for finding in reversed(findings)}
    return "; ".join(f"{code} at {found.file}:{found.line}, {found.message}" for code, found in firsts.items())
