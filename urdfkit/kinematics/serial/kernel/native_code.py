"""Machine code of the kernel: compiled with numba once, then loaded from a file without importing numba or numpy."""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from functools import partial
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from urdfkit.errors import MissingDependencyError

SIGNATURES = {
    "forward": ("floats", "integers", "count", "count", "floats", "count", "floats", "floats", "count", "floats"),
    "solve": (
        *("floats", "integers", "count", "count", "floats", "floats", "integers", "count", "floats", "count"),
        *("floats", "count", "count", "floats", "floats"),
    ),
}
"""Function of `entry_functions` → the types of its arguments."""

Compiling = Callable[[str], None]
"""Called with a message before a compilation starts."""

_functions: dict[str, Callable[..., int]] = {}


def function(name: str, compiling: Compiling | None = None) -> Callable[..., int]:
    """Return a function of the kernel; its arrays are passed as addresses, zero for none.

    Args:
        name: a name of `SIGNATURES`.
        compiling: called before a compilation.

    Raises:
        MissingDependencyError: numba is not installed.
    """
    if name not in _functions:
        if find_spec("llvmlite") is None or find_spec("numba") is None:
            raise MissingDependencyError("ik and jacobian need numba: pip install 'urdfkit[sim]'")
        from urdfkit.compilation import own_sources
        from urdfkit.compilation.native import NativeCode, cache_folders

        here = Path(__file__).parent
        code = NativeCode(f"serial_{name}", (*own_sources(), *sorted(here.glob("*.py"))), cache_folders(here))
        native = code.load()
        _functions[name] = native.bind() if native else _compiled(name, code, compiling)
    return _functions[name]


def _compiled(name: str, code: Any, compiling: Compiling | None) -> Callable[..., int]:
    """Compile a function with numba and write its machine code."""
    from urdfkit.compilation import compile_or_load
    from urdfkit.compilation.native import write_native
    from urdfkit.description.xml.cost_limit import excluded

    if compiling is not None:
        compiling("compiling the kinematics kernel, once, about 6 s …")
    with excluded():
        import numba

        from urdfkit.kinematics.serial.kernel import entry_functions
        from urdfkit.kinematics.serial.kernel.compilation import FLOATS, INTEGERS, OPTIONS

        types = {"floats": FLOATS, "integers": INTEGERS, "count": numba.int64}
        arguments = tuple(types[kind] for kind in SIGNATURES[name])
        python = getattr(entry_functions, name)
        dispatcher = compile_or_load(python, arguments, digest=name, options=OPTIONS, cache=False)
        if native := write_native(code, dispatcher, arrays=0):
            return native.bind()
        # An untested version of numba: the code has no entry of its own.
        callback = numba.cfunc(numba.int64(*arguments), **OPTIONS)(python)
    call = ctypes.CFUNCTYPE(ctypes.c_int64, *(ctypes.c_int64 for _ in arguments))(callback.address)
    return partial(_call, call, callback)


def _call(function: Callable[..., int], owner: Any, *arguments: int) -> int:
    """Call a function whose code lives as long as `owner`."""
    return function(*arguments)
