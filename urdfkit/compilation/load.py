"""Load a compiled function from numba's cache, or compile and cache it."""

from __future__ import annotations

import logging
import re
import sys
from collections.abc import Callable, Mapping
from contextlib import suppress
from pathlib import Path
from types import FunctionType
from typing import Any

import numba

from urdfkit.compilation.instruction_set import LEVELS, NATIVE, level

LOG = logging.getLogger("urdfkit.compilation")
TESTED_VERSIONS = ("0.68.1",)
"""Versions of numba that functions are compiled with as one program: `whole_program` depends on numba's internals."""
BROKEN_CACHE = (RuntimeError, OSError, EOFError, ValueError, TypeError, AttributeError)
"""Errors that numba raises when its cache is not writable or broken."""


def compile_or_load(
    function: Callable[..., Any],
    arguments: tuple[Any, ...],
    *,
    digest: str,
    options: Mapping[str, Any],
    cache: bool = True,
) -> Any:
    """Compile a function for these argument types, or load it from the cache.

    numba finds a function's cache by its name and checks only the function's own source file. Therefore the name has
    a digest of all sources, so that no stale kernel is used after a change, and the level that the function is compiled
    for (see `level`), so that processors that share a folder keep one kernel per level.

    Args:
        function: plain Python, written for numba.
        arguments: their numba types.
        digest: digest of the sources of all functions it calls.
        options: options of ``numba.njit``.
        cache: use numba's cache.
    """
    named = FunctionType(function.__code__, function.__globals__, function.__name__)
    named.__qualname__ = f"{function.__name__}_{level().replace('-', '_')}_{digest[:16]}"
    try:
        dispatcher = _compile(named, arguments, cache=cache, **options)
        if cache and dispatcher.stats.cache_misses:
            _forget_stale(Path(dispatcher.stats.cache_path), function, digest)
    except BROKEN_CACHE:
        dispatcher = _compile(named, arguments, **options)
    dispatcher.disable_compile()
    return dispatcher


def _compile(named: FunctionType, arguments: tuple[Any, ...], **options: Any) -> Any:
    """Compile as one program for a fixed level; in numba's standard way with an untested version of numba."""
    dispatcher = numba.njit(named, **options)
    if numba.__version__ in TESTED_VERSIONS:
        try:
            from urdfkit.compilation.codegen import fixed_level
            from urdfkit.compilation.whole_program import whole_program

            with fixed_level(), whole_program(named.__qualname__):
                dispatcher.compile(arguments)
            return dispatcher
        except OSError:
            raise  # the cache could not be written; the compilation itself is valid
        except Exception:  # any error of numba's internals; an error in `named` is raised again below
            dispatcher = numba.njit(named, **options)
    else:
        LOG.info("numba %s is untested: compilation takes longer than with %s", numba.__version__, TESTED_VERSIONS[-1])
    dispatcher.compile(arguments)
    return dispatcher


def _forget_stale(folder: Path, function: Callable[..., Any], digest: str) -> None:
    """Remove cached compilations of earlier sources of a function for this version of Python."""
    stem = re.escape(f"{Path(function.__code__.co_filename).stem}.{function.__name__}")
    version = f"py{sys.version_info[0]}{sys.version_info[1]}{getattr(sys, 'abiflags', '')}"
    levels = "|".join(name.replace("-", "_") for name in (*LEVELS, NATIVE))
    cached = re.compile(rf"{stem}_(?:(?:{levels})_)?([0-9a-f]{{16}})-\d+\.{version}\.(nbi|\d+\.nbc)")
    for path in folder.iterdir():
        found = cached.fullmatch(path.name)
        if found and found[1] != digest[:16]:
            with suppress(OSError):
                path.unlink()
