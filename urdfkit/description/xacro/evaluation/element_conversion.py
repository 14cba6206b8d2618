"""Conversion of an expanded tree to elements, whose origins are the places and macro calls of the tree."""

from collections.abc import Iterator

from urdfkit.description.xacro.evaluation.tree import CDATA, NOTHING, TEXT, VALUES, Chain, Copy, ExpandedElements, Tag
from urdfkit.description.xml.element import Element
from urdfkit.description.xml.reader import MAX_MADE_DEPTH, check_depth
from urdfkit.description.xml.source import Origin


def element_of(tag: Tag, depth: int = 0) -> Element:
    """Return an expanded element with all below it.

    Raises:
        XmlError: macros have made elements that are nested too deep.
    """
    if (
        type(tag) is Copy
        and tag.source is not None
        and depth + tag.height < MAX_MADE_DEPTH
        and (tag.values is not None or tag.work == NOTHING)
    ):
        return _copied(tag.source, tag.chain, iter(tag.values or ()))
    if depth >= MAX_MADE_DEPTH:
        check_depth(depth, tag.position)
    children: list[Element] = []
    text = ""
    child = tag.first
    while child is not None:
        if type(child) is ExpandedElements:
            if depth >= MAX_MADE_DEPTH // 2:
                for element in child.elements:
                    _check_all(element, depth + 1)
            children += child.elements
        elif isinstance(child, Tag):
            children.append(element_of(child, depth + 1))
        elif child.kind == TEXT or child.kind == CDATA:
            text += child.data
        child = child.after
    attributes = {name: str(value) for name, value in tag.attributes.items()}
    return Element(tag.tag, attributes, children, text.strip(), Origin(tag.position, tag.chain))


def _copied(source: Tag, chain: Chain, values: Iterator[str]) -> Element:
    """Return the element that a copy of an element becomes."""
    attributes = source.attributes.copy()
    if source.work == VALUES:
        for name, value in attributes.items():
            if "$" in value:
                attributes[name] = next(values)
    if source.content is None:
        source.content = _content(source)
    text, tags = source.content
    if text is not None:
        children = [_copied(child, chain, values) for child in tags] if tags else []
    else:
        children, text = [], ""
        for child in source.children():
            if isinstance(child, Tag):
                children.append(_copied(child, chain, values))
            elif child.kind in (TEXT, CDATA):
                text += next(values) if "$" in child.data and child.kind == TEXT else child.data
        text = text.strip()
    return Element(source.tag, attributes, children, text, Origin(source.position, chain))


def _content(tag: Tag) -> tuple[str | None, list[Tag]]:
    """Return the text in an element, None if it has expressions, and the elements in it."""
    texts = [child.data for child in tag.children() if child.kind == TEXT or child.kind == CDATA]
    text = "".join(texts)
    return None if "$" in text else text.strip(), list(tag.tags())


def _check_all(element: Element, depth: int) -> None:
    check_depth(depth, element.origin.position)
    for child in element.children:
        _check_all(child, depth + 1)
