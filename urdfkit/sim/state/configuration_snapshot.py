"""Snapshot: a copy of a robot's configuration, from which the poses of its links are computed later."""

from functools import cached_property
from typing import Any

import numpy as np

from urdfkit.kinematics import Kinematics
from urdfkit.linear_algebra import Array
from urdfkit.sim.engine import Engine
from urdfkit.sim.engine.articulation import Articulation
from urdfkit.sim.state.quaternion import product, rotate

Placement = tuple[tuple[float, float, float], tuple[float, float, float, float]]


class Snapshot:
    """Copy of the robot's configuration at one time; link poses are computed on first access.

    Args:
        kinematics: the robot's model.
        t: simulated time [s].
        engine: the physics engine.
        articulation: the engine's articulation of this robot; its coordinates are copied.

    Attributes:
        t: simulated time [s].
        coordinates: joint coordinates of the robot's bodies, in the order of the engine.
    """

    def __init__(self, kinematics: Kinematics, t: float, engine: Engine, articulation: Articulation) -> None:
        self._kinematics = kinematics
        self.t = t
        self._engine, self._articulation = engine, articulation
        self.coordinates: Array = articulation.coordinates.copy()
        self._poses: Array | None = None

    @cached_property
    def q(self) -> Array:
        """Configuration; shape (nq,)."""
        return self._articulation.configuration(self.coordinates)

    def __getstate__(self) -> dict[str, Any]:
        """Return the copy without the engine."""
        return {**vars(self), "q": self.q, "_poses": self.link_poses(), "_engine": None, "_articulation": None}

    def link_poses(self) -> Array:
        """Return x y z [m] and quaternion x y z w of every link in the world, read-only; shape (n_links, 7)."""
        if self._poses is None:
            self._poses = self._engine.link_poses(self._articulation, self.coordinates).copy()
            self._poses.flags.writeable = False
        return self._poses

    def placement(self, link: str | None, relative_to: str | None) -> Placement:
        """Return position [m] and quaternion x y z w of a link in another link's frame."""
        poses, names = self.link_poses(), self._kinematics.link_names
        child, parent = poses[names.index(link or "")], poses[names.index(relative_to or "")]
        inverse = np.array([-parent[3], -parent[4], -parent[5], parent[6]])
        return rotate(inverse, child[:3] - parent[:3]), product(inverse, child[3:])
