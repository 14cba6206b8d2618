"""The instruction set that kernels are compiled for: a level of x86-64, whatever else the processor has.

numba compiles for the processor it runs on, so that each has its own machine code, and its own last bits. The levels
are those of the x86-64 ABI. Processors since Intel's Haswell (2013) and AMD's Excavator (2015) run the code of the
first, and compute the same bytes. Others, which lack fused multiply-add (Pentium, Celeron and Atom of some later years
among them), run slower code, which rounds otherwise where a kernel lets a product and a sum be one instruction.

The user's settings come first: with ``NUMBA_CPU_NAME`` or ``NUMBA_CPU_FEATURES`` kernels follow these variables, and
with ``NUMBA_ENABLE_AVX=0`` for the level without AVX. For other architectures they are compiled as numba does.
"""

from __future__ import annotations

import os
from functools import lru_cache

from llvmlite import binding

V2 = ("cx16", "sahf", "popcnt", "sse3", "ssse3", "sse4.1", "sse4.2")
LEVELS = {
    "x86-64-v3": (*V2, "avx", "avx2", "bmi", "bmi2", "f16c", "fma", "lzcnt", "movbe", "xsave"),
    "x86-64-v2": V2,
    "x86-64": (),
}
"""Level → the features a processor must support, by LLVM's names; the best level first."""
BEYOND = "-adx,-aes,-clflushopt,-fsgsbase,-invpcid,-pclmul,-prfchw,-rdrnd,-rdseed,-sgx,-xsavec,-xsaveopt,-xsaves"
TUNED = {"x86-64-v3": ("skylake", BEYOND)}
"""The processor that code of a level is arranged for, and the features it has beyond the level. This changes the order
of instructions, not what they compute; some kernels are up to 8 % faster than with LLVM's processor ``x86-64-v3``."""
NATIVE = "native"
"""In place of a level: whatever numba is configured for."""


@lru_cache(maxsize=1)
def level() -> str:
    """Return the best of `LEVELS` that this processor supports, or `NATIVE`."""
    if "NUMBA_CPU_NAME" in os.environ or "NUMBA_CPU_FEATURES" in os.environ:
        return NATIVE
    if not binding.get_process_triple().startswith("x86_64"):
        return NATIVE
    avx = os.environ.get("NUMBA_ENABLE_AVX", "1") != "0"
    try:
        host = binding.get_host_cpu_features()
    except RuntimeError:  # LLVM cannot detect the features
        host = {}
    supported = {name for name, has in host.items() if has and (avx or not name.startswith("avx"))}
    return next(name for name, needed in LEVELS.items() if supported.issuperset(needed))
