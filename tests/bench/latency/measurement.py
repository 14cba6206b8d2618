"""The measurement, with the standard library only: a node of ROS 2 runs it in another environment."""

from __future__ import annotations

import random
import time
from typing import Protocol

SPEEDS = (0.5, 0.2)
"""Commanded in turn [m/s]; the odometry of encoders has no sign, as in Gazebo."""

CHANGE = 0.01
"""Change of the velocity that shows a command [m/s]; the wheels accelerate by twice as much in one step."""


class Client(Protocol):
    """A client that drives the robot and receives its odometry and images."""

    def command(self, x: float) -> None:
        """Publish a forward velocity [m/s]."""

    def receive(self) -> tuple[str, float]:
        """Return ``odometry`` and its velocity [m/s], or ``image`` and zero."""
        ...


def measured(client: Client, commands: int) -> tuple[list[float], float]:
    """Drive quickly and slowly in turn; return the times to the odometry [ms] and the images per second."""
    for _ in range(30):
        client.receive()
    times: list[float] = []
    pauses = random.Random(1)
    begin, images, speed = time.perf_counter(), 0, 0.0
    while len(times) < commands:
        rest = time.perf_counter() + pauses.uniform(0.05, 0.15)
        while time.perf_counter() < rest:
            kind, x = client.receive()
            images += kind == "image"
            speed = x if kind == "odometry" else speed
        wanted = SPEEDS[len(times) % 2]
        sent = time.perf_counter()
        client.command(wanted)
        while True:
            kind, x = client.receive()
            images += kind == "image"
            if kind == "odometry" and abs(x - wanted) < abs(speed - wanted) - CHANGE:
                break
        times.append((time.perf_counter() - sent) * 1e3)
    return times, images / (time.perf_counter() - begin)
