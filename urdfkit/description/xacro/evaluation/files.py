"""Files: what one expansion reads: the entry, included files and YAML files; and the warnings it collects."""

from __future__ import annotations

import errno
import os
import re
from collections.abc import Iterator, Mapping
from pathlib import Path

from urdfkit.description.packages.resolver import NOT_READ, OUTSIDE
from urdfkit.description.xacro.evaluation.expressions.functions import Functions
from urdfkit.description.xacro.evaluation.expressions.limits import (
    MAX_INCLUDE_DEPTH,
    MAX_INCLUDES,
    MAX_YAML,
    TooLarge,
    check_length,
)
from urdfkit.description.xacro.evaluation.expressions.symbols import Scope
from urdfkit.description.xacro.evaluation.failures import Failure, cycle, recursive_include, short
from urdfkit.description.xacro.evaluation.texts import Texts, unreadable
from urdfkit.description.xacro.evaluation.tree import Tag
from urdfkit.description.xacro.evaluation.tree_reader import read_tree
from urdfkit.description.xacro.faults import Warned
from urdfkit.description.xml.extended_text import ExtendedText
from urdfkit.description.xml.reader import read_source, shown_path
from urdfkit.description.xml.source import Position, Source, absolute, content_of
from urdfkit.errors import ResourceError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from urdfkit.description.packages.resolver import Packages


