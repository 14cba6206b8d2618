"""``urdfkit format``: format URDF and xacro files without a change of the robot."""

import argparse
import sys
from collections.abc import Iterator
from pathlib import Path

from urdfkit.cli.colors import colored_diff
from urdfkit.errors import ResourceError, UrdfkitError, UsageError
from urdfkit.lint.fixes.file_changes import FileChange

_EPILOG = """examples:
  urdfkit format urdf/robot.urdf.xacro
  urdfkit format --check src

exit status: 0 formatted, or nothing to change; 1 with --check or --diff: files would change; 2 a file cannot be read
keep a part of a file as it is:
  <!-- urdfkit: format off -->  to  <!-- urdfkit: format on -->
settings: indent in [format] of urdfkit.toml, or in [tool.urdfkit.format] of pyproject.toml"""


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    add = parser.add_argument
    add(
        "paths",
        nargs="*",
        metavar="PATH",
        help="files, or folders with .urdf and .xacro files (default: the working directory); "
        "- formats standard input to standard output",
    )
    mode = parser.add_mutually_exclusive_group()
    mode.add_argument("--check", action="store_true", help="list the files that would change, without changing them")
    mode.add_argument("--diff", action="store_true", help="print the changes without writing them")
    add("--indent", type=_indent, metavar="N", help="number of spaces for each level (default: 2)")
    parser.epilog = _EPILOG


def _indent(text: str) -> int:
    from urdfkit.description.xml.formatting import MAX_INDENT

    if not text.isdecimal() or not 1 <= int(text) <= MAX_INDENT:
        from argparse import ArgumentTypeError

        raise ArgumentTypeError(f"`{text}` is not a number of spaces from 1 to {MAX_INDENT}")
    return int(text)


def run(arguments: argparse.Namespace) -> int:
    """Format files; return the exit code.

    Raises:
        UsageError: standard input is combined with files.
        ResourceError: a path does not exist.
    """
    if "-" in arguments.paths:
        if arguments.paths != ["-"] or arguments.check or arguments.diff:
            raise UsageError("format: - reads standard input and cannot be combined with paths, --check or --diff")
        sys.stdout.write(_formatted("<stdin>", sys.stdin.buffer.read(), _indent_for(Path.cwd(), arguments)))
        return 0
    count = failed = 0
    changes: list[FileChange] = []
    for path in _files(arguments.paths or ["."], quiet=arguments.quiet):
        count += 1
        try:
            change = _change(path, arguments)
        except UrdfkitError as error:
            print(f"urdfkit: {error}", file=sys.stderr)
            failed += 1
            continue
        if change is not None:
            changes.append(change)
            if arguments.diff:
                sys.stdout.write(colored_diff(change.diff()))
            elif arguments.check:
                print(f"would format {change.shown}")
            else:
                change.write()
    if not arguments.quiet:
        verb = "would change" if arguments.check or arguments.diff else "formatted"
        kept = count - len(changes) - failed
        print(f"{_number(len(changes))} {verb}, {_number(kept)} unchanged", file=sys.stderr)
    return 2 if failed else 1 if changes and (arguments.check or arguments.diff) else 0


def _files(words: list[str], *, quiet: bool) -> Iterator[Path]:
    """Yield the files to format; generated files only where they are named.

    Raises:
        ResourceError: a path does not exist.
    """
    from urdfkit.description.xml.reader import shown_path
    from urdfkit.lint.fixes.generated_files import reason_if_generated
    from urdfkit.lint.project.description_files import walk

    for word in words:
        path = Path(word)
        if path.is_file():
            yield path
        elif not path.is_dir():
            from urdfkit.missing_files import missing_path

            raise ResourceError(missing_path(word, "file or folder"))
        else:
            for file in walk(path):
                reason = reason_if_generated(file, file.read_text("utf-8", "replace"))
                if not reason:
                    yield file
                elif not quiet:
                    print(
                        f"urdfkit: {shown_path(file)} is skipped: {reason}; name the file to format it", file=sys.stderr
                    )


def _change(path: Path, arguments: argparse.Namespace) -> FileChange | None:
    """Return the change of a file; None if the file is formatted already."""
    from urdfkit.description.xml.reader import shown_path
    from urdfkit.description.xml.source import content_of

    shown = shown_path(path)
    try:
        before = content_of(path)
    except OSError as error:
        raise ResourceError(f"cannot read {shown}: {error.strerror or error}") from error
    after = _formatted(shown, before, _indent_for(path, arguments)).encode()
    if before.startswith(_MARK):
        after = _MARK + after
    return None if after == before else FileChange(path.absolute(), shown, before, after)


_MARK = b"\xef\xbb\xbf"
"""Byte order mark of UTF-8."""


def _formatted(shown: str, content: bytes, indent: int) -> str:
    from urdfkit.description.xml.formatting import formatted
    from urdfkit.description.xml.reader import MAX_BYTES
    from urdfkit.description.xml.source import Source

    if len(content) > MAX_BYTES:
        raise ResourceError(f"{shown} is larger than {MAX_BYTES // 2**20} MiB, the limit for a robot description")
    return formatted(Source.decode(shown, content), indent=indent)


def _indent_for(path: Path, arguments: argparse.Namespace) -> int:
    from urdfkit.lint.engine.settings import find

    return int(arguments.indent or find(path).indent)


def _number(count: int) -> str:
    return f"{count} file{'' if count == 1 else 's'}"
