"""Validation of the meshes and textures that are copied into a package.

A URDF from another source may refer to any file of the disk. Only files with the content of a mesh or texture, and from
folders that belong to the robot, are copied.
"""

import re
from collections.abc import Iterable
from pathlib import Path

from urdfkit.description.lfs_pointer import LFS, POINTER
from urdfkit.description.packages.resolver import Packages
from urdfkit.errors import ResourceError

FOLDER_NAMES = ("meshes", "mesh", "textures", "materials")
"""Names of folders for meshes and textures."""
_HOMES = frozenset({"urdf", "xacro", "robot", "robots", "model", "models", "description", "descriptions"})
"""Names of folders for descriptions; their parent folder belongs to the robot, too."""
_ABOVE = 4
"""Maximum number of folders from the description up to its package."""

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
"""Suffix → possible beginnings of the content."""
_HOLDS = {
    ".dae": re.compile(rb"<(?:\w+:)?COLLADA\b"),
    ".obj": re.compile(rb"^[ \t]*(?:v[ \t]+[-+.\d]|f[ \t]+[-\d])", re.MULTILINE),
    ".mtl": re.compile(rb"^[ \t]*newmtl\b", re.MULTILINE),
    ".gltf": re.compile(rb'"asset"\s*:'),
    ".material": re.compile(rb"^\s*(?:\w+[ \t]+)?material\b", re.MULTILINE),
}
"""Suffix → pattern that the content must contain."""
_SHAPELESS = frozenset({".bin", ".tga"})
"""Suffixes of buffers and textures without a signature, which only meshes refer to."""
_STEREOLITHOGRAPHY = frozenset({".stl", ".stlb"})
SUFFIXES = frozenset({*_BEGINS, *_HOLDS, *_SHAPELESS, *_STEREOLITHOGRAPHY})
"""Suffixes of files that may be copied."""


def rejection(path: Path) -> str:
    """Return why a file is not copied as a mesh, a texture or a dependency of a mesh; empty if it is copied.

    Args:
        path: the file; its suffix determines the expected content.
    """
    suffix = path.suffix.lower()
    if suffix not in SUFFIXES:
        return f"has the unsupported suffix `{path.suffix}`" if suffix else "has no suffix"
    try:
        content = path.read_bytes()
    except OSError as error:
        return f"cannot be read: {error.strerror}"
    if content.startswith(LFS):
        return POINTER
    if not content:
        return "is empty"
    if suffix in _STEREOLITHOGRAPHY:
        return "" if _is_stl(content) else "is not an STL file"
    if suffix in _BEGINS:
        return "" if content.startswith(_BEGINS[suffix]) else f"is not a {suffix[1:].upper()} file"
    if suffix in _HOLDS:
        plain = content.replace(b"\0", b"") if content[:2] in (b"\xff\xfe", b"\xfe\xff") else content
        return "" if _HOLDS[suffix].search(plain) else f"is not a {suffix[1:].upper()} file"
    return "" if b"\0" in content or suffix == ".tga" else "is a text file"


def _is_stl(content: bytes) -> bool:
    """Return whether a file is STL, possibly truncated: text with facets, or binary records of 50 bytes."""
    if content.lstrip()[:5].lower() == b"solid" and b"facet" in content.lower():
        return True
    triangles = int.from_bytes(content[80:84], "little")
    return len(content) >= 84 and b"\0" in content and 84 + 50 * triangles <= 2 * len(content)


class RobotFolders:
    """Folders whose files belong to a description: its own, its package, packages it refers to, and folders given.

    Args:
        description: the description.
        folders: additional folders.
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

    def contain(self, path: Path, uri: str = "") -> bool:
        """Return whether a file is in one of the folders.

        Args:
            path: the file; symbolic links are followed.
            uri: URI of the file; ``package://`` allows files inside that package.
        """
        path = path.resolve()
        if any(path.is_relative_to(root) for root in self._roots):
            return True
        # Packages of one workspace are in the same folder.
        package = _package_of(path.parent)
        if package is not None and self._workspace is not None and package.parent == self._workspace:
            return True
        scheme, separator, rest = uri.strip().partition("://")
        if not separator or scheme not in ("package", "model"):
            return False
        try:
            folder = self._packages.find(rest.partition("/")[0])
        except ResourceError:
            return False
        is_package = any((folder / name).is_file() for name in ("package.xml", "model.config"))
        return is_package and path.is_relative_to(folder.resolve())


def _package_of(folder: Path) -> Path | None:
    """Return the nearest package folder above a folder; None if no package is near."""
    for above in (folder, *list(folder.parents)[:_ABOVE]):
        if (above / "package.xml").is_file():
            return above
    return None
