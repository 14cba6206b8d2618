"""Parameters of well-known ROS 2 nodes in YAML: values of the wrong type, names of other nodes, nested lists."""

import re
from collections.abc import Iterable, Iterator
from fnmatch import fnmatchcase

from urdfkit.defect_message import Suggestion
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.controller_settings import misspelt_sections, settings
from urdfkit.lint.facts.control.ros2_controllers import PARAMETERS
from urdfkit.lint.facts.control.yaml_tree import Node, documents, nodes, walk, yamls
from urdfkit.lint.facts.navigation.defects import choice_defects
from urdfkit.lint.facts.navigation.sections import sections
from urdfkit.lint.facts.nodes.node_sections import groups_of
from urdfkit.lint.facts.nodes.started import launched_nodes, parameter_files
from urdfkit.lint.facts.parameters.other_names import renamed_in
from urdfkit.lint.facts.parameters.schemas import OF_CONTROLLERS, OF_GROUPS, OF_ROS1, renamed, schemas
from urdfkit.lint.model.model import Model

Defects = Iterator[tuple[Node, str]]

_INTEGER = r"[-+]?\d+"
_DOUBLE = r"[-+]?(?:\d+\.\d*|\.\d+|\d+(?=[eE]))(?:[eE][-+]?\d+)?"
_TRUTH = r"(?i:true|false|yes|no|on|off|y|n)"


def node_defects(source: Source) -> Defects:
    """Yield values of the wrong type, renamed parameters and nested lists in a ROS 2 YAML file."""
    for key, group in sections(source) if PARAMETERS in source.text else ():
        kind = kind_of(key, group)
        others, written = renamed().get(kind, {}), {name for name, _, _ in parameters(group)}
        for name, parameter, value in parameters(group):
            right = others.get(name)
            if right is not None and right not in written and not _is_named_by(group, name):
                yield parameter, f"`{key.text}` has no parameter `{name}`" + Suggestion(right, name)
            for pattern, type in schemas().get(kind, ()):
                if fnmatchcase(name, pattern) and (problem := type_problem(name, value, type)):
                    yield (parameter if value.kind == "group" else value), problem
        if kind.startswith("teleop"):
            yield from _shared_axes(group)
        yield from outside_of_empty_groups(group, schemas().get(kind, ()))
        for node in walk(group):
            yield from _renamed_in_groups(node)
    yield from _nested_lists(source)


def node_defects_of_ros1(model: Model) -> Iterator[tuple[Source, Node, str]]:
    """Yield the parameters of ROS 2 in the YAML files of ROS 1: of controllers, costmaps and launched nodes."""
    for source in yamls(model):
        if PARAMETERS in source.text or any(misspelt_sections(source)):
            continue
        for one in settings(source):
            names = OF_CONTROLLERS.get(one.kind, {})
            yield from ((source, *defect) for defect in renamed_in(one.name, one.group, names))
        for node in nodes(source):
            for key, inputs in node.entries if "priority" in source.text else ():
                is_group = key.text in ("topics", "locks") and any(each.find("priority") for _, each in inputs.entries)
                if is_group:
                    message = (
                        f"`{key.text}` of twist_mux in ROS 1 is a list; write `- name: {inputs.entries[0][0].text}`"
                    )
                    yield source, key, message
            if node.find("topic") is not None and (kind := node.find("data_type")) is not None:
                names = {new: old for old, new in OF_GROUPS.get(kind.text, {}).items()}
                yield from ((source, *defect) for defect in renamed_in(kind.text, node, names))
    files, seen = parameter_files(model), set[tuple[str, int]]()
    for launched in launched_nodes(model):
        names = OF_ROS1.get(launched.package, {})
        for source, group in groups_of(launched, files) if names else ():
            if PARAMETERS not in source.text:
                for place, message in (*renamed_in(launched.program, group, names), *choice_defects(group)):
                    if (source.file, place.line) not in seen:
                        seen.add((source.file, place.line))
                        yield source, place, message


def wrong_numbers_of_nodes(source: Source) -> Iterator[tuple[Node, str, str]]:
    """Yield integers in parameters of the type double, and the reverse: value, parameter, the right text."""
    for key, group in sections(source) if PARAMETERS in source.text else ():
        kind = kind_of(key, group)
        for name, _, value in parameters(group):
            if value.kind != "text" or not value.is_plain:
                continue
            for pattern, type in schemas().get(kind, ()) if re.fullmatch(r"[-+.\d]+", value.text) else ():
                if type == "double" and re.fullmatch(_INTEGER, value.text) and fnmatchcase(name, pattern):
                    yield value, name, f"{value.text}.0"
                elif type.split()[0] == "int" and re.fullmatch(_DOUBLE, value.text) and fnmatchcase(name, pattern):
                    yield value, name, f"{float(value.text):.0f}"


def kind_of(key: Node, group: Node) -> str:
    """Return the node of the schemas to which a section belongs."""
    name = key.last_name
    if group.find("world_frame") is not None or re.fullmatch(r"[eu]kf_(?:filter|localization|se)?_?node\w*", name):
        return "ekf"
    return name


def parameters(group: Node, prefix: str = "", depth: int = 0) -> Iterator[tuple[str, Node, Node]]:
    """Yield the parameters of a node: full name, key and value; groups too."""
    for key, value in group.entries:
        yield f"{prefix}{key.text}", key, value
        if value.kind == "group" and depth < 4:
            yield from parameters(value, f"{prefix}{key.text}.", depth + 1)


