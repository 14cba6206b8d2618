"""What may be copied into a package to be published: meshes and pictures that are such, from around the description.

Whoever imports a URDF from elsewhere does not look at each name in it. What lies elsewhere on the disk, or is something
else behind the name of a mesh, is none of the robot's.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path

from urdfkit.description.packages.resolver import Packages
from urdfkit.errors import ResourceError

FOLDER_NAMES = ("meshes", "mesh", "textures", "materials")
"""What folders of meshes and pictures are called."""
_HOMES = frozenset({"urdf", "xacro", "robot", "robots", "model", "models", "description", "descriptions"})
"""Folders of descriptions: what belongs to a robot is also beside such a folder."""
_ABOVE = 4
"""How many folders above the description may be its package."""
_LFS = b"version https://git-lfs"

_BEGINS = {
    ".glb": (b"glTF",),
    ".ply": (b"ply\n", b"ply\r"),
    ".off": (b"OFF", b"COFF", b"NOFF", b"STOFF", b"CNOFF"),
    ".3ds": (b"MM",),
    ".fbx": (b"Kaydara FBX Binary", b"; FBX"),
    ".3mf": (b"PK",),
    ".mesh": (b"\0\x10[MeshSerializer", b"\x10\0[MeshSerializer"),
    ".png": (b"\x89PNG\r\n\x1a\n",),
    ".jpg": (b"\xff\xd8\xff",),
    ".jpeg": (b"\xff\xd8\xff",),
    ".gif": (b"GIF87a", b"GIF89a"),
    ".bmp": (b"BM",),
    ".tif": (b"II*\0", b"MM\0*"),
    ".tiff": (b"II*\0", b"MM\0*"),
    ".webp": (b"RIFF",),
    ".dds": (b"DDS ",),
    ".ktx": (b"\xabKTX",),
    ".ktx2": (b"\xabKTX",),
    ".hdr": (b"#?RADIANCE", b"#?RGBE"),
    ".exr": (b"\x76\x2f\x31\x01",),
    ".ppm": (b"P3", b"P6"),
    ".pgm": (b"P2", b"P5"),
}
"""Ending → what such a file begins with."""
_HOLDS = {
    ".dae": re.compile(rb"<(?:\w+:)?COLLADA\b"),
    ".obj": re.compile(rb"^[ \t]*(?:v[ \t]+[-+.\d]|f[ \t]+[-\d])", re.MULTILINE),
    ".mtl": re.compile(rb"^[ \t]*newmtl\b", re.MULTILINE),
    ".gltf": re.compile(rb'"asset"\s*:'),
    ".material": re.compile(rb"^\s*(?:\w+[ \t]+)?material\b", re.MULTILINE),
}
"""Ending → what is somewhere in such a file."""
_SHAPELESS = frozenset({".bin", ".tga"})
"""Buffers and pictures that begin with nothing of their own; only meshes name them."""
_STEREOLITHOGRAPHY = frozenset({".stl", ".stlb"})
KNOWN = frozenset({*_BEGINS, *_HOLDS, *_SHAPELESS, *_STEREOLITHOGRAPHY})
"""Endings of what is copied."""


def unlike(path: Path) -> str:
    """Return why a file is not to be copied as a mesh, a picture or what a mesh needs; empty if it is one.

    Args:
        path: of the file; its ending says what it should be.
    """
    ending = path.suffix.lower()
    if ending not in KNOWN:
        return f"ends in `{path.suffix}`, as no mesh or picture does" if ending else "has no ending of a mesh"
    try:
        content = path.read_bytes()
    except OSError as error:
        return f"cannot be read: {error.strerror}"
    if content.startswith(_LFS):
        return "is a pointer of Git LFS: run `git lfs pull`"
    if not content:
        return "is empty"
    if ending in _STEREOLITHOGRAPHY:
        return "" if _is_stl(content) else "is no STL"
    if ending in _BEGINS:
        return "" if content.startswith(_BEGINS[ending]) else f"is no {ending[1:].upper()}"
    if ending in _HOLDS:
        plain = content.replace(b"\0", b"") if content[:2] in (b"\xff\xfe", b"\xfe\xff") else content
        return "" if _HOLDS[ending].search(plain) else f"is no {ending[1:].upper()}"
    return "" if b"\0" in content or ending == ".tga" else "is text"


def _is_stl(content: bytes) -> bool:
    """Tell an STL, also one that is cut off, from what is none: text with facets, or so many records of 50 bytes."""
    if content.lstrip()[:5].lower() == b"solid" and b"facet" in content.lower():
        return True
    triangles = int.from_bytes(content[80:84], "little")
    return len(content) >= 84 and b"\0" in content and 84 + 50 * triangles <= 2 * len(content)


class Surroundings:
    """The folders whose files belong to a description: its own, its package, packages it names, those told of.

    Args:
        description: the file.
        folders: more that may be taken from.
        packages: finds packages by name.
    """

    def __init__(self, description: Path, folders: Iterable[Path], packages: Packages) -> None:
        self._packages = packages
        home = description.resolve().parent
        self._roots = {home, *(folder.resolve() for folder in folders)}
        near = (home, *list(home.parents)[:_ABOVE])
        self._roots |= {above.parent for above in near if above.name.lower() in _HOMES}
        self._roots |= {above / name for above in near for name in FOLDER_NAMES if (above / name).is_dir()}
        package = _package_of(home)
        if package is not None:
            self._roots.add(package)
        self._workspace = package.parent if package is not None else None

    def hold(self, path: Path, uri: str = "") -> bool:
        """Tell whether a file lies in one of them.

        Args:
            path: of the file, with links followed.
            uri: that led there; ``package://`` of a package that is there may be elsewhere, inside that package.
        """
        path = path.resolve()
        if any(path.is_relative_to(root) for root in self._roots):
            return True
        # Packages of one workspace lie side by side.
        package = _package_of(path.parent)
        if package is not None and self._workspace is not None and package.parent == self._workspace:
            return True
        scheme, separator, rest = uri.strip().partition("://")
        if not separator or scheme not in ("package", "model"):
            return False
        try:
            found = self._packages.find(rest.partition("/")[0])
        except ResourceError:
            return False
        described = any((found / name).is_file() for name in ("package.xml", "model.config"))
        return described and path.is_relative_to(found.resolve())


def _package_of(folder: Path) -> Path | None:
    """Return the package around a folder, None if there is none near."""
    for above in (folder, *list(folder.parents)[:_ABOVE]):
        if (above / "package.xml").is_file():
            return above
    return None
