"""Takes pictures by OpenGL."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import partial
from threading import Lock
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from urdfkit.scene.gl.models import Model, models_of
from urdfkit.scene.gl.probe import create
from urdfkit.scene.gl.shaders import BOTH, STILL, Kind, fragment_shader, vertex_shader
from urdfkit.scene.gl.shadows import EDGES, Rest, Shadows
from urdfkit.scene.image import Painter, Picture
from urdfkit.scene.lens import Lens
from urdfkit.scene.lights import Lighting
from urdfkit.scene.rays.paint import paint_of
from urdfkit.scene.rays.picture import DIRECTIONAL, SPOT
from urdfkit.scene.rays.table import RayTable

Array = NDArray[np.float64]
Rows = NDArray[np.float32]
Numbers = NDArray[np.int64]

VERTEX = ("3f 3f 2f 4f", "in_position", "in_normal", "in_uv", "in_color")
INSTANCE = ("4f 4f 4f 3f 4f 1f/i", "in_x", "in_y", "in_z", "in_scale", "in_rgba", "in_shape")

FIRST = 2.0
"""Number of the first shape in a picture: a background is 0..1."""


@dataclass(eq=False)
class Batch:
    """Triangles on the device, and the shapes that they are drawn for.

    Attributes:
        model: what they are.
        vertices: their buffer.
        instances: the buffer of where they are, written before they are drawn.
        arrays: what ties the buffers to programs.
    """

    model: Model
    vertices: Any
    instances: Any
    arrays: dict[Any, Any] = field(default_factory=dict)


class GlPainter:
    """Takes pictures of what is in a table of shapes; the counterpart of `Painter`.

    Args:
        table: the shapes; placed by whoever holds it.
        lighting: what shines.
        backend: how the device is reached, as `probe` says.
        note: tells the user that the driver has failed.
    """

    def __init__(
        self,
        table: RayTable,
        lighting: Lighting,
        backend: str = "egl",
        note: Callable[[str], None] = lambda _: None,
    ) -> None:
        import moderngl

        self.table = table
        self._rays = Painter(table, lighting)
        self._gl = moderngl
        self._ctx = create(backend)
        self._note = note
        self._works = True
        self._lock = Lock()
        self._lights, self._air = lighting.lights, lighting.air
        lamps = tuple((int(row[0]), bool(row[11])) for row in self._lights)
        # Only suns have shadow maps: a lamp's would go all around it.
        self._drawable = all(kind == DIRECTIONAL or not shadows for kind, shadows in lamps)
        self._lamps = lamps
        colors, _, skins, textures, texels = paint = paint_of(table)
        self._colors = colors.astype(np.float32)
        self._programs: dict[Kind, Any] = {}
        self._targets: dict[tuple[int, int, int], dict[str, Any]] = {}
        with self._lock, self._ctx:
            self._batches = [
                Batch(
                    model, self._ctx.buffer(model.vertices.tobytes()), self._ctx.buffer(reserve=80 * len(model.shapes))
                )
                for model in models_of(table, paint)
            ]
            self._textures = [self._texture(texels, *row) for row in textures.tolist()]
            holed = [
                bool((texels[s : s + 4 * w * h].reshape(-1, 4)[:, 3] < 255).any()) for s, w, h in textures.tolist()
            ]
            self._shadows = {
                (k, name): Shadows(self._ctx, edge)
                for k, (_, shadows) in enumerate(lamps)
                if shadows and self._drawable
                for name, edge in EDGES.items()
            }
        self._rest = Rest(len(table.shapes))
        self._maps: tuple[str, ...] = STILL
        del skins
        clear = np.zeros(len(table.shapes), dtype=bool)
        self._clear_models = set()
        for k, batch in enumerate(self._batches):
            model = batch.model
            if (model.vertices[:, 11] < 1.0).any() or (model.texture >= 0 and holed[model.texture]):
                self._clear_models.add(k)
        self._clear = clear | (self._colors[:, 3] < 1.0)
        self._scales = np.ones((len(table.shapes), 3), dtype=np.float32)
        for batch in self._batches:
            self._scales[batch.model.shapes] = batch.model.scale

    def _texture(self, texels: NDArray[np.uint8], start: int, width: int, height: int) -> Any:
        texture = self._ctx.texture((width, height), 4, texels[start : start + 4 * width * height].tobytes())
        texture.filter = self._gl.LINEAR, self._gl.LINEAR
        return texture

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
        """Return a picture; through a distorted lens, or with lamps that cast shadows, by rays.

        Args:
            lens: what it is taken with.
            frame: placement of the camera, which looks along x; shape (4, 4).
            near: what is nearer is not seen [m].
            far: what is farther is not seen [m].
            samples: places in each pixel that its colour is the mean of; as many as the device has.
            deep: whether depths and shapes are wanted; without, they are empty.
        """
        if self._works and self._drawable and not lens.distortion:
            try:
                with self._lock, self._ctx:
                    return self._take(lens, np.asarray(frame, dtype=float), near, far, samples, deep)
            except self._gl.Error as error:
                self._works = False
                self._note(f"OpenGL has failed ({error}): pictures are taken by casting rays from now on")
        return self._rays.take(lens, frame, near=near, far=far, samples=samples)

    def _take(self, lens: Lens, frame: Array, near: float, far: float, samples: int, deep: bool) -> Picture:
        turn, origin = frame[:3, :3], frame[:3, 3]
        frames = self.table.frames
        rows = np.empty((len(frames), 20), dtype=np.float32)
        rows[:, :12].reshape(-1, 3, 4)[:, :, :3] = turn.T @ frames[:, :9].reshape(-1, 3, 3)
        rows[:, :12].reshape(-1, 3, 4)[:, :, 3] = (frames[:, 9:] - origin) @ turn
        rows[:, 12:15], rows[:, 15:19] = self._scales, self._colors
        rows[:, 19] = np.arange(len(frames)) + FIRST
        nearest, farthest = self._reach(origin)
        corner = float(lens.towards(np.zeros(1), np.zeros(1))[0, 0])
        low = max(near, 0.0) * corner if near > 0.0 else max(1e-3 * float(nearest.min(initial=1.0)), 1e-4)
        high = min(max(float(farthest.max(initial=1.0)) * 1.001, 2.0 * low), far)
        high = max(high, 1.01 * low)
        exact = bool((nearest < near).any() or (farthest > far).any())
        order = np.argsort(nearest, kind="stable")
        uniforms = self._uniforms(lens, turn, origin, low, high, near, far)
        samples = min(samples, self._ctx.max_samples)
        target = self._target(lens, samples)
        self._cast_shadows(rows, turn, origin, uniforms)
        ctx, gl = self._ctx, self._gl
        ctx.enable_only(gl.DEPTH_TEST)
        ctx.front_face = "cw"  # the picture's top row comes first
        clear = any(k in self._clear_models for k in range(len(self._batches))) or bool(self._clear.any())
        rgb = np.empty((lens.height, lens.width, 3), dtype=np.uint8)
        fbo = target["color"]
        fbo.use()
        fbo.clear(*self._air[1].tolist(), 1.0)
        self._draw(rows, order, uniforms, deep=False, exact=exact, clear=False)
        if clear:
            self._blend(rows, nearest, uniforms, exact)
        if samples > 1:
            ctx.copy_framebuffer(target["plain"], fbo)
            fbo = target["plain"]
        fbo.read_into(rgb, components=3, alignment=1)
        if not deep:
            return Picture(rgb, np.empty((0, 0), np.float32), np.empty((0, 0), np.int64))
        fbo = target["deep"]
        fbo.use()
        fbo.clear(0.0, 0.0, 0.0, 0.0)
        ctx.enable_only(gl.DEPTH_TEST)
        self._draw(rows, order, uniforms, deep=True, exact=exact, clear=False)
        if clear:
            self._draw(rows, order, uniforms, deep=True, exact=exact, clear=True)
        found = np.empty((lens.height, lens.width, 2), dtype=np.float32)
        fbo.read_into(found, components=2, dtype="f4")
        seen = found[..., 1] >= FIRST
        return Picture(
            rgb, np.where(seen, found[..., 0], np.float32(np.inf)),
            np.where(seen, np.rint(found[..., 1] - FIRST), -1).astype(np.int64),
        )  # fmt: skip

    def _reach(self, origin: Array) -> tuple[Array, Array]:
        """Return how far the box of each shape is from the camera, at least and at most [m]; shape (shapes,) each."""
        boxes = self.table.boxes
        off = np.maximum(np.maximum(boxes[:, :3] - origin, origin - boxes[:, 3:]), 0.0)
        on = np.maximum(np.abs(boxes[:, :3] - origin), np.abs(boxes[:, 3:] - origin))
        return np.linalg.norm(off, axis=1), np.linalg.norm(on, axis=1)

    def _uniforms(
        self, lens: Lens, turn: Array, origin: Array, low: float, high: float, near: float, far: float
    ) -> dict[str, Any]:
        """Return the values of the shaders' uniforms."""
        f = lens.focal_length
        found: dict[str, Any] = {
            "u_lens": (
                2 * f / lens.width,
                2 * f / lens.height,
                (high + low) / (high - low),
                -2 * high * low / (high - low),
            ),
            "u_reach": (near, min(far, 3e38)),
            "u_air": tuple(self._air[0].tolist()),
        }
        for k, row in enumerate(self._lights):
            kind, where = int(row[0]), row[1:4]
            found[f"u_lamp{k}"] = tuple((where @ turn if kind == DIRECTIONAL else (where - origin) @ turn).tolist())
            found[f"u_glow{k}"] = tuple(row[4:7].tolist())
            if kind != DIRECTIONAL:
                found[f"u_fall{k}"] = tuple(row[7:11].tolist())
            if kind == SPOT:
                found[f"u_towards{k}"] = tuple((row[12:15] @ turn).tolist())
                found[f"u_cone{k}"] = tuple(row[15:18].tolist())
        return found

    def _cast_shadows(self, rows: Rows, turn: Array, origin: Array, uniforms: dict[str, Any]) -> None:
        """Bring the shadow maps up to date, and tell the shaders where they are."""
        if not self._shadows:
            return
        solid = np.zeros(len(rows), dtype=bool)
        casters = [batch for batch in self._batches if batch.model.casts]
        for batch in casters:
            solid[batch.model.shapes] = True
        solid &= ~self._clear
        moving = self._rest.moving(self.table.frames, self.table.boxes) & solid
        self._maps = BOTH if moving.any() else STILL
        for unit, ((k, name), shadows) in enumerate(self._shadows.items(), start=1):
            if name not in self._maps:
                continue
            wanted = moving if name == "m" else solid & ~moving
            drawn = [(batch, _members(batch, wanted)) for batch in casters]
            fill = partial(self._fill, drawn, rows)
            shadows.cast(self._lights[k, 1:4], self.table, wanted, turn, origin, fill)
            uniforms[f"u_lift{k}{name}"] = shadows.lift
            uniforms[f"u_shade{k}{name}"] = shadows.matrix(turn, origin)
            shadows.texture.use(location=unit)
            uniforms[f"u_map{k}{name}"] = unit

    def _fill(self, drawn: Sequence[tuple[Batch, Numbers]], rows: Rows) -> Iterator[tuple[Batch, int]]:
        """Write where shapes are, batch by batch; yield each with how often it is to be drawn."""
        for batch, shapes in drawn:
            if len(shapes):
                batch.instances.write(rows[shapes].tobytes())
                yield batch, len(shapes)

    def _draw(
        self, rows: Rows, order: Numbers, uniforms: dict[str, Any], *, deep: bool, exact: bool, clear: bool
    ) -> None:
        """Draw what is opaque, or what is transparent; the nearest first."""
        rank = np.empty(len(order), dtype=np.int64)
        rank[order] = np.arange(len(order))
        todo = []
        for number, batch in enumerate(self._batches):
            wanted = np.full(len(rows), True) if number in self._clear_models else self._clear
            shapes = _members(batch, wanted if clear else ~wanted)
            if len(shapes):
                shapes = shapes[np.argsort(rank[shapes])]
                todo.append((int(rank[shapes[0]]), batch, shapes))
        for _, batch, shapes in sorted(todo, key=lambda each: each[0]):
            batch.instances.write(rows[shapes].tobytes())
            self._array(batch, uniforms, deep=deep, exact=exact).render(instances=len(shapes))

    def _blend(self, rows: Rows, nearest: Array, uniforms: dict[str, Any], exact: bool) -> None:
        """Draw what is transparent over the rest, the farthest first; of each shape first what looks away."""
        ctx, gl = self._ctx, self._gl
        ctx.enable_only(gl.DEPTH_TEST | gl.BLEND | gl.CULL_FACE)
        ctx.blend_func = gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA
        ctx.fbo.depth_mask = False
        try:
            todo = [
                (float(nearest[shape]), batch, int(shape))
                for number, batch in enumerate(self._batches)
                for shape in batch.model.shapes
                if self._clear[shape] or number in self._clear_models
            ]
            for _, batch, shape in sorted(todo, key=lambda each: -each[0]):
                batch.instances.write(rows[shape : shape + 1].tobytes())
                array = self._array(batch, uniforms, deep=False, exact=exact)
                for side in ("front", "back"):
                    ctx.cull_face = side
                    array.render(instances=1)
        finally:
            ctx.fbo.depth_mask = True

    def _array(self, batch: Batch, uniforms: dict[str, Any], *, deep: bool, exact: bool) -> Any:
        """Return what draws a batch, its program's uniforms set."""
        model = batch.model
        kind = Kind(self._lamps, model.flat, model.plain, model.texture >= 0, deep, exact, self._maps)
        program = self._programs.get(kind)
        if program is None:
            program = self._programs[kind] = self._ctx.program(vertex_shader(kind), fragment_shader(kind))
        array = batch.arrays.get(kind)
        if array is None:
            array = batch.arrays[kind] = self._ctx.vertex_array(
                program, [(batch.vertices, *VERTEX), (batch.instances, *INSTANCE)], skip_errors=True
            )
        if program.extra is not uniforms:
            for name, value in uniforms.items():
                if name in program:
                    program[name] = value
            program.extra = uniforms
        if model.texture >= 0:
            self._textures[model.texture].use(location=0)
        return array

    def _target(self, lens: Lens, samples: int) -> dict[str, Any]:
        """Return the framebuffers of a size."""
        size = lens.width, lens.height
        key = (*size, samples)
        if key not in self._targets:
            ctx = self._ctx
            plain = ctx.framebuffer([ctx.renderbuffer(size, 4)], ctx.depth_renderbuffer(size))
            deep = ctx.framebuffer([ctx.renderbuffer(size, 2, dtype="f4")], ctx.depth_renderbuffer(size))
            color = plain
            if samples > 1:
                color = ctx.framebuffer(
                    [ctx.renderbuffer(size, 4, samples=samples)], ctx.depth_renderbuffer(size, samples=samples)
                )
            self._targets[key] = {"plain": plain, "color": color, "deep": deep}
        return self._targets[key]


def _members(batch: Batch, wanted: NDArray[np.bool_]) -> Numbers:
    """Return which of the wanted shapes a batch draws."""
    shapes = batch.model.shapes
    found: Numbers = shapes[wanted[shapes]]
    return found
