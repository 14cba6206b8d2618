"""Inlay hints: values of expressions and masses of links, next to where the file computes them."""

from collections.abc import Callable, Iterator, Sequence

from urdfkit.lint.model.model import Model
from urdfkit.lint.model.tags import Document, Tag

_SHOWN = 2
_LONGEST = 40


def inlay_hints(
    model: Model,
    document: Document,
    start: int,
    end: int,
    probe: Callable[[Sequence[tuple[int, str]]], Sequence[Sequence[str]]],
) -> Iterator[tuple[int, str]]:
    """Yield offset and text of each hint in a range of a file.

    Args:
        model: the model that the file belongs to.
        document: the file.
        start: offset of the range.
        end: offset after the range.
        probe: returns the values of texts inserted at offsets, one sequence for each text.
    """
    tags = [tag for tag in document.walk() if start <= tag.start < end]
    values = _expanded_values(model, document)
    for tag in tags:
        for attribute in tag.attributes.values():
            found = values.get((tag.start, attribute.name))
            if found and "$" in attribute.value and tag.parent is not None:
                yield attribute.end, _listed(found)
    properties = [tag for tag in tags if _is_computed_property(tag)]
    written = [(tag.close_end, tag.attributes["value"].value) for tag in properties]
    for tag, results in zip(properties, probe(written) if written else (), strict=True):
        if results:
            yield tag.attributes["value"].end, _listed(results)
    yield from _masses(model, document, tags)


def _is_computed_property(tag: Tag) -> bool:
    value = tag.attributes.get("value") if tag.name == "xacro:property" else None
    return value is not None and "$" in value.value


def _expanded_values(model: Model, document: Document) -> dict[tuple[int, str], list[str]]:
    """Return the values of the attributes of each expanded element of a file, by the offset of its start tag."""
    source = document.source
    found: dict[tuple[int, str], dict[str, None]] = {}
    root = model.expanded.root
    for element in root.walk() if root is not None else ():
        at = element.origin.position
        if at.file == source.file:
            offset = source.offset(at.line, at.column)
            for name, value in element.attributes.items():
                if "$" not in str(value):
                    found.setdefault((offset, name), {})[str(value)] = None
    return {key: list(values) for key, values in found.items()}


def _masses(model: Model, document: Document, tags: list[Tag]) -> Iterator[tuple[int, str]]:
    """Yield the mass of each link whose mass another element, such as a macro call, computes."""
    starts = {tag.start: tag for tag in tags if tag.name == "link"}
    source = document.source
    masses: dict[int, dict[str, None]] = {}
    for link in model.robot.links:
        at = link.element.origin.position
        mass = link.inertial.mass if link.inertial is not None else None
        if at.file == source.file and mass is not None:
            masses.setdefault(source.offset(at.line, at.column), {})[f"{mass:.4g} kg"] = None
    for offset, found in masses.items():
        tag = starts.get(offset)
        if tag is not None:
            yield tag.end, _listed(list(found), sign="")


def _listed(values: Sequence[str], sign: str = "= ") -> str:
    shown = ", ".join(value if len(value) <= _LONGEST else value[: _LONGEST - 1] + "…" for value in values[:_SHOWN])
    return f"{sign}{shown}{f' and {len(values) - _SHOWN} more' if len(values) > _SHOWN else ''}"
