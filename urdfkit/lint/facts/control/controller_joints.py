"""Controllers in YAML: their names, types and joints, with source offsets."""

import re
from collections.abc import Iterator
from functools import lru_cache

from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.launch_package_paths import uncommented
from urdfkit.lint.facts.control.yaml_tree import Node, documents, documents_in, groups, start_of, walk
from urdfkit.record import record

_TYPE = r"(?<!\w)\w*(?:_controllers?|_broadcaster)/\w+"
_JOINTS = r"joints?|(?:left|right)_wheel(?:_names)?|(?:traction|steering)_joints?_names?|(?:front|rear)_wheels_names"

_GAINS = "pid_gains"
"""Section of gazebo_ros_control with the gains of joints."""

_WRITTEN_TYPE = r"(?m)(?:^|[{,])[ \t]*type[ \t]*:[ \t]*[\"']?([\w-]+/[\w-]+)[\"']?[ \t]*(?=\r?$|[},])"


@record
class Named:
    """A name in YAML or a launch file, and the offset of its first character.

    Attributes:
        name: the name.
        start: offset of the name, or of the expression that computes it.
        stop: offset after the expression that computes it; None for a name that is written in the file.
    """

    name: str
    start: int
    stop: int | None = None

    @property
    def end(self) -> int:
        """Offset after its last character."""
        return self.start + len(self.name) if self.stop is None else self.stop


def typed(source: Source) -> Iterator[Named]:
    """Yield the plugin types in a YAML file: ``package/Class``."""
    for at in re.finditer(_WRITTEN_TYPE, uncommented(source)):
        yield Named(at[1], at.start(1))


def controllers(source: Source) -> list[str]:
    """Return the names of the controllers with a type in a YAML file."""
    return [name for name, _ in _of_controllers(source.text)]


def joints(source: Source) -> Iterator[Named]:
    """Yield the joints named in a YAML file that configures controllers or gazebo_ros_control; else nothing."""
    if controllers(source) or _GAINS in source.text:
        for root in documents(source):
            yield from _named(source, root)


def joints_of(source: Source, kind: Named) -> list[str]:
    """Return the joints in the settings of the controller with the type `kind`, which is a result of `typed`."""
    for _, group in _of_controllers(source.text):
        node = group.find("type")
        if node is not None and start_of(source, node) == kind.start:
            return [named.name for named in _named(source, group)]
    return []


@lru_cache(maxsize=400)
def _of_controllers(text: str) -> tuple[tuple[str, Node], ...]:
    """Return name and settings of each controller with a type; several rules read them in every YAML file."""
    if not re.search(_TYPE, text):
        return ()
    found = []
    for root in documents_in(text)[0]:
        for name, group in groups(root):
            kind = group.find("type")
            if kind is not None and re.fullmatch(_TYPE, kind.text):
                found.append((name, group))
    return tuple(found)


def _named(source: Source, part: Node) -> Iterator[Named]:
    """Yield the joints named below a node; each source offset once, because aliases repeat nodes."""
    places: dict[int, str] = {}
    for node in walk(part):
        for key, value in node.entries if node.kind == "group" else ():
            for item in (value, *value.items) if re.fullmatch(_JOINTS, key.text) else ():
                if item.kind == "text" and re.fullmatch(r"[\w./-]+", item.text):
                    places.setdefault(start_of(source, item), item.text)
            for joint, gains in value.entries if key.text.rpartition("/")[2] == _GAINS else ():
                if gains.kind == "group" and re.fullmatch(r"[\w.-]+", joint.text):
                    places.setdefault(start_of(source, joint), joint.text)
            section, _, joint_name = key.text.rpartition("/")
            if section.endswith(f"gazebo_ros_control/{_GAINS}") and value.kind == "group":
                places.setdefault(start_of(source, key) + len(section) + 1, joint_name)
    yield from (Named(name, start) for start, name in sorted(places.items()))
