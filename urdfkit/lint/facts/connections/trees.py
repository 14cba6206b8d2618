"""Launch files with the files that they include: the nodes that one command starts, with evaluated namespaces."""

from functools import lru_cache
from pathlib import Path

from urdfkit.description.launch.launch_file import read_launch_file
from urdfkit.description.launch.launch_scope import UNKNOWN, LaunchContents, LaunchNode
from urdfkit.description.packages.related_files import LAUNCH
from urdfkit.description.xml.reader import shown_path
from urdfkit.description.xml.source import Source, Span
from urdfkit.lint.facts.launch.ros_version import reads_ros1
from urdfkit.lint.model.model import Model
from urdfkit.lint.model.tags import Document


@lru_cache(maxsize=1)
def launch_trees(model: Model) -> tuple[LaunchContents, ...]:
    """Return the contents of each launch file that no other one includes."""
    files = [Path(name) for name in model.related_files if name.endswith(LAUNCH)]
    found = [read_launch_file(file.absolute(), model.expanded.packages, model.texts) for file in files]
    included = {path.resolve() for each in found for path in each.included}
    return tuple(each for each in found if each.path.resolve() not in included)


def full_name(node: LaunchNode, name: str) -> str:
    """Return a name as a node resolves it, without slashes at its ends."""
    return name.strip("/") if name.startswith("/") else f"{node.namespace}/{name}".strip("/")


def is_constant(text: str) -> bool:
    """Return whether a text of a launch file has no computed part."""
    return UNKNOWN not in text


def is_ros1(tree: LaunchContents, model: Model) -> bool:
    """Return whether roslaunch reads the files of a launch."""
    sources = (model.related_files.get(shown_path(path)) for path in (tree.path, *tree.included))
    return any(source is not None and reads_ros1(source) for source in sources)


def source_of(node: LaunchNode, model: Model) -> Source | None:
    """Return the launch file of a node; None if it is not related to the robot."""
    return model.related_files.get(shown_path(node.path))


def place_of(node: LaunchNode, model: Model) -> Span | None:
    """Return the place of the namespace of a node, or of the node without one; None outside of the related files."""
    path, line, column = node.spaced_at or (node.path, node.line, node.column)
    source = model.related_files.get(shown_path(path))
    text = node.namespace.rpartition("/")[2] if node.spaced_at is not None else node.program
    return span_in(source, line, column, text, ("ns", "namespace", "exec", "type")) if source is not None else None


def span_in(source: Source, line: int, column: int, text: str, attributes: tuple[str, ...] = ()) -> Span:
    """Return the span of a text in an action or expression that begins at a place of a launch file.

    Args:
        source: the launch file.
        line: line of the action, from 1.
        column: column of the action, from 1.
        text: the evaluated text.
        attributes: attributes of an XML element that can contain the text.

    Returns:
        The first line of the action, if it does not contain the text.
    """
    start = source.offset(line, column)
    end = source.text.find("\n", start)
    end = len(source.text) if end < 0 else end
    tag = None
    if source.text.startswith("<", start):
        tag = next((tag for root in Document(source).roots for tag in root.walk() if tag.start == start), None)
    if tag is not None:
        for each in (tag.attributes[name] for name in attributes if name in tag.attributes):
            at = source.text.find(text, each.value_start, each.value_end) if text else -1
            if at >= 0:
                return source.span(at, at + len(text))
        return source.span(tag.start, tag.end)
    at = source.text.find(text, start, min(end, start + len(text) + 2)) if text else -1
    return source.span(at, at + len(text)) if at >= 0 else source.span(start, end)
