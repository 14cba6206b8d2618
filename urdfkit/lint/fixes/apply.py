"""Fix files: edit literal source text, lint the result, and keep it only if it is not worse.

The result has no regressions (see `regressions`), and the expanded robot changes only where the findings name it (see
`model_changes`).

Bytes outside of the edits stay unchanged: line endings, byte order marks, encodings, comments. Files are written only
after the fixed text has been linted, and each file is replaced atomically. Files outside the linted folders, such as
installed packages, are never changed.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path

from urdfkit.description.xml.source import Overlay, Source, Span
from urdfkit.errors import ResourceError, UrdfkitError
from urdfkit.lint.engine.run import Outcome, run
from urdfkit.lint.finding import Edit, Finding
from urdfkit.lint.fixes.generated_files import reason_if_generated
from urdfkit.lint.fixes.model_changes import unnamed_changes
from urdfkit.lint.fixes.regressions import WrittenText, new_findings, unmatched
from urdfkit.lint.project.entry_files import Entry
from urdfkit.lint.project.options import Options
from urdfkit.record import record

TYPE_CHECKING = False
if TYPE_CHECKING:
    from urdfkit.description.xacro.expanded import Expanded
    from urdfkit.description.xml.element import Element

_ROUNDS = 10
_SURROGATE = re.compile("[\ud800-\udfff]")


@record(eq=False)
class FileChange:
    """Change of one file.

    Attributes:
        path: the file, absolute.
        shown: the file name in findings.
        before: bytes read from the file.
        after: bytes to write.
    """

    path: Path
    shown: str
    before: bytes
    after: bytes

    def write(self) -> None:
        """Replace the file atomically.

        Raises:
            ResourceError: the file cannot be written, or has changed since it was read.
        """
        from urdfkit.atomic import write_bytes

        if self.path.read_bytes() != self.before:
            raise ResourceError(f"{self.shown} was changed while it was being fixed; nothing was written to it")
        write_bytes(self.path, self.after)

    @property
    def text(self) -> str:
        """New text of the file, decoded."""
        return _SURROGATE.sub("\ufffd", _Text(self.after).text)

    def diff(self) -> str:
        """Return the change as a unified diff, for ``git apply`` and ``patch -p1``."""
        from difflib import unified_diff

        old, new = (re.findall(r"[^\n]*\n|[^\n]+", _Text(content).text) for content in (self.before, self.after))
        # File names as in git's diffs, for `git apply` and `patch -p1`.
        names = (self.shown, self.shown) if self.shown.startswith("/") else (f"a/{self.shown}", f"b/{self.shown}")
        lines = unified_diff(old, new, *names)
        return "".join(line if line.endswith("\n") else f"{line}\n\\ No newline at end of file\n" for line in lines)


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


def editable_folders(paths: Iterable[Path]) -> list[Path]:
    """Return the folders whose files fixes may change, for the paths a user named.

    For a folder, the folder itself; for a file, its package, or its folder if it is not in a package.
    """
    folders = []
    for path in paths:
        if path.is_dir():
            folders.append(path.resolve())
        elif path.is_file():
            resolved = path.resolve()
            package = next((folder for folder in resolved.parents if (folder / "package.xml").is_file()), None)
            folders.append(package or resolved.parent)
    return folders


def changes(edits: Iterable[Edit], sources: Mapping[str, Source], *, within: Iterable[Path]) -> list[FileChange]:
    """Apply edits in memory and return the changed files; `FileChange.write` writes them.

    Args:
        edits: non-overlapping edits; their files are keys of `sources`.
        sources: name → text of each file.
        within: folders (or files) whose files may be changed.

    Raises:
        ResourceError: a file is outside the folders, or in an unsupported encoding.
    """
    folders = [folder.resolve() for folder in within]
    found = []
    edits = list(edits)
    for file in dict.fromkeys(edit.span.file for edit in edits):
        path, source = Path.cwd() / file, sources[file]
        real = path.resolve()
        if not any(real == folder or folder in real.parents for folder in folders):
            raise ResourceError(f"{file} is outside of the model's package; nothing was written")
        content = path.read_bytes()
        text = _Text(content)
        if not text.agrees_with(source):
            raise ResourceError(f"{file} is not in UTF-8 or UTF-16, or was changed meanwhile; nothing was written")
        edited = text.text
        for edit in sorted((edit for edit in edits if edit.span.file == file), key=lambda e: e.span, reverse=True):
            start, end = _offsets(source, edit.span)
            edited = edited[:start] + edit.text + edited[end:]
        if edited != text.text:
            found.append(FileChange(path, file, content, text.encoded(edited)))
    return found


class _Text:
    """Decoded text of a file, which can be encoded back to the exact bytes."""

    def __init__(self, content: bytes) -> None:
        if content[:2] in (b"\xff\xfe", b"\xfe\xff"):
            self.codec, self.mark = ("utf-16-le" if content[:2] == b"\xff\xfe" else "utf-16-be"), content[:2]
        else:
            self.codec, self.mark = "utf-8", b"\xef\xbb\xbf" if content[:3] == b"\xef\xbb\xbf" else b""
        # Bytes that are not UTF-8, such as Latin-1 comments, are preserved.
        self.text = content[len(self.mark) :].decode(self.codec, errors="surrogateescape")

    def encoded(self, text: str) -> bytes:
        """Return the bytes of an edited text."""
        return self.mark + text.encode(self.codec, errors="surrogateescape")

    def overlay(self, text: str) -> str:
        """Return an edited text as the linter would read it from disk."""
        seen = Overlay(_SURROGATE.sub("\ufffd", text))
        stray = _SURROGATE.search(text)
        if self.codec != "utf-8":
            seen.flaw = 0, "UTF-16"
        elif stray is not None:
            seen.flaw = stray.start(), f"byte 0x{ord(stray[0]) - 0xDC00:02X}"
        return seen

    def agrees_with(self, source: Source) -> bool:
        """Return whether offsets into the linted text are valid in this text."""
        return len(self.text) == len(source.text) and all(
            ours == theirs or theirs == "�" for ours, theirs in zip(self.text, source.text, strict=True)
        )


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
        self.originals: dict[Path, _Text] = {}
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
                cause = f"that would have caused {_listed(worse)}"
            elif unnamed:
                place = unnamed[0].origin.position
                cause = f"that would also have changed <{unnamed[0].tag}> at {place.file}:{place.line}"
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
                start, end = _offsets(source, edit.span)
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
            text = _Text(content)
            if not text.agrees_with(outcome.sources[file]):
                self.notes[f"{file} was not fixed: its encoding is not UTF-8 or UTF-16"] = None
                return False
            reason = "" if self.generated else reason_if_generated(path, text.text)
            if reason:
                self.notes[f"{file} was not fixed: {reason}; fix its source, or use --fix-generated"] = None
                return False
            self.contents[path], self.originals[path], self.shown[path] = content, text, file
        return True


def _offsets(source: Source, span: Span) -> tuple[int, int]:
    return source.offset(span.line, span.column), source.offset(span.end_line, span.end_column)


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
