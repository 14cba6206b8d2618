"""Cursor: the syntax element at an offset of a file."""

import re

from urdfkit.lint.model.tags import Attribute, Document, Tag

_WORD = r"[A-Za-z_][\w.]*"
_PARAMETER = r"[^\s:=,;]+"


class Cursor:
    """The syntax element at an offset.

    Attributes:
        document: the file.
        offset: offset into the text.
        tag: the innermost element that contains the offset; None outside of all elements.
        attribute: the attribute whose name or value contains the offset.
        in_value: whether the offset is in the value of the attribute.
        in_name: whether the offset is in the name of the start tag or end tag.
    """

    def __init__(self, document: Document, offset: int) -> None:
        self.document, self.offset = document, offset
        self.tag = _innermost(document, offset)
        self.attribute: Attribute | None = None
        self.in_value = self.in_name = False
        tag = self.tag
        if tag is None:
            return
        self.in_name = tag.start < offset <= tag.start + 1 + len(tag.name)
        if tag.close is not None and tag.close + 2 <= offset <= tag.close + 2 + len(tag.name):
            self.in_name = True
        if offset < tag.end:
            for attribute in tag.attributes.values():
                if attribute.start <= offset <= attribute.value_end:
                    self.attribute = attribute
                    self.in_value = offset >= attribute.value_start

    @property
    def text(self) -> tuple[str, int]:
        """The attribute value or element text at the cursor, and its start offset; empty elsewhere."""
        tag, attribute = self.tag, self.attribute
        if attribute is not None:
            return (attribute.value, attribute.value_start) if self.in_value else ("", self.offset)
        if tag is not None and tag.close is not None and not tag.children and tag.end <= self.offset <= tag.close:
            return self.document.source.text[tag.end : tag.close], tag.end
        return "", self.offset

    @property
    def expression(self) -> tuple[str, int] | None:
        """The ``${…}`` or ``$(…)`` at the cursor, and its start offset; None elsewhere."""
        text, start = self.text
        for found in re.finditer(r"\$\{[^{}]*\}|\$\([^()]*\)", text):
            if found.start() <= self.offset - start <= found.end():
                return found[0], start + found.start()
        return None

    @property
    def word(self) -> tuple[str, int]:
        """The name in an expression or macro parameter at the cursor, and its start offset; empty elsewhere."""
        text, start = self.text
        within = self.expression
        pattern = _WORD if within is not None else _PARAMETER
        for found in re.finditer(pattern, text):
            if found.start() <= self.offset - start <= found.end():
                return found[0], start + found.start()
        return "", self.offset


def _innermost(document: Document, offset: int) -> Tag | None:
    found: Tag | None = None
    tags = document.roots
    while True:
        inside = next((tag for tag in tags if tag.start < offset < tag.close_end), None)
        if inside is None:
            return found
        found, tags = inside, inside.children
