"""The meshes and pictures that a description uses: find them, say where they go, copy what they need themselves."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator, Sequence
from html import unescape
from pathlib import Path, PurePosixPath
from urllib.parse import unquote

from urdfkit.description.packages.resolver import Packages
from urdfkit.errors import ResourceError
from urdfkit.scaffold.templates.names import ascii_letters
from urdfkit.scaffold.wrap.asset_copying import FOLDER_NAMES, Surroundings, unlike

URI = re.compile(r"""(<(?:mesh|texture)\b[^>]*?\bfilename\s*=\s*)(["'])(.*?)\2""", re.DOTALL)
"""The files that elements of URDF name."""

_ABOVE = 4
"""How many folders above the description are looked into."""
_NEEDS = {
    ".obj": re.compile(r"(?m)^\s*mtllib\s+(.+?)\s*$"),
    ".mtl": re.compile(r"(?m)^\s*(?:map_\w+|bump|disp|decal|refl)\s+(?:-\S+\s+\S+\s+)*(\S.*?)\s*$"),
    ".dae": re.compile(r"<init_from>\s*(?:file://)?([^<]+?)\s*</init_from>"),
    ".gltf": re.compile(r'"uri"\s*:\s*"(?!data:)([^"]+)"'),
}
"""What a file of that kind says it needs: libraries of materials, pictures, buffers."""


class Meshes:
    """Where the files of a description are, and where they go in a new package.

    Args:
        description: the file that names them.
        folders: where to look first.
    """

    def __init__(self, description: Path, folders: Sequence[Path] = ()) -> None:
        self.description = description
        self.folders = folders
        self.packages = Packages(folders, description)
        self.copies: dict[Path, str] = {}
        """File → its path in the package, from ``meshes/`` on."""
        self.missing: list[str] = []
        """URIs that nothing was found for."""
        self.refused: dict[str, str] = {}
        """URI → why the file it leads to is not copied."""
        self.left: dict[Path, str] = {}
        """File that a mesh names → why it is not copied."""
        self._surroundings = Surroundings(description, folders, self.packages)

    def uri(self, written: str, package: str) -> str:
        """Return the URI of a file in the new package; as it was where the file is not found.

        Args:
            written: the URI as written in XML.
            package: the name of the new package; empty: relative to a folder beside ``meshes``.
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
            package: its folder.

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
        """Give a file its place, and those it needs the same places about it as they have now."""
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
                if not self._surroundings.hold(needed):
                    self.left[needed] = "not near the robot"
                elif reason := unlike(needed):
                    self.left[needed] = reason
                else:
                    self._add(needed, str(about))

    def _reason(self, path: Path, uri: str = "") -> str:
        """Return why a file is not copied, empty if it is."""
        if not self._surroundings.hold(path, uri):
            return f"leads to {path}, which is not near the robot: copy it there, or --meshes DIR if it is the robot's"
        return unlike(path)

    def _chosen(self, uri: str, written: str) -> Path | None:
        """Return the first file that a URI may mean and that may be copied; note why others may not."""
        for path in self._candidates(uri):
            if path in self.copies:
                return path
            reason = self._reason(path, uri)
            if not reason:
                return path
            self.refused.setdefault(written, reason)
        return None

    def _candidates(self, uri: str) -> Iterator[Path]:
        """Yield the files that a URI may mean, the likeliest first."""
        try:
            path = self.packages.resolve(uri, self.description)
            if path.is_file():
                yield path.resolve()
        except ResourceError:
            pass
        tail = _tail(uri)
        homes = [*self.folders, *self.description.resolve().parents[:_ABOVE]]
        for home in homes:
            # With and without the first part: the name of a package that is not there, or a folder of that name.
            for parts in (tail.parts, tail.parts[1:]):
                if parts and (path := home.joinpath(*parts)).is_file():
                    yield path.resolve()
        for home in (*self.folders, self.description.resolve().parent, self.description.resolve().parent.parent):
            found = [path for path in _below(home) if _alike(path.name) == _alike(tail.name)]
            if len(found) == 1:
                yield found[0].resolve()


def _alike(name: str) -> str:
    """Return a file's name as it compares: case aside, and whether an umlaut is one character or two."""
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
    """Return what a URI says after its scheme."""
    path = re.sub(r"^(?:package|model|file)://", "", uri.strip()).replace("\\", "/")
    return PurePosixPath(re.sub(r"^(?:[A-Za-z]:)?/+", "", path))


def _place(uri: str) -> str:
    """Return where a file goes: below ``meshes``, with the folders that it had below one of that name.

    Blanks, commas, ``#``, ``%`` and what else a URI has to escape become ``_``, and letters lose their accents: not
    everybody escapes alike.
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
