"""Pictures of a scene: colour, depth and which shape, by casting a ray per pixel and one per light."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from urdfkit.scene.lens import Lens
from urdfkit.scene.lights import Lighting
from urdfkit.scene.rays.cast import SCRATCH
from urdfkit.scene.rays.kernels import looker
from urdfkit.scene.rays.packet import FAR
from urdfkit.scene.rays.picture import DESK
from urdfkit.scene.rays.table import RayTable


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
        colors = np.array([shape.rgba[:3] for shape in table.shapes], dtype=float).reshape(-1, 3)
        tinted = [s.mesh is not None and s.mesh.colors is not None and not s.has_color for s in table.shapes]
        self._paint = colors, np.array(tinted, dtype=np.int64), table.tints()

    def take(self, lens: Lens, frame: ArrayLike, *, near: float = 0.0, far: float = np.inf) -> Picture:
        """Return a picture.

        Args:
            lens: what it is taken with.
            frame: placement of the camera, which looks along x; shape (4, 4).
            near: what is nearer is not seen [m].
            far: what is farther is not seen [m].
        """
        placed = np.asarray(frame, dtype=float)
        count = lens.width * lens.height
        rgb, depths = np.empty((count, 3), dtype=np.uint8), np.empty(count)
        hits = np.empty(count, dtype=np.int64)
        looker()(
            self.table.kernel_scene, self._paint, self._lights, self._air,
            np.concatenate([placed[:3, :3].ravel(), placed[:3, 3]]), lens.directions, float(near),
            float(min(far, FAR)), np.empty(SCRATCH), np.empty(DESK), rgb, depths, hits,
        )  # fmt: skip
        shape = (lens.height, lens.width)
        seen, deep, known = np.empty_like(rgb), np.empty(count, dtype=np.float32), np.empty_like(hits)
        seen[lens.order], deep[lens.order], known[lens.order] = rgb, depths, hits
        return Picture(seen.reshape(*shape, 3), deep.reshape(shape), known.reshape(shape))
