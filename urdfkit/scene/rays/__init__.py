"""Ray casting for lidars and cameras, compiled, on one core and without a GPU.

::

    table = RayTable(scene, scene.with_role("collision"))
    table.place(poses)  # after bodies have moved
    hits = table.cast((0, 0, 0.5), directions, far=10.0)

There are two levels of trees: one over the shapes, which is refitted when they move, and one per mesh, which is built
once and cached on disk. Rays traverse them in packets of sixteen (see `ray_packet`).
"""

from urdfkit.scene.rays.kernels import announcement, cached, warmup
from urdfkit.scene.rays.ray_scene import Hits, RayTable

__all__ = ["Hits", "RayTable", "announcement", "cached", "warmup"]
