"""The compiled ray kernels with the types of their arguments."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from contextlib import suppress
from functools import lru_cache
from importlib import import_module
from pathlib import Path
from typing import Any

from urdfkit.description.xml.cost_limit import excluded
from urdfkit.scene.rays.compilation import load_compiled, sources_digest

Progress = Callable[[int], None]
"""Called with the number of compiled functions, starting with 0; not called if everything is cached."""


_SCENE = "(d1 q1 q1 q1 d2 q1 d2 q1 d1)"
_PAINT = "(d2 q1 d2 f2 q2 B1)"

KERNELS: dict[str, tuple[str, str]] = {
    "build": ("bvh", "d2 q1 d2 q2 q d1"),
    "widen": ("wide_bvh", "d2 q2 q3 q1"),
    "fill": ("wide_bvh", "d2 q3 q d2"),
    "place": ("shape_placement", "d2 d2 d1 q1 q1 d2 d1 d2 q1 d2 q2 q3 q1 d2 d1 d1"),
    "cast": ("ray_casting", f"{_SCENE} d1 d2 d2 d d d1 d1 q1 q1 d2"),
    "trace": ("shading.camera_picture", f"{_SCENE} {_SCENE} {_PAINT} d2 d2 d1 d2 q1 d d d1 d1 B2 d1 q1"),
    "outline": ("shading.edge_pixels", "B3 q q1"),
}
"""Name of a kernel → its module in this package, and the types of its arguments.

A type is a letter of `struct`: ``d`` and ``f`` for floats of 64 and 32 bits, ``q`` and ``B`` for integers of 64 and
8 bits. A digit after it is the number of dimensions of an array, in C order. Parentheses enclose a tuple.
"""


@lru_cache
def kernel(name: str) -> Callable[..., Any]:
    """Return a compiled kernel of `KERNELS`."""
    from numba import types

    letters = {"d": types.float64, "f": types.float32, "q": types.int64, "B": types.uint8}

    def read(words: Iterator[str]) -> Iterator[Any]:
        for word in words:
            if word == ")":
                return
            if word == "(":
                yield types.Tuple(tuple(read(words)))
            else:
                yield types.Array(letters[word[0]], int(word[1]), "C") if word[1:] else letters[word]

    words = iter(re.findall(r"[()]|\w+", KERNELS[name][1]))
    return load_compiled(_python(name), tuple(read(words)))


def _python(name: str) -> Callable[..., Any]:
    """Return a kernel in Python."""
    found: Callable[..., Any] = getattr(import_module(f"urdfkit.scene.rays.{KERNELS[name][0]}"), name)
    return found


def cached() -> bool:
    """Return whether numba's cache contains all kernels."""
    from numba.core.caching import FunctionCache

    index = f"_{sources_digest()[:16]}-*.nbi"  # named by `compile_or_load`
    with suppress(RuntimeError):  # numba has no folder for its cache
        return all(any(Path(FunctionCache(_python(name)).cache_path).glob(f"*.{name}_*{index}")) for name in KERNELS)
    return False


def announcement() -> str:
    """Return the message before a compilation, with its approximate duration."""
    from urdfkit.compilation.duration import announced_duration

    return f"compiling the ray kernels, once, {announced_duration(15)} …"


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
        for name in KERNELS:
            kernel(name)
    return bool(compiled)
