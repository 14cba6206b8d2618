"""Controllers that ROS 1 launch files spawn, and the parameter files that define and load them."""

import re
from collections.abc import Iterator
from pathlib import Path

from urdfkit.description.packages.related_files import neighbours
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.launch_package_paths import uncommented
from urdfkit.lint.facts.control.yaml_tree import Node, documents, yamls
from urdfkit.lint.facts.launch.ros_version import reads_ros1
from urdfkit.lint.model.model import Model
from urdfkit.lint.model.tags import Document, Tag
from urdfkit.record import record

_SPAWNERS = ("spawner", "controller_manager")
_MAX_DEPTH = 5
_MAX_FILES = 200


@record(eq=False)
class Spawner:
    """A spawner of controllers.

    Attributes:
        source: the launch file.
        tag: the <node> element.
        names: the controllers that it spawns.
        namespace: its namespace in the launch file, without slashes at its ends.
    """

    source: Source
    tag: Tag
    names: tuple[str, ...]
    namespace: str


def ros1_files(model: Model) -> list[Source]:
    """Return the launch files that roslaunch reads."""
    files = model.related_files.items()
    return [source for name, source in files if name.endswith((".launch", ".launch.xml")) and reads_ros1(source)]


def tags(files: list[Source], name: str) -> Iterator[tuple[Source, Tag]]:
    """Yield the elements with a name."""
    for source in files:
        for root in Document(source).roots:
            yield from ((source, tag) for tag in root.walk() if tag.name == name)


def namespace_of(tag: Tag) -> str | None:
    """Return the namespace of an element in its launch file, without slashes at its ends; None if it is computed."""
    found = ""
    for each in reversed([tag, *tag.ancestors()]):
        written = each.attributes.get("ns")
        if written is not None:
            found = written.value if written.value.startswith("/") else f"{found}/{written.value}"
    return found.strip("/") if "$" not in found else None


def spawners(files: list[Source]) -> Iterator[Spawner]:
    """Yield the spawners with literal names and namespaces, in files that are not included in a namespace."""
    moved = {
        tag.attributes["file"].value.rpartition("/")[2]
        for _, tag in tags(files, "include")
        if "file" in tag.attributes and namespace_of(tag) != ""
    }
    for source, tag in tags(files, "node"):
        attributes = tag.attributes
        program, arguments = (attributes[name].value if name in attributes else "" for name in ("type", "args"))
        namespace = namespace_of(tag)
        is_literal = namespace is not None and "namespace" not in arguments and "__ns" not in arguments
        if program in _SPAWNERS and is_literal and Path(source.file).name not in moved:
            words = [word for word in arguments.split() if word not in ("spawn", "load", "unspawn")]
            names = tuple(word for word in words if re.fullmatch(r"[A-Za-z]\w*", word))
            yield Spawner(source, tag, names, namespace or "")


def definitions(model: Model) -> dict[str, list[tuple[Source, str]]]:
    """Return controller → the YAML files that define it, and the namespace in the file."""
    found: dict[str, list[tuple[Source, str]]] = {}

    def visit(source: Source, node: Node, path: tuple[str, ...]) -> None:
        for key, value in node.entries if len(path) < _MAX_DEPTH else ():
            kind = value.find("type")
            if kind is not None and "/" in kind.text:
                parts = (*path, *key.text.strip("/").split("/"))
                found.setdefault(parts[-1], []).append((source, "/".join(parts[:-1])))
            else:
                visit(source, value, (*path, key.text.strip("/")))

    for source in yamls(model):
        for root in documents(source):
            visit(source, root, ())
    return found


def loaders(files: list[Source], parameters: Source) -> list[str] | None:
    """Return the namespaces in which launch files load a YAML file; None if some of them are computed."""
    name = Path(parameters.file).name
    found = []
    for _, tag in tags(files, "rosparam"):
        attributes = tag.attributes
        file = attributes["file"].value.rpartition("/")[2].strip("'") if "file" in attributes else ""
        if "$" in file or file.endswith(")"):
            return None
        if file == name:
            namespace = namespace_of(tag)
            if namespace is None or "param" in attributes:
                return None
            found.append(namespace)
    mentions = sum(len(re.findall(rf"(?<![\w.-]){re.escape(name)}", uncommented(source))) for source in files)
    return found if mentions == len(found) else None


def is_mentioned_elsewhere(name: str, model: Model) -> bool:
    """Return whether a launch file of a package next to the robot's that is not a related file contains a file name."""
    related = {str(Path(file).absolute()) for file in model.related_files}
    for folder in neighbours(model.package).values() if model.package is not None else ():
        model.expanded.packages.watch(folder, ".launch", ".xml")
        for file in [*folder.glob("launch/**/*.launch"), *folder.glob("launch/**/*.xml")][:_MAX_FILES]:
            try:
                is_other = str(file.absolute()) not in related and file.is_file()
                if is_other and name in file.read_text("utf-8", "replace"):
                    return True
            except OSError:
                continue
    return False
