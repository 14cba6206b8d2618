"""Controller settings in YAML for ROS 1 and ROS 2: types, parameters, misspelt parameters."""

import re
from collections.abc import Iterator
from functools import lru_cache
from itertools import pairwise

from urdfkit.description.control.controller_parameters import ALWAYS, OF_TYPES
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.launch_package_paths import uncommented
from urdfkit.lint.facts.control.ros2_controllers import PARAMETERS, DeclaredController, declared
from urdfkit.lint.facts.control.yaml_tree import Node, documents, groups, walk
from urdfkit.lint.fix_builders import nearest
from urdfkit.record import record

_LIMITS = [f"{kind}_{name}" for kind in ("max", "min") for name in ("velocity", "acceleration", "deceleration", "jerk")]
_NESTED: dict[str, tuple[str, ...]] = {
    "velocity_ff": (),
    "gains": (
        "p",
        "i",
        "d",
        "i_clamp",
        "i_clamp_min",
        "i_clamp_max",
        "antiwindup",
        "ff_velocity_scale",
        "publish_state",
        "u_clamp_min",
        "u_clamp_max",
        "feedforward_gain",
    ),
    "constraints": ("stopped_velocity_tolerance", "goal_time", "trajectory", "goal", "stopped_position_tolerance"),
    **dict.fromkeys(
        ("linear", "angular"),
        ("x", "y", "z", *(f"has_{name}_limits" for name in ("velocity", "acceleration", "jerk")), *_LIMITS),
    ),
}
"""Group of parameters → the parameters in it, without those of joints."""

_MANAGER = (
    *("update_rate", "use_sim_time", "lock_memory", "thread_priority", "cpu_affinity", "enforce_command_limits"),
    *("hardware_components_initial_state", "handle_exceptions", "overruns", "defaults", "diagnostics"),
    *("shutdown_on_initial_state_failure", "state_publish_rate", "is_async", "qos_overrides", "robot_description"),
)
"""Parameters of controller_manager (Humble to Rolling)."""

_KEY = r"(?m)^([ \t]*)[\"']?([\w/]+)[\"']?[ \t]*:[ \t]*\r?$"
_GROUP = r"(?m)(?:^|[{,])[ \t]*[\"']?(ros_*[A-Za-z_]+)[\"']?[ \t]*:[ \t]*(?=\r?$|[{&*])"

INTERFACES = ("position", "velocity", "acceleration", "effort", "torque", "force")
_INTERFACE_KEYS = (
    *("command_interfaces", "state_interfaces", "interface_name", "interface_names", "command_interface"),
    "reference_and_state_interfaces",
)


@record(eq=False)
class ControllerSettings:
    """Settings of one controller.

    Attributes:
        name: name of the controller, without namespaces.
        kind: type of the controller.
        group: parameters of the controller.
    """

    name: str
    kind: str
    group: Node


def settings(source: Source) -> tuple[ControllerSettings, ...]:
    """Return the settings of the controllers with a type in a YAML file; each mapping once."""
    return _settings(documents(source), declared(source) if PARAMETERS in source.text else ())


@lru_cache(maxsize=400)
def _settings(roots: tuple[Node, ...], controllers: tuple[DeclaredController, ...]) -> tuple[ControllerSettings, ...]:
    found = [(one.name, one.kind, one.settings) for one in controllers if one.settings is not None]
    seen, named = {id(group) for _, _, group in found}, {name for name, _, _ in found}
    for name, group in (each for root in roots for each in groups(root)):
        kind = group.find("type")
        if len(group.entries) == 1 and name in named:
            continue  # the declaration of a controller whose parameters are in a section
        if kind is not None and re.fullmatch(r"\w+/\w+", kind.text) and id(group) not in seen:
            seen.add(id(group))
            found.append((name, kind, group))
    return tuple(ControllerSettings(name, kind.text, group) for name, kind, group in found)


