"""Setup: interfaces and options with which the simulator configures a plugin."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from urdfkit.bus import Bus
from urdfkit.description.urdf.robot import SensorTag
from urdfkit.description.xml.source import Position
from urdfkit.errors import SimulationError, did_you_mean
from urdfkit.kinematics import Kinematics
from urdfkit.sim.construction.repairs.collector import Repairs
from urdfkit.sim.plugins.ros_distro import Distro
from urdfkit.sim.scene_view import Surroundings
from urdfkit.sim.state.arguments import LARGEST as LARGEST


def is_command(numbers: Iterable[float]) -> bool:
    """Whether all numbers of a command are finite and not larger than `LARGEST`."""
    return all(abs(number) <= LARGEST for number in numbers)


@dataclass(frozen=True)
class Setup:
    """Interfaces and options of one plugin.

    Attributes:
        bus: bus on which the plugin publishes and subscribes.
        kinematics: kinematic model of the robot.
        model: name under which the robot was spawned.
        world: name of the world.
        dt: the simulation's step [s].
        random: random generator of this plugin, derived from the simulation's seed.
        note: reports a note to the user, once per text.
        surroundings: scene that sensors observe; None without a scene.
        sensor: ``<sensor>`` that contains the plugin; None outside a sensor.
        link: reference of the ``<gazebo>`` block, a link or joint; empty for a block of the whole model.
        distro: ROS distribution whose behaviour the plugin follows.
        parameter_files: parameter files of controllers, instead of the files that the robot's packages load.
        namespace: namespace of the built-in topics: empty for the first robot, ``/NAME`` for others.
        repairs: collects the parts of the robot that are ignored.
    """

    bus: Bus
    kinematics: Kinematics
    model: str
    world: str
    dt: float
    random: np.random.Generator
    note: Callable[[str], None]
    distro: Distro = field(default_factory=Distro)
    parameter_files: tuple[Path, ...] = ()
    namespace: str = ""
    surroundings: Surroundings | None = None
    sensor: SensorTag | None = None
    link: str = ""
    repairs: Repairs = field(default_factory=lambda: Repairs(lambda _: None, strict=True))

    @property
    def names(self) -> dict[str, str]:
        """Values of the placeholders in a table's defaults."""
        return {"model": self.model, "world": self.world, "root": self.kinematics.root}

    def joint(self, name: str, position: Position, code: str = "Z802") -> str:
        """Return the name of a joint that moves in one degree of freedom.

        Args:
            name: the name in the parameter.
            position: source position of the parameter.
            code: code of the lint rule that reports unknown joints of the parameter.

        Raises:
            SimulationError: no joint with one degree of freedom has this name, with the position of the parameter.
        """
        names = (*self.kinematics.joint_names, *self.kinematics.mimic_names)
        if name in names:
            return name
        robot = self.kinematics.robot
        if name in robot.joint_by_name:
            raise SimulationError(
                f"joint `{name}` is {robot.joint_by_name[name].type}: it cannot be driven", position=position, code=code
            )
        raise SimulationError(
            f"no joint `{name}` in robot `{robot.name}`" + did_you_mean(name, names), position=position, code=code
        )
