"""Repeated elements: links, joints and other children of the root element that calls of one macro make alike.

They differ in their names and in the macro call only. A rule that checks each element alone needs to check one of them.
"""

from __future__ import annotations

from collections.abc import Hashable

from urdfkit.description.xml.element import Element

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

_NAMED = {"parent": "link", "child": "link"}
"""Element → attribute whose value is the name of another element."""


def content_key(element: Element) -> Hashable:
    """Return a key that elements have in common if they come from the same source text and differ in names only.

    Args:
        element: a child of the root element.
    """
    if not element.origin.expansions:
        return element
    attributes = dict(element.attributes)
    found: list[Any] = [element.tag, "name" in attributes]
    attributes.pop("name", None)
    found += attributes.items()
    pending = [element]
    for one in pending:  # The list grows during the iteration.
        # All elements that were made from one start tag share its position.
        found += (id(one.origin.position), one.tag, one.text, len(one.children))
        if one is not element:
            name = _NAMED.get(one.tag)
            if name is None:
                found += one.attributes
                found += one.attributes.values()
            else:
                found += [item if item[0] != name else name for item in one.attributes.items()]
        pending += one.children
    return tuple(found)
