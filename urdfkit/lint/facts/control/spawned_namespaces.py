"""Namespaces of controllers in ROS 1: where launch files load their parameters, and where the spawner reads them."""

import re
from collections.abc import Iterator

from urdfkit.description.xml.element import Element
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.yaml_tree import Node, documents
from urdfkit.lint.facts.gazebo.plugins import plugins
from urdfkit.lint.model.model import Model
from urdfkit.lint.model.tags import Document, Tag
from urdfkit.record import record

_SPAWNERS = ("spawner", "controller_manager")
_MAX_DEPTH = 4


@record(eq=False)
class MisplacedControllers:
    """Controllers whose parameters are in another namespace than their spawner reads.

    Attributes:
        source: the YAML file of the parameters.
        key: the key of the namespace, or of the controller if the file has no namespace.
        controller: name of the controller.
        found: namespace of its parameters.
        expected: namespace of the spawner.
        line: line of the spawner in the launch file.
        loaded_at: start and end of the namespace in the launch file that moves the parameters; None if the YAML does.
    """

    source: Source
    key: Node
    controller: str
    found: str
    expected: str
    line: int
    loaded_at: tuple[int, int] | None = None


def paths_of_controllers(source: Source) -> Iterator[tuple[Node, ...]]:
    """Yield the keys from the start of a YAML file to each controller with a type."""
    for root in documents(source):
        yield from _paths(root, ())


def _paths(node: Node, above: tuple[Node, ...]) -> Iterator[tuple[Node, ...]]:
    for key, value in node.entries if len(above) < _MAX_DEPTH else ():
        kind = value.find("type")
        if kind is not None and re.fullmatch(r"\w+/\w+", kind.text):
            yield (*above, key)
        else:
            yield from _paths(value, (*above, key))


def misplaced_controllers(launch: Source, model: Model) -> Iterator[MisplacedControllers]:
    """Yield the controllers that a launch file loads and spawns in different namespaces; one of each namespace."""
    tags = [tag for root in Document(launch).roots for tag in root.walk()]
    loaded: dict[str, tuple[Source, tuple[Node, ...], str, Tag]] = {}
    places: set[str] = set()
    for tag in tags:
        if tag.name != "rosparam" or _value(tag, "command") not in ("load", ""):
            continue
        source, above = _file(tag, model), _namespace(tag)
        if source is None or above is None or _value(tag, "param"):
            return
        for path in paths_of_controllers(source):
            place = _joined(above, *(key.text for key in path))
            places.add(place)
            loaded[path[-1].text] = (source, path, place.rpartition("/")[0], tag)
    seen: set[str] = set()
    for tag in tags:
        arguments = _value(tag, "args")
        if tag.name != "node" or _value(tag, "type") not in _SPAWNERS or _value(tag, "pkg") != "controller_manager":
            continue
        expected = _namespace(tag)
        if expected is None or "--" in arguments or "$" in arguments:
            continue
        for name in arguments.split():
            if _joined(expected, name) in places or name not in loaded:
                continue
            source, path, found, loader = loaded[name]
            if found not in seen:
                seen.add(found)
                line, own = launch.position(tag.start).line, loader.attributes.get("ns")
                is_own = own is not None and len(path) == 1 and f"/{own.value.strip('/')}" == found
                at = (own.value_start, own.value_end) if own is not None and is_own else None
                yield MisplacedControllers(source, path[0], name, found, expected, line, at)


def plugins_in_other_namespace(model: Model) -> Iterator[tuple[Element, str]]:
    """Yield the namespace of each gazebo_ros_control in which no launch file spawns controllers, with the message."""
    from urdfkit.lint.facts.launch.spawned_controllers import ros1_files, spawners

    found = [spawner for spawner in spawners(ros1_files(model)) if spawner.names]
    if not found or any("/" in spawner.tag.attributes["args"].value for spawner in found):
        return
    namespaces = {spawner.namespace for spawner in found}
    for plugin, _, _ in plugins(model.robot):
        written = plugin.element.find("robotNamespace") if "gazebo_ros_control" in (plugin.filename or "") else None
        if written is not None and "$" not in written.text and written.text.strip().strip("/") not in namespaces:
            spawner = found[0]
            place = f"{spawner.source.file}:{spawner.source.position(spawner.tag.start).line}"
            where = f"namespace `{spawner.namespace}`" if spawner.namespace else "no namespace"
            message = f"the controller manager is in namespace `{written.text.strip()}`, but the spawner"
            yield written, f"{message} in {place} is in {where}"


def _joined(*parts: str) -> str:
    """Return a name in namespaces; a part that begins with a slash is absolute."""
    name = ""
    for part in parts:
        name = part if part.startswith("/") else f"{name}/{part}"
    return re.sub(r"/+", "/", name).rstrip("/")


def _value(tag: Tag, name: str) -> str:
    return tag.attributes[name].value.strip() if name in tag.attributes else ""


def _namespace(tag: Tag) -> str | None:
    """Return the namespace of an element; None if it is computed."""
    found: list[str] = []
    each: Tag | None = tag
    while each is not None:
        if namespace := _value(each, "ns"):
            found.insert(0, namespace)
        each = each.parent
    return None if any("$" in namespace for namespace in found) else _joined(*found)


def _file(tag: Tag, model: Model) -> Source | None:
    """Return the related file that a <rosparam> loads; None if it is unknown or named by an argument."""
    path = re.fullmatch(r"\$\(find [\w-]+\)/([^$]+)", _value(tag, "file"))
    files = [] if path is None else [name for name in model.related_files if f"/{name}".endswith(f"/{path[1]}")]
    return model.related_files[files[0]] if len(files) == 1 else None
