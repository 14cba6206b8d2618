"""Distances from a link to the static bodies of the world, in all worlds of a batch."""

from dataclasses import replace
from math import inf

import numpy as np
from numpy.typing import ArrayLike

from urdfkit.errors import UsageError
from urdfkit.linear_algebra import Array
from urdfkit.scene.rays import RayTable
from urdfkit.sim.scene_view import world_scene
from urdfkit.sim.simulator import Simulator


class RangeFinder:
    """Casts rays at the collision shapes of static bodies, which are the same in all worlds.

    Args:
        simulator: the simulation that is copied.
    """

    def __init__(self, simulator: Simulator) -> None:
        world = simulator.world.description
        static = tuple(model for model in world.models if model.static)
        scene, poses = world_scene(replace(world, models=static))
        self._table = RayTable(scene, scene.with_role("collision"))
        self._table.place(poses)

    def measure(self, placements: Array, directions: ArrayLike, far: float = inf) -> Array:
        """Return the distances along rays from the origins of frames [m]; shape (n, m).

        Args:
            placements: of the frames; shape (n, 4, 4).
            directions: of the rays in each frame; shape (m, 3).
            far: result without a nearer hit [m].

        Raises:
            UsageError: a direction is zero or not finite.
        """
        rays = np.asarray(directions, dtype=float).reshape(-1, 3)
        lengths = np.sqrt(np.einsum("mi,mi->m", rays, rays))
        if not (np.isfinite(lengths) & (lengths > 0)).all():
            raise UsageError("a direction of a ray is zero or not finite")
        turned = np.einsum("nij,mj->nmi", placements[:, :3, :3], rays / lengths[:, None])
        origins = np.repeat(placements[:, :3, 3], len(rays), axis=0)
        hits = self._table.cast(origins, turned.reshape(-1, 3), far=far)
        return np.asarray(np.minimum(hits.distances, far).reshape(len(placements), len(rays)))
