"""From plugins as written to drives, sensors, controllers and publications at work."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from urdfkit import registry
from urdfkit.description.plugins import PluginSpec, match
from urdfkit.description.plugins.lookup import stem
from urdfkit.description.plugins.sensors.table import BARE
from urdfkit.description.plugins.unknown_plugins import unknown
from urdfkit.description.sdf.reader.world_plugins import NEEDLESS
from urdfkit.description.urdf.robot import Plugin, Robot, SensorTag
from urdfkit.errors import SimulationError, UsageError
from urdfkit.sim.plugins.base import Controller, Drive, Sensor
from urdfkit.sim.plugins.controllers import CONTROLLERS
from urdfkit.sim.plugins.controllers.joints.joint_state_broadcaster import JointStatePublisher
from urdfkit.sim.plugins.drives import DRIVES
from urdfkit.sim.plugins.publishers import JointStates, all_joint_states, joint_states
from urdfkit.sim.plugins.sensors import SENSORS
from urdfkit.sim.plugins.setup import Setup
from urdfkit.sim.plugins.unknown_tags import SharedTopics, misspelt, not_read, strange


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
    installed, shared = Installed(), SharedTopics(setup.note)
    for remark in misspelt(robot):
        setup.note(remark)
    rooms: tuple[tuple[Sequence[Any], list[Any]], ...] = (
        ((*DRIVES, *registry.load("urdfkit.drives")), installed.drives),
        ((*SENSORS, *registry.load("urdfkit.sensors")), installed.sensors),
        ((*CONTROLLERS, *registry.load("urdfkit.controllers")), installed.controllers),
    )
    for number, (plugin, sensor, link) in enumerate(_plugins(robot)):
        own = replace(setup, random=np.random.default_rng([seed, number]), sensor=sensor, link=link)
        bare = sensor is not None and plugin.element is sensor.element
        spec = BARE.get((sensor.type or "").strip()) if bare and sensor is not None else match(plugin)
        if sensor is not None and (remark := strange(sensor, simulated=spec is not None or not bare)):
            setup.note(remark)
            continue
        for remark in not_read(plugin, spec) if spec is not None and not bare else ():
            setup.note(remark)
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
            if isinstance(made, Sensor):
                told = (topic.name for topic in made.topics if not topic.type.endswith("/CameraInfo"))
                shared.add(made.name or plugin.name or "", plugin.element, told)
        elif stem(plugin.filename or "") not in NEEDLESS and not _noted_on_reading(plugin, setup):
            brought = [
                name for classes, _ in rooms for made in classes for table in made.specs for name in table.filenames
            ]
            setup.note(unknown(plugin, None if sensor is None else sensor.name or "", [*NEEDLESS, *brought]))
    if robot.ros2_control and not any(controller.kind == "ros2_control" for controller in installed.controllers):
        for block in robot.ros2_control:
            setup.note(
                f"{block.element.origin.position}: no plugin runs ros2_control `{block.name or ''}`: "
                "gz_ros2_control or gazebo_ros2_control would"
            )
    if not installed.joint_states and not _publishes_joint_states(installed):
        installed.joint_states.append(all_joint_states(setup))
    return installed


def _noted_on_reading(plugin: Plugin, setup: Setup) -> bool:
    """Whether nobody knew the plugin when its model was read from the world's file."""
    notes = () if setup.surroundings is None else setup.surroundings.world.notes
    return any(note.startswith(f"{plugin.element.origin.position}: unknown plugin") for note in notes)


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
