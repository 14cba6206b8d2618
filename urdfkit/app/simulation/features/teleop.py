"""Teleop: the robots that can be driven, and the keys."""

from collections.abc import Sequence
from typing import Any

from urdfkit.messages import TWIST, TWIST_STAMPED, header, message_type, twist
from urdfkit.sim.simulator import Simulator
from urdfkit.sim.world.simulated_robot import SimulatedRobot


def drive_controls(simulator: Simulator) -> dict[str, Any]:
    """Return the controls of the page: robots that accept commands, key tables and initial speeds."""
    robots = [
        {"name": name, "drives": bool(command_topics(robot))}
        for name, robot in simulator.world.robots.items()
        if robot.has_plugins or name == simulator.name
    ]
    return controls_of(robots)


def controls_of(robots: Sequence[dict[str, Any]]) -> dict[str, Any]:
    """Return the controls of the page for robots with their names, and whether they accept commands."""
    from urdfkit.teleop import HELD_LAYOUT, HELD_SPEEDS, Teleop

    start = Teleop()
    return {
        "drives": any(robot["drives"] for robot in robots),
        "robots": robots,
        "moves": HELD_LAYOUT,
        "factors": HELD_SPEEDS,
        "speed": start.speed,
        "turn": start.turn,
    }


def command_topics(robot: SimulatedRobot) -> dict[str, str]:
    """Return topic → type of the velocity commands of a robot's drives and running controllers."""
    topics = {topic: TWIST for drive in robot.plugins.drives for topic in drive.commands}
    return {**topics, **robot.controllers.command_topics}


def command(simulator: Simulator, robot: SimulatedRobot, linear: Sequence[float], angular: Sequence[float]) -> None:
    """Publish a velocity command [m/s, rad/s] to every drive and controller of a robot."""
    for topic, kind in command_topics(robot).items():
        message = twist(linear, angular)
        if kind == TWIST_STAMPED:
            message = message_type(TWIST_STAMPED)(header(simulator.t, ""), message)
        simulator.bus.publish(topic, kind, message)
