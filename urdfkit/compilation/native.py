"""Machine code in files of its own, loaded by LLVM without numba.

Importing numba and its registries takes five times as long as importing llvmlite and loading the code. A file is named
by the syntax of the sources, so that a comment does not compile anything again, and by the level of the processor.
"""

from __future__ import annotations

import ast
import ctypes
import hashlib
import json
import os
import struct
import sys
from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from functools import partial
from pathlib import Path
from typing import Any

from urdfkit.compilation.instruction_set import NATIVE, level

BUNDLED = Path(__file__).parents[1] / "machine_code"
"""Folder of a wheel with machine code for some processors; missing in a checkout."""
ENTRY = "urdfkit_entry"
"""Name of the function that `add_native_entry` adds."""
_FORMAT = 1
UNUSABLE = (OSError, ValueError, TypeError, KeyError, RuntimeError)
"""Errors of files that are missing, damaged or for another system."""
_OWN_ENTRY = ("numba_adapt_ndarray", "numba_do_raise", "numba_runtime_build_excinfo_struct", "numba_unpickle")
"""Functions that only numba's own entry calls, which is not used here."""
_NUMBA_FUNCTIONS = {"numba_ldexp": "ldexp", **dict.fromkeys(_OWN_ENTRY, "abort")}
"""Functions of numba's library in compiled code → functions of the C library in their place."""
_BEGIN, _RENAMED = b"numba_", b"urdfk_"
"""Begin of these names, and in files of machine code, so that numba in the same process keeps its own functions."""


class _Method(ctypes.Structure):
    """``PyMethodDef`` of Python's C interface."""

    _fields_ = (
        ("name", ctypes.c_char_p),
        ("function", ctypes.c_void_p),
        ("flags", ctypes.c_int),
        ("text", ctypes.c_char_p),
    )


_FASTCALL = 0x80
"""``METH_FASTCALL``."""


class NativeFunction:
    """Compiled function with arrays as its first arguments, then numbers and addresses; its result is an integer.

    Args:
        address: of its `ENTRY`.
        arrays: number of arrays.
        memory: owner of the code.
    """

    def __init__(self, address: int, arrays: int, memory: Any) -> None:
        self._method = _Method(ENTRY.encode(), address, _FASTCALL, None)
        self._arrays, self._memory = arrays, memory
        make = ctypes.pythonapi.PyCFunction_NewEx
        make.restype, make.argtypes = ctypes.py_object, [ctypes.c_void_p, ctypes.py_object, ctypes.c_void_p]
        self._make = make
        _LOADED.append(self)

    def __call__(self, *arguments: Any) -> int:
        """Call the function."""
        return self.bind(*arguments[: self._arrays])(*arguments[self._arrays :])

    def bind(self, *arrays: Any) -> Callable[..., int]:
        """Return a function of the numbers alone. The arrays must live as long as it."""
        places = [number for array in arrays for number in (array.__array_interface__["data"][0], array.size)]
        owner = struct.pack(f"{len(places)}q", *places)
        function: Callable[..., int] = self._make(ctypes.addressof(self._method), owner, None)
        return function


_LOADED: list[NativeFunction] = []
"""All of the process: functions from `NativeFunction.bind` point into them, which Python's garbage collector reads."""


def bind(function: Callable[..., int], *arrays: Any) -> Callable[..., int]:
    """Return a compiled function of numbers alone, with its arrays fixed."""
    return function.bind(*arrays) if isinstance(function, NativeFunction) else partial(function, *arrays)


class NativeCode:
    """File with the machine code of a function for these sources.

    Args:
        name: name of the function in the folder.
        sources: the files that the code is compiled from.
        folders: folders that may contain the file; it is written to the first that is writable.
    """

    def __init__(self, name: str, sources: Iterable[Path], folders: Sequence[Path]) -> None:
        self._name, self._folders = f"{name}_{_processor()}", folders
        self._sources = tuple(sources)
        self._texts = [path.read_bytes() for path in self._sources]

    @property
    def exists(self) -> bool:
        """Whether there is code for these sources, which need not be usable."""
        name = self._code_name()
        return any((folder / name).exists() for folder in self._folders)

    def load(self) -> NativeFunction | None:
        """Return the function; None if there is no code for these sources, or it cannot be loaded."""
        written = f"{self._name}_{_digest(self._texts)}.link"
        for folder in (BUNDLED, *self._folders):
            with suppress(*UNUSABLE):
                found = folder / (folder / written).read_text("utf-8")
                return _loaded(found.read_bytes())
        name = self._code_name()
        for folder in self._folders:
            with suppress(*UNUSABLE):
                function = _loaded((folder / name).read_bytes())
                with suppress(OSError):
                    (folder / written).write_text(name, "utf-8")
                return function
        return None

    def save(self, code: bytes, functions: Iterable[str], *, arrays: int) -> NativeFunction:
        """Write machine code with an `ENTRY`, remove that of earlier sources, and return the function.

        Args:
            code: object file in memory.
            functions: names of the functions that it calls.
            arrays: number of arrays among the arguments.

        Raises:
            ValueError: the function calls an unknown function.
        """
        head = {"format": _FORMAT, "functions": sorted(functions), "arrays": arrays}
        for own in map(str.encode, _NUMBA_FUNCTIONS):
            code = code.replace(own + b"\0", own.replace(_BEGIN, _RENAMED) + b"\0")
        digest = hashlib.sha256(code).hexdigest()
        content = json.dumps({**head, "digest": digest}).encode() + b"\n" + code
        for folder in self._folders:
            with suppress(OSError):
                folder.mkdir(parents=True, exist_ok=True)
                temporary = folder / f"{self._name}.{os.getpid()}"
                temporary.write_bytes(content)
                for stale in folder.glob(f"{self._name}_*"):
                    stale.unlink()
                name = self._code_name()
                temporary.replace(folder / name)
                (folder / f"{self._name}_{_digest(self._texts)}.link").write_text(name, "utf-8")
                break
        return _loaded(content)

    def _code_name(self) -> str:
        return f"{self._name}_{_digest(_syntax(text) for text in self._texts)}.o"


