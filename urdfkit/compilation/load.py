"""A compiled function: found in numba's cache, or compiled and put there."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from types import FunctionType
from typing import Any

import numba

BROKEN_CACHE = (RuntimeError, OSError, EOFError, ValueError, TypeError, AttributeError)
"""What numba raises where it has no writable place for its cache, or finds a broken one."""


def compile_or_load(
    function: Callable[..., Any], arguments: tuple[Any, ...], *, digest: str, options: Mapping[str, Any]
) -> Any:
    """Compile a function for these types of arguments, or load what was compiled before.

    numba finds a function's cache by its name and checks the file it is in, not those of the functions it calls. So the
    name carries a digest of them all: no change of a source can meet a stale kernel.

    Args:
        function: plain Python, written for numba.
        arguments: their numba types.
        digest: of the sources of all that the function calls.
        options: numba's.
    """
    named = FunctionType(function.__code__, function.__globals__, function.__name__)
    named.__qualname__ = f"{function.__name__}_{digest[:16]}"
    try:
        dispatcher = _compile(named, arguments, cache=True, **options)
    except BROKEN_CACHE:
        dispatcher = _compile(named, arguments, **options)
    dispatcher.disable_compile()
    return dispatcher


def _compile(named: FunctionType, arguments: tuple[Any, ...], **options: Any) -> Any:
    """Compile as one program; where this numba is not made as we take it to be, as numba does."""
    try:
        from urdfkit.compilation.whole import whole_program

        dispatcher = numba.njit(named, **options)
        with whole_program(named.__qualname__):
            dispatcher.compile(arguments)
    except Exception:  # anything: it reaches into numba's inner parts, and a mistake in `named` is met again below
        dispatcher = numba.njit(named, **options)
        dispatcher.compile(arguments)
    return dispatcher


def own_sources() -> bytes:
    """Return what a digest holds besides the sources of the kernels: how they are compiled."""
    return b"".join(path.read_bytes() for path in sorted(Path(__file__).parent.glob("*.py")))
