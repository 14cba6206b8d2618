"""Draw calls for the shapes of a table: buffers on the device, and the drawing order."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from urdfkit.linear_algebra import Array
from urdfkit.scene.gl.shaders import COLOR, Lamps, ShaderKind, fragment_shader, vertex_shader
from urdfkit.scene.gl.triangle_models import TriangleModel, models_of
from urdfkit.scene.rays.ray_scene import RayTable

Rows = NDArray[np.float32]
Numbers = NDArray[np.int64]
Mask = NDArray[np.bool_]

VERTEX = ("3f 3f 2f 4f", "in_position", "in_normal", "in_uv", "in_color")
INSTANCE = ("4f 4f 4f 3f 4f 1f/i", "in_x", "in_y", "in_z", "in_scale", "in_rgba", "in_shape")
ROW = 20
"""Number of values per instance."""


@dataclass(eq=False)
class TriangleBatch:
    """Triangles on the device, and the shapes that use them.

    Attributes:
        model: the triangles.
        holed: whether some triangles are transparent, independent of the opacity of the shape.
        vertices: vertex buffer.
        instances: instance buffer with the poses, written before drawing.
        arrays: vertex arrays of the programs.
    """

    model: TriangleModel
    holed: bool
    vertices: Any
    instances: Any
    arrays: dict[Any, Any] = field(default_factory=dict)

    def members(self, wanted: Mask) -> Numbers:
        """Return which of these shapes the batch draws."""
        found: Numbers = self.model.shapes[wanted[self.model.shapes]]
        return found


@dataclass(frozen=True, eq=False)
class Shot:
    """State of the drawing of one image.

    Attributes:
        rows: `ROW` numbers of each shape, in the camera's frame; shape (shapes, `ROW`).
        nearest: minimum distance of each shape [m]; shape (shapes,).
        outside: whether the camera and its near plane are outside of each shape; shape (shapes,).
        exact: whether surfaces are clipped by their distance.
        uniforms: uniforms of the shaders.
    """

    rows: Rows
    nearest: Array
    outside: Mask
    exact: bool
    uniforms: dict[str, Any]


class Drawing:
    """Draws the shapes of a table.

    Args:
        context: the current context of moderngl.
        table: the shapes.
        paint: materials of the shapes, see `paint_of`.
        lamps: the lights.

    Attributes:
        batches: the batches.
        clear: which shapes are transparent; shape (shapes,).
        maps: the shadow maps in use.
    """

    def __init__(self, context: Any, table: RayTable, paint: tuple[Any, ...], lamps: Lamps) -> None:
        self._ctx = context
        self._lamps = lamps
        self._programs: dict[ShaderKind, tuple[Any, frozenset[str]]] = {}
        colors, _, _, _, textures, texels = paint
        self.clear: Mask = colors[:, 3] < 1.0
        self.maps: tuple[str, ...] = ()
        self._textures, holed = [], []
        for start, width, height in textures.tolist():
            texture = context.texture((width, height), 4, texels[start : start + 4 * width * height].tobytes())
            content, level = texels[start : start + 4 * width * height], 0
            texture.build_mipmaps()  # allocates them
            while width > 1 or height > 1:
                start += 4 * width * height
                width, height, level = max(width // 2, 1), max(height // 2, 1), level + 1
                texture.write(texels[start : start + 4 * width * height].tobytes(), level=level)
            texture.filter = context.LINEAR_MIPMAP_LINEAR, context.LINEAR
            self._textures.append(texture)
            holed.append(bool((content[3::4] < 255).any()))
        self.batches = [
            TriangleBatch(
                model,
                bool((model.vertices[:, 11] < 1.0).any()) or (model.texture >= 0 and holed[model.texture]),
                context.buffer(model.vertices.tobytes()),
                context.buffer(reserve=4 * ROW * len(model.shapes)),
            )
            for model in models_of(table, paint)
        ]
        self._still = np.ones((len(table.shapes), ROW), dtype=np.float32)
        self._still[:, 15:19] = colors
        for batch in self.batches:
            self._still[batch.model.shapes, 12:15] = batch.model.scale

    @property
    def has_clear(self) -> bool:
        """Whether any shape is transparent."""
        return bool(self.clear.any()) or any(batch.holed for batch in self.batches)

    def rows(self, frames: Array, turn: Array, origin: Array) -> Rows:
        """Return the instance data of the shapes.

        Args:
            frames: frames of the shapes in the world; shape (shapes, 12).
            turn: rotation of the camera; shape (3, 3).
            origin: position of the camera [m].
        """
        rows: Rows = self._still.copy()
        placed = rows[:, :12].reshape(-1, 3, 4)
        placed[:, :, :3] = turn.T @ frames[:, :9].reshape(-1, 3, 3)
        placed[:, :, 3] = (frames[:, 9:] - origin) @ turn
        rows[:, :12] = placed.reshape(-1, 12)
        rows[:, 19] = np.arange(len(frames))
        return rows

    def fill(self, drawn: Sequence[tuple[TriangleBatch, Numbers]], rows: Rows) -> Iterator[tuple[TriangleBatch, int]]:
        """Write the instance data of each batch; yield the batch with its number of instances."""
        for batch, shapes in drawn:
            if len(shapes):
                batch.instances.write(rows[shapes].tobytes())
                yield batch, len(shapes)

    def draw(self, shot: Shot, wanted: tuple[str, ...] = COLOR, *, clear: bool = False) -> None:
        """Draw the opaque or the transparent shapes, the nearest first.

        Args:
            shot: the state of the drawing.
            wanted: the output buffers.
            clear: whether to draw the transparent shapes.
        """
        todo: list[tuple[float, bool, TriangleBatch, Numbers]] = []
        for batch in self.batches:
            through = self.clear | batch.holed
            shapes = batch.members(through if clear else ~through)
            hidden = shot.outside[shapes] & batch.model.closed  # back faces are hidden by front faces
            for some, cull in ((shapes[~hidden], False), (shapes[hidden], True)):
                if len(some):
                    some = some[np.argsort(shot.nearest[some], kind="stable")]
                    todo.append((float(shot.nearest[some[0]]), cull, batch, some))
        for _, cull, batch, shapes in sorted(todo, key=lambda each: each[0]):
            self._ctx.enable_only(self._ctx.DEPTH_TEST | (self._ctx.CULL_FACE if cull else 0))
            batch.instances.write(shot.rows[shapes].tobytes())
            self._array(batch, shot, wanted, clear=clear).render(instances=len(shapes))

    def blend(self, shot: Shot) -> None:
        """Blend the transparent shapes, the farthest first, and for each shape its back faces first."""
        ctx = self._ctx
        ctx.enable_only(ctx.DEPTH_TEST | ctx.BLEND | ctx.CULL_FACE)
        ctx.blend_func = ctx.SRC_ALPHA, ctx.ONE_MINUS_SRC_ALPHA
        ctx.fbo.depth_mask = False
        try:
            todo = [
                (float(shot.nearest[shape]), batch, int(shape))
                for batch in self.batches
                for shape in batch.members(self.clear | batch.holed)
            ]
            for _, batch, shape in sorted(todo, key=lambda each: -each[0]):
                batch.instances.write(shot.rows[shape : shape + 1].tobytes())
                array = self._array(batch, shot)
                for side in ("front", "back"):
                    ctx.cull_face = side
                    array.render(instances=1)
        finally:
            ctx.fbo.depth_mask = True
            ctx.cull_face = "back"

    def _array(self, batch: TriangleBatch, shot: Shot, wanted: tuple[str, ...] = COLOR, *, clear: bool = False) -> Any:
        """Return the vertex array of a batch, with the uniforms of its program set."""
        model = batch.model
        glossy, textured = model.gloss[3] > 0.0 and "color" in wanted, model.texture >= 0
        kind = ShaderKind(self._lamps, model.flat, model.plain, textured, wanted, clear, shot.exact, self.maps, glossy)
        if kind not in self._programs:
            made = self._ctx.program(vertex_shader(kind), fragment_shader(kind))
            self._programs[kind] = made, frozenset(made)
        program, names = self._programs[kind]
        array = batch.arrays.get(kind)
        if array is None:
            array = batch.arrays[kind] = self._ctx.vertex_array(
                program, [(batch.vertices, *VERTEX), (batch.instances, *INSTANCE)], skip_errors=True
            )
        if program.extra is not shot.uniforms:
            for name, value in shot.uniforms.items():
                if name in names:
                    program[name] = value
            program.extra = shot.uniforms
        if glossy and "u_gloss" in names:
            program["u_gloss"] = model.gloss
        if textured:
            self._textures[model.texture].use(location=0)
        return array