def _processor() -> str:
    """Return the system and the level that code is compiled for, or the processor where there are no levels."""
    if (found := level()) != NATIVE:
        return f"{sys.platform}_{found.replace('-', '_')}"
    from llvmlite import binding

    settings = [f"{name}={value}" for name, value in sorted(os.environ.items()) if name.startswith("NUMBA_CPU")]
    host = f"{binding.get_process_triple()} {binding.get_host_cpu_name()} {binding.get_host_cpu_features()} {settings}"
    return f"native_{hashlib.sha256(host.encode()).hexdigest()[:8]}"


def _digest(texts: Iterable[bytes]) -> str:
    digest = hashlib.sha256()
    for text in texts:
        digest.update(hashlib.sha256(text).digest())
    return digest.hexdigest()[:16]


def _syntax(text: bytes) -> bytes:
    """Return a module without comments, docstrings and positions."""
    tree = ast.parse(text)
    for node in ast.walk(tree):
        if isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef)):
            node.body = [each for each in node.body if not _is_text(each)]
    return ast.dump(tree).encode()


def _is_text(node: ast.stmt) -> bool:
    return isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant) and isinstance(node.value.value, str)


def _loaded(content: bytes) -> NativeFunction:
    """Return the function of a file.

    Raises:
        ValueError: the file is damaged, or a function that the code calls does not exist in this process.
    """
    from llvmlite import binding

    head, _, code = content.partition(b"\n")
    found = json.loads(head)
    if found["format"] != _FORMAT or found["digest"] != hashlib.sha256(code).hexdigest():
        raise ValueError("the file is damaged")
    binding.initialize_native_target()
    binding.initialize_native_asmprinter()
    process = ctypes.CDLL(None)
    for name in found["functions"]:
        own = getattr(process, _NUMBA_FUNCTIONS.get(name, name), None)
        if own is None:
            raise ValueError(f"unknown function {name}")
        if name in _NUMBA_FUNCTIONS:
            renamed = name.replace(_BEGIN.decode(), _RENAMED.decode())
            binding.add_symbol(renamed, ctypes.cast(own, ctypes.c_void_p).value)
    machine = binding.Target.from_default_triple().create_target_machine(jit=True)
    memory = binding.create_mcjit_compiler(binding.parse_assembly(""), machine)
    memory.add_object_file(binding.ObjectFileRef.from_data(code))
    memory.finalize_object()
    return NativeFunction(memory.get_function_address(ENTRY), found["arrays"], memory)


def cache_folders(sources: Path) -> tuple[Path, ...]:
    """Return the folders for machine code: that of numba's setting, else next to the sources, and that of the user."""
    if setting := os.environ.get("NUMBA_CACHE_DIR"):
        return (Path(setting) / "urdfkit",)
    with suppress(RuntimeError):  # no home folder
        place = os.environ.get("XDG_CACHE_HOME", "")
        user = Path(place) if Path(place).is_absolute() else Path.home() / ".cache"
        return sources / "__pycache__", user / "urdfkit" / "kernels"
    return (sources / "__pycache__",)


def write_native(code: NativeCode, dispatcher: Any, *, arrays: int) -> NativeFunction | None:
    """Write the machine code of a compiled function; None if it was not compiled as one program with an entry."""
    library = next(iter(dispatcher.overloads.values())).library
    functions = {each.name for each in library._final_module.functions if each.is_declaration}
    defined = {each.name for each in library.get_defined_functions()}
    with suppress(AttributeError, RuntimeError, ValueError):
        if ENTRY in defined:
            called = {name for name in functions if not name.startswith("llvm.")}
            return code.save(library._get_compiled_object(), called, arrays=arrays)
    return None
