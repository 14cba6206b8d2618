"""The simulator: drives, sensors and controllers around the physics engine, publishing on a bus.

A robot, a world and commands go in; states, messages and recordings come out.

::

    from urdfkit.sim import Simulator

    simulator = Simulator("simpleton")
    simulator.subscribe("/simpleton/odom", "nav_msgs/msg/Odometry", print)
    simulator.command((0.5, 0.0, 0.0), (0.0, 0.0, 0.5))
    simulator.run(10.0)
    print(simulator.t, simulator.state.base_pose)
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from urdfkit.sim.construction.start_pose import Spawn
    from urdfkit.sim.plugins.base import Controller, Drive, Sensor
    from urdfkit.sim.simulator import Simulator
    from urdfkit.sim.state.robot_state import State

__all__ = ["Controller", "Drive", "Sensor", "Simulator", "Spawn", "State"]

_HOMES = {
    "Controller": "plugins.base",
    "Drive": "plugins.base",
    "Sensor": "plugins.base",
    "Simulator": "simulator",
    "Spawn": "construction.start_pose",
    "State": "state.robot_state",
}


def __getattr__(name: str) -> Any:
    """Import on first use: the engine takes a second."""
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_HOMES[name]}"), name)
