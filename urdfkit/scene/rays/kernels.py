"""The compiled ray kernels with the types of their arguments."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from functools import lru_cache
from pathlib import Path
from typing import Any

from urdfkit.description.xml.cost_limit import excluded
from urdfkit.scene.rays.compilation import load_compiled, sources_digest

Progress = Callable[[int], None]
"""Called with the number of compiled functions, starting with 0; not called if everything is cached."""


@lru_cache(maxsize=1)
def caster() -> Callable[..., Any]:
    """Return the compiled `ray_casting.cast`."""
    from numba import float64 as f
    from numba import int64 as i

    from urdfkit.scene.rays.ray_casting import cast

    return load_compiled(
        cast, (scene_type(), f[::1], f[:, ::1], f[:, ::1], f, f, f[::1], f[::1], i[::1], i[::1], f[:, ::1])
    )


def scene_type() -> Any:
    """Return the numba type of a scene."""
    from numba import float64 as f
    from numba import int64 as i
    from numba import types

    return types.Tuple((f[::1], i[::1], i[::1], i[::1], f[:, ::1], i[::1], f[:, ::1], i[::1], f[::1]))


@lru_cache(maxsize=1)
def tracer() -> Callable[..., Any]:
    """Return the compiled `camera_picture.trace`."""
    from numba import float32, types, uint8
    from numba import float64 as f
    from numba import int64 as i

    from urdfkit.scene.rays.shading.camera_picture import trace

    paint = types.Tuple((f[:, ::1], i[::1], f[:, ::1], float32[:, ::1], i[:, ::1], uint8[::1]))
    return load_compiled(
        trace,
        (
            scene_type(),
            scene_type(),
            paint,
            f[:, ::1],
            f[:, ::1],
            f[::1],
            f[:, ::1],
            i[::1],
            f,
            f,
            f[::1],
            f[::1],
            uint8[:, ::1],
            f[::1],
            i[::1],
        ),
    )


@lru_cache(maxsize=1)
def outliner() -> Callable[..., Any]:
    """Return the compiled `edge_pixels.outline`."""
    from numba import int64, uint8

    from urdfkit.scene.rays.shading.edge_pixels import outline

    return load_compiled(outline, (uint8[:, :, ::1], int64, int64[::1]))


@lru_cache(maxsize=1)
def placer() -> Callable[..., Any]:
    """Return the compiled `shape_placement.place`."""
    from numba import float64 as f
    from numba import int64 as i

    from urdfkit.scene.rays.shape_placement import place

    return load_compiled(
        place,
        (
            f[:, ::1],
            f[:, ::1],
            f[::1],
            i[::1],
            i[::1],
            f[:, ::1],
            f[::1],
            f[:, ::1],
            i[::1],
            f[:, ::1],
            i[:, ::1],
            i[:, :, ::1],
            i[::1],
            f[:, ::1],
            f[::1],
            f[::1],
        ),
    )


@lru_cache(maxsize=1)
def builder() -> Callable[..., Any]:
    """Return the compiled `bvh.build`."""
    from numba import float64 as f
    from numba import int64 as i

    from urdfkit.scene.rays.bvh import build

    return load_compiled(build, (f[:, ::1], i[::1], f[:, ::1], i[:, ::1], i, f[::1]))


@lru_cache(maxsize=1)
def widener() -> Callable[..., Any]:
    """Return the compiled `wide_bvh.widen`."""
    from numba import float64 as f
    from numba import int64 as i

    from urdfkit.scene.rays.wide_bvh import widen

    return load_compiled(widen, (f[:, ::1], i[:, ::1], i[:, :, ::1], i[::1]))


@lru_cache(maxsize=1)
def filler() -> Callable[..., Any]:
    """Return the compiled `wide_bvh.fill`."""
    from numba import float64 as f
    from numba import int64 as i

    from urdfkit.scene.rays.wide_bvh import fill

    return load_compiled(fill, (f[:, ::1], i[:, :, ::1], i, f[:, ::1]))


def cached() -> bool:
    """Return whether numba's cache contains all kernels."""
    from numba.core.caching import FunctionCache

    from urdfkit.scene.rays.bvh import build
    from urdfkit.scene.rays.ray_casting import cast
    from urdfkit.scene.rays.shading.camera_picture import trace
    from urdfkit.scene.rays.shading.edge_pixels import outline
    from urdfkit.scene.rays.shape_placement import place
    from urdfkit.scene.rays.wide_bvh import fill, widen

    index = f"_{sources_digest()[:16]}-*.nbi"  # named by `compile_or_load`
    with suppress(RuntimeError):  # numba has no folder for its cache
        return all(
            any(Path(FunctionCache(function).cache_path).glob(f"*.{function.__name__}_*{index}"))
            for function in (build, cast, fill, outline, place, trace, widen)
        )
    return False


def announcement() -> str:
    """Return the message before a compilation, with its measured duration [CPU s]."""
    return "compiling the ray kernels, once, about 15 s …"


def warmup(progress: Progress | None = None) -> bool:
    """Compile or load the kernels; return whether they had to be compiled (see `announcement`).

    Args:
        progress: called with 0 before a compilation starts and with a growing count while it runs.
    """
    from numba.core import event

    compiled: list[str] = []

    class RayKernelEvents(event.Listener):  # type: ignore[misc]
        def on_start(self, event: Any) -> None:
            if progress is not None:
                progress(len(compiled))
            compiled.append(str(event.data["dispatcher"]))

        def on_end(self, event: Any) -> None:
            pass

    with excluded(), event.install_listener("numba:compile", RayKernelEvents()):
        for kernel in (builder, widener, filler, placer, caster, tracer, outliner):
            kernel()
    return bool(compiled)
