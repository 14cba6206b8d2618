"""Values and names in YAML files that no node accepts or that stand alone, without a table of a node.

Negative rates and sizes, minima above their maxima, misspelt frames, joints and parameters, and names that a list has
twice.
"""

import re
from collections import Counter
from collections.abc import Iterator
from functools import cache, lru_cache

from urdfkit.defect_message import Suggestion
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.yaml_tree import Node, nodes, number_of
from urdfkit.lint.facts.parameters.misspelt_names import is_misspelt
from urdfkit.lint.facts.plugins.class_names import misspelt_classes
from urdfkit.lint.model.model import Model

Defects = Iterator[tuple[Node, str]]

_SHORTEST = 4
"""Smallest number of letters of a name that is compared."""

_NAME = r"(?:\$\([^()]*\))?[A-Za-z_][\w/:.-]*"
_LISTS_OF_NAMES = (
    r"(?:\w+_)?plugins|observation_sources|polygons|critics|(?:command|state)_interfaces|joints|(?:\w+_)?joint_names"
    r"|controller_names|dof_names|re(?:quest|sponse)_adapters"
)
"""Matches lists whose entries are all different."""

_POSITIVE = (
    r"(?:update|publish(?:ing)?|control(?:ler)?|planner|loop)_(?:rate|frequency)|resolution|track_width|wheel_?base"
    r"|wheel_separation|(?:wheel|foot|robot|inflation)_radius"
)
"""Matches parameters that are not negative; -1 stands for a default."""

_BOUNDS = ((r"(?<![a-z])min(?![a-z])", "max"), (r"(?<![a-z])lower(?![a-z])", "upper"))
"""Words of parameters that are lower bounds, and those of their upper bounds."""

_ORDERED = (
    r"lower|position|vel|velocity|speed|acc|acceleration|range|dist|distance|depth|height|force|effort|torque|voltage"
    r"|current|temperature|width|particles"
)
"""Matches words of parameters with bounds in this order; sectors go over zero and servos turn in both directions."""

_CAMEL = r"[a-z]+[a-z0-9]*(?:[A-Z][a-z0-9]+)+"

_SLIPS_OF_ODOM = ("odm", "oom", "dom", "odmo", "oodm", "doom", "oddom", "oodom", "odoom", "odomm")

_FRAMES = ("map", "odom", "base_link", "base_footprint", "world")


def odd_values(source: Source, model: Model) -> Defects:
    """Yield the values and names of a YAML file that no node accepts or that stand alone, with a message."""
    from urdfkit.lint.facts.control.controller_joints import controllers
    from urdfkit.lint.facts.navigation.tables import ORDERED

    checked = () if controllers(source) else ORDERED  # by K971
    for node in nodes(source):
        yield from _negative(node)
        yield from _reversed(node, checked)
        yield from _misspelt_joints(node, model)
        yield from _misspelt_frames(node, model)
        yield from _misspelt_parameters(node)
        yield from misspelt_classes(node, model)
        for key, value in node.entries:
            if re.fullmatch(_LISTS_OF_NAMES, key.text):
                yield from _repeated(key, value)
            yield from _unlike_numbered(key, value)


def _negative(node: Node) -> Defects:
    for key, value in node.entries:
        number = number_of(value) if value.kind == "text" and value.is_plain else None
        is_negative = number is not None and number < 0.0 and number != -1.0
        if is_negative and re.fullmatch(_POSITIVE, key.text.rpartition(".")[2]):
            yield value, f"`{key.text}` is {value.text}; it must not be negative"


def _reversed(node: Node, checked: tuple[tuple[str, str], ...]) -> Defects:
    """Yield the lower bounds above their upper bounds, without the pairs that another rule checks."""
    for key, value in node.entries:
        if re.search(rf"(?:^|_)(?:{_ORDERED})(?:_|$)", key.text) is None:
            continue
        low = number_of(value) if value.kind == "text" else None
        for word, other in _BOUNDS if low is not None else ():
            name = re.sub(word, other, key.text, count=1)
            if (key.text, name) in checked:
                continue
            above = node.find(name) if name != key.text else None
            high = number_of(above)
            if low is not None and above is not None and high is not None and low > high:
                place = above if high < 0.0 <= low else value
                yield place, f"`{key.text}` is {low:g}, more than `{name}`, {high:g}"


def _misspelt_frames(node: Node, model: Model) -> Defects:
    """Yield the frames that differ by a letter from a usual frame or a link of the robot."""
    links = model.robot.link_by_name
    framed = {id(inner) for key, value in node.entries if key.text == "frame" and (inner := value.find("id"))}
    inside = [entry for _, value in node.entries for entry in value.entries if id(entry[1]) in framed]
    for key, value in (*node.entries, *inside):
        is_frame = re.search(r"(?:^|_)frame(?:_id|_name)?$", key.text) or id(value) in framed
        if not is_frame or value.kind != "text" or not value.text:
            continue
        name = value.text.strip("/")
        if name in links or name in _FRAMES or len(name) < 3 or "$" in name:
            continue
        near = next((each for each in (*_FRAMES, *links) if is_misspelt(name, each)), None)
        near = "odom" if near is None and name in _SLIPS_OF_ODOM else near
        if near is not None and not model.neighbouring_descriptions.define("link", name):
            yield value, f"unknown frame `{name}`" + Suggestion(near, name)


