"""Faults of the content of mesh files that the readers of the formats report in words of their own, or not at all."""

from __future__ import annotations

import re

from urdfkit.description.meshes.points import has_infinite
from urdfkit.description.meshes.stl import HEADER, SIZE

TYPE_CHECKING = False
if TYPE_CHECKING:
    from mmap import mmap

    from urdfkit.description.meshes.collada_outline import Outline

MAX_CHECKED = 2 * 2**20
"""Size of an OBJ file above which its faces are not checked [bytes]."""

NOT_FINITE = "is invalid: a vertex is not finite"

TITLES = {
    ".stl": "an STL file",
    ".obj": "an OBJ file",
    ".dae": "a COLLADA file",
    ".glb": "a binary glTF file",
    ".gltf": "a glTF file",
    ".ply": "a PLY file",
}
"""Suffix → format, as messages name it."""

_VERTEX = re.compile(rb"^[ \t]*v[ \t]", re.MULTILINE)
_NOT_FINITE = re.compile(
    rb"^[ \t]*v[ \t][^\r\n#]*?(?:nan|inf|\de\+?0*(?:39|[4-9]\d|[1-9]\d\d))", re.MULTILINE | re.IGNORECASE
)
"""Matches a vertex with a number that is infinite, also as a 32-bit number, or not a number."""
_NOT_FINITE_STL = re.compile(rb"vertex[ \t][^\r\n]*?(?:nan|inf)")
_NOT_FINITE_WORD = re.compile(rb"[\s>][-+]?(?:nan|inf)", re.IGNORECASE)
_INPUT = re.compile(rb"<(?:\w+:)?input\b[^<>]*")
_SOURCE = re.compile(rb"""#([^"'\s>]+)""")
_ARRAY = re.compile(
    rb"""<(?:\w+:)?source\b[^<>]*?\bid\s*=\s*["']([^"'<>]+)["'][^<>]*>\s*<(?:\w+:)?float_array\b[^<>]*>([^<]*)"""
)
"""Matches an array of numbers in a COLLADA file; the groups are its ID and the numbers."""
_FACE = re.compile(rb"^[ \t]*f[ \t](.*)$", re.MULTILINE)
_INDEX = re.compile(rb"-?\d{1,9}(?![^\s/])")
_GLB_HEADER = 20
"""Bytes of the header of a binary glTF file, with the header of its first chunk."""
_HEAD = 1024
"""Bytes in which other formats are recognised."""

_OTHERS = (
    (rb"<!doctype html|<html", "a web page (HTML): download the file again", ""),
    (rb"\x89PNG", "a PNG image", ""),
    (rb"\xff\xd8\xff", "a JPEG image", ""),
    (rb"PK\x03\x04", "a ZIP archive: unpack it", ""),
    (rb"\x1f\x8b", "a gzip archive: unpack it", ""),
    (rb"glTF", "a binary glTF file", ".glb"),
    (rb"ply\s", "a PLY file", ".ply"),
    (rb"(?s:(?:<\?xml.*)?)<(?:\w+:)?COLLADA\b", "a COLLADA file", ".dae"),
    (rb"solid\b[^\0]*?\bfacet\b", "an STL file", ".stl"),
    (rb"\{\s*\"", "a glTF file", ".gltf"),
)
"""Start of a file (pattern), its format, and the suffix of a supported format."""


def dae_fault(content: bytes, outline: Outline | None = None) -> str:
    """Return the fault of the vertices of a COLLADA file; empty if none is found. Normals may be no numbers.

    Args:
        content: of the file.
        outline: of the file, if it is known.
    """
    from urdfkit.description.meshes.collada_outline import outline_of

    skeleton, texts = outline or outline_of(content)
    inputs = [tag for tag in _INPUT.findall(skeleton) if b"POSITION" in tag]
    positions = {name for tag in inputs for name in _SOURCE.findall(tag)}
    for name, text in _ARRAY.findall(skeleton) if positions else ():
        if name in positions:
            start, end = texts.get(text, (0, 0))
            has_letter = content.find(b"n", start, end) >= 0 or content.find(b"N", start, end) >= 0
            if _NOT_FINITE_WORD.search(b" " + (content[start:end] if has_letter else text)):
                return NOT_FINITE
    return ""


