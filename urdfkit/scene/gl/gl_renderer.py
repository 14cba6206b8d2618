"""GlRenderer: renders images with OpenGL."""

from collections.abc import Callable
from functools import partial
from math import hypot
from threading import Lock
from typing import Any
from weakref import finalize

import numpy as np
from numpy.typing import ArrayLike, NDArray

from urdfkit.linear_algebra import Array
from urdfkit.scene.camera_model import Lens
from urdfkit.scene.gl.draw_calls import Drawing, Shot
from urdfkit.scene.gl.drawing_threads import lower_priority
from urdfkit.scene.gl.driver_probe import create, on_processor
from urdfkit.scene.gl.moving_shadow_rectangles import LARGE, Rectangle, shaded, union
from urdfkit.scene.gl.pixel_reading import read_pixels
from urdfkit.scene.gl.shaders import ALL, BOTH, COLOR, DEEP, STILL
from urdfkit.scene.gl.shadow_maps import EDGES, FINER, Rest, Shadows
from urdfkit.scene.lights import Lighting
from urdfkit.scene.ray_renderer import Picture, RayRenderer
from urdfkit.scene.rays.ray_scene import RayTable
from urdfkit.scene.rays.shading.direct_lighting import DIRECTIONAL, SPOT


class GlRenderer:
    """Renders images of the shapes of a table with OpenGL; the counterpart of `RayRenderer`.

    Args:
        table: the shapes; the caller places them.
        lighting: the lights.
        backend: backend of the context, from `driver_probe`.
        note: receives a message if the driver fails.
    """

    def __init__(
        self, table: RayTable, lighting: Lighting, backend: str = "egl", note: Callable[[str], None] = lambda _: None
    ) -> None:
        import moderngl

        self.table = table
        self._error: type[Exception] = moderngl.Error
        self._rays = RayRenderer(table, lighting)
        self._note = note
        self._works = True
        self._lock = Lock()
        self._lights, self._air = lighting.lights, lighting.air
        lamps = tuple((int(row[0]), bool(row[11])) for row in self._lights)
        # Only directional lights have shadow maps; the map of a point light would need all directions.
        self._drawable = all(kind == DIRECTIONAL or not shadows for kind, shadows in lamps)
        self._targets: dict[tuple[int, int, int], dict[str, Any]] = {}
        self._ctx = create(backend)
        finalize(self, self._ctx.release).atexit = False  # a driver on the processor keeps 40 MB of each context
        self._on_processor = on_processor(str(self._ctx.info["GL_RENDERER"]))
        if self._on_processor:
            lower_priority()
        with self._lock, self._ctx:
            self._drawing = Drawing(self._ctx, table, self._rays.paint, lamps)
            self._shadows = {
                (k, name): Shadows(self._ctx, edge)
                for k, (_, shadows) in enumerate(lamps)
                if shadows and self._drawable
                for name, edge in EDGES.items()
            }
        self._rest = Rest(len(table.shapes))

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
        """Render an image; with a distorted lens, or point lights that cast shadows, by ray casting.

        Args:
            lens: the camera model.
            frame: placement of the camera, which looks along x; shape (4, 4).
            near: nearer surfaces are not seen [m].
            far: farther surfaces are not seen [m].
            samples: places in each pixel that its colour is the mean of; as many as the device has. A driver that
                draws on the processor takes one, and rays the others, only where something ends: that is quicker.
            deep: whether to return depths and shapes; otherwise they are empty.
        """
        if self._works and self._drawable and not lens.distortion:
            try:
                with self._lock, self._ctx:
                    return self._take(lens, np.asarray(frame, dtype=float), near, far, samples, deep)
            except self._error as error:
                self._works = False
                self._note(f"OpenGL has failed ({error}); images are now rendered by ray casting")
        return self._rays.take(lens, frame, near=near, far=far, samples=samples)

    def _take(self, lens: Lens, frame: Array, near: float, far: float, samples: int, deep: bool) -> Picture:
        turn, origin = frame[:3, :3], frame[:3, 3]
        drawing = self._drawing
        rows = drawing.rows(self.table.frames, turn, origin)
        nearest, farthest = self._reach(origin)
        corner = lens.focal_length / hypot(lens.focal_length, (lens.width - 1) / 2, (lens.height - 1) / 2)
        low = near * corner if near > 0.0 else max(1e-3 * float(nearest.min(initial=1.0)), 1e-4)
        high = max(min(max(float(farthest.max(initial=1.0)) * 1.001, 2.0 * low), far), 1.01 * low)
        exact = bool((nearest < near).any() or (farthest > far).any())
        shot = Shot(rows, nearest, nearest > near, exact, self._uniforms(lens, turn, origin, low, high, near, far))
        target = self._target(lens, 1 if self._on_processor else min(samples, self._ctx.max_samples))
        again = self._cast_shadows(shot, turn, origin, lens, low)
        self._ctx.front_face = "cw"  # the top row of the image comes first
        rgb = np.empty((lens.height, lens.width, 3), dtype=np.uint8)
        target["color"].clear(*self._air[1].tolist(), 1.0)
        at_once = deep and "all" in target
        if at_once:
            target["depth"].clear(np.inf)
            target["shape"].clear(-1.0)
        target["all" if at_once else "color"].use()
        drawing.draw(shot, ALL if at_once else COLOR)
        target["color"].use()
        if again is not None:  # draw again where shadows of moving shapes can fall
            drawing.maps = BOTH
            target["color"].scissor = again
            self._ctx.depth_func = "<="
            drawing.draw(shot)
            self._ctx.depth_func = "<"
            target["color"].scissor = None
        if drawing.has_clear:
            drawing.blend(shot)
        if target["color"] is not target["plain"]:
            self._ctx.copy_framebuffer(target["plain"], target["color"])
        read_pixels(target["plain"], rgb)
        if samples > 1 and self._on_processor:
            self._rays.smooth(rgb, lens, frame, near=near, far=far, samples=samples)
        if not deep:
            return Picture(rgb, np.empty((0, 0), np.float32), np.empty((0, 0), np.int64))
        target["deep"].use()
        if not at_once:
            target["deep"].clear(np.inf)
            target["shape"].clear(-1.0)
            drawing.draw(shot, DEEP)
        if drawing.has_clear:
            drawing.draw(shot, DEEP, clear=True)
        depth = np.empty((lens.height, lens.width), dtype=np.float32)
        read_pixels(target["depth"], depth)
        read_pixels(target["shape"], target["numbers"])
        return Picture(rgb, depth, target["numbers"].astype(np.int64))

    def _reach(self, origin: Array) -> tuple[Array, Array]:
        """Return minimum and maximum distance of the box of each shape from the camera [m]; shape (shapes,) each."""
        low, high = self.table.boxes[:, :3] - origin, self.table.boxes[:, 3:] - origin
        off, on = np.maximum(np.maximum(low, -high), 0.0), np.maximum(np.abs(low), np.abs(high))
        return np.sqrt((off * off).sum(axis=1)), np.sqrt((on * on).sum(axis=1))

    def _uniforms(
        self, lens: Lens, turn: Array, origin: Array, low: float, high: float, near: float, far: float
    ) -> dict[str, Any]:
        """Return the values of the shaders' uniforms."""
        f, span = lens.focal_length, high - low
        found: dict[str, Any] = {
            "u_lens": (2 * f / lens.width, 2 * f / lens.height, (high + low) / span, -2 * high * low / span),
            "u_reach": (near, min(far, 3e38)),
            "u_air": tuple(self._air[0].tolist()),
        }
        for k, row in enumerate(self._lights):
            kind, where = int(row[0]), row[1:4]
            found[f"u_lamp{k}"] = tuple((where @ turn if kind == DIRECTIONAL else (where - origin) @ turn).tolist())
            found[f"u_glow{k}"] = tuple(row[4:7].tolist())
            found[f"u_sheen{k}"] = tuple(row[18:21].tolist())
            if kind != DIRECTIONAL:
                found[f"u_fall{k}"] = tuple(row[7:11].tolist())
            if kind == SPOT:
                found[f"u_towards{k}"] = tuple((row[12:15] @ turn).tolist())
                found[f"u_cone{k}"] = tuple(row[15:18].tolist())
        return found

    def _cast_shadows(self, shot: Shot, turn: Array, origin: Array, lens: Lens, low: float) -> Rectangle | None:
        """Update the shadow maps and their uniforms.

        Returns:
            Where the picture has to be drawn once more, with the shadows of what moves; None where it need not.
        """
        if not self._shadows:
            return None
        drawing, table = self._drawing, self.table
        casters = [batch for batch in drawing.batches if batch.model.casts]
        solid = np.zeros(len(shot.rows), dtype=bool)
        for batch in casters:
            solid[batch.model.shapes] = True
        solid &= ~drawing.clear
        moving = self._rest.moving(table.frames, table.boxes) & solid
        boxes, again = table.boxes, (0, 0, 0, 0)

        def cast(k: int, name: str, wanted: NDArray[np.bool_], texel: float) -> None:
            shadows = self._shadows[k, name]
            fill = partial(drawing.fill, [(batch, batch.members(wanted)) for batch in casters], shot.rows)
            shadows.cast(self._lights[k, 1:4], table, wanted, turn, origin, fill, texel=texel)
            unit = 1 + list(self._shadows).index((k, name))
            shot.uniforms[f"u_lift{k}{name}"] = shadows.lift
            shot.uniforms[f"u_shade{k}{name}"] = shadows.matrix(turn, origin)
            shadows.texture.use(location=unit)
            shot.uniforms[f"u_map{k}{name}"] = unit

        suns = [k for k, name in self._shadows if name == "s"]
        for k in suns:
            cast(k, "s", solid & ~moving, 0.0)
        if moving.any():
            wide = float((boxes[moving, 3:].max(axis=0) - boxes[moving, :3].min(axis=0)).max())
            slack = 3.0 * max(wide / EDGES["m"], *(self._shadows[k, "s"].texel for k in suns))
            again = union(
                [shaded(boxes[moving], self._lights[k, 1:4], boxes, turn, origin, lens, low, slack) for k in suns]
            )
        drawing.maps = STILL
        if not (again[2] and again[3]):
            return None
        for k in suns:
            cast(k, "m", moving, self._shadows[k, "s"].texel / FINER)
        if again[2] * again[3] > LARGE * lens.width * lens.height:
            drawing.maps = BOTH
            return None
        return again

    def _target(self, lens: Lens, samples: int) -> dict[str, Any]:
        """Return the framebuffers of a size, and room for numbers read from them."""
        size = lens.width, lens.height
        key = (*size, samples)
        if key not in self._targets:
            ctx = self._ctx
            rgba, depth, shape = ctx.renderbuffer(size, 4), *(ctx.renderbuffer(size, 1, dtype="f4") for _ in range(2))
            z = ctx.depth_renderbuffer(size)
            found: dict[str, Any] = {"numbers": np.empty((lens.height, lens.width), dtype=np.float32)}
            found |= {"depth": ctx.framebuffer([depth]), "shape": ctx.framebuffer([shape])}
            found["plain"] = found["color"] = ctx.framebuffer([rgba], z)
            found["deep"] = ctx.framebuffer([depth, shape], z)
            found["all"] = ctx.framebuffer([rgba, depth, shape], z)
            if samples > 1:
                fine = ctx.renderbuffer(size, 4, samples=samples)
                found["color"] = ctx.framebuffer([fine], ctx.depth_renderbuffer(size, samples=samples))
                del found["all"]
            self._targets[key] = found
        return self._targets[key]
