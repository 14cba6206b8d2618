"""Parameter files that ROS 1 launch files load, and the parameters of MoveIt and Gazebo that depend on these.

The behaviour is that of roslaunch, MoveIt and gazebo_ros of Noetic; the sources were not compared, except for the
names of the costmaps (navigation, move_base.cpp).
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from pathlib import Path

from urdfkit.defect_message import Suggestion
from urdfkit.description.packages.existence import is_file
from urdfkit.description.packages.related_files import neighbours, package_of
from urdfkit.description.xml.reader import read_source, shown_path
from urdfkit.description.xml.source import Source
from urdfkit.errors import ResourceError, nearest
from urdfkit.lint.facts.control.launch_package_paths import uncommented
from urdfkit.lint.facts.control.yaml_tree import documents
from urdfkit.lint.facts.launch.actions import actions_of, share_of
from urdfkit.lint.facts.launch.spawned_controllers import ros1_files
from urdfkit.lint.facts.moveit.planning import WITHOUT_TIMES, is_untimed
from urdfkit.lint.facts.navigation.sections import COSTMAPS
from urdfkit.lint.facts.navigation.tables import COSTMAP_ROS1
from urdfkit.lint.model.model import Model
from urdfkit.lint.model.tags import Attribute, Document, Tag

Defects = Iterator[tuple[Attribute, str]]

_SUBSTITUTION = r"\$\((?:arg|find|env|optenv|eval|anon|dirname)\b[^()]*\)"
_EXPECTED = {
    "_kinematics": ("kinematics_solver",),
    "_planning": ("joint_limits", "cartesian_limits", "default_velocity_scaling_factor", "max_velocity", "joint_names"),
}
"""End of a namespace of MoveIt → parameters of which a file for it has one."""


def loaded_file_defects(source: Source, model: Model) -> Defects:
    """Yield the files that a ROS 1 launch file loads without substitution or into the wrong namespace."""
    for tag in tags_of(source):
        attributes = tag.attributes
        file = attributes.get("file")
        if tag.name != "rosparam" or file is None or _is_command(tag):
            continue
        parameters = parameters_at(file.value, model)
        if parameters is None:
            continue
        text, name = uncommented(parameters), Path(parameters.file).name
        below = tag.parent.attributes.get("pkg") if tag.parent is not None and tag.parent.name == "node" else None
        is_flat = below is not None and (below.value in _FLAT or re.search(_FLAT_FILES.get(below.value, "$^"), text))
        if below is not None and is_flat and "ns" in attributes and "$" not in attributes["ns"].value:
            space = attributes["ns"].value.strip("/")
            yield attributes["ns"], f"`{below.value}` reads its own parameters, not those in `{space}`; remove `ns`"
        is_replaced = "subst_value" in attributes and attributes["subst_value"].value.lower() != "false"
        use = re.search(_SUBSTITUTION, text)
        if use is not None and not is_replaced:
            yield file, f'`{use[0]}` in {name} is not replaced; add `subst_value="true"`'
        namespace = namespace_of(tag)
        is_of_costmaps = tag.parent is not None and tag.parent.name == "node" and program_of(tag.parent) == "move_base"
        if is_of_costmaps and (message := _unread_by_costmaps(parameters, own_namespace(tag))) is not None:
            yield file, f"{name} " + message
        if (end := _replaced(text, namespace)) is not None:
            yield file, f"{name} has no `{_EXPECTED[end][0]}`, which MoveIt reads from `robot_description{end}`"
        is_elsewhere = re.search(r"(?:^|/)robot_description_\w+$", namespace) and not namespace.endswith("_kinematics")
        if is_elsewhere and "kinematics_solver:" in text:
            read = "`robot_description_kinematics`"
            yield file, f"MoveIt reads the solvers of {name} from {read}, not from `{namespace.rpartition('/')[2]}`"


def _replaced(text: str, namespace: str) -> str | None:
    """Return the end of the namespace of MoveIt whose parameters a file does not have, although it is loaded there."""
    is_other = re.search(r"(?m)^[ \t]*[\w/]+[ \t]*:", text)
    for end, expected in _EXPECTED.items() if is_other else ():
        if namespace.endswith(f"robot_description{end}") and not any(word in text for word in expected):
            return end
    return None


_FLAT_FILES = {"moveit_ros_move_group": r"(?m)^controller_list[ \t]*:"}
"""Package → matches the files whose parameters its node reads from its own namespace only."""

_FLAT = ("amcl", "gmapping", "joy", "robot_localization", "teleop_twist_joy", "twist_mux")
"""Packages whose nodes have no parameters of another namespace."""


def unread_semantics(source: Source, model: Model) -> Defects:
    """Yield the names of parameters with an SRDF in a ROS 1 launch file, if no file loads one where MoveIt reads it."""
    names = list(_semantics(source))
    if not names or any(_is_semantic(name) for file in ros1_files(model) for name in _semantics(file)):
        return
    for name in names:
        shown = re.sub(r"\$\(arg ([\w-]+)\)", r"\1", name.value).rpartition("/")[2]
        yield name, f"MoveIt reads the SRDF from `robot_description_semantic`, not from `{shown}`"


def _semantics(source: Source) -> Iterator[Attribute]:
    """Yield the names of the parameters with the text of an SRDF."""
    for tag in tags_of(source) if ".srdf" in source.text else ():
        texts = [tag.attributes[key].value for key in ("textfile", "command") if key in tag.attributes]
        if tag.name == "param" and "name" in tag.attributes and any(".srdf" in text for text in texts):
            yield tag.attributes["name"]


def _is_semantic(name: Attribute) -> bool:
    return name.value.rstrip(")").endswith("semantic")


def _unread_by_costmaps(parameters: Source, namespace: str) -> str | None:
    """Return why the costmaps of move_base do not read a file; None if they do, or if it is for another part."""
    roots = documents(parameters)
    names = {key.text for root in roots for key, _ in root.entries}
    if not namespace and not names & {*COSTMAPS} and len(names & COSTMAP_ROS1) + len(names & _LAYERS) > 2:
        return 'has parameters of costmaps, which costmaps read only from their own namespace; add `ns="local_costmap"`'
    if namespace in COSTMAPS and namespace in names:
        return f"also names `{namespace}`, so its parameters are in `{namespace}/{namespace}`; remove `ns`"
    is_elsewhere = namespace != "" and "$" not in namespace and namespace.partition("/")[0] not in COSTMAPS
    if is_elsewhere and not names & {*COSTMAPS} and len(names & COSTMAP_ROS1) + len(names & _LAYERS) > 2:
        message = f"has parameters of costmaps, which move_base does not read from `{namespace}`"
        return message + Suggestion(nearest(namespace, COSTMAPS, cutoff=0.6), namespace)
    return None


_LAYERS = frozenset(("obstacle_layer", "inflation_layer", "static_layer", "voxel_layer", "obstacles_layer", "inflater"))


def program_of(tag: Tag) -> str:
    """Return the ``type`` of a node; empty without one."""
    return tag.attributes["type"].value if "type" in tag.attributes else ""


def own_namespace(tag: Tag) -> str:
    """Return the namespace that an element itself sets; empty without one."""
    return tag.attributes["ns"].value.strip("/") if "ns" in tag.attributes else ""


def controllers_without_manager(source: Source, model: Model) -> Defects:
    """Yield the files with controllers of MoveIt that a ROS 1 launch file loads if no file names their manager."""
    if any("moveit_controller_manager" in file.text for file in ros1_files(model)):
        return
    for tag in tags_of(source) if "move_group" in source.text else ():
        file = tag.attributes.get("file") if tag.name == "rosparam" and not _is_command(tag) else None
        parameters = parameters_at(file.value, model) if file is not None else None
        if file is not None and parameters is not None and "controller_list:" in uncommented(parameters):
            name = Path(parameters.file).name
            yield file, f"no launch file sets `moveit_controller_manager`, so MoveIt does not read {name}"


def unloaded_moveit_files(source: Source, model: Model) -> Defects:
    """Yield the node ``move_group`` of ROS 1 for each file of its package with parameters that no launch file loads."""
    for tag in tags_of(source) if "moveit_ros_move_group" in source.text else ():
        program = tag.attributes.get("type")
        package = package_of(Path(source.file))
        if tag.name != "node" or program is None or program.value != "move_group" or package is None:
            continue
        texts = [file.text for file in model.related_files.values() if file.file.endswith((".launch", ".xml"))]
        replaced = {word for end in _replaced_by_others(model) for word in _EXPECTED[end]}
        for name, word in _OF_MOVE_GROUP.items():
            path = shown_path(package / "config" / name)
            parameters = model.related_files.get(path)
            is_used = parameters is not None and re.search(rf"(?m)^\s*{word}:", parameters.text)
            is_loaded = any(name in text or "$(arg pipeline)_planning" in text for text in texts)
            if is_used and not is_loaded and word not in replaced:
                yield program, f"no launch file loads {name}, which has parameters of `move_group`"


def _replaced_by_others(model: Model) -> Iterator[str]:
    """Yield the ends of the namespaces of MoveIt into which launch files load a wrong file, which is reported there."""
    for tag in (tag for file in ros1_files(model) for tag in tags_of(file)):
        file = tag.attributes.get("file") if tag.name == "rosparam" and not _is_command(tag) else None
        parameters = parameters_at(file.value, model) if file is not None else None
        if parameters is not None and (end := _replaced(uncommented(parameters), namespace_of(tag))) is not None:
            yield end


_OF_MOVE_GROUP = {
    "joint_limits.yaml": "joint_limits",
    "kinematics.yaml": "kinematics_solver",
    "ompl_planning.yaml": "planner_configs",
}
"""File of a MoveIt package → a word in it (moveit_setup_assistant, templates)."""


def untimed_pipelines(source: Source) -> Defects:
    """Yield the ``request_adapters`` of a ROS 1 launch file that add no times to the trajectories of OMPL."""
    if "request_adapters" not in source.text:
        return
    tags = list(tags_of(source))
    written = {tag.attributes["name"].value: tag.attributes for tag in tags if "name" in tag.attributes}
    for tag in tags:
        name, adapters = (tag.attributes.get(key) for key in ("name", "value"))
        if tag.name != "param" or name is None or adapters is None or name.value.rpartition("/")[2] != _ADAPTERS:
            continue
        plugin = written.get(name.value.replace(_ADAPTERS, "planning_plugin"), {}).get("value")
        adapters, plugin = (_of_argument(each, written) for each in (adapters, plugin))
        words = adapters.value.split() if adapters is not None else []
        is_listed = all(word.startswith("default_planner_request_adapters/") for word in words)
        if adapters is not None and plugin is not None and is_listed and is_untimed((plugin.value.strip(),), words):
            yield adapters, f"`{_ADAPTERS}` {WITHOUT_TIMES}"


_ADAPTERS = "request_adapters"


def _of_argument(value: Attribute | None, written: Mapping[str, Mapping[str, Attribute]]) -> Attribute | None:
    """Return the default of the argument that a value stands for, and other values as they are."""
    use = re.fullmatch(r"\s*\$\(arg\s+([\w-]+)\s*\)\s*", value.value) if value is not None else None
    if use is None:
        return value
    argument = written.get(use[1], {})
    return argument.get("default") or argument.get("value")


def spawned_while_paused(source: Source, model: Model) -> Defects:
    """Yield the arguments of ``spawn_model`` in a launch file that starts Gazebo paused, if no file unpauses it."""
    tags = list(tags_of(source)) if "paused" in source.text else []
    defaults = actions_of(source).defaults
    is_paused = False
    for tag in tags:
        name, value = (tag.attributes.get(key) for key in ("name", "value"))
        parent = tag.parent.attributes.get("file") if tag.parent is not None else None
        if tag.name == "arg" and name is not None and value is not None and parent is not None:
            use = re.fullmatch(r"\$\(arg\s+([\w-]+)\s*\)", value.value)
            text = defaults.get(use[1], "") if use is not None else value.value
            is_paused |= name.value == "paused" and "empty_world.launch" in parent.value and text.lower() == "true"
    if not is_paused or any("unpause" in file.text for file in model.related_files.values()):
        return
    if not any(re.search(r"pkg\s*=\s*[\"']controller_manager[\"']", file.text) for file in ros1_files(model)):
        return
    for tag in tags:
        program, arguments = (tag.attributes.get(key) for key in ("type", "args"))
        if tag.name == "node" and program is not None and program.value == "spawn_model" and arguments is not None:
            yield arguments, "Gazebo starts paused, and controllers wait until it runs; add `-unpause`"


def _is_command(tag: Tag) -> bool:
    """Return whether a <rosparam> does something else than to load its file."""
    command = tag.attributes.get("command")
    return command is not None and command.value != "load"


def tags_of(source: Source) -> Iterator[Tag]:
    """Yield the elements of a launch file."""
    for root in Document(source).roots:
        yield from root.walk()


def namespace_of(tag: Tag) -> str:
    """Return the namespace of an element, with ``robot_description`` for arguments of this name."""
    parts = [each.attributes["ns"].value for each in (tag, *tag.ancestors()) if "ns" in each.attributes]
    return re.sub(r"\$\(arg robot_description\)", "robot_description", "/".join(reversed(parts))).strip("/")


def parameters_at(path: str, model: Model) -> Source | None:
    """Return a parameter file of a package of the workspace; None for other files."""
    package, inner = share_of(path)
    folder = neighbours(model.package).get(package) if model.package is not None else None
    if folder is None or not is_file(folder / inner):
        return None
    name = shown_path(folder / inner)
    try:
        return model.related_files.get(name) or read_source(folder / inner, shown_as=name, texts=model.texts)
    except ResourceError:
        return None
