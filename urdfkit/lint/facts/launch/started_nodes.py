"""Nodes that ROS 2 launch files start, with the names of their parameters."""

import ast
import re
from collections.abc import Iterator

from urdfkit.description.launch.python_constants import LaunchReader, launch_reader, name_of
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.launch_package_paths import place
from urdfkit.lint.facts.launch.python.names import python_files
from urdfkit.lint.facts.launch.ros_version import reads_ros1
from urdfkit.lint.facts.nodes.started import MOVEIT_PARTS, part_of_moveit
from urdfkit.lint.model.model import Model
from urdfkit.lint.model.tags import Document, Tag
from urdfkit.record import record


@record(eq=False)
class StartedNode:
    """A ROS 2 node.

    Attributes:
        source: the launch file.
        start: start offset of the node.
        end: end offset of the node, or of its start tag.
        package: its package; empty if it is computed.
        program: its executable; empty if it is computed.
        parameters: names of its parameters, up to a dot; None if there can be others, such as those of files.
        has_arguments: whether it has command line arguments.
    """

    source: Source
    start: int
    end: int
    package: str
    program: str
    parameters: tuple[str, ...] | None
    has_arguments: bool

    @property
    def settings_place(self) -> tuple[int, int]:
        """Where parameters are to be added: at the first of ``parameters`` in Python, else at the node."""
        if not self.source.file.endswith(".py"):
            return self.start, self.end
        others = "|".join(re.escape(name) for name in self.parameters or () if name != "use_sim_time")
        named = re.compile(rf"[\"'](?:{others or '(?!)'})[\"']")
        for pattern in (named, re.compile(r"(?<=\[)\s*[^\s,\]]+")):
            start = self.source.text.find("parameters", self.start, self.end)
            found = pattern.search(self.source.text, start, self.end) if start >= 0 else None
            if found is not None:
                return found.end() - len(found[0].strip()), found.end()
        return self.start, self.end


def started_nodes(model: Model) -> Iterator[StartedNode]:
    """Yield the nodes of launch files in XML and Python; files that set parameters for all nodes are ignored."""
    for source, tree in python_files(model):
        if "SetParameter" not in source.text:
            yield from _in_python(source, tree)
    for name, source in model.related_files.items():
        is_xml = name.endswith((".launch", ".launch.xml", "_launch.xml"))
        if is_xml and not reads_ros1(source) and "set_parameter" not in source.text:
            for root in Document(source).roots:
                yield from (_from_tag(source, tag) for tag in root.walk() if tag.name == "node")


def _from_tag(source: Source, tag: Tag) -> StartedNode:
    attributes = tag.attributes
    package, program = (attributes[name].value if name in attributes else "" for name in ("pkg", "exec"))
    inner = [child.attributes for child in tag.children if child.name == "param"]
    is_literal = all("name" in each and "$" not in each["name"].value for each in inner)
    names = tuple(each["name"].value.partition(".")[0] for each in inner) if is_literal else None
    has_arguments = "args" in attributes or "ros_args" in attributes
    return StartedNode(source, tag.start, tag.end, package, program, names, has_arguments)


def _in_python(source: Source, tree: ast.Module) -> Iterator[StartedNode]:
    reader = launch_reader(tree)
    for node in ast.walk(tree):
        if not isinstance(node, ast.Call) or name_of(node.func) not in ("Node", "LifecycleNode"):
            continue
        words = {word.arg: word.value for word in node.keywords}
        if None in words:
            continue
        package, program = (reader.text(words[key]) if key in words else None for key in ("package", "executable"))
        names = _names(words["parameters"], reader, source) if "parameters" in words else ()
        has_arguments = "arguments" in words or "ros_arguments" in words
        start, end = place(source, node)
        yield StartedNode(source, start, end, package or "", program or "", names, has_arguments)


def _names(node: ast.expr, reader: LaunchReader, source: Source) -> tuple[str, ...] | None:
    """Return the names of parameters in a list of dictionaries; None if it may contain others.

    A part of a MoveIt configuration counts as the parameter with its name.
    """
    if not isinstance(node, ast.List):
        return None
    found: list[str] = []
    for item in node.elts:
        if (part := part_of_moveit(item, reader, source)) is not None:
            found += MOVEIT_PARTS if part == "to_dict" else (part,)
            continue
        is_changed = isinstance(item, ast.Name) and any(f"{item.id}{end}" in source.text for end in ("[", ".update"))
        value = reader.assigned.get(item.id) if isinstance(item, ast.Name) else item
        if not isinstance(value, ast.Dict) or is_changed:
            return None
        texts = [reader.text(key) if key is not None else None for key in value.keys]
        if None in texts:
            return None
        found += [text for text in texts if text is not None]
    return tuple(name.partition(".")[0] for name in found)
