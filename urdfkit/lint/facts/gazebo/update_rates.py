"""Update rates of controller managers in Gazebo, compared with the physics of the worlds.

Sources: gz_ros2_control (gz_ros2_control_plugin.cpp) and gazebo_ros2_control (gazebo_ros2_control_plugin.cpp): the
controllers are updated after a step of the physics, and a shorter period is a warning; sdformat (physics.sdf): the
default of ``max_step_size`` is 0.001 s.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from urdfkit.description.packages.related_files import package_of
from urdfkit.description.xml.numbers import number
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.ros2_controllers import PARAMETERS
from urdfkit.lint.facts.control.yaml_tree import Node, number_of, yamls
from urdfkit.lint.facts.gazebo.plugins import plugins
from urdfkit.lint.facts.navigation.sections import sections
from urdfkit.lint.model.model import Model
from urdfkit.lint.project.code_files import code_texts

_STEP = r"<max_step_size>\s*([^<>\s]+)\s*</max_step_size>"
_DEFAULT_STEP = 0.001
_PLUGIN = r"(?:gz|ign|gazebo)_ros2_control"


def rates_above_physics(model: Model) -> Iterator[tuple[Source, Node, str]]:
    """Yield each update rate of a controller manager that is higher than the rate of every world of the packages."""
    if not any(re.search(_PLUGIN, plugin.filename or "") for plugin, _, _ in plugins(model.robot)):
        return
    found = [
        (source, value)
        for source in yamls(model)
        for key, group in (sections(source) if PARAMETERS in source.text else ())
        if key.last_name == "controller_manager" and (value := group.find("update_rate")) is not None
    ]
    steps = _steps(model) if any((number_of(value) or 0.0) > 100.0 for _, value in found) else []
    for source, value in found if steps else ():
        rate = number_of(value)
        if rate is not None and rate * min(steps) > 1.0 + 1e-6:
            message = (
                f"`update_rate` is {rate:g} Hz, but the physics of Gazebo has {1.0 / min(steps):g} steps per second"
            )
            yield source, value, message


def _steps(model: Model) -> list[float]:
    """Return the step sizes of the worlds of the packages, or that of other worlds [s]; empty if one is computed."""
    steps: list[float] = []
    folders = {folder for file in model.related_files if (folder := package_of(Path(file))) is not None}
    for folder in sorted(folders):
        model.expanded.packages.watch(folder, ".sdf", ".world")
        for _, text in code_texts(folder, (".sdf", ".world")):
            if re.search(r"<world\b", text):
                written = [number(each) for each in re.findall(_STEP, text)] or [_DEFAULT_STEP]
                if None in written:
                    return []
                steps += [each for each in written if each is not None and each > 0.0]
    return steps or [_DEFAULT_STEP]
