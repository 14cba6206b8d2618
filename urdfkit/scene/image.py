"""Pictures of a scene: colour, depth and which shape, by casting a ray per pixel and one per light."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from urdfkit.scene.lens import Lens, spread
from urdfkit.scene.lights import Lighting
from urdfkit.scene.rays.cast import SCRATCH
from urdfkit.scene.rays.kernels import looker
from urdfkit.scene.rays.packet import FAR
from urdfkit.scene.rays.paint import cover_of, paint_of
from urdfkit.scene.rays.picture import DESK
from urdfkit.scene.rays.table import RayTable

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
    """

    def __init__(self, table: RayTable, lighting: Lighting) -> None:
        self.table = table
        self._lights, self._air = lighting.lights, lighting.air
        self._paint, self._cover = paint_of(table), cover_of(table)

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
        pixel = 1.0 / lens.focal_length
        rgb, depths, hits = self._look(lens.directions, frame, near, far, pixel)
        if samples > 1:
            self._smooth(lens, rgb, hits, samples, lambda rays: self._look(rays, frame, near, far, pixel)[0])
        shape = (lens.height, lens.width)
        seen, depth, known = np.empty_like(rgb), np.empty(len(rgb), dtype=np.float32), np.empty_like(hits)
        seen[lens.order], depth[lens.order], known[lens.order] = rgb, depths, hits
        return Picture(seen.reshape(*shape, 3), depth.reshape(shape), known.reshape(shape))

    def _look(
        self, directions: Array, frame: ArrayLike, near: float, far: float, pixel: float
    ) -> tuple[NDArray[np.uint8], Array, NDArray[np.int64]]:
        """Return colours, depths along x and shapes for rays from the camera; a pixel is so wide at 1 m."""
        placed, count = np.asarray(frame, dtype=float), len(directions)
        rgb, depths = np.empty((count, 3), dtype=np.uint8), np.empty(count)
        hits = np.empty(count, dtype=np.int64)
        looker()(
            self.table.kernel_scene, self._cover, self._paint, self._lights, self._air,
            np.concatenate([placed[:3, :3].ravel(), placed[:3, 3], [pixel]]), directions, float(near),
            float(min(far, FAR)), np.empty(SCRATCH), np.empty(DESK), rgb, depths, hits,
        )  # fmt: skip
        return rgb, depths, hits

    def _smooth(
        self,
        lens: Lens,
        rgb: NDArray[np.uint8],
        hits: NDArray[np.int64],
        samples: int,
        look: Callable[[Array], NDArray[np.uint8]],
    ) -> None:
        """Give the pixels at edges the mean of several rays."""
        shape = (lens.height, lens.width)
        colors, known = np.empty(rgb.shape, dtype=np.int16), np.empty_like(hits)
        colors[lens.order], known[lens.order] = rgb, hits
        edge = edges(colors.reshape(*shape, 3), known.reshape(shape)).ravel()[lens.order]
        row, column = np.divmod(lens.order[edge], lens.width)
        for part in np.array_split(np.arange(len(row)), len(row) * samples // MOST_RAYS + 1):
            at = np.column_stack([column[part], row[part]])[:, None] + spread(samples)
            rays = lens.towards(at[..., 0].ravel(), at[..., 1].ravel())
            rgb[np.flatnonzero(edge)[part]] = np.rint(look(rays).reshape(-1, samples, 3).mean(axis=1))


def edges(colors: NDArray[np.int16], shapes: NDArray[np.int64]) -> NDArray[np.bool_]:
    """Return which pixels differ from one beside, above or below; shape (height, width).

    Args:
        colors: 0..255; shape (height, width, 3).
        shapes: shape (height, width).
    """
    found = np.zeros(shapes.shape, dtype=bool)
    for axis in (0, 1):
        differs = (np.diff(shapes, axis=axis) != 0) | (np.abs(np.diff(colors, axis=axis)).max(axis=2) > ALIKE)
        first = (slice(None), slice(-1)) if axis else (slice(-1),)
        second = (slice(None), slice(1, None)) if axis else (slice(1, None),)
        found[first] |= differs
        found[second] |= differs
    return found
