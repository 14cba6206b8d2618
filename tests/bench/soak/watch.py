"""Who watches: what must hold at every look, and at every check."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from soak.found import Found
from soak.walls import Walls, matrix
from urdfkit.scene import lowest_point
from urdfkit.sim import Simulator
from urdfkit.sim.engine import FreeBody

Array = NDArray[np.float64]

LOOK = 0.05
"""Seconds between looks at walls and speeds; all else is looked at once a second."""
SUNK = 0.01
"""How far a robot or body may be below the floor [m]."""
DEEP = 0.005
"""How deep a contact may be [m]."""
GLANCES = ((1.0, 10), (5.0, 50))
"""Speeds [m/s] from which on ways are looked at so often in a look: what whips round a door's jamb takes no chord."""
BEYOND_LIMIT = 1e-3
"""How far a joint may be beyond its limit [rad or m]."""
OFF_UNIT = 1e-9
"""How far the norm of a quaternion may be from one."""
ROOM = 3.0
"""How far from the walls a robot is called back, and a body has escaped [m]."""
TIPPED = 0.5
"""Cosine of the tilt from which on a robot lies on its side."""
RESTS = 0.1
"""Speed [m/s, rad/s] of its base and joints below which a robot rests.

One that is told to may not: the wheels of Gazebo's drives with an acceleration limit wind up where they slip.
"""
STIRRED = 1e-3
"""How much energy all bodies may gain in a look while the robot rests [J]."""
GRAVITY = 9.81
"""Of the world [m/s²]."""


