"""Shadow maps: how far a sun's light gets, seen from the sun."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from urdfkit.scene.gl.shaders import SHADOW_FRAGMENT, SHADOW_VERTEX
from urdfkit.scene.placement import upright
from urdfkit.scene.rays.ray_scene import RayTable

Array = NDArray[np.float64]

EDGES = {"s": 2048, "m": 1024}
"""Texels along each edge of the map of what stands still, and of what moves, at most."""

FINER = 2.0
"""How much finer the map of what moves is than the other, where it need not have the most texels for that."""

LEAST = 128
"""Texels along each edge at least."""

REST = 100
"""Pictures after which what has not moved counts as standing still again."""

INSTANCE = ("4f 4f 4f 3f 20x/i", "in_x", "in_y", "in_z", "in_scale")


class Shadows:
    """The map of one sun; drawn anew only when what casts shadows has moved.

    Args:
        context: of moderngl, current.
        edge: of the map [texels], at most.

    Attributes:
        texture: the map.
        lift: how far surfaces are to be lifted off it [m].
        texel: length of its edge [m].
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
        """Return the map of so many texels along each edge, and what draws into it."""
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
        """Bring the map up to date.

        Args:
            towards: the sun; unit vector in the world.
            table: the shapes, placed.
            casters: which of them cast shadows.
            turn: of the camera, in whose frame shapes are drawn; shape (3, 3).
            origin: of the camera [m].
            fill: writes where the casters are, batch by batch; yields each with how often it is to be drawn.
            texel: fine enough for its texels [m]; zero for as fine as can be.
        """
        key = towards.tobytes() + casters.tobytes() + table.frames[casters].tobytes()
        if key == self._key:
            return
        self._key = key
        axes = upright(towards).T  # its rows are the map's axes in the world; the last looks at the sun
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
        """Return what takes the camera's frame to the map's, -1..1; shape (4, 4)."""
        placed = np.eye(4)
        placed[:3, :3], placed[:3, 3] = turn, origin
        found: Array = self._from_world @ placed
        return found

    def matrix(self, turn: Array, origin: Array) -> tuple[float, ...]:
        """Return what takes the camera's frame to places on the map, 0..1, column by column."""
        halves = np.diag([0.5, 0.5, 0.5, 1.0])
        halves[:3, 3] = 0.5
        return _columns(halves @ self._of_camera(turn, origin))


class Rest:
    """Knows which shapes move.

    Args:
        count: of shapes.
    """

    def __init__(self, count: int) -> None:
        self._age = np.full(count, REST, dtype=np.int64)
        self._before: Array | None = None

    def moving(self, frames: Array, boxes: Array) -> NDArray[np.bool_]:
        """Return which shapes have moved of late; none where they are spread too wide for a map of their own.

        Args:
            frames: where they are; shape (shapes, 12).
            boxes: that hold them; shape (shapes, 6).
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
