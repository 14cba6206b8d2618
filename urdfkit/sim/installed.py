"""From plugins as written to drives, sensors, controllers and publications at work."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from urdfkit.description.plugins import match
from urdfkit.description.robot import Plugin, Robot
from urdfkit.sim.controllers import CONTROLLERS
from urdfkit.sim.drives import DRIVES
from urdfkit.sim.plugin import Controller, Drive, Sensor, Setup
from urdfkit.sim.publications import JointStates, all_joint_states, joint_states
from urdfkit.sim.sensors import SENSORS


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
    drives, sensors, controllers = (
        _known("drives", DRIVES),
        _known("sensors", SENSORS),
        _known("controllers", CONTROLLERS),
    )
    for number, plugin in enumerate(_plugins(robot)):
        own = replace(setup, random=np.random.default_rng([seed, number]))
        spec = match(plugin)
        if spec is not None and spec.kind == "joint_state_publisher":
            installed.joint_states.append(joint_states(plugin, spec, own))
            continue
        for known, works in (
            (drives, installed.drives),
            (sensors, installed.sensors),
            (controllers, installed.controllers),
        ):
            if spec is not None and spec.kind in known:
                made = known[spec.kind](plugin, spec)
                made.configure(own)
                works.append(made)
                break
        else:
            setup.note(f"plugin {plugin.filename or plugin.name or 'without file name'}: not simulated yet")
    for block in robot.ros2_control:
        setup.note(f"ros2_control {block.name or ''}: not simulated yet")
    if not installed.joint_states:
        installed.joint_states.append(all_joint_states(setup))
    return installed


def _plugins(robot: Robot) -> Iterator[Plugin]:
    for block in robot.gazebo:
        yield from block.plugins
        for sensor in block.sensors:
            yield from sensor.plugins


def _known(what: str, ours: tuple[Any, ...]) -> dict[str, Any]:
    """Return kind → class; ours win over those of third parties."""
    return {made.kind: made for made in reversed(ours)}
