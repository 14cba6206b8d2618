"""Checks of COLLADA files that their reader lacks: units, and rejection of malicious files."""

import re
from xml.etree import ElementTree

MAX_INSTANCES = 20_000
"""Largest number of nodes after the expansion of node instances."""

_UNIT = re.compile(rb"""<unit\b[^>]*?\bmeter\s*=\s*["']\s*([^"']+?)\s*["']""")


def metres_per_unit(content: bytes) -> float:
    """Return the factor to metres of ``<unit meter="…">``; 1 without it."""
    written = _UNIT.search(content)
    try:
        factor = float(written[1]) if written else 1.0
    except ValueError:
        return 1.0
    return factor if 0.0 < factor < float("inf") else 1.0


def rejection_reason(content: bytes) -> str | None:
    """Return the reason to reject a file; None if it is safe.

    Entities can unfold into gigabytes, and so can nodes that contain two instances of a node that contains two
    instances, and so on.
    """
    if re.search(rb"<!(DOCTYPE|ENTITY)", content):
        return "it declares a document type or XML entities"
    if b"instance_node" not in content:
        return None
    try:
        root = ElementTree.fromstring(content)
    except ElementTree.ParseError:
        return None  # the reader reports it
    nodes = {element.get("id"): element for element in root.iter() if _tag(element) == "node"}
    sizes: dict[str | None, int] = {}

    def unfolded(element: ElementTree.Element, above: tuple[str | None, ...]) -> int:
        count = 1
        for inner in element.iter():
            if _tag(inner) != "instance_node":
                continue
            name = inner.get("url", "").removeprefix("#")
            if name in above or len(above) > 100:
                return MAX_INSTANCES + 1
            if name not in sizes and name in nodes:
                sizes[name] = unfolded(nodes[name], (*above, name))
            count += sizes.get(name, 0)
        return count

    scenes = [element for element in root.iter() if _tag(element) == "visual_scene"]
    if any(unfolded(scene, ()) > MAX_INSTANCES for scene in scenes):
        return f"its nodes unfold into more than {MAX_INSTANCES} instances"
    return None


def _tag(element: ElementTree.Element) -> str:
    return element.tag.rpartition("}")[2] if isinstance(element.tag, str) else ""
