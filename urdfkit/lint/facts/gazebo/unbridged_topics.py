"""Topics of Gazebo that nodes of ROS need, but no bridge of the workspace has: the clock and the joint states.

Sources: ros_gz_bridge (README.md), gz-sim (JointStatePublisher.hh), robot_state_publisher (robot_state_publisher.cpp).
"""

import re
from collections.abc import Iterator, Sequence
from pathlib import PurePath

from urdfkit.description.launch.launch_scope import LaunchContents
from urdfkit.description.packages.related_files import LAUNCH
from urdfkit.description.xml.reader import shown_path
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.connections.controller_managers import WITHOUT_MANAGER
from urdfkit.lint.facts.connections.trees import launch_trees
from urdfkit.lint.facts.control.controller_joints import Named
from urdfkit.lint.facts.control.launch_package_paths import uncommented
from urdfkit.lint.facts.control.ros_gz_bridges import Bridged
from urdfkit.lint.model.model import Model

_USED = r"use_sim_time[\"']?\s*(?::|,|\"\s+value=|\"\s+default=|,\s*default_value=)\s*[\"']?[Tt]rue"
"""Matches a parameter or argument with which nodes use the time of the simulation."""

_SIMULATION = r"\bgz_sim\b|\bros_gz_sim\.launch|\bgz_server\b|\bgzserver\b|\b(?:gz|ign)\W+(?:sim|gazebo)\b"
"""Matches a launch file that starts Gazebo; packages that spawn a robot can join a simulation of another launch."""

_JOINTS = r"[Jj]oint_?[Ss]tate|ros2_control|controller_manager"


def unbridged(bridges: Sequence[tuple[Source, Bridged]], model: Model) -> Iterator[tuple[Source, Named, str]]:
    """Yield the first bridge of a launch without the clock or the joint states, with the message."""
    publishes = any("gz-sim-joint-state-publisher" in source.text for source in model.expanded.sources.values())
    seen = set[tuple[str, int]]()
    for tree in launch_trees(model) if bridges else ():
        files = _files(tree, model)
        text, names = "\n".join(map(uncommented, files)), {source.file for source in files}
        own = [(source, each.topic) for source, each in bridges if each.topic is not None and source.file in names]
        own.sort(key=lambda each: (each[0].file, each[1].start))
        is_open = any(package not in WITHOUT_MANAGER for package, _ in tree.outside)
        if len(own) < 2 or is_open or (own[0][0].file, own[0][1].start) in seen:
            continue
        listed = {source.file for source, _ in own if not source.file.endswith(LAUNCH)}
        if text.count("config_file") > len(listed) or re.search(_SIMULATION, text) is None:
            continue  # the file of a bridge is computed, or the simulation is another launch
        seen.add((own[0][0].file, own[0][1].start))
        others = [source for source in model.related_files.values() if source.file not in names]
        elsewhere = "\n".join(each.text for each in others if each.file.endswith((*LAUNCH, ".yaml", ".yml")))
        if re.search(_USED, text) and not re.search(r"(?<!gz_)\bclock\b", f"{text}\n{elsewhere}"):
            yield *own[0], "no bridge has the topic `clock`, so the time of nodes with `use_sim_time` stays at zero"
        has_joints = re.search(_JOINTS, text) or re.search(r"JointState\b", elsewhere)
        if publishes and "robot_state_publisher" in tree.started and not has_joints:
            yield *own[0], "no bridge has the joint states of the robot, which robot_state_publisher needs"


def _files(tree: LaunchContents, model: Model) -> list[Source]:
    """Return the files of a launch, and the YAML files that they name."""
    launches = [model.related_files.get(shown_path(path)) for path in (tree.path, *tree.included)]
    found = [source for source in launches if source is not None]
    text = "\n".join(source.text for source in found)
    yamls = [source for source in model.related_files.values() if source.file.endswith((".yaml", ".yml"))]
    return found + [source for source in yamls if PurePath(source.file).name in text and source not in found]
