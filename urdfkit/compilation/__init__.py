"""Compile functions with numba, once per machine and version.

A function and the types of its arguments go in; machine code comes out, loaded from the cache if possible (`load`), or
compiled as one program with all functions it calls (`whole_program`).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

__all__ = ["compile_or_load", "own_sources"]

_COMPILERS = ("codegen", "instruction_set", "load", "native_entry", "whole_program")


def compile_or_load(
    function: Callable[..., Any],
    arguments: tuple[Any, ...],
    *,
    digest: str,
    options: Mapping[str, Any],
    cache: bool = True,
) -> Any:
    """Compile a function, or load it from numba's cache, see `load.compile_or_load`; imports numba."""
    from urdfkit.compilation import load

    return load.compile_or_load(function, arguments, digest=digest, options=options, cache=cache)


def own_sources() -> tuple[Path, ...]:
    """Return the sources of this package that machine code depends on, in addition to the sources of the kernels."""
    return tuple(Path(__file__).parent / f"{name}.py" for name in _COMPILERS)
