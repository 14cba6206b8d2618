"""Driving a robot next to its ideal."""

import math

import pytest

from urdfkit.sim import Simulator


class Driven:
    """A robot that was driven, and where a rigid body that obeys at once would be.

    Attributes:
        simulator: the simulation.
        ideal: x [m], y [m] and heading [rad] of that body.
    """

    def __init__(self, robot, *, world="empty"):
        self.simulator = Simulator(robot, world=world, note=lambda _: None)
        self.ideal = self.pose[:3]

    @property
    def pose(self):
        """Return x [m], y [m], heading [rad], z [m] and the sine of half the tilt of the root link."""
        x, y, z, qx, qy, qz, qw = self.simulator.link_poses()[0]
        return x, y, 2 * math.atan2(qz, qw), z, math.hypot(qx, qy)

    @property
    def odometry(self):
        """Return x [m], y [m] and heading [rad] as the first drive has it."""
        (x, y, _), (_, _, qz, qw) = next(iter(self.simulator.odometry().values()))
        return x, y, 2 * math.atan2(qz, qw)

    def drive(self, vx, w, *, vy=0.0, seconds, ramp=0.0):
        """Hold a command [m/s, rad/s] that is ramped up over `ramp` seconds from rest."""
        dt = self.simulator.dt
        x, y, yaw = self.ideal
        for step in range(round(seconds / dt)):
            f = min(1.0, (step + 0.5) * dt / ramp) if ramp else 1.0
            if step * dt < ramp + dt:
                self.simulator.command((f * vx, f * vy, 0), (0, 0, f * w))
                self.simulator.step()
            c, s = math.cos(yaw + f * w * dt / 2), math.sin(yaw + f * w * dt / 2)
            x += f * (vx * c - vy * s) * dt
            y += f * (vx * s + vy * c) * dt
            yaw += f * w * dt
        self.simulator.step(round(seconds / dt) - round(min(seconds, ramp + dt) / dt))
        self.ideal = (x, y, yaw)
        return self

    def off(self, other=None):
        """Return how far it is from `other`, its ideal pose when None: [m] and [rad]."""
        x, y, yaw = self.ideal if other is None else other
        at = self.pose
        return math.hypot(at[0] - x, at[1] - y), abs(math.remainder(at[2] - yaw, 2 * math.pi))


@pytest.fixture
def driven():
    """Return what makes a driven robot."""
    return Driven
