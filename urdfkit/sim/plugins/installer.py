"""Installation of a robot's plugins: select and configure a class for each element, report skipped plugins."""

from collections.abc import Iterator
from dataclasses import dataclass, field, replace

import numpy as np

from urdfkit import entry_points
from urdfkit.defect_message import with_effect
from urdfkit.description.hardware_defects import hardware_plugin, mock_blocks, not_run
from urdfkit.description.plugins import PluginSpec, match
from urdfkit.description.plugins.gazebo_libraries import meant_library
from urdfkit.description.plugins.lookup import stem
from urdfkit.description.plugins.sensors.table import BARE, INSTEAD, SENSOR_TYPES
from urdfkit.description.plugins.unknown_plugins import unknown, unsupported
from urdfkit.description.sdf.reader.world_plugins import NEEDLESS
from urdfkit.description.urdf.repair_record import Repair, RepairKind
from urdfkit.description.urdf.robot import Plugin, Robot, SensorTag
from urdfkit.errors import DescriptionError, SimulationError, UrdfkitError, UsageError, nearest
from urdfkit.position import Position
from urdfkit.sim.plugins.base import Controller, Drive, Sensor
from urdfkit.sim.plugins.builtin_publishers import JointStates, all_joint_states, joint_states
from urdfkit.sim.plugins.controllers import CONTROLLERS
from urdfkit.sim.plugins.controllers.joints.joint_state_broadcaster import JointStatePublisher
from urdfkit.sim.plugins.controllers.ros2_control import mock_control
from urdfkit.sim.plugins.drives import DRIVES
from urdfkit.sim.plugins.sensors import SENSORS
from urdfkit.sim.plugins.setup import Setup
from urdfkit.sim.plugins.unknown_tags import SharedTopics, misspelt, not_read

_NOT_SIMULATED = "Z833"
"""Code of the lint rule that reports parts that are not simulated."""


@dataclass(frozen=True)
class Simulated:
    """Decision to simulate a plugin.

    Attributes:
        made: the object that simulates the plugin.
    """

    made: Drive | Sensor | Controller | JointStates


@dataclass(frozen=True)
class LeftOut:
    """Decision not to simulate a plugin.

    Attributes:
        message: reason, without the position.
        position: source position of the plugin or sensor.
        code: code of the lint rule that reports the same defect; None if it depends on the parameter.
        attribute: attribute that has the defect; None for the whole element.
    """

    message: str
    position: Position | None
    code: str | None = None
    attribute: str | None = None


@dataclass(frozen=True)
class Needless:
    """Decision to skip a plugin whose function is built in, or that an earlier note reports."""


Decision = Simulated | LeftOut | Needless


@dataclass
class Installed:
    """The configured plugins of one robot, in the order of the description."""

    drives: list[Drive] = field(default_factory=list)
    sensors: list[Sensor] = field(default_factory=list)
    controllers: list[Controller] = field(default_factory=list)
    joint_states: list[JointStates] = field(default_factory=list)

    def add(self, made: Drive | Sensor | Controller | JointStates) -> None:
        """Add a plugin to the list of its kind."""
        if isinstance(made, Drive):
            self.drives.append(made)
        elif isinstance(made, Sensor):
            self.sensors.append(made)
        elif isinstance(made, Controller):
            self.controllers.append(made)
        else:
            self.joint_states.append(made)

    @property
    def publishes_joint_states(self) -> bool:
        """Whether a plugin or a controller publishes joint states."""
        loops = [controller.loop for controller in self.controllers if controller.loop is not None]
        return bool(self.joint_states) or any(
            isinstance(controller, JointStatePublisher) for loop in loops for controller in loop.controllers.values()
        )


def install(robot: Robot, setup: Setup, *, seed: int) -> Installed:
    """Configure every plugin of a robot that can be simulated, and report every other plugin once.

    Args:
        robot: the robot as written.
        setup: what plugins may use; each gets its own random generator.
        seed: seed of the simulation.

    Raises:
        UrdfkitError: a parameter is wrong, and robots that need a repair are refused; with its position.
    """
    installed, shared = Installed(), SharedTopics(setup.note)
    for warning in misspelt(robot):
        setup.note(warning)
    classes = (
        *DRIVES, *entry_points.load("urdfkit.drives"),
        *SENSORS, *entry_points.load("urdfkit.sensors"),
        *CONTROLLERS, *entry_points.load("urdfkit.controllers"),
    )  # fmt: skip
    for number, (plugin, sensor, link) in enumerate(_plugins(robot)):
        own = replace(setup, random=np.random.default_rng([seed, number]), sensor=sensor, link=link)
        decision = _choose(plugin, own, classes)
        if isinstance(decision, Simulated):
            decision = _configure(decision.made, own)
        if isinstance(decision, LeftOut):
            _report(decision, "plugin", setup)
        elif isinstance(decision, Simulated):
            installed.add(decision.made)
            if isinstance(decision.made, Sensor):
                shared.add(decision.made)
    specs = [match(plugin) for plugin, _, _ in _plugins(robot)] if robot.ros2_control else []
    if not any(
        spec is not None and spec.kind == "ros2_control" for spec in specs
    ):  # its own repair reports a plugin that is ignored
        if run := mock_blocks(robot):
            decision = _configure(mock_control(robot), setup)
            if isinstance(decision, Simulated):
                installed.add(decision.made)
        for block in (each for each in robot.ros2_control if each not in run):
            written, hardware = hardware_plugin(block), block.element.find("hardware")
            at = next(each for each in (written, hardware, block.element) if each is not None)
            code = "C717" if written is None else "C718"
            _report(LeftOut("; ".join(not_run(block, robot)), at.origin.position, code), "hardware", setup)
    if not installed.publishes_joint_states:
        installed.joint_states.append(all_joint_states(setup))
    return installed


