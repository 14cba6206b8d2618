"""Entries of YAML files that differ from others of the same file: misspelt keys and names, lengths, quoted values.

These checks need no table of a node: sections of the same shape, a list and the sections that it names, and the joints
of the robot are compared with each other.
"""

import re
from collections import Counter
from collections.abc import Iterator

from urdfkit.defect_message import Suggestion
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.ros2_controllers import PARAMETERS
from urdfkit.lint.facts.control.yaml_tree import Node, nodes, number_of
from urdfkit.lint.facts.ros_packages import is_slip
from urdfkit.lint.model.model import Model

Defects = Iterator[tuple[Node, str]]

_FEWEST = 3
"""Smallest number of sections that are compared with each other."""

_MAX_DEPTH = 3
_SHORTEST = 4
"""Smallest number of letters of a name that is compared."""

_NAME = r"[A-Za-z][\w/:.-]*"
_LISTS_OF_NAMES = (
    r"(?:\w+_)?plugins|observation_sources|polygons|critics|filters|sensors|(?:command_|state_)?interfaces|joints"
    r"|(?:controller_)?joint_names|(?:controller|node|wheel|link|interface)_names|re(?:quest|sponse)_adapters|links"
)
"""Matches lists whose entries are all different."""

_NUMBERS = (
    r"(?:.*_)?(?:rate|frequency|timeout|tolerance|radius|separation|velocity|vel|acc|accel|acceleration|resolution|range"
    r"|height|width|dist|distance|period|interval|duration|scale|factor|weight|priority|gain|threshold|angle|depth)"
)
"""Matches parameters that are numbers."""

_FOLDERS = r"/(?:config|configs|cfg|params?|parameters|yaml)/[^/]*$"
"""Matches files in a folder of parameters."""

_POSITIVE = r"(?:.*_)?(?:rate|frequency|radius|separation|resolution|tolerance|period|wheelbase|multiplier)"
"""Matches parameters that are not negative; -1 stands for a default."""


def odd_entries(source: Source, model: Model) -> Defects:
    """Yield the entries that differ from others of their file or from the joints of the robot, with a message."""
    is_parameter_file = PARAMETERS in source.text or re.search(_FOLDERS, source.file) is not None
    for node in nodes(source):
        if node.kind == "list":
            yield from _odd_sections([item for item in node.items if item.kind == "group"])
            continue
        if not node.entries:
            continue
        yield from _odd_sections([value for _, value in node.entries if value.kind == "group"])
        yield from _unlisted_sections(source, node)
        yield from _odd_lengths(node)
        yield from _odd_values(node, is_parameter_file)
        yield from _misspelt_joints(node, model)
        for key, value in node.entries:
            if re.fullmatch(_LISTS_OF_NAMES, key.text):
                yield from _repeated(key, value)


def _odd_sections(sections: list[Node]) -> Defects:
    """Yield the keys, names and lists of sections of the same shape that only one of them has in this form."""
    if len(sections) < _FEWEST:
        return
    flat = [_flat(section) for section in sections]
    count = Counter(path for each in flat for path in each)
    common = [path for path, times in count.items() if times >= _FEWEST - 1 and times >= len(flat) - 1]
    for each in flat:
        for path, (key, _) in each.items():
            if count[path] != 1 or len(key.text) < _SHORTEST:
                continue
            others = [one for one in common if one not in each and one[:-1] == path[:-1]]
            near = next((name for *_, name in others if is_slip(key.text, name)), None)
            if near is not None:
                yield key, f"unknown key `{key.text}`, unlike the other sections" + Suggestion(near, key.text)
    for path in common:
        values = [value for each in flat if path in each for _, value in [each[path]]]
        yield from _odd_names(path[-1], [value for value in values if value.kind == "text" and value.is_plain])
        yield from _odd_list(path[-1], values)


def _flat(section: Node) -> dict[tuple[str, ...], tuple[Node, Node]]:
    """Return the entries below a section: path of names → key and value."""
    found: dict[tuple[str, ...], tuple[Node, Node]] = {}
    waiting: list[tuple[tuple[str, ...], Node]] = [((), section)]
    while waiting:
        path, node = waiting.pop()
        for key, value in node.entries:
            inner = (*path, key.text)
            found.setdefault(inner, (key, value))
            if value.kind == "group" and len(inner) < _MAX_DEPTH:
                waiting.append((inner, value))
    return found


def _odd_names(name: str, values: list[Node]) -> Defects:
    """Yield the name that differs by a slip from the name in at least two of the other sections."""
    count = Counter(value.text for value in values)
    if len(values) < _FEWEST or len(count) < 2:
        return
    usual = [text for text, times in count.items() if times >= _FEWEST - 1]
    for value in values:
        if count[value.text] == 1 and len(value.text) > _SHORTEST and re.fullmatch(_NAME, value.text):
            near = next((text for text in usual if is_slip(value.text, text)), None)
            if near is not None:
                message = f"unknown `{name}` `{value.text}`, unlike the other sections" + Suggestion(near, value.text)
                yield value, message


