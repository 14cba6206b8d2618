"""RayRenderer: images of a scene with colour, depth and shape of each pixel, by ray casting."""

from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from urdfkit.linear_algebra import Array
from urdfkit.scene.camera_model import Lens, spread
from urdfkit.scene.lights import Lighting
from urdfkit.scene.rays.kernels import kernel
from urdfkit.scene.rays.ray_casting import SCRATCH
from urdfkit.scene.rays.ray_packet import FAR, WIDTH
from urdfkit.scene.rays.ray_scene import RayTable
from urdfkit.scene.rays.shading.materials import occluders_of, paint_of
from urdfkit.scene.rays.shading.shading_buffers import BUFFER_SIZE

ALIKE = 8
"""Largest difference between the channels of neighbouring pixels that is not an edge [of 255]."""

PART = 256 * WIDTH
"""Number of rays that a thread traces at once."""

MOST_RAYS = 4_000_000
"""Maximum number of rays that are cast at once for edge pixels."""


@dataclass(frozen=True, eq=False)
class Picture:
    """Image of a camera.

    Attributes:
        rgb: red, green, blue, 0..255; shape (height, width, 3).
        depth: distance along the camera's axis [m], infinite without a hit; shape (height, width).
        shapes: indices into `RayTable.shapes`, -1 without a hit; shape (height, width).
    """

    rgb: NDArray[np.uint8]
    depth: NDArray[np.float32]
    shapes: NDArray[np.int64]


class RayRenderer:
    """Renders images of the shapes of a table by ray casting.

    Args:
        table: the shapes; the caller places them.
        lighting: the lights.
        threads: number of threads that share the rays of an image; the image does not depend on it.

    Attributes:
        paint: materials of the shapes, see `paint_of`.
    """

    def __init__(self, table: RayTable, lighting: Lighting, *, threads: int = 1) -> None:
        self.table, self._threads = table, threads
        self._lights, self._air = lighting.lights, lighting.air
        self.paint, self._occluders = paint_of(table), occluders_of(table)

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
        """Render an image.

        Args:
            lens: the camera model.
            frame: placement of the camera, which looks along x; shape (4, 4).
            near: nearer surfaces are not seen [m].
            far: farther surfaces are not seen [m].
            samples: rays per edge pixel for its colour; depth and shape use one ray.
            deep: whether depth and shapes are needed; this renderer always computes them.
        """
        rgb, depths, hits = self._trace(lens, lens.directions, lens.order, frame, near, far)
        shape = (lens.height, lens.width)
        seen = rgb.reshape(*shape, 3)
        if samples > 1:
            self.smooth(seen, lens, frame, near=near, far=far, samples=samples)
        return Picture(seen, depths.astype(np.float32).reshape(shape), hits.reshape(shape))

    def smooth(
        self, rgb: NDArray[np.uint8], lens: Lens, frame: ArrayLike, *, near: float, far: float, samples: int
    ) -> None:
        """Replace the colours of the edge pixels of an image by the mean of several rays.

        Args:
            rgb: the image with one sample per pixel; shape (height, width, 3).
            lens: its camera model.
            frame: placement of the camera; shape (4, 4).
            near: nearer surfaces are not seen [m].
            far: farther surfaces are not seen [m].
            samples: rays per edge pixel.
        """
        found = np.empty(lens.width * lens.height, dtype=np.int64)
        ends = found[: kernel("outline")(rgb, ALIKE, found)]
        flat = rgb.reshape(-1, 3)
        for part in np.array_split(ends, len(ends) * samples // MOST_RAYS + 1):
            row, column = np.divmod(part, lens.width)
            at = np.column_stack([column, row])[:, None] + spread(samples)
            rays = lens.towards(at[..., 0].ravel(), at[..., 1].ravel())
            colors = self._trace(lens, rays, np.arange(len(rays)), frame, near, far)[0]
            flat[part] = np.rint(colors.reshape(-1, samples, 3).mean(axis=1))

    def _trace(
        self, lens: Lens, directions: Array, order: NDArray[np.int64], frame: ArrayLike, near: float, far: float
    ) -> tuple[NDArray[np.uint8], Array, NDArray[np.int64]]:
        """Return colours, depths along x and shapes for rays from the camera, sorted by `order`."""
        placed, count = np.asarray(frame, dtype=float), len(directions)
        rgb, depths = np.empty((count, 3), dtype=np.uint8), np.empty(count)
        hits = np.empty(count, dtype=np.int64)
        compiled = kernel("trace")
        camera = np.concatenate([placed[:3, :3].ravel(), placed[:3, 3], [1.0 / lens.focal_length]])

        def trace(first: int) -> None:
            part = slice(first, first + size)
            compiled(
                self.table.kernel_scene, self._occluders, self.paint, self._lights, self._air, camera, directions[part],
                order[part], float(near), float(min(far, FAR)), np.empty(SCRATCH), np.empty(BUFFER_SIZE), rgb, depths,
                hits,
            )  # fmt: skip

        if self._threads == 1:
            size = count
            trace(0)
        else:
            size = PART
            with ThreadPoolExecutor(self._threads) as pool:
                list(pool.map(trace, range(0, count, size)))
        return rgb, depths, hits
