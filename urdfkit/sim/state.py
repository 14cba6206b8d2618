"""State: where the robot is and how it moves. Read only; what plugins, subscribers and users look at."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from urdfkit.kinematics import Kinematics
from urdfkit.sim.rotation import product, rotate

if TYPE_CHECKING:
    from urdfkit.sim.engine import Contact, Engine

Array = NDArray[np.float64]
Placement = tuple[tuple[float, float, float], tuple[float, float, float, float]]


class Snapshot:
    """The robot's configuration at one moment, kept.

    Args:
        kinematics: the robot's model.
        t: simulated time [s].
        q: configuration, copied.
        base: pose of the root link of a robot that is bolted down; None for one that floats.

    Attributes:
        t: simulated time [s].
        q: configuration; shape (nq,).
    """

    def __init__(self, kinematics: Kinematics, t: float, q: Array, base: Array | None) -> None:
        self._kinematics = kinematics
        self.t = t
        self.q = q.copy()
        self._base = base
        self._poses: Array | None = None

    def link_poses(self) -> Array:
        """Return x y z [m] and quaternion x y z w of every link in the world; shape (n_links, 7)."""
        if self._poses is None:
            self._poses = self._kinematics.link_poses(self.q)
            if self._base is not None:
                for row in self._poses:
                    row[:3] = self._base[:3] + rotate(self._base[3:], row[:3])
                    row[3:] = product(self._base[3:], row[3:])
        return self._poses

    def placement(self, link: str | None, relative_to: str | None) -> Placement:
        """Return position [m] and quaternion x y z w of a link in another link's frame."""
        poses, names = self.link_poses(), self._kinematics.link_names
        child, parent = poses[names.index(link or "")], poses[names.index(relative_to or "")]
        inverse = np.array([-parent[3], -parent[4], -parent[5], parent[6]])
        return rotate(inverse, child[:3] - parent[:3]), product(inverse, child[3:])


class State:
    """The simulation's present. Nobody can write to it.

    Args:
        kinematics: the robot's model.
        engine: what moves it.
        base: pose of the root link of a robot that is bolted down; None for one that floats.

    Attributes:
        step: steps since the start.
    """

    def __init__(self, kinematics: Kinematics, engine: Engine, base: Array | None) -> None:
        self._kinematics = kinematics
        self._engine = engine
        self._base = base
        self.step = 0
        names = (*kinematics.joint_names, *kinematics.mimic_names)
        self._index = {name: kinematics.velocity_index(name) for name in names}
        self._snapshot: Snapshot | None = None
        self._positions: list[float] | None = None

    def advance(self, steps: int) -> None:
        """Take note that the engine moved on by `steps`."""
        self.step += steps
        self._snapshot = self._positions = None

    @property
    def t(self) -> float:
        """Simulated time [s]."""
        return self.step * self._engine.dt

    @property
    def q(self) -> Array:
        """Configuration, in the order of `Kinematics`, read-only; shape (nq,)."""
        return self._engine.q

    @property
    def v(self) -> Array:
        """Velocity, a floating base's twist in its own axes and linear first, read-only; shape (nv,)."""
        return self._engine.v

    @property
    def tau(self) -> Array:
        """All effort of the last step but contacts and limits [N·m] or [N], read-only; shape (nv,)."""
        return self._engine.tau

    @property
    def contacts(self) -> tuple[Contact, ...]:
        """Where the robot touched something in the last step."""
        return self._engine.contacts()

    @property
    def energy(self) -> tuple[float, float]:
        """Kinetic and potential energy [J], the latter zero at the world's origin."""
        return self._engine.energy()

    def position(self, joint: str) -> float:
        """Return a joint's position [rad] or [m]; that of a continuous joint counts its turns."""
        if self._positions is None:
            self._positions = self._engine.positions.tolist()
        return self._positions[self._index[joint]]

    def velocity(self, joint: str) -> float:
        """Return a joint's velocity [rad/s] or [m/s]."""
        return float(self._engine.v[self._index[joint]])

    def effort(self, joint: str) -> float:
        """Return what the joint's motor, its servo and efforts beside them exerted in the last step [N·m] or [N]."""
        index = self._index[joint]
        return float(self._engine.effort[index] + self._engine.applied[index])

    @property
    def base_pose(self) -> tuple[float, ...]:
        """The root link in the world: x y z [m] and quaternion x y z w."""
        return tuple((self._engine.q[:7] if self._base is None else self._base).tolist())

    @property
    def base_velocity(self) -> tuple[float, ...]:
        """Velocity of the root link's origin [m/s] and its angular velocity [rad/s], along the world's axes."""
        if self._base is not None:
            return (0.0,) * 6
        rotation, v = self._engine.q[3:7], self._engine.v
        return (*rotate(rotation, v[:3]), *rotate(rotation, v[3:6]))

    def snapshot(self) -> Snapshot:
        """Return this moment, kept; the same object for everybody who asks before the next step."""
        if self._snapshot is None:
            self._snapshot = Snapshot(self._kinematics, self.t, self._engine.q, self._base)
        return self._snapshot

    def link_poses(self) -> Array:
        """Return x y z [m] and quaternion x y z w of every link in the world; shape (n_links, 7)."""
        return self.snapshot().link_poses()
