"""Memory: the elements of the last expansion of a file, reused where the next one makes the same."""

from __future__ import annotations

from urdfkit.description.xml.element import Element

TYPE_CHECKING = False
if TYPE_CHECKING:
    from urdfkit.description.urdf.values import Part


class Memory:
    """What an editor keeps of a file from one expansion to the next.

    Attributes:
        parts: element → the part of the robot that was read from it.
    """

    def __init__(self) -> None:
        self.parts: dict[Element, Part] = {}
        self._elements: dict[tuple[object, ...], Element] = {}

    def settle(self, root: Element | None) -> None:
        """Replace the elements below a root by those of the last expansion that equal them."""
        if root is None:
            return
        known, self._elements = self._elements, {}
        for index, element in enumerate(root.children):
            at = element.origin
            calls = at.expansions and (at.expansions[0].macro, at.expansions[0].position.line)
            key = (element.tag, element.attributes.get("name"), at.position.line, at.position.column, calls)
            old = known.pop(key, None)
            if old is not None:
                root.children[index] = element = _reused(element, old)
            self._elements[key] = element


def _reused(new: Element, old: Element) -> Element:
    """Return an old element if it equals a new one, else the new one with the equal elements of the old one in it."""
    children = [_reused(*pair) for pair in zip(new.children, old.children, strict=False)]
    new.children[: len(children)] = children
    is_same = len(children) == len(new.children) == len(old.children)
    is_same = is_same and all(child is other for child, other in zip(children, old.children, strict=True))
    is_same = is_same and new.tag == old.tag and new.attributes == old.attributes and new.text == old.text
    return old if is_same and new.origin == old.origin else new
