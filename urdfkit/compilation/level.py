"""The instruction set that kernels are compiled for: a level of x86-64, whatever else the processor has.

numba compiles for the processor it runs on. Compiled for a level instead, and with every operation rounded as IEEE 754
defines it, kernels compute the same bytes on every processor: wider registers and other instructions change how many
numbers are computed at once, not how one is rounded. `LEVELS` are those of the x86-64 ABI. All give the same bytes; a
processor below the first level only runs slower.

The user's settings come first: with ``NUMBA_CPU_NAME`` or ``NUMBA_CPU_FEATURES`` kernels are compiled as these say, and
with ``NUMBA_ENABLE_AVX=0`` for the level without AVX. For other architectures they are compiled as numba does.
"""

from __future__ import annotations

from functools import lru_cache

from llvmlite import binding
from numba import config

V2 = ("cx16", "sahf", "popcnt", "sse3", "ssse3", "sse4.1", "sse4.2")
LEVELS = {
    "x86-64-v3": (*V2, "avx", "avx2", "bmi", "bmi2", "f16c", "fma", "lzcnt", "movbe", "xsave"),
    "x86-64-v2": V2,
    "x86-64": (),
}
"""What a processor has to support for each level, by LLVM's names; the best level first."""
NATIVE = "native"
"""In place of a level: whatever numba is configured for."""


@lru_cache(maxsize=1)
def level() -> str:
    """Return the best of `LEVELS` that this processor supports, or `NATIVE`."""
    if config.CPU_NAME is not None or config.CPU_FEATURES is not None:
        return NATIVE
    if not binding.get_process_triple().startswith("x86_64"):
        return NATIVE
    try:
        host = binding.get_host_cpu_features()
    except RuntimeError:  # LLVM cannot tell
        host = {}
    supported = {name for name, has in host.items() if has and (config.ENABLE_AVX or not name.startswith("avx"))}
    return next(name for name, needed in LEVELS.items() if supported.issuperset(needed))
