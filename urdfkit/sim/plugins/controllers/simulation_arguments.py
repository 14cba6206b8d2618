"""Xacro arguments of a robot that select the hardware of the simulation, for messages about other hardware."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from urdfkit.description.xacro.declared_arguments import declared_arguments
from urdfkit.description.xml.reader import read_source

if TYPE_CHECKING:
    from urdfkit.description.urdf.robot import Robot

_FALSE = ("false", "False", "0")
_SIMULATION = re.compile(r"(^|_)(sim|simulation|gazebo|gz|ignition|ign|mock|fake)(_|$)")


def simulation_hint(robot: Robot) -> str:
    """Return the end of a message that lists the arguments that enable the simulated hardware; empty without any.

    All files of the robot are searched. The end is empty, too, if the robot was loaded with such an argument.
    """
    defaults = declared_arguments([read_source(file) for file in robot.files if file.is_file()])
    enabling = [name for name, value in defaults.items() if value in _FALSE and _SIMULATION.search(name)]
    if not enabling or any(name in robot.arguments for name in enabling):
        return ""
    return f"; pass {' or '.join(f'{name}:=true' for name in enabling)}"
