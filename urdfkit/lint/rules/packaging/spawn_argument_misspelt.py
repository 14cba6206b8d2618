"""K968 spawn-argument-misspelt."""

from __future__ import annotations

import re
from collections.abc import Iterator

from urdfkit.defect_message import Suggestion
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.controller_joints import Named
from urdfkit.lint.facts.control.launched_nodes import Started, launches, started
from urdfkit.lint.facts.launch.receivers import included_files
from urdfkit.lint.fix_builders import nearest
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule

_CREATE = "world file param string topic name allow_renaming x y z R P Y"
_SPAWN = "reference_frame gazebo_namespace robot_namespace unpause wait package_to_model x y z R P Y J b"
_OPTIONS: dict[str, tuple[str, ...]] = {
    "create": tuple(_CREATE.split()),
    "spawn_entity.py": tuple(f"{_SPAWN} file topic database stdin entity timeout spawn_service_timeout".split()),
    "spawn_model": tuple(f"{_SPAWN} file param database stdin model urdf sdf trimesh gazebo".split()),
}
"""Program → its options (ros_gz_sim Jazzy; gazebo_ros Humble and Noetic)."""

_SPAWNERS = {
    1: ("wait-for", "namespace", "timeout", "stopped", "shutdown-timeout"),
    2: (
        *("controller-manager", "param-file", "namespace", "load-only", "inactive", "activate-as-group"),
        *("unload-on-kill", "controller-manager-timeout", "switch-timeout", "service-call-timeout", "stopped"),
        *("fallback_controllers", "controller-type", "controller-ros-args", "ros-args", "help"),
    ),
}
"""Version of ROS → options of the spawner of controller_manager (Noetic; Humble to Rolling)."""

_PACKAGES = ("ros_gz_sim", "ros_ign_gazebo", "gazebo_ros")
_SYNONYMS = {
    "create": {"entity": "name", "model": "name", "robot": "name", "yaw": "Y", "pitch": "P", "roll": "R"},
    "spawn_entity.py": {"name": "entity", "model": "entity", "param": "topic", "yaw": "Y", "pitch": "P", "roll": "R"},
    "spawn_model": {"name": "model", "entity": "model", "topic": "param", "yaw": "Y", "pitch": "P", "roll": "R"},
}
"""Spawner → option of another spawner, or common name → the corresponding option."""

_DESCRIPTION = "robot_description"
_FORMATS = frozenset(("urdf", "sdf", "trimesh", "gazebo"))


