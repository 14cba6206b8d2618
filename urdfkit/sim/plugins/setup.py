"""Setup: what a plugin of the simulator is configured with."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from urdfkit.errors import SimulationError, did_you_mean
from urdfkit.sim.plugins.ros_distro import Distro

if TYPE_CHECKING:
    from pathlib import Path

    import numpy as np

    from urdfkit.bus import Bus
    from urdfkit.description.urdf.robot import SensorTag
    from urdfkit.description.xml.source import Position
    from urdfkit.kinematics import Kinematics
    from urdfkit.sim.scene_view import Surroundings


@dataclass(frozen=True)
class Setup:
    """What a plugin may use.

    Attributes:
        bus: where it publishes and subscribes.
        kinematics: the robot's model.
        model: the name the robot was spawned under.
        world: the world's name.
        dt: the simulation's step [s].
        random: the generator of this plugin alone, from the simulation's seed.
        note: tells the user something, once per text.
        surroundings: everything there is to see; None where nobody looks.
        sensor: the ``<sensor>`` that the plugin stands in; None for others.
        link: the link that the ``<gazebo>`` block is about; empty for those of the whole model.
        distro: the ROS distribution whose behaviour is wanted.
        parameter_files: of controllers, in place of those the robot's packages load.
        namespace: of what is published unasked: empty for the first robot, ``/NAME`` for others.
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

    @property
    def names(self) -> dict[str, str]:
        """What goes into the braces of a table's defaults."""
        return {"model": self.model, "world": self.world, "root": self.kinematics.root}

    def joint(self, name: str, position: Position) -> str:
        """Return the name of a joint that moves in one degree of freedom.

        Raises:
            SimulationError: there is none, at the place where it was asked for.
        """
        known = (*self.kinematics.joint_names, *self.kinematics.mimic_names)
        if name in known:
            return name
        robot = self.kinematics.robot
        if name in robot.joint_by_name:
            raise SimulationError(
                f"joint `{name}` is {robot.joint_by_name[name].type}: nothing can drive it", position=position
            )
        raise SimulationError(
            f"no joint `{name}` in robot `{robot.name}`{did_you_mean(name, known)}", position=position
        )
