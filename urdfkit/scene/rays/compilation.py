"""Compilation of the ray kernels, once per machine and version, with numba's cache."""

import hashlib
from collections.abc import Callable
from functools import lru_cache
from pathlib import Path
from typing import Any, TypeVar, cast

from urdfkit.compilation import compile_or_load, own_sources
from urdfkit.compilation.deferred import Deferred

Function = TypeVar("Function", bound=Callable[..., Any])

KERNEL_MODULES = (
    "bvh",
    "compilation",
    "primitives",
    "ray_casting",
    "ray_packet",
    "shading/camera_picture",
    "shading/direct_lighting",
    "shading/edge_pixels",
    "shading/shading_buffers",
    "shading/surface_attributes",
    "shape_placement",
    "surface_normals",
    "triangles",
    "wide_bvh",
)
"""Modules of this package with compiled functions."""

# Without fastmath every operation is rounded as IEEE 754 requires, so distances do not depend on the compiler.
# Reference counting is off: the caller of a kernel holds the arrays, and the kernels only create views of them.
OPTIONS: dict[str, Any] = {"fastmath": False, "error_model": "numpy", "nogil": True, "_nrt": False}


def inlined(function: Function) -> Function:
    """Compile a function as part of the kernels that call it."""
    return cast(Function, Deferred(lambda: _compilable(function, forceinline=True)))


def compiled(function: Function) -> Function:
    """Compile a function that kernels call, without inlining.

    By default numba inlines a function that is first called by an `inlined` one.
    """
    return cast(Function, Deferred(lambda: _compilable(function, forceinline=False)))


def _compilable(function: Callable[..., Any], *, forceinline: bool) -> Any:
    import numba

    return numba.njit(function, forceinline=forceinline, **OPTIONS)


@lru_cache
def load_compiled(function: Callable[..., Any], arguments: tuple[Any, ...]) -> Callable[..., Any]:
    """Compile a function for these numba argument types, or load it from the cache."""
    compiled = compile_or_load(function, arguments, digest=sources_digest(), options=OPTIONS)
    return cast(Callable[..., Any], compiled)


@lru_cache(maxsize=1)
def sources_digest() -> str:
    """Return a digest of the kernels' sources."""
    digest = hashlib.sha256()
    for path in (*own_sources(), *((Path(__file__).parent / f"{name}.py") for name in KERNEL_MODULES)):
        digest.update(path.read_bytes())
    return digest.hexdigest()
