"""minidom's builder, extended to stamp each element with the position of its start tag."""

from __future__ import annotations

from collections.abc import Callable
from xml.dom.expatbuilder import ExpatBuilder, ExpatBuilderNS

from urdfkit.description.xml.element import MAX_DEPTH, STAMP, stamp_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any


class _Stamping(ExpatBuilder):
    """Stamps each element that a builder creates.

    Args:
        file: the name to stamp.
        on_clone: DOM user data handler of the stamps.
        too_deep: called with the parser when elements nest too deep; raises.
        check: called before each element is created, with the parser, the tag and the values of the attributes.
    """

    def __init__(
        self,
        file: str,
        on_clone: Any,
        too_deep: Callable[[Any], None],
        check: Callable[[Any, str, Any], None] | None = None,
    ) -> None:
        self._file, self._on_clone, self._too_deep, self._check = file, on_clone, too_deep, check
        self._depth = 0
        super().__init__()

    @property
    def _node(self) -> Any:
        return self.curNode

    def start_element_handler(self, name: str, attributes: Any) -> None:
        """Stamp the element."""
        if self._check is not None:
            self._check(self.getParser(), name.rpartition(" ")[2], attributes[1::2])
        super().start_element_handler(name, attributes)
        parser = self.getParser()
        stamp = (self._file, parser.CurrentLineNumber, parser.CurrentColumnNumber + 1, ())
        self._node.setUserData(STAMP, stamp, self._on_clone)
        self._depth += 1
        if self._depth > MAX_DEPTH:
            self._too_deep(parser)

    def end_element_handler(self, name: str) -> None:
        """Close the element."""
        self._depth -= 1
        super().end_element_handler(name)

    def open_tags(self) -> list[tuple[str, int]]:
        """Return tag and line of the elements that are open, outermost first."""
        found: list[tuple[str, int]] = []
        node = self._node
        while node is not None and node.nodeType == 1:
            found.append((node.tagName, stamp_of(node)[1]))
            node = node.parentNode
        return found[::-1]


class StampingBuilder(_Stamping, ExpatBuilderNS):
    """Builds the same document as ``minidom.parseString``, with stamps."""


class PrefixBlindBuilder(_Stamping):
    """Treats prefixes as part of the name, declared or not."""
