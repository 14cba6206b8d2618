"""Topics of Gazebo and arguments of spawners with the name of a world or model that the packages do not have."""

import re
from collections.abc import Iterator
from pathlib import Path

from urdfkit.description.packages.related_files import LAUNCH, package_of
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.launch_package_paths import uncommented
from urdfkit.lint.facts.ros_packages import is_slip
from urdfkit.lint.fix_builders import nearest
from urdfkit.lint.model.model import Model
from urdfkit.lint.project.code_files import code_texts

_TOPIC = r"(?<![\w/])/world/(\w+)/(?=\w)"
_SPAWNED = r"(?<![\w-])--?world[\"']?(?:\s*,)?\s+[\"']?(\w+)(?=[\s\"'])"
"""Matches the name of the world among the arguments of ``create`` (ros_gz_sim)."""

_NAMED = r"<world\s[^<>]*?\bname\s*=\s*[\"']([^\"'<>]+)[\"']"
_ENDINGS = (".sdf", ".world", ".xacro")
_WORLD_FILE = r"([\w.-]+\.(?:sdf|world))\b"


def topics_of_other_worlds(model: Model) -> Iterator[tuple[Source, int, str, list[str]]]:
    """Yield file, offset and name of each world in a topic that no world file of the packages defines, with theirs."""
    files = [source for name, source in model.related_files.items() if name.endswith((".yaml", ".yml", *LAUNCH))]
    used = [(source, at) for source in files for at in re.finditer(_TOPIC, uncommented(source))]
    spawning = [source for source in files if "ros_gz_sim" in source.text and "create" in source.text]
    used += [(source, at) for source in spawning for at in re.finditer(_SPAWNED, uncommented(source))]
    if not used:
        return
    worlds, names = set[str](), set[str]()
    folders = {folder for file in model.related_files if (folder := package_of(Path(file))) is not None}
    for folder in sorted(folders):
        model.expanded.packages.watch(folder, *_ENDINGS)
        for path, text in code_texts(folder, _ENDINGS):
            names.add(path.name)
            worlds.update(re.findall(_NAMED, text))
    loaded = {name for source in files for name in re.findall(_WORLD_FILE, uncommented(source))}
    if not worlds or any("$" in name for name in worlds) or not loaded <= names:
        return
    for source, at in used:
        if at[1] not in worlds:
            yield source, at.start(1), at[1], sorted(worlds)


_MODEL_TOPIC = r"(?<![\w/])/model/(\w+)/(?=\w)"
_NAME = r"(?<![\w-])--?name(?:[\"']?\s*,\s*[\"']|\s+[\"']?)(\w+)(?=[\s\"'])"
"""Matches the name of the model among the arguments of ``create`` (ros_gz_sim)."""

_PARAMETER = (
    r"[\"'](?:name|entity_name|model_name)[\"']\s*:\s*[\"'](\w+)[\"']"
    r"|\bname\s*=\s*[\"'](?:name|entity_name|model_name)[\"']\s+(?:value|default)\s*=\s*[\"'](\w+)[\"']"
)
"""Matches the name of the model among the parameters of ``create``, or an argument for it."""

_OF_ROBOTS = r"(?:cmd_vel|odometry|odom|tf|pose|joint_state|joint_trajectory)\b"
"""Matches the ends of topics that a robot has, but furniture has not."""

_ANY_NAME = r"(?<![\w-])--?name(?=[\s\"'])"
_MODEL = r"<model\s[^<>]*?\bname\s*=\s*[\"']([^\"'<>]+)[\"']|<name>\s*([^<>]+?)\s*</name>"
"""Matches the names of models and includes in a world."""


def topics_of_other_models(model: Model) -> Iterator[tuple[Source, int, str, str]]:
    """Yield file, offset and name of each model in a topic that no launch file spawns and no world contains.

    The last value is the spawned model that is probably meant: it has a similar or longer name. Nothing is yielded if
    a launch file computes the name of a model that it spawns.
    """
    files = [source for name, source in model.related_files.items() if name.endswith((".yaml", ".yml", *LAUNCH))]
    used = [(source, at) for source in files for at in re.finditer(_MODEL_TOPIC, uncommented(source))]
    spawning = [uncommented(source) for source in files if "ros_gz_sim" in source.text and "create" in source.text]
    spawned = {name for text in spawning for name in re.findall(_NAME, text)}
    others = {name for text in spawning for pair in re.findall(_PARAMETER, text) for name in pair}
    every = sum(len(re.findall(_ANY_NAME, text)) for text in spawning)
    if not used or not spawned or every != sum(len(re.findall(_NAME, text)) for text in spawning):
        return
    folders = {folder for file in model.related_files if (folder := package_of(Path(file))) is not None}
    texts = [text for folder in sorted(folders) for _, text in code_texts(folder, _ENDINGS)]
    others |= {name for text in texts for pair in re.findall(_MODEL, text) for name in pair} | {model.robot.name or ""}
    topics = {word.strip("\"'") for source in files for word in uncommented(source).split()}
    for source, at in used:
        if at[1] not in spawned | others:
            slips = [name for name in sorted(spawned) if is_slip(at[1], name)]
            rest = source.text[at.end() :].partition("\n")[0].strip(" \"'")
            is_of_robot = re.match(_OF_ROBOTS, rest) is not None
            free = [name for name in sorted(spawned) if is_of_robot and f"/model/{name}/{rest}" not in topics]
            longer = [name for name in free if name in at[1] or at[1] in name]
            near = next(iter(slips), None) or nearest(at[1], free, cutoff=0.7) or next(iter(longer), None)
            if near is not None:  # else it may be a model that a world includes
                yield source, at.start(1), at[1], near
