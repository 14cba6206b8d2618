"""Compile a function and all it calls as one program.

numba optimises a function and turns it into machine code as soon as it has been typed, then links it into each of its
callers, which are optimised with it once more: what lies five calls deep is optimised five times, and emitted as often.
Here the functions that are called wait, and only the outermost is optimised and emitted, with all of them in it.

Besides, what an operator or a function of numba's own takes and returns is asked once for the same types, not at each
of its thousands of places, and no garbage is collected: most objects live as long as the compilation.

This changes nothing in numba itself, but three objects of one process while it lasts: the code generator, the target
and the typing context that make a function of Python into one of the machine. The versions of numba that it was
checked with are in `CHECKED`; where one is made otherwise, `load` compiles as numba does.
"""

from __future__ import annotations

import gc
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from llvmlite import binding
from numba.core import event, types
from numba.core.codegen import JITCodeLibrary, JITCPUCodegen
from numba.core.compiler_lock import global_compiler_lock
from numba.core.registry import cpu_target

CHECKED = ("0.68.1",)
"""Versions of numba whose inner parts are known to be as this module takes them; with others they are likely to be."""


class Part(JITCodeLibrary):  # type: ignore[misc]
    """The code of a function that others call: simplified alone, it waits for the program that it is part of."""

    def finalize(self) -> None:
        """Be ready to be linked; nothing is optimised or emitted."""
        self._raise_if_finalized()
        self._finalized = True

    def get_pointer_to_function(self, name: str) -> int:
        """Return no address: a part cannot be called from Python."""
        self._ensure_finalized()
        return 0


class Program(JITCodeLibrary):  # type: ignore[misc]
    """The code of the function that is called from Python, and of all that it calls."""

    def finalize(self) -> None:
        """Link every part once, then optimise and emit them all.

        What is not called from outside is internal to the program: the optimiser need not keep it.
        """
        self._raise_if_finalized()
        self._codegen._check_llvm_bugs()
        outside = {function.name for function in self.get_defined_functions()}
        for library in parts(self):
            self._reload_init.update(library._reload_init)
            module = library._final_module if isinstance(library, Part) else library._get_module_for_linking()
            self._final_module.link_in(module, preserve=True)
        for function in self.get_defined_functions():
            if function.name not in outside:
                function.linkage = binding.Linkage.internal
        self._optimize_final_module()
        self._final_module.verify()
        self._finalize_final_module()


def parts(library: Any) -> list[Any]:
    """Return the libraries that one calls, and those that they call, each once.

    A library that is no part of a program has in it whatever it calls.
    """
    found: dict[Any, None] = {}
    waiting = list(library._linking_libraries)
    while waiting:
        part = waiting.pop()
        if part not in found:
            found[part] = None
            if isinstance(part, Part):
                waiting += part._linking_libraries
    return list(found)


@contextmanager
def whole_program(entry: str) -> Iterator[None]:
    """Compile, while this lasts, functions as parts of one program.

    Nobody else in the process compiles meanwhile, and nothing that was compiled here other than the entry is left for
    others to find: it could not be called.

    Args:
        entry: the qualified name of the function that is called from Python.
    """
    with global_compiler_lock:
        target = cpu_target.target_context
        codegen = target.codegen()
        typing = cpu_target.typing_context
        collecting = gc.isenabled()
        subroutines = target.cached_internal_func
        known = set(subroutines)
        environments: list[tuple[str, Any]] = []
        compiled: list[Any] = []
        resolved: dict[tuple[Any, ...], Any] = {}

        def resolve_function_type(function: Any, arguments: Any, named: Any) -> Any:
            if named or not isinstance(function, types.Function):
                return type(typing).resolve_function_type(typing, function, arguments, named)
            key = (function, tuple(arguments))
            if key not in resolved:
                resolved[key] = type(typing).resolve_function_type(typing, function, arguments, named)
            return resolved[key]

        def create_library(name: str, **options: Any) -> Any:
            return (Program if name == entry else Part)(codegen, name, **options)

        def create_cpython_wrapper(library: Any, *arguments: Any, **options: Any) -> None:
            if isinstance(library, Program):
                type(target).create_cpython_wrapper(target, library, *arguments, **options)

        def create_cfunc_wrapper(*arguments: Any, **options: Any) -> None:
            pass

        class Listener(event.Listener):  # type: ignore[misc]
            def on_start(self, event: Any) -> None:
                compiled.append(event.data["dispatcher"])

            def on_end(self, event: Any) -> None:
                pass

        codegen.create_library = create_library
        codegen.set_env = lambda name, environment: environments.append((name, environment))
        target.create_cpython_wrapper = create_cpython_wrapper
        target.create_cfunc_wrapper = create_cfunc_wrapper
        typing.resolve_function_type = resolve_function_type
        gc.disable()
        try:
            with event.install_listener("numba:compile", Listener()):
                yield
        finally:
            del codegen.create_library, codegen.set_env
            del target.create_cpython_wrapper, target.create_cfunc_wrapper, typing.resolve_function_type
            if collecting:
                gc.enable()
            for key in set(subroutines) - known:
                del subroutines[key]
            for dispatcher in compiled:
                if dispatcher.py_func.__qualname__ != entry:
                    dispatcher._make_finalizer()()
                    dispatcher._reset_overloads()
        for name, environment in environments:
            if codegen._engine.is_symbol_defined(name):
                JITCPUCodegen.set_env(codegen, name, environment)
