"""Meshes and textures of a description: search, new paths, and copies of the files that they depend on."""

import re
import unicodedata
from collections.abc import Iterator, Sequence
from html import unescape
from pathlib import Path, PurePosixPath
from urllib.parse import unquote

from urdfkit.description.packages.resolver import Packages
from urdfkit.errors import ResourceError
from urdfkit.scaffold.templates.names import ascii_letters
from urdfkit.scaffold.wrap.accepted_assets import FOLDER_NAMES, RobotFolders, rejection

URI = re.compile(r"""(<(?:mesh|texture)\b[^>]*?\bfilename\s*=\s*)(["'])(.*?)\2""", re.DOTALL)
"""URIs in mesh and texture elements of URDF."""

_ABOVE = 4
"""Number of folders above the description that are searched."""
_NEEDS = {
    ".obj": re.compile(r"(?m)^\s*mtllib\s+(.+?)\s*$"),
    ".mtl": re.compile(r"(?m)^\s*(?:map_\w+|bump|disp|decal|refl)\s+(?:-\S+\s+\S+\s+)*(\S.*?)\s*$"),
    ".dae": re.compile(r"<init_from>\s*(?:file://)?([^<]+?)\s*</init_from>"),
    ".gltf": re.compile(r'"uri"\s*:\s*"(?!data:)([^"]+)"'),
}
"""Suffix → pattern of references to material libraries, textures and buffers."""


class Meshes:
    """Files of a description, and their paths in a new package.

    Args:
        description: the description.
        folders: folders that are searched first.
    """

    def __init__(self, description: Path, folders: Sequence[Path] = ()) -> None:
        self.description = description
        self.folders = folders
        self.packages = Packages(folders, description)
        self.copies: dict[Path, str] = {}
        """File → its path in the package, beginning with ``meshes/``."""
        self.missing: list[str] = []
        """URIs without a file."""
        self.refused: dict[str, str] = {}
        """URI → why its file is not copied."""
        self.left: dict[Path, str] = {}
        """File that a mesh depends on → why it is not copied."""
        self._robot_folders = RobotFolders(description, folders, self.packages)

    def uri(self, written: str, package: str) -> str:
        """Return the URI of a file in the new package; the original URI if the file is not found.

        Args:
            written: the URI as written in XML.
            package: name of the new package; empty: the URI is relative to a folder next to ``meshes``.
        """
        uri = unescape(written)
        if written in self.refused:
            return written
        source = self._chosen(uri, written)
        if source is None and "%" in uri:
            uri = unquote(uri)
            source = self._chosen(uri, written)
        if source is None:
            self.missing += [written] if written not in (*self.missing, *self.refused) else []
            return written
        self.refused.pop(written, None)
        if source not in self.copies:
            self._add(source, _place(uri))
        return f"package://{package}/{self.copies[source]}" if package else f"../{self.copies[source]}"

    def copy(self, package: Path) -> None:
        """Copy the files into the new package.

        Args:
            package: folder of the package.

        Raises:
            ResourceError: a file cannot be read or written.
        """
        for source, place in self.copies.items():
            target = package / place
            try:
                target.parent.mkdir(parents=True, exist_ok=True)
                target.write_bytes(source.read_bytes())
            except OSError as error:
                raise ResourceError(f"cannot copy {source} to {target}: {error.strerror}") from error

    def _add(self, source: Path, place: str) -> None:
        """Choose the path of a file, and keep the relative paths of the files that it depends on."""
        taken = set(self.copies.values())
        stem, number = PurePosixPath(place), 1
        while place in taken:
            number += 1
            place = str(stem.with_name(f"{stem.stem}_{number}{stem.suffix}"))
        self.copies[source] = place
        for name in _needs(source):
            needed = (source.parent / name).resolve()
            about = PurePosixPath(place).parent / name
            if needed.is_file() and needed not in self.copies and ".." not in about.parts and not name.startswith("/"):
                if not self._robot_folders.contain(needed):
                    self.left[needed] = "outside the folders of the robot"
                elif reason := rejection(needed):
                    self.left[needed] = reason
                else:
                    self._add(needed, str(about))

    def _reason(self, path: Path, uri: str = "") -> str:
        """Return why a file is not copied; empty if it is copied."""
        if not self._robot_folders.contain(path, uri):
            return (
                f"refers to {path}, outside the folders of the robot: copy the file there, or use --meshes DIR if it "
                "belongs to the robot"
            )
        return rejection(path)

    def _chosen(self, uri: str, written: str) -> Path | None:
        """Return the first candidate for a URI that may be copied; record why others are rejected."""
        for path in self._candidates(uri):
            if path in self.copies:
                return path
            reason = self._reason(path, uri)
            if not reason:
                return path
            self.refused.setdefault(written, reason)
        return None

    def _candidates(self, uri: str) -> Iterator[Path]:
        """Yield the files that a URI may refer to, most likely first."""
        try:
            path = self.packages.resolve(uri, self.description)
            if path.is_file():
                yield path.resolve()
        except ResourceError:
            pass
        tail = _tail(uri)
        homes = [*self.folders, *self.description.resolve().parents[:_ABOVE]]
        for home in homes:
            # The first component may be the name of a missing package, or of a folder.
            for parts in (tail.parts, tail.parts[1:]):
                if parts and (path := home.joinpath(*parts)).is_file():
                    yield path.resolve()
        for home in (*self.folders, self.description.resolve().parent, self.description.resolve().parent.parent):
            found = [path for path in _below(home) if _alike(path.name) == _alike(tail.name)]
            if len(found) == 1:
                yield found[0].resolve()


def _alike(name: str) -> str:
    """Return a normalized file name for comparison: case-insensitive, with composed characters."""
    return unicodedata.normalize("NFC", name).lower()


def _needs(source: Path) -> list[str]:
    pattern = _NEEDS.get(source.suffix.lower())
    if pattern is None:
        return []
    try:
        return [name.replace("\\", "/") for name in pattern.findall(source.read_text("utf-8", "replace"))]
    except OSError:
        return []


def _tail(uri: str) -> PurePosixPath:
    """Return the path in a URI, without the scheme."""
    path = re.sub(r"^(?:package|model|file)://", "", uri.strip()).replace("\\", "/")
    return PurePosixPath(re.sub(r"^(?:[A-Za-z]:)?/+", "", path))


def _place(uri: str) -> str:
    """Return the path of a file in the package: below ``meshes``, with its folders below a folder for meshes.

    Blanks, commas, ``#``, ``%`` and other characters that must be escaped in URIs are replaced by ``_``, and accents
    are removed, because tools differ in how they unescape URIs.
    """
    parts = [
        re.sub(r"[^\w.+-]+", "_", ascii_letters(part), flags=re.ASCII)
        for part in _tail(uri).parts
        if part not in (".", "..")
    ]
    named = [index for index, part in enumerate(parts[:-1]) if part.lower() in FOLDER_NAMES]
    return str(PurePosixPath("meshes", *(parts[named[-1] + 1 :] if named else parts[-1:])))


def _below(home: Path, depth: int = 3) -> Iterator[Path]:
    try:
        children = sorted(home.iterdir())
    except OSError:
        return
    for child in children[:5000]:
        if child.is_file():
            yield child
        elif depth > 0 and child.is_dir() and not child.is_symlink() and not child.name.startswith("."):
            yield from _below(child, depth - 1)