class Files(Texts):
    """Reads the files of one expansion.

    Attributes:
        files: every file that was read, absolute, in order.
        sources: the text of every XML file that was read, by the name shown.
        file_stack: the files that are open, outermost first.
        warnings: of directives, and messages of the file.
        untraced: how often something was read or done that a memory cannot repeat.
        globals: the names that every expression can use.
    """

    def __init__(
        self, path: str, arguments: Mapping[str, str], packages: Packages, *, texts: Mapping[str, str] | None = None
    ) -> None:
        super().__init__(arguments, self._find, packages.variable)
        if packages.hides_variables:
            self.commands.unset = NOT_READ
        self.path, self.packages = path, packages
        self._texts = texts
        self.files: dict[Path, None] = {}
        self.sources: dict[str, Source] = {}
        self.file_stack: list[str] = [path]
        self.warnings: list[Warned] = []
        self._opened = self.untraced = 0
        host: dict[str, Any] = {
            "load_yaml": self._load_yaml,
            "abs_filename": self._absolute,
            "arg": self._argument_value,
            "message": lambda *words, **_: self._record_message("message", words),
            "warning": lambda *words, **_: self._record_message("warning", words),
            "error": lambda *words, **_: self._record_message("error", words),
            "print_location": lambda *_, **__: "",
        }
        functions = Functions(self.budget, lambda function: self.expressions.callable_of(function))
        self.globals = functions.symbols(host, self.warn)

    def warn(self, message: str) -> None:
        """Record a warning at the place that is being evaluated."""
        self._record_message("warning", (message,))

    def redefined(self, name: str) -> None:
        """Warn about a property with the name of a global."""
        self.warn(f"redefining global symbol: {name}")

    def open(self, path: Path) -> Tag:
        """Read a file into a tree.

        Raises:
            ResourceError: it cannot be read.
            XmlError: it is not well-formed, or hostile.
        """
        if path.is_dir():
            raise ResourceError(f"{path} is a folder, not a description")
        shown = shown_path(path)
        self.files.setdefault(absolute(path))
        source = self.sources.get(shown)
        if source is None:
            source = self.sources[shown] = read_source(path, shown_as=shown, texts=self._texts)
        document = self._document(source)
        if isinstance(source.text, ExtendedText):
            self.sources[shown] = source.text.original
        return document

    def _document(self, source: Source) -> Tag:
        return self._read(source)

    def _read(self, source: Source) -> Tag:
        return read_tree(source)

    def open_included(self, file: str) -> Tag:
        """Read an included file, put it on the stack of files, and return its document element.

        Raises:
            Failure: it cannot be read.
            XmlError: it is not well-formed, or hostile.
        """
        self.file_stack.append(file)
        if len(self.file_stack) > MAX_INCLUDE_DEPTH:
            raise self.placed(recursive_include(cycle([shown_path(_target(name)) for name in self.file_stack])))
        self._opened += 1
        if self._opened > MAX_INCLUDES:
            message = f"more than {MAX_INCLUDES:,} files are included; check for nested includes"
            raise self.placed(Failure("too-many", message))
        try:
            document = self.open(Path(file))
        except (OSError, ResourceError, ValueError) as error:  # ValueError: the name has a character that no file has
            self.file_stack.pop()
            missing = OSError(str(error))
            missing.filename = file
            failure = unreadable(missing, is_include=True, user=Path(self.file_stack[-1]) if self.file_stack else None)
            failure.is_missing_file = not isinstance(error, ValueError)
            raise self.placed(failure) from None
        return next(document.tags())

    def included_files(self, node: Tag, specification: str, scope: Scope) -> Iterator[str]:
        """Yield the paths of the files that an include names."""
        self.at = (node, "filename")
        text = self.text(specification, scope)
        if not isinstance(text, str):
            raise self.placed(Failure("other", f"the file name `{short(str(text))}` is not text"))
        try:
            path = self._absolute(text)
            is_pattern = re.search("[*[?]+", path) is not None
            found = sorted(self._matching(path)) if is_pattern else [path]
        except OSError as error:
            raise self.placed(unreadable(error, is_include=True)) from None
        except TooLarge as error:
            raise self.placed(Failure("too-large", f"cannot include `{short(text)}`: {error}")) from None
        if not found:
            self.at = (node, None)
            self.warn(f'Include tag\'s filename spec "{path}" matched no files.')
        yield from found

    def _matching(self, pattern: str) -> Iterator[str]:
        """Yield the paths that `glob.glob` finds, and count the entries of listed folders as steps."""
        import fnmatch
        import glob

        folder, name = os.path.split(pattern)
        for parent in self._matching(folder) if glob.has_magic(folder) and folder != pattern else [folder]:
            if glob.has_magic(name):
                try:
                    names = os.listdir(parent or ".")  # noqa: PTH208 - names, not paths
                except OSError:
                    continue
                self.budget.spend(8 + len(names))
                found = [one for one in fnmatch.filter(names, name) if name[0] == "." or one[0] != "."]
            else:
                path = os.path.join(parent, name)  # noqa: PTH118
                found = [name] if os.path.lexists(path) and (name or Path(parent).is_dir()) else []
            for one in found:
                yield os.path.join(parent, one)  # noqa: PTH118

    def printed(self, document: Tag) -> str:
        """Return the text that stock xacro prints for an expanded document."""
        from urdfkit.description.xacro.evaluation.printing import printed

        return printed(document, self.path)

    def _absolute(self, name: str) -> str:
        self.untraced += 1
        folder = os.path.dirname(self.file_stack[-1])  # noqa: PTH120 - the text that stock xacro makes
        path = os.path.join(folder, name)  # noqa: PTH118
        if not self.packages.permits(path):
            raise PermissionError(errno.EACCES, OUTSIDE, path)
        check_length(path)
        if not os.path.exists(path) and (moved := self.packages.relocate(path)) is not None:  # noqa: PTH110 - `Path.exists` raises without permission
            return str(moved)
        return self._in_any_case(path, name)

    def _in_any_case(self, path: str, name: str) -> str:
        """Return the path of a file; in other capital letters if only such a file exists."""
        if os.path.exists(path):  # noqa: PTH110 - as above
            return path
        tag, _ = self.at
        found = self.packages.in_any_case(Path(path), name, None if tag is None else tag.position)
        return path if found is None else str(found)

    def _load_yaml(self, name: str) -> Any:
        from urdfkit.description.xacro.evaluation.yaml_files import yaml_values

        path = self._absolute(name)
        self.files.setdefault(absolute(path))
        content = content_of(Path(path), MAX_YAML + 1)
        if len(content) > MAX_YAML:
            raise TooLarge(f"{path} is larger than {MAX_YAML // 1000:,} kB")
        text = content.decode()
        self.file_stack.append(path)
        try:
            found = yaml_values(
                text,
                shown_path(Path(path)),
                lambda value: self.expressions.evaluate(value, self.globals),
                self.budget.spend,
            )
            return self.budget.checked(found)
        finally:
            self.file_stack.pop()

    def _argument_value(self, name: str) -> str:
        self.untraced += 1
        return self.commands.argument(name)

    def _find(self, name: str) -> str:
        try:
            return str(self.packages.find(name))
        except ResourceError as error:
            raise Failure("package-not-found", error.message, name=name) from None

    def _record_message(self, level: Any, words: tuple[object, ...]) -> str:
        self.untraced += 1
        tag, _ = self.at
        position = tag.position if tag is not None else Position(shown_path(self.path), 1, 1)
        self.warnings.append(Warned(" ".join(map(str, words)), position, tag.chain if tag is not None else (), level))
        return ""


def _target(file: str) -> str:
    """Return the file that a name stands for: that of a symbolic link, which may lead back to a file on the stack."""
    return os.path.join(os.path.dirname(file), os.readlink(file)) if os.path.islink(file) else file  # noqa: PTH114, PTH115, PTH118, PTH120