def obj_fault(content: bytes) -> str:
    """Return the fault of an OBJ file; empty if none is found."""
    if _NOT_FINITE.search(content):
        return NOT_FINITE
    if len(content) > MAX_CHECKED:
        return ""
    count = len(_VERTEX.findall(content))
    most = 0
    for face in _FACE.finditer(content):
        corners = face[1].partition(b"#")[0].split()
        most = max(most, len(corners))
        for corner in corners:
            index = _INDEX.match(corner)
            if corner[:1].isalpha():
                return f"is invalid: the corner `{corner[:20].decode(errors='replace')}` of a face is not a number"
            if index is not None and not 0 < abs(int(index[0])) <= count:
                return "is invalid: a triangle refers to a missing vertex"
    if 0 < most < 3:
        return "has no triangles"
    return "" if most or not other_format(content) else wrong_format(content, ".obj")


def glb_fault(head: bytes, size: int) -> str:
    """Return the fault of a binary glTF file of a size, from its first bytes; empty if none is found."""
    if not head.startswith(b"glTF"):
        return wrong_format(head, ".glb")
    wanted = max(int.from_bytes(head[8:12], "little"), _GLB_HEADER)
    return f"is truncated: {size} bytes instead of {wanted}" if size < wanted else ""


def text_fault(suffix: str, content: bytes) -> str:
    """Return the fault of a COLLADA, glTF (JSON) or PLY file that its first bytes show; empty if none is found.

    Args:
        suffix: of the file, in lower case.
        content: of the file, or its first 1,024 bytes.
    """
    start = {".dae": b"<", ".gltf": b"{", ".ply": b"ply"}[suffix]
    other = other_format(content)
    is_right = _text_of(content).startswith(start) and (other is None or other[1] == suffix)
    return "" if is_right else wrong_format(content, suffix)


def has_infinite_stl_vertex(content: bytes | mmap, *, is_text: bool) -> bool:
    """Return whether a coordinate in a text or binary STL file is infinite or not a number."""
    if is_text:
        text = content[:].lower()  # searching for these words takes a twentieth of the time of the pattern
        return (b"nan" in text or b"inf" in text) and bool(_NOT_FINITE_STL.search(text))
    end = HEADER + SIZE * int.from_bytes(content[80:HEADER], "little")
    return any(has_infinite(content, first, end, SIZE) for first in range(HEADER + 12, HEADER + 48, 12))


def other_format(content: bytes) -> tuple[str, str] | None:
    """Return the format of a file, by its first bytes, and the suffix of this format; None for unknown formats."""
    head = _text_of(content)
    for start, title, suffix in _OTHERS:
        if re.match(start, head, re.IGNORECASE):
            return title, suffix
    return None


def _text_of(content: bytes) -> bytes:
    """Return the first bytes of a file without white space, and without what encodings other than UTF-8 add."""
    head = content[:_HEAD]
    if head.startswith((b"\xff\xfe", b"\xfe\xff")):
        head = head[2:].replace(b"\0", b"")
    return head.removeprefix(b"\xef\xbb\xbf").lstrip()


def wrong_format(content: bytes, suffix: str) -> str:
    """Return that a file is not of the format of its suffix, and of which it is."""
    found = other_format(content)
    if found is None or found[1] == suffix:
        return f"is not {TITLES[suffix]}"
    rename = f": rename it to end with {found[1]}" if found[1] else ""
    return f"is not {TITLES[suffix]} but {found[0]}{rename}"


def reading_fault(suffix: str, content: bytes) -> str:
    """Return why the reader of a format fails, with the place in the file where the syntax is wrong."""
    if suffix == ".dae":
        from xml.parsers.expat import ExpatError, ParserCreate

        try:
            ParserCreate().Parse(content, True)
        except ExpatError as error:
            return f"its XML is invalid on line {error.lineno}, column {error.offset + 1}"
    if suffix in (".gltf", ".glb"):
        import json

        size = int.from_bytes(content[12:16], "little")
        try:
            json.loads(content[_GLB_HEADER : _GLB_HEADER + size] if suffix == ".glb" else content)
        except json.JSONDecodeError as error:
            return f"its JSON is invalid on line {error.lineno}, column {error.colno}"
        except (ValueError, RecursionError):
            return "its JSON is invalid"
    return f"it is not a valid {TITLES[suffix].split(maxsplit=1)[1]}: export it again"
