"""COLLADA files without their long texts of numbers, which are nearly all of a file."""

from __future__ import annotations

from typing import NamedTuple

LONG = 500
"""Bytes of a text that is cut out."""


class Outline(NamedTuple):
    """A document with a placeholder for each long text.

    Attributes:
        skeleton: the document; ``@`` and a number stand for a long text.
        texts: placeholder → positions in the file where its text starts and ends.
    """

    skeleton: bytes
    texts: dict[bytes, tuple[int, int]]


def outline_of(content: bytes) -> Outline:
    """Return the outline of a COLLADA file."""
    parts: list[bytes] = []
    texts: dict[bytes, tuple[int, int]] = {}
    at = content.find(b"<")
    while at >= 0:
        following = content.find(b"<", at + 1)
        stop = following if following >= 0 else len(content)
        if stop - at > LONG and (end := content.find(b">", at, stop) + 1):
            placeholder = b"@%d" % len(texts)
            parts += (content[at:end], placeholder)
            texts[placeholder] = end, stop
        else:
            parts.append(content[at:stop])
        at = following
    return Outline(b"".join(parts), texts)
