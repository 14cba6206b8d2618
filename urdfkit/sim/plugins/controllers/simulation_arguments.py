"""Xacro arguments of a robot that select the hardware of the simulation, for messages about other hardware."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from urdfkit.description.urdf.robot import Robot

_ARGUMENT = re.compile(r"<xacro:arg\b[^>]*?\bname=[\"']([^\"']+)[\"'][^>]*?\bdefault=[\"'](?:false|False|0)[\"']")
_SIMULATION = re.compile(r"(^|_)(sim|simulation|gazebo|gz|ignition|ign|mock|fake)(_|$)")


def simulation_hint(robot: Robot) -> str:
    """Return the end of a message that lists the arguments that enable the simulated hardware; empty without any."""
    entry = robot.files[0].read_text(errors="replace") if robot.files and robot.files[0].is_file() else ""
    names = [name for name in dict.fromkeys(_ARGUMENT.findall(entry)) if _SIMULATION.search(name)]
    return f"; pass {' or '.join(f'{name}:=true' for name in names)}" if names else ""
