"""Arguments that the files of a description declare with ``<xacro:arg>``, also where a condition excludes them."""

from __future__ import annotations

from collections.abc import Iterable

from urdfkit.description.xml.reader import document_of
from urdfkit.description.xml.source import Source
from urdfkit.errors import XmlError


def declared_arguments(sources: Iterable[Source]) -> dict[str, str | None]:
    """Return name → default of the declared arguments; the default is None without one. Other files have none.

    Args:
        sources: the files; the first declaration of an argument applies.
    """
    declared: dict[str, str | None] = {}
    for source in sources:
        try:
            document = document_of(source)
        except XmlError:
            continue
        for element in document.walk():
            if element.tag.rpartition(":")[2] == "arg" and (name := element.get("name")):
                declared.setdefault(name, element.get("default"))
    return declared
