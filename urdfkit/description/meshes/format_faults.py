"""Faults of OBJ and binary glTF files that their readers report in words of their own, or not at all."""

import re

MAX_CHECKED = 2 * 2**20
"""Size of an OBJ file above which its faces are not checked [bytes]."""

_VERTEX = re.compile(rb"^[ \t]*v[ \t]", re.MULTILINE)
_NOT_FINITE = re.compile(rb"^[ \t]*v[ \t][^\r\n]*?(?:nan|inf)", re.MULTILINE | re.IGNORECASE)
_FACE = re.compile(rb"^[ \t]*f[ \t](.*)$", re.MULTILINE)
_INDEX = re.compile(rb"-?\d{1,9}(?![^\s/])")
_GLB_HEADER = 20
"""Bytes of the header of a binary glTF file, with the header of its first chunk."""


def obj_fault(content: bytes) -> str:
    """Return the fault of an OBJ file; empty if none is found."""
    if _NOT_FINITE.search(content):
        return "is invalid: a vertex is not finite"
    if len(content) > MAX_CHECKED:
        return ""
    count = len(_VERTEX.findall(content))
    for face in _FACE.finditer(content):
        for corner in face[1].partition(b"#")[0].split():
            index = _INDEX.match(corner)
            if index is not None and not 0 < abs(int(index[0])) <= count:
                return "is invalid: a triangle refers to a missing vertex"
    return ""


def glb_fault(head: bytes, size: int) -> str:
    """Return the fault of a binary glTF file of a size, from its first bytes; empty if none is found."""
    if not head.startswith(b"glTF"):
        return "is not a binary glTF file"
    wanted = max(int.from_bytes(head[8:12], "little"), _GLB_HEADER)
    return f"is truncated: {size} bytes instead of {wanted}" if size < wanted else ""