def outside_of_empty_groups(group: Node, rows: Iterable[tuple[str, str]]) -> Defects:
    """Yield the first entry after each empty group of a section that belongs in this group.

    Args:
        group: the section.
        rows: the patterns of its parameters with their types.
    """
    patterns = [pattern for pattern, _ in rows]
    accepted = {pattern.partition(".")[0] for pattern in patterns}
    for at, (key, value) in enumerate(group.entries[:-1]):
        inner = [pattern.removeprefix(f"{key.text}.") for pattern in patterns if pattern.startswith(f"{key.text}.")]
        if not inner or value.kind != "text" or value.text or not value.is_plain:
            continue
        name, member = group.entries[at + 1]
        parts = {pattern.removeprefix("*.") for pattern in inner if pattern.startswith("*.")}
        is_member = bool(member.entries) and {each.text for each, _ in member.entries} <= parts
        if name.text not in accepted and (is_member or name.text in inner):
            yield name, f"`{name.text}` belongs in `{key.text}`, which is empty; indent it"


def _is_named_by(group: Node, name: str) -> bool:
    """Return whether a list of the node names a group, such as a plugin ``topic``."""
    return any(item.text == name for _, value in group.entries for item in value.items)


def type_problem(name: str, value: Node, type: str) -> str:
    """Return why a value has not the type of its parameter; empty if it has, or if it is computed."""
    kind, *rest = type.split()
    if kind == "keys":
        if value.kind == "group":
            wrong = next((key.text for key, _ in value.entries if key.text not in rest), None)
            return f"`{name}` has no `{wrong}`; write {_listed(rest)}" if wrong is not None else ""
        is_empty = value.kind == "text" and not value.text
        return "" if is_empty or "$" in value.text else f"`{name}` is a group; write `{rest[0]}` below it"
    if value.kind == "group":
        return f"`{name}` is a group of parameters, but must be {_KINDS[kind]}" if value.entries else ""
    if kind == "list":
        if value.kind != "list":
            needs_list = value.text and "$" not in value.text
            return f"`{name}` is not a list; write it in brackets" if needs_list else ""
        lengths = [int(each) for each in rest[1:]]
        if lengths and len(value.items) not in lengths:
            return f"`{name}` has {len(value.items)} values; it must have {' or '.join(rest[1:])}"
        if rest[0] == "bool" and any(re.fullmatch(_INTEGER, each.text) for each in value.items if each.is_plain):
            return f"`{name}` contains numbers; write true and false"
        return ""
    if value.kind == "list":
        return f"`{name}` is a list, but must be {_KINDS[kind]}"
    if rest and re.fullmatch(_INTEGER, value.text) and not int(rest[0]) <= int(value.text) <= int(rest[1]):
        return f"`{name}` is {value.text}; it must be between {rest[0]} and {rest[1]}"
    return _scalar(name, value, kind) if value.text and "$" not in value.text else ""


_KINDS = {"bool": "true or false", "double": "a number", "int": "an integer", "list": "a list", "text": "a string"}


def _scalar(name: str, value: Node, kind: str) -> str:
    text, is_number = value.text, re.fullmatch(rf"{_INTEGER}|{_DOUBLE}|[-+]?\.(?i:inf|nan)", value.text) is not None
    if kind == "text":
        is_other = value.is_plain and (is_number or re.fullmatch(r"(?i:true|false)", text))
        return f"`{name}` is {text}, which is not a string" if is_other else ""
    if kind == "bool":
        is_truth = re.fullmatch(_TRUTH, text) is not None
        if is_truth and value.is_plain:
            return ""
        return (
            f'`{name}` is "{text}", a string; write {text.lower()}'
            if is_truth
            else f"`{name}` is `{text}`, which is neither true nor false"
        )
    if not is_number:
        return f"`{name}` is `{text}`, which is not a number"
    return "" if value.is_plain else f'`{name}` is "{text}", a quoted string'


def _listed(names: list[str]) -> str:
    return ", ".join(f"`{name}`" for name in names[:-1]) + f" or `{names[-1]}`"


def _renamed_in_groups(node: Node) -> Defects:
    """Yield the ROS 1 parameters in plugins and observation sources of Nav2."""
    for kind in [value.text for key, value in node.entries if key.text in ("plugin", "data_type")]:
        yield from renamed_in(kind, node, OF_GROUPS.get(kind, {}))


def _shared_axes(group: Node) -> Defects:
    """Yield the axes of a joystick that move the robot in two directions."""
    seen: dict[str, str] = {}
    for name, _, value in parameters(group):
        if re.match(r"axis_(?:linear|angular)\.", name) and re.fullmatch(r"\d+", value.text):
            if value.text in seen:
                yield value, f"`{seen[value.text]}` and `{name}` are both {value.text}"
            seen.setdefault(value.text, name)


def _nested_lists(source: Source) -> Defects:
    """Yield lists and groups in lists below ``ros__parameters``, which rcl_yaml_param_parser refuses.

    Sources: rcl_yaml_param_parser/src/parse.c; ros-navigation/navigation2, issues 1874 and 1976.
    """
    for root in documents(source) if PARAMETERS in source.text else ():
        for section in [inner for node in walk(root) if (inner := node.find(PARAMETERS)) is not None]:
            for key, value in (entry for node in walk(section) for entry in node.entries):
                lists = [item for item in value.items if item.kind == "list"]
                # The parser accepts groups of lists by chance.
                groups = [item for item in value.items if len(item.entries) > 1 and item.entries[0][1].kind == "text"]
                if len(lists) > 1:
                    message = f"`{key.text}` is a list of lists, which ROS 2 rejects; write points as a"
                    yield value, f'{message} string, "[[x, y], ...]"'
                elif groups:
                    message = f"`{key.text}` is a list of groups, which ROS 2 rejects; list names, and write"
                    yield value, f"{message} a group for each name"
