"""Context of a reader: the SDF version, the search for files, and the notes so far."""

from __future__ import annotations

import re
from pathlib import Path

from urdfkit.description.packages.resolver import Packages
from urdfkit.description.sdf.values import wrong
from urdfkit.description.xml.element import Element
from urdfkit.description.xml.reader import document_of, read_source, shown_path
from urdfkit.description.xml.source import absolute
from urdfkit.errors import DescriptionError, did_you_mean
from urdfkit.notice import Notice

OLDEST, NEWEST = (1, 4), (1, 11)
"""The supported versions of SDF."""

_MAX_NESTING = 20
_VERSION = re.compile(r"^(\d+)\.(\d+)$")


class Context:
    """State of the reader: the current file and its version of SDF.

    Args:
        packages: resolver of ``model://`` and ``package://``.
        path: the current file.
        text: content to use instead of the file on disk; None for the file.

    Attributes:
        notes: notes for the user, shared by all files of a world.
        files: the files read, in order.
        version: SDF version of the current file.
    """

    def __init__(self, packages: Packages, path: Path, text: str | None = None) -> None:
        self.packages = packages
        self.path = absolute(path)
        self._texts = {} if text is None else {str(self.path): text}
        self.version = NEWEST
        self.notes: list[str] = []
        self.files: list[Path] = []
        self._documents: dict[Path, Element] = {}
        self._above: tuple[Path, ...] = ()

    def open(self) -> Element:
        """Read this file and return its root; sets `version`.

        Raises:
            ResourceError: the file cannot be read.
            XmlError: the file is not well-formed, declares entities, or exceeds a limit.
            DescriptionError: the file is not SDF of a supported version.
        """
        root = self._documents.get(self.path)
        if root is None:
            root = document_of(read_source(self.path, shown_as=shown_path(self.path), texts=self._texts))
            self._documents[self.path] = root
            self.files.append(self.path)
        if root.tag == "sdf":
            self.version = self._version(root)
        return root

    def enter(self, path: Path, at: Element) -> Context:
        """Return the context of a file that this one includes.

        Raises:
            DescriptionError: files include each other in a cycle.
        """
        inner = Context(self.packages, path)
        inner.notes, inner.files, inner._documents = self.notes, self.files, self._documents
        inner._above = (*self._above, self.path)
        if inner.path in inner._above or len(inner._above) > _MAX_NESTING:
            raise wrong(at, f"{shown_path(path)} includes itself")
        return inner

    def note(self, element: Element, text: str, cause: str | None = None, package: str = "") -> None:
        """Add a note about an element, once; see `Notice` for its cause and package."""
        at = element.origin.position
        line = Notice(f"{at}: {text}", position=at, cause=cause, package=package)
        if line not in self.notes:
            self.notes.append(line)

    def _version(self, root: Element) -> tuple[int, int]:
        written = root.get("version")
        if written is None:
            raise wrong(root, f'<sdf> has no version: write <sdf version="1.{min(NEWEST[1], 9)}">')
        found = _VERSION.match(written.strip())
        if found is None:
            raise wrong(root, f"version `{written}` is not a version of SDF" + did_you_mean(written, ["1.6", "1.9"]))
        version = int(found[1]), int(found[2])
        if version < OLDEST or version[0] > NEWEST[0]:
            oldest, newest = (".".join(map(str, each)) for each in (OLDEST, NEWEST))
            raise wrong(root, f"SDF {written} is not supported; supported versions are {oldest} to {newest}")
        if version > NEWEST:
            self.note(root, f"SDF {written} is newer than 1.{NEWEST[1]}; newer elements are ignored")
        return version


def root_error(root: Element) -> DescriptionError:
    """Return the error for a file that is not SDF."""
    if root.tag == "robot":
        return wrong(
            root, "this is a robot; an SDF world starts with <sdf>: pass the robot as ROBOT, or include it in a world"
        )
    return wrong(root, "an SDF world starts with <sdf> and contains a <world> or a <model>")
