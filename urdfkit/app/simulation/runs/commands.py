"""Commands of a run: velocity ramps, joint targets, and messages at given times."""

from __future__ import annotations

from math import ceil
from typing import TYPE_CHECKING, NamedTuple

from urdfkit.errors import SimulationError, UsageError

if TYPE_CHECKING:
    from urdfkit.sim.simulator import Simulator

COMMAND_PERIOD = 0.1
"""Simulated seconds between velocity commands to controllers, whose commands time out."""


class TopicMessage(NamedTuple):
    """``TOPIC TYPE YAML@T``: the message, its topic, and the time to publish it [s]."""

    topic: str
    type: str
    text: str
    t: float


def ramp(simulator: Simulator, command: tuple[float, float, float], seconds: float) -> None:
    """Publish a velocity command that increases linearly from zero.

    The command is published once per update of the drives, each time with the mean of the ramp until the next update:
    the commands that the drives hold add up to exactly the ramp. Controllers time out after about half a second, so
    they receive the final command ten times a second.

    Args:
        simulator: not yet advanced.
        command: VX, VY [m/s], WZ [rad/s].
        seconds: duration of the ramp.

    Raises:
        SimulationError: the robot has no drive.
    """
    vx, vy, wz = command
    period = simulator.command_period
    for i in range(ceil(seconds / period - 1e-9) + 1):
        begin, end = i * period, (i + 1) * period
        part = 1.0
        if begin < seconds:
            risen = (min(end, seconds) ** 2 - begin**2) / 2 / seconds
            part = (risen + max(0.0, end - seconds)) / period
        linear, angular = (part * vx, part * vy, 0.0), (0.0, 0.0, part * wz)
        simulator.at(begin, lambda linear=linear, angular=angular: simulator.command(linear, angular))  # type: ignore[misc]
    if simulator.controllers.command_topics:
        simulator.every(
            COMMAND_PERIOD, lambda: simulator.command((vx, vy, 0.0), (0.0, 0.0, wz)), start=seconds + COMMAND_PERIOD
        )
    if not simulator.command_topics:
        simulator.command((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))  # raises


def require_free(simulator: Simulator, joint: str) -> None:
    """Reject a target for a joint that a controller commands in every step.

    Raises:
        SimulationError: a running controller claims the joint.
    """
    for one in simulator.controllers.list():
        if one.state in ("running", "active") and any(claim.split("/")[0] == joint for claim in one.claims):
            raise SimulationError(
                f"--joint-target {joint}: controller `{one.name}` commands this joint; publish to it with --topic-pub"
            )


def publish_at(simulator: Simulator, wanted: TopicMessage, *, others_may_subscribe: bool = False) -> None:
    """Schedule one message.

    Args:
        simulator: not yet advanced.
        wanted: the message.
        others_may_subscribe: whether a recording or programs on a bridge may subscribe to the topic later; a topic
            without subscribers is then a warning.

    Raises:
        UsageError: the type or a field is unknown, the topic has another type, or it has no subscribers.
    """
    import yaml

    from urdfkit.bus import absolute, similar_topic
    from urdfkit.messages import from_fields, full_type_name

    try:
        fields = yaml.safe_load(wanted.text)
    except yaml.YAMLError as error:
        raise UsageError(
            f"--topic-pub {wanted.topic}: `{wanted.text}` is not YAML ({str(error).splitlines()[0]})"
        ) from None
    kind = full_type_name(wanted.type)
    message = from_fields(kind, fields)
    subscribed = [topic.name for topic in simulator.bus.topics if topic.subscribers]
    simulator.bus.advertise(wanted.topic, kind)
    if absolute(wanted.topic) not in subscribed:
        own = sorted(topic for topic in subscribed if not topic.startswith(("/gazebo/", "/world/")))
        others = f" (topics with subscribers: {', '.join(own)})" if own else ""
        near = similar_topic(absolute(wanted.topic), subscribed) or others
        if not others_may_subscribe:
            raise UsageError(f"--topic-pub: {absolute(wanted.topic)} has no subscribers{near}")
        simulator.note(f"{absolute(wanted.topic)} has no subscribers{near}")
    simulator.at(wanted.t, lambda: simulator.bus.publish(wanted.topic, kind, message))
