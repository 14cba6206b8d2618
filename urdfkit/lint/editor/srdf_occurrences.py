"""Links and joints in the SRDF files of a package."""

from __future__ import annotations

from urdfkit.description.packages.related_files import SRDF
from urdfkit.lint.editor.symbol_occurrences import Occurrence
from urdfkit.lint.model.tags import Document

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.model.model import Model

_LINKS = frozenset(("link", "link1", "link2", "base_link", "tip_link", "parent_link", "child_link"))
"""Attributes whose value is a link, and elements whose name is a link."""


def in_srdf_files(model: Model) -> Iterator[Occurrence]:
    """Yield the links and joints that the SRDF files of the package and of related packages name literally."""
    for source in model.related_files.values():
        if not source.file.endswith(SRDF):
            continue
        for tag in Document(source).walk():
            for name, attribute in tag.attributes.items():
                is_name = name == "name" and tag.name in ("link", "joint", "passive_joint")
                kind = "joint" if is_name and tag.name != "link" else "link"
                if (is_name or name in _LINKS) and attribute.value:
                    span = source.span(attribute.value_start, attribute.value_end)
                    yield Occurrence(kind, attribute.value, span, False, attribute.value)
