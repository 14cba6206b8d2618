"""Compile a function and all it calls as one program.

numba optimises a function and turns it into machine code as soon as it has been typed, then links it into each of its
callers, which are optimised with it again: a function five calls deep is optimised and emitted five times. Here, called
functions are only linked, and the outermost one is optimised and emitted once, together with all of them.

In addition, the signature of an operator or a numba function is resolved once per types instead of at each of its
thousands of calls, and garbage collection is off: most objects live as long as the compilation.

numba itself is unchanged; only three objects of the process are modified during the compilation: the code generator,
the target context and the typing context. `load.TESTED_VERSIONS` lists the versions of numba this was tested with; with
another version, `load` compiles in numba's standard way.
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

from urdfkit.compilation.native_entry import add_native_entry


class LinkedFunction(JITCodeLibrary):  # type: ignore[misc]
    """Unoptimised code of a function that other functions call, to be linked into an `EntryLibrary`."""

    def finalize(self) -> None:
        """Mark as ready for linking, without optimising or emitting code."""
        self._raise_if_finalized()
        self._finalized = True

    def get_pointer_to_function(self, name: str) -> int:
        """Return no address: a linked function cannot be called from Python."""
        self._ensure_finalized()
        return 0


class EntryLibrary(JITCodeLibrary):  # type: ignore[misc]
    """Code of the function that Python calls and of every function it calls."""

    def finalize(self) -> None:
        """Link every called function once, then optimise and emit all code.

        Functions that are not called from outside get internal linkage, so the optimiser may remove them.
        """
        self._raise_if_finalized()
        self._codegen._check_llvm_bugs()
        outside = {function.name for function in self.get_defined_functions()}
        for library in linked_libraries(self):
            self._reload_init.update(library._reload_init)
            module = library._final_module if isinstance(library, LinkedFunction) else library._get_module_for_linking()
            self._final_module.link_in(module, preserve=True)
        for function in self.get_defined_functions():
            if function.name not in outside:
                function.linkage = binding.Linkage.internal
        self._optimize_final_module()
        self._final_module.verify()
        self._finalize_final_module()


def linked_libraries(library: Any) -> list[Any]:
    """Return the libraries that a library links directly and indirectly, each once.

    Libraries of other types already contain the functions they call.
    """
    found: dict[Any, None] = {}
    waiting = list(library._linking_libraries)
    while waiting:
        part = waiting.pop()
        if part not in found:
            found[part] = None
            if isinstance(part, LinkedFunction):
                waiting += part._linking_libraries
    return list(found)


@contextmanager
def whole_program(entry: str) -> Iterator[None]:
    """Compile the functions of the ``with`` block as one program.

    Other threads of the process wait to compile, and only the compiled entry stays in numba's registries: the other
    functions cannot be called.

    Args:
        entry: the qualified name of the function that is called from Python.
    """
    with global_compiler_lock:
        target = cpu_target.target_context
        codegen = target.codegen()
        typing = cpu_target.typing_context
        collecting = gc.isenabled()
        subroutines = target.cached_internal_func
        subroutines_before = set(subroutines)
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
            if name != entry:
                return LinkedFunction(codegen, name, **options)
            library = EntryLibrary(codegen, name, **options)
            library.enable_object_caching()
            return library

        def create_cpython_wrapper(library: Any, *arguments: Any, **options: Any) -> None:
            if isinstance(library, EntryLibrary):
                type(target).create_cpython_wrapper(target, library, *arguments, **options)
                add_native_entry(target, library, arguments[0])

        def create_cfunc_wrapper(*arguments: Any, **options: Any) -> None:
            pass

        class DispatcherCollector(event.Listener):  # type: ignore[misc]
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
            with event.install_listener("numba:compile", DispatcherCollector()):
                yield
        finally:
            del codegen.create_library, codegen.set_env
            del target.create_cpython_wrapper, target.create_cfunc_wrapper, typing.resolve_function_type
            if collecting:
                gc.enable()
            for key in set(subroutines) - subroutines_before:
                del subroutines[key]
            for dispatcher in compiled:
                if dispatcher.py_func.__qualname__ != entry:
                    dispatcher._make_finalizer()()
                    dispatcher._reset_overloads()
        for name, environment in environments:
            if codegen._engine.is_symbol_defined(name):
                JITCPUCodegen.set_env(codegen, name, environment)
