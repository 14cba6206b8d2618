"""Parameters of ROS 1 launch files in the namespace of a node that reads them elsewhere, and the reverse.

Sources: roslaunch (a parameter inside of a node is private: ``/node/name``) and rospy (names.py: ``~name`` is private,
``/name`` is global, and ``name`` is in the namespace of the node).
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from urdfkit.description.packages.kept_files import kept
from urdfkit.description.packages.related_files import neighbours
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.yaml_tree import documents
from urdfkit.lint.facts.launch.node_parameters import parameters_of_package
from urdfkit.lint.facts.launch.spawned_controllers import namespace_of, ros1_files, tags
from urdfkit.lint.facts.parameters.loaded_files import parameters_at
from urdfkit.lint.model.model import Model
from urdfkit.lint.model.tags import Attribute, Tag
from urdfkit.lint.project.code_files import node_texts
from urdfkit.record import record

_READ = r"\brospy\.(?:get_param|get_param_cached|has_param)\s*\(\s*[\"']([~/]?)(\w+)[\"']"
_COMPUTED = (
    r"\b(?:get_param|get_param_cached|has_param)\s*\(\s*(?![\"'])|[\"']~?/?(?:%s|\{\w*\})?[\"']\s*[+%.]|search_param"
    r"|[\"']~[\"']"
)
"""Matches code that reads parameters with computed names."""

_SHARED = ("robot_description", "robot_name", "tf_prefix", "use_sim_time")
"""Parameters that many nodes read from the global namespace."""

_PRIVATE = (
    *("amcl", "gazebo_ros", "gmapping", "joint_state_publisher", "joint_state_publisher_gui", "joy", "map_server"),
    *("robot_localization", "robot_state_publisher", "rviz", "tf2_ros"),
)
"""Packages outside of the workspace whose nodes read private parameters and those of `_SHARED` only."""

_OF_OTHERS = re.compile(r"frame|topic")
"""Parts of the names of parameters that nodes of many packages read."""

_NAMED = r"\binit(?:_node)?\s*\([^()]*\)"
"""Matches the call that names a node."""


@record(eq=False)
class _SetParameters:
    """Parameters that an element sets.

    Attributes:
        attribute: attribute with the name of the parameter, or with a file.
        names: names of the parameters; None if they are unknown.
        node: node around the element; None outside of nodes.
        space: namespace of the element; None if it is computed.
    """

    attribute: Attribute
    names: frozenset[str] | None
    node: Tag | None
    space: str | None

    def misplaced(self, word: str) -> str:
        """Return the end of a message: the wrong namespace, and the place for the element."""
        short = self.attribute.value.rpartition("/")[2]
        is_file = self.attribute.name == "file"
        what, verb = (f"{short} is loaded into", "load") if is_file else ("this parameter is in", "write")
        own = self.node.attributes["name"].value if self.node is not None else ""
        return f"but {what} `/{f'{self.space}/{own}'.strip('/')}`; {verb} it {word} of the node"


@record(eq=False)
class _ParameterReader:
    """A node with the names of its private parameters, and of the other parameters that it reads, as its code does."""

    node: Tag
    name: str
    space: str | None
    private: frozenset[str]
    public: dict[str, str]


def parameters_out_of_reach(source: Source, model: Model) -> Iterator[tuple[Attribute, str]]:
    """Yield the parameters and files of a ROS 1 launch file that their node reads from another namespace."""
    written, texts = list(_written(source, model)), _texts(model)
    yield from _repeated_names(written, texts)
    packages = {*_PRIVATE, *(neighbours(model.package) if model.package is not None else ())}
    nodes = [tag.attributes["pkg"].value for _, tag in tags([source], "node") if "pkg" in tag.attributes]
    readers = list(_readers(source, texts, packages.issuperset(nodes)))
    outside, read = (_outside_of_nodes(model), _names_read(model)) if readers else ([], frozenset[str]())
    for each in (one for one in written if one.names):
        found = (_misplaced(each, reader, written, outside, read) for reader in readers)
        message = next((one for one in found if one is not None), None)
        if message is not None:
            yield each.attribute, message


def _misplaced(
    each: _SetParameters,
    reader: _ParameterReader,
    written: list[_SetParameters],
    outside: list[_SetParameters],
    read: frozenset[str],
) -> str | None:
    """Return the message for parameters that a node reads, but not where an element sets them; None for others.

    Args:
        each: the parameters.
        reader: the node.
        written: all parameters of the launch file.
        outside: the parameters that launch files set outside of nodes.
        read: the names in the code of the workspace, except private ones.
    """
    names = each.names or frozenset()
    if _is_same(each.node, reader.node):
        lost = sorted(names & reader.public.keys())
        is_set = any(one.names is None or one.names & {*lost} for one in outside)
        if not lost or is_set or names & reader.private:
            return None
        return f"node `{reader.name}` reads `{reader.public[lost[0]]}`, {each.misplaced('outside')}"
    own = [one.names for one in written if _is_same(one.node, reader.node)]
    if each.node is not None or each.space is None or each.space != reader.space or None in own:
        return None
    lost = sorted((names & reader.private) - {*_SHARED}.union(*(one for one in own if one is not None)))
    if not lost or names & read:
        return None
    return f"node `{reader.name}` reads its private parameter `{lost[0]}`, {each.misplaced('inside')}"


def _is_same(one: Tag | None, other: Tag) -> bool:
    return one is not None and one.start == other.start


def _repeated_names(
    written: list[_SetParameters], texts: list[tuple[str, str, str]]
) -> Iterator[tuple[Attribute, str]]:
    """Yield the files whose only section has the name of the node that loads them into its own namespace.

    The code of the node has to be known: it may read a section with this name.
    """
    packages = {*_PRIVATE, *(package for package, _, _ in texts)}
    for each in written:
        words = each.node.attributes if each.node is not None else {}
        name, package = (words[word].value if word in words else "" for word in ("name", "pkg"))
        is_file = each.attribute.name == "file"
        if not (is_file and name and each.names == frozenset((name,)) and package in packages):
            continue
        is_read = rf"[\"']~?/?{re.escape(name)}[\"'/]"
        if not any(re.search(is_read, re.sub(_NAMED, "", text)) for _, _, text in texts):
            short = each.attribute.value.rpartition("/")[2]
            message = f"the only section of {short} is `{name}`, so its parameters are in `/{name}/{name}`"
            yield each.attribute, f"{message}; load it outside the node"


@kept
def _outside_of_nodes(model: Model) -> list[_SetParameters]:
    """Return the parameters that the launch files set outside of nodes."""
    return [each for file in ros1_files(model) for each in _written(file, model) if each.node is None]


def _written(source: Source, model: Model) -> Iterator[_SetParameters]:
    for _, tag in (*tags([source], "param"), *tags([source], "rosparam")):
        at = tag.attributes
        node = next((each for each in tag.ancestors() if each.name == "node"), None)
        attribute = at.get("name" if tag.name == "param" else "file")
        names: frozenset[str] | None = None
        if attribute is None or ("command" in at and at["command"].value != "load"):
            continue
        if tag.name == "param" and re.fullmatch(r"\w+", attribute.value):
            names = frozenset((attribute.value,))
        elif tag.name == "rosparam" and not {"ns", "param"} & at.keys():
            parameters = parameters_at(attribute.value, model)
            roots = documents(parameters) if parameters is not None else ()
            names = frozenset(key.text for root in roots for key, _ in root.entries) if roots else None
        if names is not None or tag.name == "rosparam":
            yield _SetParameters(attribute, names, node, namespace_of(tag))


def _readers(source: Source, texts: list[tuple[str, str, str]], is_complete: bool) -> Iterator[_ParameterReader]:
    """Yield the nodes whose parameters are known.

    Args:
        source: a launch file.
        texts: the code of the workspace.
        is_complete: whether no node of the file can read parameters of its namespace in code outside of the workspace.
    """
    for _, tag in tags([source], "node"):
        at = tag.attributes
        if not {"pkg", "type", "name"} <= at.keys() or "$" in at["name"].value or _has_inner(tag):
            continue
        package, program = at["pkg"].value, at["type"].value.removesuffix(".py")
        own = [text for name, stem, text in texts if (name, stem) == (package, program)]
        private, public = frozenset[str](), dict[str, str]()
        if package in _PRIVATE and package == program.removeprefix("slam_"):
            names = parameters_of_package(package)
            private = frozenset(name for name in names if is_complete or not _OF_OTHERS.search(name))
        elif len(own) == 1 and "rospy" in own[0] and not re.search(_COMPUTED, own[0]):
            read = re.findall(_READ, own[0])
            private = frozenset(name for kind, name in read if kind == "~")
            others = " ".join(_imported(own[0], texts))
            if not re.search(_COMPUTED, others):
                others_private = {name for kind, name in re.findall(_READ, others) if kind == "~"}
                public = {name: f"{kind}{name}" for kind, name in read if kind != "~"}
                public = {name: text for name, text in public.items() if name not in private | others_private}
            private = private if is_complete else frozenset()
        remaps = [each.attributes for each in tag.children if each.name == "remap"]
        words = {value.value.strip("~/") for remap in remaps for value in remap.values()}
        words.update(re.findall(r"(?:^|\s)_(\w+):=", at["args"].value) if "args" in at else ())
        private, public = private - words, {name: text for name, text in public.items() if name not in words}
        if private or public:
            yield _ParameterReader(tag, at["name"].value, namespace_of(tag), private, public)


def _imported(code: str, texts: list[tuple[str, str, str]]) -> list[str]:
    """Return the code of the packages and modules of the workspace that code in Python imports."""
    words = {word for line in re.findall(r"(?m)^\s*(?:from|import)\s+(.*)", code) for word in re.findall(r"\w+", line)}
    return [text for package, stem, text in texts if "rospy" in text and not words.isdisjoint((package, stem))]


def _has_inner(node: Tag) -> bool:
    """Return whether a node has parameters in the text of its elements."""
    return any(each.name == "rosparam" and "file" not in each.attributes for each in node.children)


@kept
def _names_read(model: Model) -> frozenset[str]:
    """Return the last words of the names in the code of the workspace, except private names."""
    name = re.compile(r"[\"'](?:[\w/]*/)?(\w+)(?=[\"'])")
    return frozenset(word for _, _, text in _texts(model) for word in name.findall(text))


@kept
def _texts(model: Model) -> list[tuple[str, str, str]]:
    """Return package, name without its ending, and text of each file with code in the workspace."""
    folders = neighbours(model.package) if model.package is not None else {}
    return [(name, path.stem, text) for name, folder in folders.items() for path, text in node_texts(folder)]
