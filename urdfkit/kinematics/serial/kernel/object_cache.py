"""Machine code of the kernel: compiled with numba once, then loaded from a file without importing numba or numpy.

numba's import and its cache take longer than a process that solves one pose. Therefore the object code is stored, and
LLVM links it into the process. The functions are called with ctypes, which releases Python's lock.
"""

from __future__ import annotations

import ctypes
import os
import sys
import zlib
from collections.abc import Callable
from functools import lru_cache
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from urdfkit.errors import MissingDependencyError

KINDS = {"floats": ctypes.c_void_p, "integers": ctypes.c_void_p, "count": ctypes.c_int64, "number": ctypes.c_double}
"""Type of an argument → its type in ctypes."""
SIGNATURES = {
    "forward": ("floats", "integers", "count", "count", "floats", "count", "floats", "floats", "count", "floats"),
    "solve": (
        *("floats", "integers", "count", "count", "floats", "floats", "integers", "count", "floats", "count"),
        *("floats", "count", "count", "floats", "floats"),
    ),
}
"""Function of `entry_functions` → the types of its arguments."""
VARIABLES = ("NUMBA_CPU_NAME", "NUMBA_CPU_FEATURES", "NUMBA_ENABLE_AVX")
"""Settings of numba that change the code."""
MAGIC = b"urdfkit object 1\n"

Compiling = Callable[[str], None]
"""Called with a message before a compilation starts."""


_functions: dict[str, tuple[Callable[..., int], Any]] = {}
"""Function → its code, and the engine that keeps the code in memory."""


def function(name: str, compiling: Compiling | None = None) -> Callable[..., int]:
    """Return a function of the kernel; its arrays are passed as addresses.

    Args:
        name: a name of `SIGNATURES`.
        compiling: called before a compilation.

    Raises:
        MissingDependencyError: numba is not installed.
    """
    if name not in _functions:
        _functions[name] = _loaded(name, compiling)
    return _functions[name][0]


def _loaded(name: str, compiling: Compiling | None) -> tuple[Callable[..., int], Any]:
    """Load the object code of a function or compile it, and link it into this process."""
    if find_spec("llvmlite") is None or find_spec("numba") is None:
        raise MissingDependencyError("ik and jacobian need numba: pip install 'urdfkit[sim]'")
    symbol, code = _stored(name) or _compiled(name, compiling)
    from llvmlite import binding

    binding.initialize_native_target()
    binding.initialize_native_asmprinter()
    machine = binding.Target.from_default_triple().create_target_machine(jit=True)
    # llvmlite's own memory keeps code and constants near each other, as the small code model requires.
    engine = binding.create_mcjit_compiler(binding.parse_assembly(""), machine, use_lmm=True)
    engine.add_object_file(binding.ObjectFileRef.from_data(code))
    engine.finalize_object()
    native = ctypes.CFUNCTYPE(
        ctypes.c_int32, ctypes.c_void_p, ctypes.c_void_p, *(KINDS[kind] for kind in SIGNATURES[name])
    )(engine.get_function_address(symbol))

    def call(*arguments: Any) -> int:
        result, error = ctypes.c_int64(), ctypes.c_void_p()
        native(ctypes.byref(result), ctypes.byref(error), *arguments)
        return result.value

    return call, (engine, code)


def _stored(name: str) -> tuple[str, bytes] | None:
    """Return the symbol and the object code of a function; None if no valid file has it."""
    for folder in _folders():
        try:
            content = (folder / _file_name(name)).read_bytes()
        except OSError:
            continue
        head, _, code = content[len(MAGIC) :].partition(b"\n")
        checksum, _, symbol = head.partition(b" ")
        if content.startswith(MAGIC) and checksum == b"%08x" % zlib.crc32(code):
            return symbol.decode(), code
    return None


def _compiled(name: str, compiling: Compiling | None) -> tuple[str, bytes]:
    """Compile a function with numba and store its object code."""
    from urdfkit.atomic import write_bytes
    from urdfkit.description.xml.cost_limit import excluded
    from urdfkit.errors import ResourceError
    from urdfkit.kinematics.serial.kernel.native_code import compile_to_object

    if compiling is not None:
        compiling("compiling the kinematics kernel, once, about 6 s …")
    with excluded():
        symbol, code = compile_to_object(name, SIGNATURES[name])
    content = MAGIC + b"%08x %s\n" % (zlib.crc32(code), symbol.encode()) + code
    for folder in _folders():
        try:
            folder.mkdir(parents=True, exist_ok=True)
            write_bytes(folder / _file_name(name), content)
        except (OSError, ResourceError):
            continue
        _remove_stale(folder, name)
        break
    return symbol, code


def _remove_stale(folder: Path, name: str) -> None:
    """Remove the code of other sources."""
    for path in folder.glob(f"serial-{name}-*.o"):
        if path.name.split("-")[2] != _sources():
            path.unlink(missing_ok=True)


def _folders() -> list[Path]:
    """Return the folders for object code, the preferred one first."""
    if named := os.environ.get("NUMBA_CACHE_DIR"):
        return [Path(named)]
    place = os.environ.get("XDG_CACHE_HOME")
    user = Path(place) if place and Path(place).is_absolute() else Path(os.path.expanduser("~")) / ".cache"  # noqa: PTH111
    return [Path(__file__).parent / "__pycache__", user / "urdfkit" / "kernels"]


@lru_cache(maxsize=1)
def _sources() -> str:
    """Return a checksum of the sources of the kernel and of its compilation."""
    folders = (Path(__file__).parent, Path(__file__).parents[3] / "compilation")  # importing the latter imports numba
    checksum = 0
    for path in (path for folder in folders for path in sorted(folder.glob("*.py"))):
        checksum = zlib.crc32(path.read_bytes(), checksum)
    return f"{checksum:08x}"


@lru_cache
def _file_name(name: str) -> str:
    """Return the name of the file: with the sources, LLVM's version, the processor and the settings of numba."""
    import llvmlite
    from llvmlite import binding

    try:
        features = binding.get_host_cpu_features().flatten()
    except RuntimeError:  # LLVM cannot detect them
        features = ""
    machine = (
        *(llvmlite.__version__, binding.get_process_triple(), binding.get_host_cpu_name(), features, sys.byteorder),
        *(os.environ.get(variable, "") for variable in VARIABLES),
    )
    return f"serial-{name}-{_sources()}-{zlib.crc32(repr(machine).encode()):08x}.o"