class Watch:
    """Looks at a simulation and takes down what does not hold."""

    def __init__(self, simulator: Simulator, found: Found) -> None:
        self.simulator = simulator
        self.found = found
        self.walls = Walls(simulator)
        # The middle of several shapes, such as the pads of a foot, may be in a board that the foot stands astride.
        indices = {name: i for i, name in enumerate(simulator.kinematics.link_names)}
        shapes = [shape for shape in simulator.scene.with_role("collision") if shape.body in indices]
        self._solid = [indices[shape.body] for shape in shapes]
        self._centres = np.array([[*shape.placement[:3, 3], 1.0] for shape in shapes])
        self.begin()

    def begin(self) -> None:
        """Forget where everything was."""
        self._before = self._seen = self._points()
        self.glances = 1
        self._energy = math.inf
        self._place = np.array(self.simulator.state.base_pose[:3])
        self._speed = 1.0

    def look(self, *, quiet: bool) -> None:
        """Look at what can be over within a second: ways through walls, and speeds.

        Args:
            quiet: nothing has been commanded for a while, so that nothing may speed up once the robot rests.
        """
        simulator, found = self.simulator, self.found
        t = simulator.t
        quiet = quiet and float(np.abs(simulator.state.v).max(initial=0.0)) < RESTS
        now = self._points()
        if not np.isfinite(now).all():
            found.fault("not finite", t, "a pose is not finite")
            return
        self.glance(now)
        links = len(self._solid)
        moved = np.linalg.norm(now - self._before, axis=1) / LOOK
        self._speed = max(0.9 * self._speed, 1.0, 2.0 * float(moved[:links].max(initial=0.0)))
        self._before = now
        self.glances = max([number for speed, number in GLANCES if moved.max(initial=0.0) > speed], default=1)
        energy = 0.0
        for name, body in simulator.world.bodies.items():
            speed, its = _motion(body)
            energy += its
            found.fastest = max(found.fastest, speed)
            if speed > 2.0 * self._speed + 5.0:  # a fall from a table is 4 m/s
                found.fault("too fast", t, f"{name} at {speed:.1f} m/s, the robot at {self._speed / 2:.1f} m/s at most")
        if quiet and energy > self._energy + STIRRED:
            found.fault("energy from nothing", t, f"the bodies gained {energy - self._energy:.3g} J while all rested")
        self._energy = energy if quiet else math.inf
        place = np.array(simulator.state.base_pose[:3])
        found.travelled += float(np.linalg.norm(place - self._place))
        self._place = place

    def glance(self, now: Array | None = None) -> None:
        """Look at the ways of all middles since the last glance, which are now at `now` (n, 3), as asked if None."""
        now = self._points() if now is None else now
        if np.array_equal(now, self._seen):
            return
        names = [self.simulator.kinematics.link_names[i] for i in self._solid] + list(self.simulator.world.bodies)
        for point, wall in self.walls.crossed(self._seen, now):
            text = f"{names[point]} through {self.walls.names[wall]} at {now[point].round(3)}"
            self.found.fault("through a wall", self.simulator.t, text)
        self._seen = now

    def check(self) -> None:
        """Look at everything else."""
        simulator, found = self.simulator, self.found
        t, state, kinematics = simulator.t, simulator.state, simulator.kinematics
        if not (np.isfinite(state.q).all() and np.isfinite(state.v).all()):
            found.fault("not finite", t, "q or v")
            return
        lowest = lowest_point(simulator.scene, state.link_poses())
        if lowest is not None and lowest < -SUNK:
            found.fault("below the floor", t, f"the robot by {-1000 * lowest:.1f} mm")
        low, high = self.walls.low - ROOM, self.walls.high + ROOM
        for name, body in simulator.world.bodies.items():
            x, y, z = body.pose[:3]
            if not (low[0] < x < high[0] and low[1] < y < high[1] and -SUNK - 1.0 < z < 5.0):
                found.fault("escaped", t, f"{name} is at {x:.2f} {y:.2f} {z:.2f}")
            if abs(math.hypot(*body.pose[3:]) - 1.0) > OFF_UNIT:
                found.fault("quaternion", t, name)
        if kinematics.floating_base and abs(float(np.linalg.norm(state.q[3:7])) - 1.0) > OFF_UNIT:
            found.fault("quaternion", t, "of the root link")
        for contact in state.contacts:
            found.deepest = max(found.deepest, contact.depth)
            if contact.depth > DEEP:
                pair = f"{contact.a} {1000 * contact.depth:.1f} mm in {contact.b}"
                found.fault("deep", t, pair)
        if any(
            contact.a in kinematics.link_names and contact.b in simulator.world.body_poses()
            for contact in state.contacts
        ):
            found.touched += 1
        for name in kinematics.joint_names:
            lower, upper = kinematics.limits(name)
            if not lower - BEYOND_LIMIT <= state.position(name) <= upper + BEYOND_LIMIT:
                found.fault("beyond a limit", t, f"{name} at {state.position(name):.4f}")
        for name, coupling in kinematics.couplings.items():
            if coupling.master is not None:
                follows = coupling.multiplier * state.position(coupling.master) + coupling.offset
                if abs(state.position(name) - follows) > BEYOND_LIMIT:
                    found.fault("mimic", t, name)

    def is_lost(self, *, may_lie: bool) -> bool:
        """Whether a driver would put the robot back: it left, or lies on its side and may not."""
        if not self.simulator.kinematics.floating_base:
            return False
        x, y, _, qx, qy, _, _ = self.simulator.state.base_pose
        upright = 1.0 - 2.0 * (qx * qx + qy * qy)
        outside = not (
            self.walls.low[0] - ROOM < x < self.walls.high[0] + ROOM
            and self.walls.low[1] - ROOM < y < self.walls.high[1] + ROOM
        )
        return outside or (upright < TIPPED and not may_lie)

    def _points(self) -> Array:
        """Return the middles of the robot's shapes that can touch something, then those of bodies; shape (n, 3)."""
        poses = self.simulator.link_poses()
        points = [(matrix(poses[i]) @ centre)[:3] for i, centre in zip(self._solid, self._centres, strict=True)]
        for body in self.simulator.world.bodies.values():
            points.append((matrix(body.pose) @ np.array([*body.body.centre, 1.0]))[:3])
        return np.array(points)


def _motion(body: FreeBody) -> tuple[float, float]:
    """Return the speed of a body's middle [m/s] and its energy [J], at rest on the floor's height zero."""
    R = matrix(body.pose)[:3, :3]
    arm = R @ np.array(body.body.centre)
    linear, angular = np.array(body.twist[:3]), np.array(body.twist[3:])
    v = linear + np.cross(angular, arm)
    turn = R.T @ angular
    kinetic = 0.5 * body.body.mass * float(v @ v) + 0.5 * float(turn @ np.array(body.body.inertia) @ turn)
    return float(np.linalg.norm(v)), kinetic + body.body.mass * GRAVITY * (body.pose[2] + float(arm[2]))