class SpawnArgumentMisspelt(RobotRule):
    """A launch file passes an unknown option to a spawner.

    ## What it does
    Checks the arguments of ``create`` (ros_gz_sim), ``spawn_entity.py`` and ``spawn_model`` (gazebo_ros) and
    ``spawner`` (controller_manager) for misspelt options, options of another spawner, and misspellings of joints and of
    the topic or parameter ``robot_description``. Also reports ``robot_description`` where a file is expected, and
    spawners of Gazebo Classic without a source of the description. Python launch files are parsed, not executed.

    The rule also reports

    - a ``spawner`` that names a controller manager that neither a launch file nor a plugin of the robot starts
    - a launch argument whose value removes the plugin that runs the controller manager from the description, although
      the opposite value adds it
    - a namespace in the topic of the description, if the launch file starts the robot and no file names that namespace

    ## Why is this bad?
    The spawner fails, or waits forever for a description, and the robot does not appear in the world. ``create``
    ignores unknown options, so a pose or a name with a misspelt option has no effect.

    ## Example
    ```diff
     <launch>
    -  <node name="spawn" pkg="gazebo_ros" type="spawn_model" args="-urdf -param robot_description -name cart"/>
    +  <node name="spawn" pkg="gazebo_ros" type="spawn_model" args="-urdf -param robot_description -model cart"/>
     </launch>
    ```

    ## Fix safety
    Unsafe: the fix replaces a misspelt name with the nearest known name, which may not be the intended one.
    """

    code = "K968"
    name = "spawn-argument-misspelt"
    fix = "unsafe"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each invalid argument."""
        from urdfkit.lint.facts.connections.controller_managers import misdirected_spawners
        from urdfkit.lint.facts.connections.unloaded_plugins import left_out_plugins
        from urdfkit.lint.facts.gazebo.spawned_models import (
            names_as_files,
            spawned_in_the_ground,
            undefined_parameters,
            wrong_formats,
        )
        from urdfkit.lint.facts.launch.ros_version import reads_ros1

        files = list(launches(model))
        places = set[tuple[str, int]]()
        has_spawner = any("spawner" in each.text for each in files)
        for span, message in (*misdirected_spawners(model), *left_out_plugins(model)) if has_spawner else ():
            places.add((span.file, span.line))
            yield self.at_span(span, message, severity="warning", kind="manager")
        for source in files:
            if not any(package in source.text for package in (*_PACKAGES, "controller_manager")):
                continue
            reported: set[int] = set()
            for node in started(source):
                for word in _in_unknown_namespaces(node, source, model):
                    is_found = (source.file, source.position(word.start).line) in places
                    if word.start in reported or is_found:  # a function of the launch file starts several nodes
                        continue
                    reported.add(word.start)
                    message = f"no node of these packages is in the namespace of `{word.name}`"
                    span, names = source.span(word.start, word.end), (word.name.strip("/"),)
                    yield self.at_span(span, message, severity="warning", names=names)
                if node.package == "controller_manager" and node.program in ("spawner", "spawner.py"):
                    for start, text, message in _unknown_options(node, 1 if reads_ros1(source) else 2):
                        span, names = source.span(start, start + len(text)), (node.program,)
                        yield self.at_span(span, message, kind="option", names=names)
                is_own = (node.package == "gazebo_ros") == (node.program != "create")
                for start, text, message in spawned_in_the_ground(node, model) if is_own else ():
                    span = source.span(start, start + len(text))
                    yield self.at_span(span, message, severity="warning", kind="height")
                for start, text, message in (
                    (*undefined_parameters(node, model), *names_as_files(node), *wrong_formats(node, model))
                    if is_own
                    else ()
                ):
                    yield self.at_span(source.span(start, start + len(text)), message, severity="warning")
                if node.package in _PACKAGES and node.program in _OPTIONS and is_own:
                    for start, text, message in _unknown_joints(node, model):
                        yield self.at_span(source.span(start, start + len(text)), message, kind="joint", names=(text,))
                    for start, text, message in (*_invalid_arguments(node, source, model), *_without_source(node)):
                        span = source.span(start, start + len(text))
                        severity = "warning" if _is_ignored(node, text) else self.severity
                        kind, names = "option" if text.startswith("-") else "", (node.program or "",)
                        yield self.at_span(span, message, severity=severity, kind=kind, names=names)


def _in_unknown_namespaces(node: Started, source: Source, model: Model) -> Iterator[Named]:
    """Yield the controller manager or description in a namespace, if the file starts a robot without a namespace."""
    from urdfkit.lint.facts.launch.actions import launch_files

    if not any(word is not None and "/" in word.name for word in node.arguments):
        return
    is_started = False
    for file in launch_files(model):  # the file itself, and the files that include it
        reached = [each.source for each in included_files(file, model) if each is not None]
        is_around = any(each.file == source.file for each in reached)
        is_started |= is_around and any("robot_state_publisher" in each.text for each in reached)
    for word in node.arguments if is_started else ():
        at = (
            re.fullmatch(r"/?([\w/]+)/(?:controller_manager|robot_description)", word.name)
            if word is not None
            else None
        )
        if word is None or at is None or node.package not in ("controller_manager", *_PACKAGES):
            continue
        pattern = rf"namespace|\bns\s*[=:]|PushR|(?<!\w){re.escape(at[1])}(?:/|\s*:)"
        files = (*model.related_files.values(), *model.expanded.sources.values())
        uses = [(each.file, use.start()) for each in files for use in re.finditer(pattern, each.text)]
        if not any(file != source.file or not word.start <= start < word.end for file, start in uses):
            yield word


def _unknown_options(node: Started, version: int) -> Iterator[tuple[int, str, str]]:
    """Yield the offset, text and message of each misspelt option of the spawner of controllers."""
    for word in node.arguments:
        option = re.fullmatch(r"--?([A-Za-z][\w-]{3,})", word.name.partition("=")[0]) if word is not None else None
        if word is None or option is None or option[1] in _SPAWNERS[version]:
            continue
        near = nearest(option[1], _SPAWNERS[version], cutoff=0.8)
        if near is not None:
            text = word.name.partition("=")[0]
            yield word.start, text, f"unknown option `{text}` of `{node.program}`" + Suggestion(f"--{near}", text)


def _is_ignored(node: Started, option: str) -> bool:
    """Return whether ``create`` ignores an unknown option and spawns the robot without it.

    It calls ``gflags::AllowCommandLineReparsing``, so only a source that is missing stops it.
    """
    sources = ("file", "param", "string", "topic")
    written = {word.name.lstrip("-").partition("=")[0] for word in node.arguments if word is not None}
    return node.program == "create" and option.startswith("-") and not written.isdisjoint(sources)


def _invalid_arguments(node: Started, source: Source, model: Model) -> Iterator[tuple[int, str, str]]:
    """Yield the offset, text and message of each invalid argument."""
    from urdfkit.lint.facts.ros_packages import is_slip

    options, previous = _OPTIONS[node.program], ""
    for word in node.arguments:
        text = word.name if word is not None else ""
        option = re.fullmatch(r"--?([A-Za-z_]\w*)(?:=.*)?", text)
        if text == "--ros-args":
            return
        if word is not None and option is not None and option[1] not in options:
            suggestion = _SYNONYMS[node.program].get(option[1]) or _nearest_option(option[1], options)
            if suggestion is not None:
                message = f"unknown option `{text}` of `{node.program}`" + Suggestion(f"-{suggestion}", text)
                yield word.start, text, message
        elif word is not None and previous in ("topic", "param"):
            name = text.strip("/").rpartition("/")[2]
            near = nearest(name, [_DESCRIPTION], cutoff=0.7)
            if near is not None and name != near and (is_slip(name, near) or _is_only_here(name, model)):
                kind = "topic" if previous == "topic" else "parameter"
                yield word.start, text, f"unknown {kind} `{text}`" + Suggestion(_DESCRIPTION, text)
            elif near is None and previous == "topic" and _is_unpublished(name, source, model):
                yield word.start, text, f"no node publishes topic `{text}`" + Suggestion(_DESCRIPTION, text)
        previous = option[1] if option is not None else ""


def _is_unpublished(topic: str, source: Source, model: Model) -> bool:
    """Return whether the launch file starts a publisher of the description, and no other file names the topic."""
    from urdfkit.lint.facts.launch.actions import actions_of

    reached = list(included_files(actions_of(source), model))
    texts = [each.source.text for each in reached if each is not None]
    is_complete = len(texts) == len(reached) and any("robot_state_publisher" in text for text in texts)
    return is_complete and _is_only_here(topic, model)


def _is_only_here(topic: str, model: Model) -> bool:
    """Return whether no other place of the files around the robot names a topic, so that no node publishes it."""
    pattern = rf"(?<!\w){re.escape(topic)}(?![\w/])"
    texts = [source.text for source in model.related_files.values()]
    uses = ((text, at.start()) for text in texts for at in re.finditer(pattern, text))
    return sum(re.search(_PACKAGE_BEFORE, text[max(at - 60, 0) : at]) is None for text, at in uses) == 1


_PACKAGE_BEFORE = (
    r"(?:[Ss]hare\w*\s*\(|\bfind(?:-pkg-share)?\s|\bpkg\s*[=:]|\bpackage(?:_name)?[\"']?\s*[=:]|depend>|<name>"
    r"|\bproject\s*\()\s*[\"']?$"
)
"""Matches the text before the name of a package, which can be that of a topic too."""


def _unknown_joints(node: Started, model: Model) -> Iterator[tuple[int, str, str]]:
    """Yield the offset, text and message of each joint after ``-J`` that is misspelt, or that alone is undefined."""
    from urdfkit.lint.facts.launch.python.api import first_slip

    names = {joint.name for joint in model.robot.joints}
    pairs = zip(node.arguments, node.arguments[1:], strict=False)
    words = [word for option, word in pairs if option is not None and option.name == "-J" and word is not None]
    is_spawned = any(word.name in names for word in words) and not model.is_incomplete
    for word in words:
        near = first_slip(word.name, names) if word.name not in names else None
        is_undefined = is_spawned and not model.neighbouring_descriptions.define("joint", word.name)
        if near is not None or (word.name not in names and is_undefined and "$" not in word.name):
            yield word.start, word.name, f"unknown joint `{word.name}`" + Suggestion(near, word.name)


def _without_source(node: Started) -> Iterator[tuple[int, str, str]]:
    """Yield the first argument of a Gazebo Classic spawner that names no source of the description."""
    written = [word.name for word in node.arguments if word is not None and word.name.startswith("-")]
    options = {option.lstrip("-").partition("=")[0] for option in written}
    previous = [None, *node.arguments]
    # A computed argument after a value can be an option.
    is_open = any(
        word is None and (before is None or not before.name.startswith("-"))
        for before, word in zip(previous, node.arguments, strict=False)
    )
    first = node.arguments[0] if node.arguments else None
    sources = {"file", "topic", "param", "database", "stdin"}
    misspelt = {_nearest_option(option, (*sources, *_FORMATS)) for option in options} | {
        _SYNONYMS[node.program].get(option) for option in options
    }
    if node.program != "create" and first is not None and not is_open and not sources & (options | misspelt):
        named = "topic" if node.program == "spawn_entity.py" else "param"
        yield first.start, first.name, f"`{node.program}` needs a source of the description, such as `-{named}`"
    elif node.program in _NAMED and first is not None and not is_open and not _names(node, options):
        yield first.start, first.name, f"`{node.program}` needs the name of the model, `-{_NAMED[node.program]}`"
    elif node.program == "spawn_model" and first is not None and not is_open and not (options | misspelt) & _FORMATS:
        yield first.start, first.name, "`spawn_model` needs the format of the description, `-urdf` or `-sdf`"


_NAMED = {"spawn_entity.py": "entity", "spawn_model": "model"}
"""Program → its required option for the name (gazebo_ros, scripts/spawn_entity.py and spawn_model)."""


def _names(node: Started, options: set[str]) -> bool:
    """Return whether an option is the name of the model, or a misspelling of it."""
    wanted = _NAMED[node.program]
    return any(
        wanted in (option, _SYNONYMS[node.program].get(option), _nearest_option(option, (wanted,)))
        for option in options
    )


def _nearest_option(option: str, options: tuple[str, ...]) -> str | None:
    return (
        nearest(option, [candidate for candidate in options if len(candidate) > 1], cutoff=0.7)
        if len(option) > 2
        else None
    )
