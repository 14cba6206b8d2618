"""minidom's own builder, which also stamps each element with the place of its start tag."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any
from xml.dom.expatbuilder import ExpatBuilderNS

from urdfkit.description.reading import MAX_DEPTH, STAMP


class StampingBuilder(ExpatBuilderNS):
    """Builds what ``minidom.parseString`` builds.

    Args:
        file: the name to stamp.
        on_clone: DOM user data handler of the stamps.
        too_deep: called with the parser when elements nest too deep; raises.
    """

    def __init__(self, file: str, on_clone: Any, too_deep: Callable[[Any], None]) -> None:
        self._file, self._on_clone, self._too_deep = file, on_clone, too_deep
        self._depth = 0
        super().__init__()

    def start_element_handler(self, name: str, attributes: Any) -> None:
        """Stamp the element."""
        super().start_element_handler(name, attributes)
        parser = self._parser
        stamp = (self._file, parser.CurrentLineNumber, parser.CurrentColumnNumber + 1, ())
        self.curNode.setUserData(STAMP, stamp, self._on_clone)
        self._depth += 1
        if self._depth > MAX_DEPTH:
            self._too_deep(parser)

    def end_element_handler(self, name: str) -> None:
        """Leave the element."""
        self._depth -= 1
        super().end_element_handler(name)

    def open_tags(self) -> list[tuple[str, int]]:
        """Return tag and line of the elements that are open, outermost first."""
        found = []
        node = self.curNode
        while node is not None and node.nodeType == 1:
            found.append((node.tagName, node.getUserData(STAMP)[1]))
            node = node.parentNode
        return found[::-1]