@cache
def _parameters_in_tables() -> dict[int, tuple[str, ...]]:
    """Return the parameters of all nodes in the tables, by the number of their letters."""
    from urdfkit.lint.facts.navigation.tables import COSTMAP_ROS1, DOUBLES, INTEGERS, ORDERED, OTHERS, SWITCHES
    from urdfkit.lint.facts.parameters.ranges import range_names
    from urdfkit.lint.facts.parameters.schemas import OF_ROS1, schemas
    from urdfkit.lint.facts.plugins.typed_groups import names_of_plugins

    names = {
        *COSTMAP_ROS1,
        *DOUBLES,
        *INTEGERS,
        *OTHERS,
        *SWITCHES,
        *range_names(),
        *(n for pair in ORDERED for n in pair),
    }
    names |= {name.rpartition(".")[2] for rows in schemas().values() for name, _ in rows}
    names |= names_of_plugins()
    names |= {name for renamed in OF_ROS1.values() for name in renamed.values()}
    found: dict[int, list[str]] = {}
    for name in sorted(name for name in names if "*" not in name and len(name) >= 6):
        found.setdefault(len(name), []).append(name)
    return {length: tuple(each) for length, each in found.items()}


@lru_cache(maxsize=4000)
def _nearest_parameter(name: str) -> str:
    """Return the parameter of any node in the tables that a name differs from by a slip, or an empty text."""
    tabulated = _parameters_in_tables()
    if name in tabulated.get(len(name), ()):
        return ""
    lengths = range(len(name) - 1, len(name) + 4 if re.fullmatch(_CAMEL, name) else len(name) + 2)
    return next((each for length in lengths for each in tabulated.get(length, ()) if is_misspelt(name, each)), "")


def _misspelt_parameters(node: Node) -> Defects:
    """Yield the keys that differ by a slip from a parameter in the tables, next to at least three of these."""
    names = {key.text for key, _ in node.entries}
    tabulated = _parameters_in_tables()
    if sum(name in tabulated.get(len(name), ()) for name in names) < 3:
        return
    for key, value in node.entries:
        near = _nearest_parameter(key.text) if len(key.text) > 5 and value.kind != "group" else ""
        if near and near not in names:
            yield key, f"unknown parameter `{key.text}`" + Suggestion(near, key.text)


def _repeated(key: Node, value: Node) -> Defects:
    """Yield the only name that a list has twice; lists with several such names describe something else."""
    names = [item.text for item in value.items]
    if len(set(names)) != len(names) - 1:
        return
    seen = set[str]()
    for item in value.items:
        if item.text in seen and re.fullmatch(_NAME, item.text):
            yield item, f"`{item.text}` occurs twice in `{key.text}`"
        seen.add(item.text)


def _unlike_numbered(key: Node, value: Node) -> Defects:
    """Yield the name of a list that differs by a letter from the others, which differ only in their numbers."""
    names = [item for item in value.items if item.text]
    if len(names) < 3 or not all(re.search(r"\d", item.text) for item in names):
        return
    stems = Counter(re.sub(r"\d+", "", item.text) for item in names)
    (usual, times), *_ = stems.most_common(1)
    if len(stems) != 2 or times != len(names) - 1 or len(usual) < _SHORTEST:
        return
    odd = next(item for item in names if re.sub(r"\d+", "", item.text) != usual)
    if is_misspelt(re.sub(r"\d+", "", odd.text), usual):
        numbers = iter(re.findall(r"\d+", odd.text))
        other = next(item.text for item in names if item is not odd)
        right = re.sub(r"\d+", lambda at: next(numbers, at[0]), other)
        if right in (item.text for item in names):
            return
        yield (
            odd,
            f"`{odd.text}` in `{key.text}` does not follow the pattern of the other names"
            + Suggestion(right, odd.text),
        )


def _misspelt_joints(node: Node, model: Model) -> Defects:
    """Yield the misspelt names of joints in a list or group of joints of the robot, or in a parameter for a joint."""
    joints = model.robot.joint_by_name
    for key, value in node.entries:
        names = [item for item in value.items if item.text]
        if "joint" in key.text and (value.kind == "text" or len(names) == 1):
            yield from _misspelt(names or [value], model)
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
        near = next((each for each in robot.joint_by_name if each not in written and is_misspelt(text, each)), None)
        if near is not None and not model.neighbouring_descriptions.define("joint", text):
            yield name, f"joint `{text}` does not exist" + Suggestion(near, text)
