"""Parameters and controllers that a ROS 1 launch file loads and spawns; conditions and includes are not evaluated."""

import re
from pathlib import Path

from urdfkit.description.control.parameter_yaml import parse_settings, read_settings
from urdfkit.description.control.settings import Settings
from urdfkit.description.packages.existence import is_file
from urdfkit.description.packages.resolver import Packages
from urdfkit.description.xml.element import Element
from urdfkit.description.xml.reader import document_of, read_source, shown_path
from urdfkit.description.xml.source import Source
from urdfkit.errors import ResourceError, UrdfkitError
from urdfkit.record import field, record

_SUBSTITUTION = re.compile(r"\$\(\s*(\w[\w-]*)\s+([^()]*?)\s*\)")
_STARTING = ("spawner", "controller_manager")


@record(eq=False)
class Launch:
    """Parameters and spawned controllers of one launch file.

    Attributes:
        path: the file.
        files: the loaded parameter files.
        settings: all loaded parameters, in their namespaces; None if the file loads none.
        spawned: full names of the spawned controllers, in order.
    """

    path: Path
    files: tuple[Path, ...]
    settings: Settings | None = field(repr=False)
    spawned: tuple[str, ...]


def read_launch(path: Path, packages: Packages) -> Launch | None:
    """Read a launch file; None if it is not readable XML."""
    try:
        root = document_of(read_source(path, shown_as=shown_path(path)))
    except UrdfkitError:
        return None
    reader = _Launch(path, packages)
    reader.enter(root, "")
    return Launch(path, tuple(reader.files), reader.settings, tuple(dict.fromkeys(reader.spawned)))


class _Launch:
    def __init__(self, path: Path, packages: Packages) -> None:
        self._path = path
        self._packages = packages
        self._arguments: dict[str, str] = {}
        self.files: list[Path] = []
        self.settings: Settings | None = None
        self.spawned: list[str] = []

    def enter(self, element: Element, namespace: str) -> None:
        """Read the children of an element; namespaces accumulate."""
        for child in element.children:
            inside = _join(namespace, self._text(child.get("ns") or "") or "")
            if child.tag == "arg":
                value = child.get("value") or child.get("default")
                if value is not None and (text := self._text(value)) is not None:
                    self._arguments[child.get("name") or ""] = text
            elif child.tag == "rosparam" and (child.get("command") or "load") == "load":
                self._load(child, inside)
            elif child.tag == "group":
                self.enter(child, inside)
            elif child.tag == "node":
                if child.get("pkg") == "controller_manager" and child.get("type") in _STARTING:
                    self._spawn(child, inside)
                self.enter(child, _join(inside, child.get("name") or ""))

    def _load(self, element: Element, namespace: str) -> None:
        namespace = _join(namespace, self._text(element.get("param") or "") or "")
        if (written := element.get("file")) is not None:
            name = self._text(written)
            if name is None:
                return
            path = self._path.parent / name
            if not is_file(path):
                return
            self.files.append(path)
            read = read_settings(path)
        elif element.text:
            read = parse_settings(Source(str(element.origin.position), element.text))
        else:
            return
        below = read.below(namespace)
        self.settings = below if self.settings is None else self.settings.merged(below)

    def _spawn(self, node: Element, namespace: str) -> None:
        words = (self._text(node.get("args") or "") or "").split()
        skip = False
        for word in words:
            if skip:
                namespace, skip = _join(namespace, word), False
            elif word in ("--namespace", "-n"):
                skip = True
            elif word.startswith("--namespace="):
                namespace = _join(namespace, word.partition("=")[2])
            elif not word.startswith("-") and ":=" not in word and word not in ("spawn", "load", "start"):
                self.spawned.append(_join(namespace, word))

    def _text(self, text: str) -> str | None:
        """Substitute ``$(find …)`` and ``$(arg …)``; None if one is unknown."""
        for _ in range(10):
            match = _SUBSTITUTION.search(text)
            if match is None:
                return text if "$(" not in text else None
            kind, name = match[1], match[2]
            if kind == "find":
                try:
                    value = str(self._packages.find(name))
                except ResourceError:
                    return None
            elif kind == "arg" and name in self._arguments:
                value = self._arguments[name]
            else:
                return None
            text = text[: match.start()] + value + text[match.end() :]
        return None


def _join(namespace: str, name: str) -> str:
    return name if name.startswith("/") else f"{namespace}/{name}".rstrip("/") if name else namespace
