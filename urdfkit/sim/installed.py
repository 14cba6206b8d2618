"""From plugins as written to drives, sensors, controllers and publications at work."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from difflib import get_close_matches
from typing import Any

import numpy as np

from urdfkit import registry
from urdfkit.description.plugins import ALL_SPECS, PluginSpec, match
from urdfkit.description.plugins.lookup import stem
from urdfkit.description.plugins.sensors import BARE, SENSOR_TYPES
from urdfkit.description.robot import Plugin, Robot, SensorTag
from urdfkit.description.world.systems import NEEDLESS
from urdfkit.errors import SimulationError, UsageError, did_you_mean
from urdfkit.sim.controllers import CONTROLLERS
from urdfkit.sim.controllers.joint_state import JointStatePublisher
from urdfkit.sim.drives import DRIVES
from urdfkit.sim.plugin import Controller, Drive, Sensor, Setup
from urdfkit.sim.publications import JointStates, all_joint_states, joint_states
from urdfkit.sim.sensors import SENSORS

_SHARED = re.compile(r"^(gazebo_ros_|gazebo_|gz-sim-|ignition-gazebo-|gz_|hector_gazebo_)|(-system|_plugin)$")
"""How names of plugins begin and end."""


@dataclass
class Installed:
    """The plugins of one robot, configured, in the order they are written."""

    drives: list[Drive] = field(default_factory=list)
    sensors: list[Sensor] = field(default_factory=list)
    controllers: list[Controller] = field(default_factory=list)
    joint_states: list[JointStates] = field(default_factory=list)


def install(robot: Robot, setup: Setup, *, seed: int) -> Installed:
    """Configure every plugin of a robot that can be simulated, and note those that cannot, once each.

    Args:
        robot: the robot as written.
        setup: what plugins may use; each gets a random generator of its own.
        seed: the simulation's.

    Raises:
        SimulationError: a parameter makes no sense, with its place.
    """
    installed = Installed()
    rooms: tuple[tuple[Sequence[Any], list[Any]], ...] = (
        ((*DRIVES, *registry.load("urdfkit.drives")), installed.drives),
        ((*SENSORS, *registry.load("urdfkit.sensors")), installed.sensors),
        ((*CONTROLLERS, *registry.load("urdfkit.controllers")), installed.controllers),
    )
    for number, (plugin, sensor, link) in enumerate(_plugins(robot)):
        own = replace(setup, random=np.random.default_rng([seed, number]), sensor=sensor, link=link)
        bare = sensor is not None and plugin.element is sensor.element
        spec = BARE.get((sensor.type or "").strip()) if bare and sensor is not None else match(plugin)
        if sensor is not None and (strange := _strange(sensor, simulated=spec is not None or not bare)):
            setup.note(strange)
            continue
        if spec is not None and spec.kind == "joint_state_publisher":
            installed.joint_states.append(joint_states(plugin, spec, own))
        elif (found := _choose(plugin, spec, rooms)) is not None:
            made, works = found
            try:
                made.configure(own)
            except (SimulationError, UsageError) as error:
                if not isinstance(made, Sensor):
                    raise
                place = "" if error.position is not None else f"{plugin.element.origin.position}: "
                left_out = sensor.name if sensor is not None else plugin.name
                setup.note(f"{place}{error}; sensor `{left_out}` is left out")
                continue
            works.append(made)
        elif stem(plugin.filename or "") not in NEEDLESS:
            setup.note(_unknown(plugin, [table for classes, _ in rooms for made in classes for table in made.specs]))
    if robot.ros2_control and not any(controller.kind == "ros2_control" for controller in installed.controllers):
        for block in robot.ros2_control:
            setup.note(
                f"{block.element.origin.position}: no plugin runs ros2_control `{block.name or ''}`: "
                "gz_ros2_control or gazebo_ros2_control would"
            )
    if not installed.joint_states and not _publishes_joint_states(installed):
        installed.joint_states.append(all_joint_states(setup))
    return installed


def _strange(sensor: SensorTag, *, simulated: bool) -> str:
    """Return why a sensor is left out before it is looked into: its place, and the nearest type; empty if it is not."""
    place, kind = sensor.element.origin.position, (sensor.type or "").strip()
    if not kind:
        return f"{place}: a sensor has no type; sensor `{sensor.name or 'sensor'}` is left out"
    if kind not in SENSOR_TYPES:
        hint = did_you_mean(kind, SENSOR_TYPES)
        return f"{place}: no sensor is of type `{kind}`{hint}; sensor `{sensor.name or 'sensor'}` is left out"
    if not simulated:
        return (
            f"{place}: sensors of type `{kind}` are not simulated yet; sensor `{sensor.name or 'sensor'}` is left out"
        )
    return ""


def _unknown(plugin: Plugin, tables: Sequence[PluginSpec]) -> str:
    """Return what to say of a plugin that nothing here simulates: its place, and the nearest that something does."""
    place = plugin.element.origin.position
    if plugin.filename is None:
        return f"{place}: plugin `{plugin.name or ''}` has no filename, so nothing runs it"
    name = stem(plugin.filename)
    # What most of them share says nothing about which one was meant.
    known = [other for spec in (*ALL_SPECS, *tables) for other in spec.filenames]
    hint = did_you_mean(_essence(name), map(_essence, known))
    if not hint:
        return f"plugin {plugin.filename}: not simulated yet"
    meant = [other for other in known if _essence(other) == hint.split("`")[1]]
    near = get_close_matches(name, meant, n=1, cutoff=0.0)[0]
    return f"{place}: no plugin `{plugin.filename}`; did you mean `{plugin.filename.replace(name, near)}`?"


def _essence(name: str) -> str:
    return _SHARED.sub("", name)


def _publishes_joint_states(installed: Installed) -> bool:
    loops = [controller.loop for controller in installed.controllers if controller.loop is not None]
    return any(isinstance(law, JointStatePublisher) for loop in loops for law in loop.laws.values())


def _plugins(robot: Robot) -> Iterator[tuple[Plugin, SensorTag | None, str]]:
    """Yield the plugins, each with the sensor and the link it is of; a sensor without any stands for itself."""
    for block in robot.gazebo:
        link = block.reference or ""
        for plugin in block.plugins:
            yield plugin, None, link
        for sensor in block.sensors:
            for plugin in sensor.plugins or (Plugin(sensor.name, None, sensor.element),):
                yield plugin, sensor, link


def _choose(
    plugin: Plugin, spec: PluginSpec | None, rooms: tuple[tuple[Sequence[Any], list[Any]], ...]
) -> tuple[Any, list[Any]] | None:
    """Return the plugin's class, instantiated, and the list it belongs to.

    A class is chosen by the kind of the plugin's table, or because it brings a table of its own for that file name.
    """
    name = stem(plugin.filename or "")
    for classes, works in rooms:
        for made in classes:
            own = next((table for table in made.specs if name in table.filenames), None)
            if own is not None or (spec is not None and made.kind == spec.kind):
                return made(plugin, own or spec), works
    return None
