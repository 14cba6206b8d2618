"""numba's code generator for a fixed level of x86-64, in addition to the default one."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from functools import lru_cache
from typing import Any

from numba.core.codegen import JITCPUCodegen
from numba.core.compiler_lock import global_compiler_lock
from numba.core.registry import cpu_target

from urdfkit.compilation.instruction_set import NATIVE, TUNED, level


class LevelCodegen(JITCPUCodegen):  # type: ignore[misc]
    """Code generator of numba for one level, which becomes part of numba's cache key."""

    def _get_host_cpu_name(self) -> str:
        """Return the processor, by LLVM's name; a level is one, too."""
        return TUNED.get(level(), (level(), ""))[0]

    def _get_host_cpu_features(self) -> str:
        """Return the features of that processor that are not in the level."""
        return TUNED.get(level(), (level(), ""))[1]


@lru_cache(maxsize=1)
def codegen() -> Any:
    """Return the code generator of this process: code lives as long as the generator that made it."""
    return LevelCodegen("urdfkit")


@contextmanager
def fixed_level() -> Iterator[None]:
    """Compile for `level` in the ``with`` block, and load code of that level from numba's cache.

    Other threads of the process wait to compile; functions compiled elsewhere are unaffected.
    """
    if level() == NATIVE:
        yield
        return
    with global_compiler_lock:
        target = cpu_target.target_context
        target.refresh()
        native, subroutines = target._internal_codegen, target.cached_internal_func
        target._internal_codegen, target.cached_internal_func = codegen(), {}
        try:
            yield
        finally:
            target._internal_codegen, target.cached_internal_func = native, subroutines
