"""Planning pipelines in ROS 1 launch files that the node ``move_group`` does not read.

The behaviour is that of MoveIt of Noetic; the sources were not compared.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from urdfkit.defect_message import Suggestion
from urdfkit.description.xml.source import Source
from urdfkit.errors import nearest
from urdfkit.lint.facts.control.launch_package_paths import uncommented
from urdfkit.lint.facts.launch.actions import actions_of
from urdfkit.lint.facts.launch.receivers import actions_at, receiver
from urdfkit.lint.facts.launch.spawned_controllers import ros1_files
from urdfkit.lint.facts.parameters.loaded_files import namespace_of, own_namespace, program_of, tags_of
from urdfkit.lint.model.model import Model
from urdfkit.lint.model.tags import Attribute, Tag

Defects = Iterator[tuple[Attribute, str]]


def unloaded_pipelines(source: Source, model: Model) -> Defects:
    """Yield the values of ``default_planning_pipeline`` that no ROS 1 launch file loads."""
    if "default_planning_pipeline" not in source.text:
        return
    texts = [uncommented(file) for file in ros1_files(model)]
    names = [at[1] for text in texts for at in re.finditer(r"planning_pipelines\b/?([^\"'\s<>/]*)", text)]
    spaces = [namespace_of(tag) for file in ros1_files(model) for tag in tags_of(file) if "ns" in tag.attributes]
    nested = [at[1] for space in spaces if (at := re.search(r"planning_pipelines/([^/]+)", space)) is not None]
    names = [name for name in names if name] + nested if nested else names
    if not names or any("$" in name or not name for name in names):
        return
    for tag in tags_of(source):
        name, value = (tag.attributes.get(key) for key in ("name", "value"))
        is_default = tag.name == "param" and name is not None and name.value.endswith("default_planning_pipeline")
        if is_default and value is not None and "$" not in value.value and value.value not in names:
            yield value, f"planning pipeline `{value.value}` is not loaded; loaded: {', '.join(sorted({*names}))}"


def pipelines_elsewhere(source: Source, model: Model) -> Defects:
    """Yield the namespaces with planning pipelines in which the node ``move_group`` does not read them."""
    tags = list(tags_of(source)) if "moveit_ros_move_group" in source.text else []
    nodes = [tag.attributes for tag in tags if tag.name == "node" and program_of(tag) == "move_group"]
    names = {at["name"].value for at in nodes if "name" in at and "ns" not in at}
    groups = [tag for tag in tags if tag.name == "group" and "ns" in tag.attributes]
    inner = [tag for tag in groups if tag.attributes["ns"].value.startswith("planning_pipelines")]
    outer = [tag.parent for tag in inner if tag.parent is not None and "ns" in tag.parent.attributes]
    spaces = {tag.start: tag.attributes["ns"] for tag in outer if namespace_of(tag) == own_namespace(tag)}
    for space in (tag.attributes["ns"] for tag in tags if nodes and "ns" in tag.attributes):
        for part in space.value.split("/"):
            if part != "planning_pipelines" and nearest(part, ("planning_pipelines",), cutoff=0.9):
                hint = Suggestion("planning_pipelines", part)
                yield space, "move_group reads its pipelines from `planning_pipelines`" + hint
    is_plain = len(names) == 1 and not any("$" in name for name in (*names, *(each.value for each in spaces.values())))
    for space in spaces.values() if is_plain and len(nodes) == 1 else ():
        if space.value.strip("/") not in names:
            (name,) = names
            message = f"node `{name}` reads planning pipelines from its own namespace" + Suggestion(name, space.value)
            yield space, message
    yield from _included_elsewhere(source, tags, names, model) if len(nodes) == 1 and len(names) == 1 else ()


def _included_elsewhere(source: Source, tags: list[Tag], names: set[str], model: Model) -> Defects:
    """Yield the namespaces of included files with a planning plugin, if the node reads several pipelines."""
    if not re.search(r"\b(?:param|name)\s*=\s*[\"']planning_pipelines[\"']", source.text):
        return
    for call in actions_of(source).includes:
        tag = next((tag for tag in tags if tag.name == "include" and tag.start == call.start), None)
        space = tag.attributes.get("ns") if tag is not None else None
        path = receiver(call, model) if tag is not None and space is not None else None
        included = actions_at(path, model) if path is not None else None
        if tag is None or space is None or included is None or "$" in namespace_of(tag):
            continue
        text = uncommented(included.source)
        if "planning_pipelines" not in f"{namespace_of(tag)} {text}" and "planning_plugin" in text:
            (name,) = names
            yield space, f"node `{name}` reads its planning pipelines from `{name}/planning_pipelines`"
