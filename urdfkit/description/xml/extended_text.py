"""Text of a file with additions: elements keep their positions in the file of the user."""

from __future__ import annotations

from collections.abc import Sequence

from urdfkit.description.xml.source import Source
from urdfkit.position import Position


class ExtendedText(str):
    """Text of a file with additions.

    Attributes:
        original: the file without the additions.
    """

    original: Source
    _additions: list[tuple[int, int]]
    _place: Position

    @classmethod
    def of(cls, source: Source, additions: Sequence[tuple[int, str]], place: Position) -> ExtendedText:
        """Return the text of a file with additions.

        Args:
            source: the file.
            additions: offset in the text of the file, and the added text; sorted by offset.
            place: position of the elements in the added texts.
        """
        parts, at = [], 0
        for offset, added in additions:
            parts += [source.text[at:offset], added]
            at = offset
        text = cls("".join([*parts, source.text[at:]]))
        text.original, text._place = source, place
        text._additions = [(offset, len(added)) for offset, added in additions]
        return text

    def written(self, position: Position) -> Position:
        """Return the position of an element of this text in the file, that of an added element included."""
        offset = self._source.offset(position.line, position.column)
        for start, length in self._additions:
            if offset < start:
                break
            if offset < start + length:
                return self._place
            offset -= length
        return self.original.position(offset)

    @property
    def _source(self) -> Source:
        found: Source | None = self.__dict__.get("whole")
        if found is None:
            found = self.__dict__["whole"] = Source(self.original.file, str(self))
        return found