def _odd_list(name: str, values: list[Node]) -> Defects:
    """Yield the list of numbers that is one value longer or shorter than the list of all other sections."""
    lists = [value for value in values if _is_numbers(value)]
    lengths = Counter(len(value.items) for value in lists)
    if len(lists) < _FEWEST or len(lists) < len(values) or len(lengths) != 2:
        return
    (usual, times), (odd, single) = lengths.most_common()
    if single == 1 and times >= _FEWEST - 1 and abs(usual - odd) == 1 and usual >= _FEWEST:
        value = next(value for value in lists if len(value.items) == odd)
        yield value, f"`{name}` has {odd} values; the other sections have {usual}"


def _odd_lengths(node: Node) -> Defects:
    """Yield the list of numbers that is one value longer or shorter than at least three others next to it."""
    lists = [(key, value) for key, value in node.entries if _is_numbers(value)]
    lengths = Counter(len(value.items) for _, value in lists)
    if len(lists) <= _FEWEST or len(lengths) != 2:
        return
    (usual, _), (odd, single) = lengths.most_common()
    if single == 1 and abs(usual - odd) == 1 and usual > _FEWEST:
        key, value = next((key, value) for key, value in lists if len(value.items) == odd)
        yield value, f"`{key.text}` has {odd} values; the other lists in this section have {usual}"


def _is_numbers(value: Node) -> bool:
    return value.kind == "list" and bool(value.items) and all(number_of(item) is not None for item in value.items)


def _unlisted_sections(source: Source, node: Node) -> Defects:
    """Yield the entry of a list that is the misspelt name of a section next to the list, or the name of the section."""
    sections = {key.text: key for key, value in node.entries if value.kind in ("group", "list")}
    for key, value in node.entries if len(sections) > 1 else ():
        names = value.texts() if value.kind == "list" else []
        lacking = [item for item in value.items if item.text and item.text not in sections]
        if len(names) < 2 or len(lacking) != 1 or len(names) != len(value.items):
            continue
        (item,) = lacking
        free = [name for name in sections if name not in names and name != key.text]
        near = next((name for name in free if len(name) >= _SHORTEST and is_slip(item.text, name)), None)
        if near is None:
            continue
        if _times(item.text, source) > _times(near, source):
            yield sections[near], f"`{key.text}` does not list `{near}`" + Suggestion(item.text, near)
        else:
            yield item, f"`{item.text}` in `{key.text}` has no section" + Suggestion(near, item.text)


def _times(name: str, source: Source) -> int:
    """Return how often the words of a name occur in a file."""
    return min(
        len(re.findall(rf"(?<![A-Za-z]){re.escape(word)}", source.text)) for word in re.findall(r"[A-Za-z]+", name)
    )


def _odd_values(node: Node, is_parameter_file: bool) -> Defects:
    """Yield the quoted Booleans and numbers, and the negative rates and sizes."""
    for key, value in node.entries if is_parameter_file else ():
        for item in value.items if value.kind == "list" else (value,):
            name, number = key.text.rpartition(".")[2], number_of(item) if item.kind == "text" else None
            if item.kind == "text" and not item.is_plain and item.text in ("true", "false", "True", "False"):
                yield item, f'`{key.text}` is "{item.text}", a quoted string; write {item.text.lower()}'
            elif number is not None and not item.is_plain and re.fullmatch(_NUMBERS, name):
                yield item, f'`{key.text}` is "{item.text}", a quoted string'
            elif (
                number is not None
                and number < 0.0
                and number != -1.0
                and value is item
                and re.fullmatch(_POSITIVE, name)
            ):
                yield item, f"`{key.text}` is {item.text}; it must not be negative"


def _repeated(key: Node, value: Node) -> Defects:
    """Yield the names that a list has twice."""
    seen = set[str]()
    for item in value.items:
        if item.text in seen and re.fullmatch(_NAME, item.text):
            yield item, f"`{item.text}` occurs twice in `{key.text}`"
        seen.add(item.text)


def _misspelt_joints(node: Node, model: Model) -> Defects:
    """Yield the misspelt names of joints in a list or group of joints of the robot, or in a parameter for a joint."""
    joints = model.robot.joint_by_name
    for key, value in node.entries:
        names = [item for item in value.items if item.text]
        if value.kind == "text" and "joint" in key.text:
            yield from _misspelt([value], model)
        elif len(names) > 1 and any(item.text in joints for item in names):
            yield from _misspelt(names, model)
    keys = [key for key, _ in node.entries]
    if sum(key.text in joints for key in keys) > 1:
        yield from _misspelt(keys, model)


def _misspelt(names: list[Node], model: Model) -> Defects:
    """Yield the names that differ by a slip from a joint of the robot that is not one of them."""
    robot = model.robot
    written = {name.text for name in names}
    for name in names:
        text = name.text
        if text in robot.joint_by_name or text in robot.link_by_name or len(text) < _SHORTEST or "$" in text:
            continue
        near = next((each for each in robot.joint_by_name if each not in written and is_slip(text, each)), None)
        if near is not None and not model.neighbouring_descriptions.define("joint", text):
            yield name, f"joint `{text}` does not exist" + Suggestion(near, text)
