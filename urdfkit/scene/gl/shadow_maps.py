"""Shadow maps of directional lights."""

from collections.abc import Callable, Iterable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from urdfkit.linear_algebra import Array
from urdfkit.scene.gl.shaders import SHADOW_FRAGMENT, SHADOW_VERTEX
from urdfkit.scene.pose_matrices import upright
from urdfkit.scene.rays.ray_scene import RayTable

EDGES = {"s": 2048, "m": 1024}
"""Maximum number of texels along the edges of the map of static and of moving shapes."""

FINER = 2.0
"""Ratio of the resolutions of the map of moving shapes and the map of static shapes, if the size limit permits."""

LEAST = 128
"""Minimum number of texels along each edge."""

REST = 100
"""Number of images after which an unmoved shape counts as static again."""

INSTANCE = ("4f 4f 4f 3f 20x/i", "in_x", "in_y", "in_z", "in_scale")


class Shadows:
    """Shadow map of one directional light; drawn again only when a shape that casts shadows has moved.

    Args:
        context: the current context of moderngl.
        edge: maximum edge length of the map [texels].

    Attributes:
        texture: the map.
        lift: offset of surfaces from the map [m].
        texel: edge length of a texel [m].
    """

    def __init__(self, context: Any, edge: int) -> None:
        self._ctx = context
        self._most = edge
        self._maps: dict[int, tuple[Any, Any]] = {}
        self.lift = self.texel = 0.0
        self.texture, self._fbo = self._map(edge)
        self._program = context.program(SHADOW_VERTEX, SHADOW_FRAGMENT)
        self._key: bytes = b""
        self._from_world = np.eye(4)

    def _map(self, edge: int) -> tuple[Any, Any]:
        """Return a map with this edge length, and its framebuffer."""
        if edge not in self._maps:
            texture = self._ctx.depth_texture((edge, edge))
            texture.filter = self._ctx.NEAREST, self._ctx.NEAREST
            texture.compare_func = "<="
            texture.repeat_x = texture.repeat_y = False
            self._maps[edge] = texture, self._ctx.framebuffer(depth_attachment=texture)
        return self._maps[edge]

    def cast(
        self,
        towards: Array,
        table: RayTable,
        casters: NDArray[np.bool_],
        turn: Array,
        origin: Array,
        fill: Callable[[], Iterable[tuple[Any, int]]],
        *,
        texel: float = 0.0,
    ) -> None:
        """Update the map.

        Args:
            towards: unit vector towards the light in the world.
            table: the shapes, placed.
            casters: which shapes cast shadows.
            turn: rotation of the camera, in whose frame shapes are drawn; shape (3, 3).
            origin: position of the camera [m].
            fill: writes the instance data of the casters; yields each batch with its number of instances.
            texel: required size of a texel [m]; zero for the highest resolution.
        """
        key = towards.tobytes() + casters.tobytes() + table.frames[casters].tobytes()
        if key == self._key:
            return
        self._key = key
        axes = upright(towards).T  # its rows are the axes of the map in the world; the last points towards the light
        boxes = table.boxes[casters]
        if not len(boxes):
            self._fbo.clear(depth=1.0)
            return
        corners = np.stack([boxes[:, [3 * x, 3 * y + 1, 3 * z + 2]] for x in (0, 1) for y in (0, 1) for z in (0, 1)])
        seen = corners.reshape(-1, 3) @ axes.T
        low, high = seen.min(axis=0), seen.max(axis=0)
        span = np.maximum(high - low, 1e-3) * 1.01
        wide, edge = float(span[:2].max()), self._most
        while edge > LEAST and 2.0 * wide <= texel * edge:
            edge //= 2
        self.texture, self._fbo = self._map(edge)
        self._fbo.use()
        self._fbo.clear(depth=1.0)
        middle = (low + high) / 2
        self._from_world = np.eye(4)
        self._from_world[:3, :3] = axes * (2.0 / span * (1, 1, -1))[:, None]
        self._from_world[:3, 3] = -middle * (2.0 / span * (1, 1, -1))
        self.texel = wide / edge
        self.lift = 1.5 * self.texel
        self._program["u_light"] = _columns(self._of_camera(turn, origin))
        ctx = self._ctx
        ctx.enable_only(ctx.DEPTH_TEST)
        ctx.polygon_offset = 1.0, 1.0
        for batch, count in fill():
            array = batch.arrays.get(self)
            if array is None:
                array = batch.arrays[self] = ctx.vertex_array(
                    self._program, [(batch.vertices, "3f 36x", "in_position"), (batch.instances, *INSTANCE)]
                )
            array.render(instances=count)
        ctx.polygon_offset = 0.0, 0.0

    def _of_camera(self, turn: Array, origin: Array) -> Array:
        """Return the transform from the frame of the camera to the map, -1..1; shape (4, 4)."""
        placed = np.eye(4)
        placed[:3, :3], placed[:3, 3] = turn, origin
        found: Array = self._from_world @ placed
        return found

    def matrix(self, turn: Array, origin: Array) -> tuple[float, ...]:
        """Return the transform from the frame of the camera to texture coordinates, 0..1, in column-major order."""
        halves = np.diag([0.5, 0.5, 0.5, 1.0])
        halves[:3, 3] = 0.5
        return _columns(halves @ self._of_camera(turn, origin))


class Rest:
    """Detects moving shapes.

    Args:
        count: number of shapes.
    """

    def __init__(self, count: int) -> None:
        self._age = np.full(count, REST, dtype=np.int64)
        self._before: Array | None = None

    def moving(self, frames: Array, boxes: Array) -> NDArray[np.bool_]:
        """Return which shapes have moved recently; none if they are too far apart for a separate map.

        Args:
            frames: poses of the shapes; shape (shapes, 12).
            boxes: boxes of the shapes; shape (shapes, 6).
        """
        if self._before is not None:
            self._age = np.where((frames != self._before).any(axis=1), 0, self._age + 1)
        self._before = frames.copy()
        found: NDArray[np.bool_] = self._age < REST

        def spread(rows: Array) -> float:
            return float(np.linalg.norm(rows[:, 3:].max(axis=0) - rows[:, :3].min(axis=0)))

        if found.any() and spread(boxes[found]) * EDGES["s"] > spread(boxes) * EDGES["m"]:
            found = np.zeros_like(found)
        return found


def _columns(matrix: Array) -> tuple[float, ...]:
    return tuple(matrix.T.ravel().tolist())
