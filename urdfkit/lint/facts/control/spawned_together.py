"""Controllers that a launch file spawns: without a type (ROS 2), or with a joint or an interface of another one."""

from __future__ import annotations

import re
from collections.abc import Iterator

from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.controller_joints import Named
from urdfkit.lint.facts.control.controller_settings import settings
from urdfkit.lint.facts.control.launch_package_paths import uncommented
from urdfkit.lint.facts.control.launched_nodes import Started, launches, started
from urdfkit.lint.facts.control.ros2_controllers import PARAMETERS, DeclaredController, Wanted, declared, wanted
from urdfkit.lint.facts.control.yaml_tree import Node, documents, yamls
from urdfkit.lint.facts.moveit.settings import entries, moveit_yamls
from urdfkit.lint.model.model import Model

SPAWNERS = ("spawner", "spawner.py", "controller_spawner", "controller_spawner.py")
_INACTIVE = ("--inactive", "--stopped", "--load-only")
_WITH_TYPE = ("-t", "--controller-type")


def spawned(node: Started) -> Iterator[Named]:
    """Yield the literal controller names that a node passes to a spawner, without the values of options."""
    for previous, word in zip([None, *node.arguments], node.arguments, strict=False):
        is_option = previous is not None and previous.name.startswith("-") and previous.name not in _INACTIVE
        if word is not None and re.fullmatch(r"[A-Za-z][\w-]*", word.name) and not is_option:
            yield word


def _is_literal(node: Started) -> bool:
    """Return whether a node always starts, and only values of its options are computed."""
    before = [None, *node.arguments]
    pairs = zip(before, node.arguments, strict=False)
    is_open = any(word is None and (last is None or not last.name.startswith("-")) for last, word in pairs)
    return not node.is_conditional and not is_open


def _spawners(model: Model, without: tuple[str, ...]) -> Iterator[tuple[Source, list[Named]]]:
    """Yield each launch file and the controllers that it always spawns, by spawners without some options."""
    for source in launches(model):
        names: list[Named] = []
        for node in started(source) if re.search("spawner|load_controller", source.text) else ():
            options = {word.name for word in node.arguments if word is not None}
            if node.program in SPAWNERS and _is_literal(node) and options.isdisjoint(without):
                names += spawned(node)
        yield source, names


def _quoted(source: Source, files: list[Source]) -> set[str]:
    """Return the words in quotes of a Python launch file that computes the arguments of a spawner.

    Among them are the names of the controllers if the file quotes the name of the only parameter file that has typed
    controllers, and one of these controllers.
    """
    if not source.file.endswith(".py") or not any(node.program in SPAWNERS for node in started(source)):
        return set()
    words = set(re.findall(r"[\"']([\w.-]+)[\"']", uncommented(source)))
    typed = [file for file in files if any(one.name in words for one in declared(file))]
    is_loaded = len(typed) == 1 and typed[0].file.rpartition("/")[2] in words
    return words if is_loaded and words.isdisjoint(_WITH_TYPE) else set()


def untyped(model: Model) -> Iterator[tuple[Source, Node, Source]]:
    """Yield the spawned controllers whose parameters are in a file that gives other controllers a type, but not them.

    Yields:
        The YAML file, the name of the section, and the launch file.
    """
    files = [source for source in yamls(model) if PARAMETERS in source.text]
    typed = {one.name for source in files for one in declared(source)}
    # The spawner reads the type from the section of the controller in its parameter file, too.
    sections = [entry for source in files for root in documents(source) for entry in root.entries] if typed else []
    groups = [(key.text.strip("/"), section.find(PARAMETERS)) for key, section in sections]
    typed |= {name for name, group in groups if group is not None and group.find("type") is not None}
    seen: set[int] = set()
    for launch, words in _spawners(model, (*_WITH_TYPE, "-p", "--param-file")) if typed else ():
        spawned_names = {word.name for word in words}
        names = spawned_names or _quoted(launch, files)
        for source in files if names else ():
            if not any(declared(source)) or "<<" in source.text:
                continue
            for key, section in (entry for root in documents(source) for entry in root.entries):
                group = section.find(PARAMETERS)
                is_spawned = key.text.strip("/") in names
                if group is None or not is_spawned or key.text.strip("/") in typed or id(key) in seen:
                    continue
                is_controller = spawned_names or _moved(group, model)
                if is_controller and not _is_mentioned(key.text.strip("/"), files):
                    seen.add(id(key))
                    yield source, key, launch


