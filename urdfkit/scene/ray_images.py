"""Pictures of a scene: colour, depth and which shape, by casting a ray per pixel and one per light."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from urdfkit.scene.camera_model import Lens, spread
from urdfkit.scene.lights import Lighting
from urdfkit.scene.rays.kernels import looker, outliner
from urdfkit.scene.rays.ray_casting import SCRATCH
from urdfkit.scene.rays.ray_packet import FAR
from urdfkit.scene.rays.ray_scene import RayTable
from urdfkit.scene.rays.shading.materials import cover_of, paint_of
from urdfkit.scene.rays.shading.shading_buffers import DESK

Array = NDArray[np.float64]

ALIKE = 8
"""Neighbouring pixels whose channels differ by no more are no edge [of 255]."""

MOST_RAYS = 4_000_000
"""Rays of edges that are cast at once."""


@dataclass(frozen=True, eq=False)
class Picture:
    """What a camera saw.

    Attributes:
        rgb: red, green, blue, 0..255; shape (height, width, 3).
        depth: distance along the camera's axis [m], infinite where nothing is; shape (height, width).
        shapes: indices into `RayTable.shapes`, -1 where nothing is; shape (height, width).
    """

    rgb: NDArray[np.uint8]
    depth: NDArray[np.float32]
    shapes: NDArray[np.int64]


class Painter:
    """Takes pictures of what is in a table of shapes.

    Args:
        table: the shapes; placed by whoever holds it.
        lighting: what shines.

    Attributes:
        paint: what the shapes look like, see `paint_of`.
    """

    def __init__(self, table: RayTable, lighting: Lighting) -> None:
        self.table = table
        self._lights, self._air = lighting.lights, lighting.air
        self.paint, self._cover = paint_of(table), cover_of(table)

    def take(
        self,
        lens: Lens,
        frame: ArrayLike,
        *,
        near: float = 0.0,
        far: float = np.inf,
        samples: int = 1,
        deep: bool = True,
    ) -> Picture:
        """Return a picture.

        Args:
            lens: what it is taken with.
            frame: placement of the camera, which looks along x; shape (4, 4).
            near: what is nearer is not seen [m].
            far: what is farther is not seen [m].
            samples: rays for the colour of each pixel in which something ends; depths and shapes are of one ray.
            deep: whether depths and shapes are wanted; here they come anyway.
        """
        rgb, depths, hits = self._look(lens, lens.directions, lens.order, frame, near, far)
        shape = (lens.height, lens.width)
        seen = rgb.reshape(*shape, 3)
        if samples > 1:
            self.smooth(seen, lens, frame, near=near, far=far, samples=samples)
        return Picture(seen, depths.astype(np.float32).reshape(shape), hits.reshape(shape))

    def smooth(
        self, rgb: NDArray[np.uint8], lens: Lens, frame: ArrayLike, *, near: float, far: float, samples: int
    ) -> None:
        """Give the pixels of a picture in which something ends the mean of several rays.

        Args:
            rgb: the picture, of one sample per pixel; shape (height, width, 3).
            lens: what it was taken with.
            frame: placement of the camera; shape (4, 4).
            near: what is nearer is not seen [m].
            far: what is farther is not seen [m].
            samples: rays for each of the pixels.
        """
        found = np.empty(lens.width * lens.height, dtype=np.int64)
        ends = found[: outliner()(rgb, ALIKE, found)]
        flat = rgb.reshape(-1, 3)
        for part in np.array_split(ends, len(ends) * samples // MOST_RAYS + 1):
            row, column = np.divmod(part, lens.width)
            at = np.column_stack([column, row])[:, None] + spread(samples)
            rays = lens.towards(at[..., 0].ravel(), at[..., 1].ravel())
            colors = self._look(lens, rays, np.arange(len(rays)), frame, near, far)[0]
            flat[part] = np.rint(colors.reshape(-1, samples, 3).mean(axis=1))

    def _look(
        self, lens: Lens, directions: Array, order: NDArray[np.int64], frame: ArrayLike, near: float, far: float
    ) -> tuple[NDArray[np.uint8], Array, NDArray[np.int64]]:
        """Return colours, depths along x and shapes for rays from the camera, each in its place in an order."""
        placed, count = np.asarray(frame, dtype=float), len(directions)
        rgb, depths = np.empty((count, 3), dtype=np.uint8), np.empty(count)
        hits = np.empty(count, dtype=np.int64)
        looker()(
            self.table.kernel_scene, self._cover, self.paint, self._lights, self._air,
            np.concatenate([placed[:3, :3].ravel(), placed[:3, 3], [1.0 / lens.focal_length]]), directions, order,
            float(near), float(min(far, FAR)), np.empty(SCRATCH), np.empty(DESK), rgb, depths, hits,
        )  # fmt: skip
        return rgb, depths, hits
