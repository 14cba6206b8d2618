"""Parameters from YAML with their source positions, in the layouts of ROS 1 and ROS 2."""

from __future__ import annotations

from pathlib import Path

from urdfkit.description.control.settings import Settings
from urdfkit.description.xml.reader import shown_path
from urdfkit.description.xml.source import Position, Source
from urdfkit.errors import DescriptionError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

_MAX_DEPTH = 30
_MAX_NODES = 100_000
_MAX_FLOW_DEPTH = 2000
_DEEP_LINE = r"(?:[-?][ \t]+){200}"
"""Lists in lists in one line: ``- - - 1``."""


def read_settings(path: Path, *, separator: str = "/") -> Settings:
    """Read a YAML file of parameters.

    Args:
        path: the file.
        separator: separator of the parts of a name: ``/`` in ROS 1, ``.`` in ROS 2.

    Raises:
        ResourceError: the file cannot be read.
        DescriptionError: the text is not YAML or does not contain parameters; with the position.
    """
    return parse_settings(Source.read(path, shown_as=shown_path(path)), separator=separator)


def parse_settings(source: Source, *, separator: str = "/") -> Settings:
    """Read the YAML text of parameters; see `read_settings`.

    Raises:
        DescriptionError: the text is not YAML or does not contain parameters; with the position.
    """
    import yaml

    try:
        node = _composed(source.text)
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        position = Position(source.file, mark.line + 1, mark.column + 1) if mark else None
        raise DescriptionError(f"invalid YAML: {error.problem or error.context}", position=position) from None
    except yaml.YAMLError as error:
        raise DescriptionError(
            f"invalid YAML: {' '.join(str(error).split())}", position=Position(source.file, 1, 1)
        ) from None
    except RecursionError:
        message = "invalid YAML: lists or maps are nested too deeply"
        raise DescriptionError(message, position=Position(source.file, 1, 1)) from None
    start = Position(source.file, 1, 1)
    if node is None:
        return Settings("", start)
    read = _YamlReader(source.file, separator).read("", node, None, 0)
    if not read.children:
        raise DescriptionError("no parameters: write names and values as `name: value`", position=start)
    return read


def loader_of(text: str) -> Any:
    """Return PyYAML's reader in C for a text; the one in Python, which limits the depth, if the nesting may be deep.

    The reader in C overflows the stack of the process at some ten thousand levels.
    """
    import re

    import yaml

    is_shallow = _flow_depth(text) < _MAX_FLOW_DEPTH and not re.search(_DEEP_LINE, text)
    return getattr(yaml, "CSafeLoader", yaml.SafeLoader) if is_shallow else yaml.SafeLoader


def _flow_depth(text: str) -> int:
    """Return an upper bound of the nesting of lists and mappings in brackets.

    Brackets that one line opens and closes add nothing, except next to quotes and comments, which may contain brackets.
    """
    depth = most = 0
    for line in text.splitlines():
        opened = line.count("[") + line.count("{")
        if not opened:
            continue
        most = max(most, opened)
        is_plain = not ('"' in line or "'" in line or "#" in line)
        depth += max(0, opened - line.count("]") - line.count("}")) if is_plain else opened
    return depth + most


def _composed(text: str) -> Any:
    """Return the root node of a YAML text; the reader in Python states the reasons of errors more precisely."""
    import yaml

    try:
        return yaml.compose(text, Loader=loader_of(text))
    except yaml.YAMLError:
        return yaml.compose(text, Loader=yaml.SafeLoader)


class _YamlReader:
    """Convert YAML nodes to settings; the number of nodes is bounded, because aliases are followed."""

    def __init__(self, file: str, separator: str) -> None:
        self._file = file
        self._separator = separator
        self._nodes = 0

    def read(self, name: str, node: Any, key: Position | None, depth: int) -> Settings:
        import yaml

        position = self._at(node)
        self._nodes += 1
        if depth > _MAX_DEPTH or self._nodes > _MAX_NODES:
            raise DescriptionError("nested too deeply, or too many aliases", position=position)
        if isinstance(node, yaml.ScalarNode):
            null = node.tag == "tag:yaml.org,2002:null"
            return Settings(name, position, None if null else str(node.value), key=key)
        if isinstance(node, yaml.SequenceNode):
            items = [self.read(name, item, None, depth + 1) for item in node.value]
            return Settings(name, position, None, tuple(items), key=key)
        group = Settings(name, position, key=key)
        for key_node, value_node in node.value:
            if key_node.tag == "tag:yaml.org,2002:merge":
                inherited = value_node.value if isinstance(value_node, yaml.SequenceNode) else [value_node]
                for other in inherited:
                    group = (
                        self.read(name, other, key, depth + 1).merged(group)
                        if group.children
                        else self.read(name, other, key, depth + 1)
                    )
                continue
            if not isinstance(key_node, yaml.ScalarNode):
                raise DescriptionError("a name must be text", position=self._at(key_node))
            parts = [part for part in str(key_node.value).split(self._separator) if part] or [""]
            child = self.read(parts[-1], value_node, self._at(key_node), depth + 1)
            laid = Settings(name, position, None, None, {parts[-1]: child}, key)
            for part in reversed(parts[:-1]):
                laid = Settings(name, position, None, None, {part: laid}, key)
            group = group.merged(laid) if group.children else laid
        return group

    def _at(self, node: Any) -> Position:
        return Position(self._file, node.start_mark.line + 1, node.start_mark.column + 1)


def node_settings(root: Settings, namespace: str, node: str) -> Settings:
    """Return the parameters of a ROS 2 node: parameters for all nodes, overridden by parameters for this node.

    The file may list the node by name, by full name or below its namespaces.

    Args:
        root: the parameters of a file.
        namespace: absolute namespace of the node.
        node: name of the node.
    """
    full = "/" + "/".join(part for part in f"{namespace}/{node}".split("/") if part)
    found = Settings(node, root.position)
    for path in ("/**", node, f"/**/{node}", full, full[1:]):
        keys = [path] if path in root.children else path.split("/")
        inner: Settings | None = root
        for key in keys:
            if inner is not None and key:
                inner = inner.children.get(key) or inner.children.get(f"/{key}")
        parameters = inner.children.get("ros__parameters") if inner is not None and inner is not root else None
        if parameters is not None and parameters.children:
            own = Settings(node, parameters.position, None, None, parameters.children, inner.key if inner else None)
            found = found.merged(own) if found.children else own
    return found