def _is_mentioned(name: str, files: list[Source]) -> bool:
    """Return whether a controller manager has an entry for a controller, perhaps a misspelt or an empty one."""
    managers = [
        root.find("controller_manager") for source in files for root in documents(source) if "type" in source.text
    ]
    groups = [each.find(PARAMETERS) for each in managers if each is not None]
    return any(group is not None and group.find(name) is not None for group in groups)


def shared_interfaces(model: Model) -> Iterator[tuple[Source, Wanted, str]]:
    """Yield the command interfaces of spawned controllers that another one claims: YAML file, interface, the other."""
    for _, names in _spawners(model, _INACTIVE):
        listed = [word.name for word in names]
        for source in yamls(model) if len(listed) > 1 else ():
            found: dict[str, DeclaredController] = {}
            for one in declared(source) if PARAMETERS in source.text else ():
                if one.name in listed:
                    found.setdefault(one.name, one)
            claimed: dict[tuple[str, str], str] = {}
            for one in sorted(found.values(), key=lambda each: listed.index(each.name)):
                for each in wanted(one):
                    other = claimed.setdefault((each.joint, each.interface), one.name) if each.is_command else one.name
                    if other != one.name:
                        yield source, Wanted(each.joint, each.interface, True, _joint(one, each)), other
            if len(listed) > 1 and PARAMETERS not in source.text:
                yield from ((source, *shared) for shared in _shared_in_ros1(source, listed))


def left_out(model: Model) -> Iterator[tuple[Source, Named, str]]:
    """Yield the last controller that a launch file spawns, and the only controller of its file that none spawns.

    The spawned controllers move none of its joints, no launch file names it, and MoveIt does not use it, which
    moveit-controller-contradiction compares.
    """
    spawners = [(file, node) for file in launches(model) for node in started(file) if node.program in SPAWNERS]
    if not spawners or not all(_is_literal(node) for _, node in spawners):
        return
    words = [(file, word) for file, node in spawners for word in spawned(node)]
    of_moveit = (entry for source, _ in moveit_yamls(model) for entry in entries(source))
    used = {entry.name.text for entry in of_moveit if entry.kind == "controller"}
    for source in yamls(model):
        is_ros2 = PARAMETERS in source.text
        groups = [(one.name, one.settings) for one in declared(source)] if is_ros2 else []
        groups += [(one.name, one.group) for one in settings(source) if one.kind and not is_ros2]
        every = {name: _moved(group, model) for name, group in groups if group is not None}
        running = [(file, word) for file, word in words if word.name in every]
        missing = {name for name in every if every[name]} - {word.name for _, word in words}
        if len(missing) != 1 or not running or missing & used:
            continue
        name = missing.pop()
        moved = set().union(*(every[word.name] for _, word in running))
        named = rf"(?<![\w-]){re.escape(name)}[\"'\s]*(?:,|\]|\)|$|--)"
        if not every[name] & moved and not any(re.search(named, file.text, re.MULTILINE) for file in launches(model)):
            yield *running[-1], name


def _moved(group: Node, model: Model) -> set[str]:
    """Return the joints of the robot that the parameters of a controller list."""
    lists = [value for key, value in group.entries if "interface" not in key.text and key.text != "type"]
    return {name for value in lists for name in value.texts() if name in model.robot.joint_by_name}


_OF_ROS1 = r"(effort|position|velocity)_controllers/\w+|(diff_drive)_controller/DiffDriveController"


def _shared_in_ros1(source: Source, listed: list[str]) -> Iterator[tuple[Wanted, str]]:
    """Yield the joints that two spawned ROS 1 controllers command; it gives a joint to one controller only."""
    claimed: dict[str, str] = {}
    for one in sorted((one for one in settings(source) if one.name in listed), key=lambda one: listed.index(one.name)):
        kind = re.fullmatch(_OF_ROS1, one.kind)
        found = [one.group.find(key) for key in ("joint", "joints", "left_wheel", "right_wheel")] if kind else []
        for node in [each for value in found if value is not None for each in (value, *value.items) if each.text]:
            other = claimed.setdefault(node.text, one.name)
            if other != one.name and kind is not None:
                yield Wanted(node.text, kind[1] or "velocity", True, node), other


def _joint(one: DeclaredController, claim: Wanted) -> Node:
    """Return the YAML node that names the joint of a claim."""
    entries = one.settings.entries if one.settings is not None else ()
    nodes = (node for key, value in entries if "interface" not in key.text for node in (value, *value.items))
    return next((node for node in nodes if node.text == claim.joint), claim.where)
