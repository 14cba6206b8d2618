"""Changes of files in memory: edits of decoded text, and the bytes to write.

Bytes outside of the edits stay unchanged: line endings, byte order marks, encodings, comments.
"""

import re
from collections.abc import Iterable, Mapping
from pathlib import Path

from urdfkit.description.xml.source import Overlay, Source, Span
from urdfkit.errors import ResourceError
from urdfkit.lint.finding import Edit
from urdfkit.record import record

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
        return _SURROGATE.sub("\ufffd", FileText(self.after).text)

    def diff(self) -> str:
        """Return the change as a unified diff, for ``git apply`` and ``patch -p1``."""
        from difflib import unified_diff

        old, new = (re.findall(r"[^\n]*\n|[^\n]+", FileText(content).text) for content in (self.before, self.after))
        # File names as in git's diffs, for `git apply` and `patch -p1`.
        names = (self.shown, self.shown) if self.shown.startswith("/") else (f"a/{self.shown}", f"b/{self.shown}")
        lines = unified_diff(old, new, *names)
        return "".join(line if line.endswith("\n") else f"{line}\n\\ No newline at end of file\n" for line in lines)


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
            raise ResourceError(f"{file} is outside the package of the model; nothing was written")
        content = path.read_bytes()
        text = FileText(content)
        if not text.agrees_with(source):
            raise ResourceError(f"{file} is not in UTF-8 or UTF-16, or was changed meanwhile; nothing was written")
        edited = text.text
        for edit in sorted((edit for edit in edits if edit.span.file == file), key=lambda e: e.span, reverse=True):
            start, end = offsets(source, edit.span)
            edited = edited[:start] + edit.text + edited[end:]
        if edited != text.text:
            found.append(FileChange(path, file, content, text.encoded(edited)))
    return found


class FileText:
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


def offsets(source: Source, span: Span) -> tuple[int, int]:
    """Return where a span begins and ends in the text of a source."""
    return source.offset(span.line, span.column), source.offset(span.end_line, span.end_column)
