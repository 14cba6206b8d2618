"""Casting rays at a scene: what lidars and cameras see, compiled, on one core and without a GPU.

::

    table = RayTable(scene, scene.with_role("collision"))
    table.place(poses)  # every time bodies have moved
    hits = table.cast((0, 0, 0.5), directions, far=10.0)

Two levels: a tree over the shapes, refitted when they move, and one per mesh, built once and kept on disk. Rays go
through them sixteen at a time (see `ray_packet`).
"""

from urdfkit.scene.rays.kernels import announcement, warmup
from urdfkit.scene.rays.ray_scene import Hits, RayTable

__all__ = ["Hits", "RayTable", "announcement", "warmup"]
