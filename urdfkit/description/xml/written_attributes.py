"""Attributes as the source files have them, before xacro evaluates them."""

from pathlib import Path

from urdfkit.description.xml.reader import read_source
from urdfkit.description.xml.source import Source
from urdfkit.description.xml.start_tag import AttributeText, start_tag
from urdfkit.errors import ResourceError
from urdfkit.position import Position


class WrittenAttributes:
    """Reads attributes at positions of tags; each file is read once."""

    def __init__(self) -> None:
        self._sources: dict[str, Source | None] = {}

    def at(self, position: Position, attribute: str) -> AttributeText | None:
        """Return an attribute of the tag at a position; None if the file cannot be read or has no such attribute."""
        if position.file not in self._sources:
            try:
                self._sources[position.file] = read_source(Path(position.file), shown_as=position.file)
            except ResourceError:
                self._sources[position.file] = None
        source = self._sources[position.file]
        tag = start_tag(source, position) if source is not None else None
        return tag.attributes.get(attribute) if tag is not None else None