def _plugins(robot: Robot) -> Iterator[tuple[Plugin, SensorTag | None, str]]:
    """Yield each plugin with its sensor and link; a sensor without plugins is yielded as its own plugin."""
    for block in robot.gazebo:
        link = block.reference or ""
        for plugin in block.plugins:
            yield plugin, None, link
        for sensor in block.sensors:
            for plugin in sensor.plugins or (Plugin(sensor.name, None, sensor.element),):
                yield plugin, sensor, link


def _choose(plugin: Plugin, setup: Setup, classes: tuple[type[Drive | Sensor | Controller], ...]) -> Decision:
    """Decide whether to simulate a plugin, and instantiate its class; report its unknown parameters.

    A class matches by the kind of the plugin's table, or by its own table for the file name.
    """
    sensor = setup.sensor
    bare = sensor is not None and plugin.element is sensor.element
    spec = BARE.get((sensor.type or "").strip()) if bare and sensor is not None else match(plugin)
    if sensor is not None and (reason := unsupported(sensor, simulated=spec is not None or not bare)):
        kind = (sensor.type or "").strip()
        is_valid = kind in (*SENSOR_TYPES, *INSTEAD)
        is_defect = not kind or (not is_valid and nearest(kind, SENSOR_TYPES, cutoff=0.8) is not None)
        return LeftOut(reason, sensor.element.origin.position, "Z827" if is_defect else _NOT_SIMULATED, "type")
    for warning in not_read(plugin, spec) if spec is not None and not bare else ():
        setup.note(warning)
    if spec is not None and spec.kind == "joint_state_publisher":
        try:
            return Simulated(joint_states(plugin, spec, setup))
        except SimulationError as error:
            return _leave_out(plugin, error, setup)
    name = stem(plugin.filename or "")
    for each in classes:
        own: PluginSpec | None = next((table for table in each.specs if name in table.filenames), None)
        chosen = own or (spec if spec is not None and each.kind == spec.kind else None)
        if chosen is not None:
            return Simulated(each(plugin, chosen))
    noted = () if setup.surroundings is None else setup.surroundings.world.unknown_plugins
    if name in NEEDLESS or plugin.element.origin.position in noted:
        return Needless()
    brought = [name for each in classes for table in each.specs for name in table.filenames]
    reason = unknown(plugin, None if sensor is None else sensor.name or "", [*NEEDLESS, *brought])
    code = "Z809" if not (plugin.filename or "").strip() else _NOT_SIMULATED
    code = code if meant_library(name) is None else "Z825"
    return LeftOut(reason, plugin.element.origin.position, code, "filename")


def _configure(made: Drive | Sensor | Controller | JointStates, setup: Setup) -> Decision:
    """Configure a plugin; a plugin with a wrong parameter is ignored.

    Raises:
        UrdfkitError: a parameter of a drive or controller is wrong, and robots that need a repair are refused.
    """
    if isinstance(made, JointStates):
        return Simulated(made)
    try:
        made.configure(setup)
    except UrdfkitError as error:
        if not isinstance(made, Sensor):
            return _leave_out(made.plugin, error, setup)
        if not isinstance(error, (SimulationError, UsageError)):
            raise
        name = setup.sensor.name if setup.sensor is not None else made.plugin.name
        label = f"sensor `{name}`" if name else "the sensor"
        message = with_effect(error.message, f"{label} is ignored")
        return LeftOut(message, error.position or made.plugin.element.origin.position, error.code)
    return Simulated(made)


def _report(part: LeftOut, kind: RepairKind, setup: Setup) -> None:
    """Record a part that is not simulated.

    Raises:
        SimulationError: robots that need a repair are refused.
    """
    setup.repairs.add(Repair(kind, part.code, part.message, part.position, attribute=part.attribute))


def _leave_out(plugin: Plugin, error: UrdfkitError, setup: Setup) -> Needless:
    """Record that a plugin with a wrong parameter is ignored.

    Raises:
        UrdfkitError: the error, if robots that need a repair are refused.
    """
    effect = f"plugin `{plugin.name or plugin.filename}` is ignored"
    code = "K971" if isinstance(error, DescriptionError) else None
    setup.repairs.leave_out(error, effect, "plugin", code, position=plugin.element.origin.position)
    return Needless()