def misspelt_names(source: Source) -> Iterator[tuple[Node, str, str]]:
    """Yield misspelt controller managers, their parameters, nested parameters and interfaces.

    Yields:
        The YAML node, the suggested name, and a description of the name with its owner.
    """
    for key, group in _managers(source):
        name = key.last_name
        if name != "controller_manager" and nearest(name, ("controller_manager",), cutoff=0.9) is not None:
            yield key, "controller_manager", f"unknown node `{name}`"
        for parameter, value in group.entries:
            kind = next((key for key, node in value.entries if re.fullmatch(r"[\w-]+/[\w-]+", node.text)), None)
            if kind is not None and value.find("type") is None and nearest(kind.text, ("type",), cutoff=0.7):
                yield kind, "type", f"unknown parameter `{kind.text}` of controller `{parameter.text}`"
            near = nearest(parameter.text, _MANAGER, cutoff=0.8) if parameter.text not in _MANAGER else None
            if near is not None and value.find("type") is None:
                yield parameter, near, f"unknown parameter `{parameter.text}` of the controller manager"
    for one in settings(source):
        joints = [node.text for name in ("joints", "joint") for node in _items(one.group.find(name))]
        for key, value in one.group.entries:
            for part in _items(value) if key.text in _INTERFACE_KEYS else ():
                near = nearest(part.text, INTERFACES, cutoff=0.8) if part.text not in INTERFACES else None
                if near is not None:
                    yield part, near, f"unknown interface `{part.text}` of controller `{one.name}`"
            axis, _, last = key.text.rpartition(".")
            limits = _NESTED[axis.partition(".")[0]] if axis in ("linear.x", "angular.z") else ()
            near = nearest(last, limits, cutoff=0.8) if last not in limits else None
            if near is not None:
                yield key, f"{axis}.{near}", f"unknown parameter `{key.text}` of controller `{one.name}`"
            names = (*_NESTED.get(key.text, ()), *joints)
            inner = [each for node in walk(value) for each, _ in node.entries] if key.text in _NESTED else []
            for each in inner:
                if each.text in names:
                    continue
                is_doubled = set(each.text) in ({"p"}, {"d"})
                near = nearest(each.text, names, cutoff=0.8) or (each.text[0] if is_doubled else None)
                if near is not None:
                    yield each, near, f"unknown name `{each.text}` in `{key.text}` of controller `{one.name}`"


def _managers(source: Source) -> Iterator[tuple[Node, Node]]:
    """Yield the name and the parameters of each ROS 2 node that loads controllers."""
    for root in documents(source) if PARAMETERS in source.text else ():
        for key, section in root.entries:
            group = section.find(PARAMETERS)
            kinds = [value.find("type") for _, value in group.entries] if group is not None else []
            is_manager = key.last_name == "controller_manager"
            if group is not None and (is_manager or any(kind is not None and "/" in kind.text for kind in kinds)):
                yield key, group


def misspelt_sections(source: Source) -> Iterator[tuple[int, str, str]]:
    """Yield the misspelt names of ``ros__parameters`` and of controllers' sections: offset, name, suggested name."""
    from urdfkit.lint.facts.control.controller_joints import controllers

    text = uncommented(source)
    for key in re.finditer(_GROUP, text):
        if key[1] != PARAMETERS and nearest(key[1], [PARAMETERS], cutoff=0.85) is not None:
            yield key.start(1), key[1], PARAMETERS
    defined = set(controllers(source))
    keys = [(key[2], key.start(2), len(key[1])) for key in re.finditer(_KEY, text)]
    sections = [
        (name, name.rpartition("/")[2], start)
        for (name, start, indent), (below, _, _) in pairwise(keys)
        if indent == 0 and below == PARAMETERS
    ]
    without_section = defined - {short_name for _, short_name, _ in sections}
    for name, short_name, start in sections:
        if short_name not in (*defined, "controller_manager"):
            near = nearest(short_name, without_section, cutoff=0.85)
            if near is not None:
                yield start, name, near


def sections_without_parameters(source: Source) -> list[Node]:
    """Return the names of the sections of ROS 2 nodes that lack ``ros__parameters``; rcl refuses such a file.

    Of a file without any ``ros__parameters``, only the section of the controller manager.
    """
    from urdfkit.description.control.controller_types import TYPES
    from urdfkit.lint.facts.launch.ros_version import ros_version

    if "controller" not in source.text:
        return []
    roots = documents(source)
    entries = [entry for root in roots for entry in root.entries]
    if PARAMETERS not in source.text:
        managers = [(key, section) for key, section in entries if key.text == "controller_manager"]
        kinds = [value.find("type") for _, section in managers for _, value in section.entries]
        is_ros2 = any(kind is not None and kind.text in TYPES for kind in kinds) and ros_version(source) == 2
        return [key for key, _ in managers] if is_ros2 else []
    names, found = {one.name for one in declared(source)}, []
    for key, section in entries:
        inner = {name.text for node in walk(section) for name, _ in node.entries}
        is_manager = key.text == "controller_manager" and section.find("update_rate") is not None
        has_level = any(re.match(r"ros_" if is_manager else r"ros_|type$", name) for name in inner)
        if inner and (is_manager or key.text in names) and not has_level:
            found.append(key)
    return found


def _items(node: Node | None) -> tuple[Node, ...]:
    """Return the scalars of a list, or the scalar."""
    return () if node is None else node.items if node.kind == "list" else (node,) if node.kind == "text" else ()


def misspelt(source: Source) -> Iterator[tuple[Node, str, ControllerSettings]]:
    """Yield the misspelt parameters of controllers: key, suggested name, settings of the controller."""
    for one in settings(source):
        parameters = OF_TYPES.get(one.kind)
        if parameters is None:
            continue
        written = {key.text.partition(".")[0] for key, _ in one.group.entries}
        lacking = [name for name in (*parameters, *ALWAYS) if name not in written]
        for key, value in one.group.entries:
            name = key.text.partition(".")[0]
            if name in parameters or name in ALWAYS or value.find("type") is not None:
                continue
            meant = nearest(name, lacking, cutoff=0.8)
            if meant is not None:
                yield key, meant, one
