"""Compile a function of the kernel to object code that runs without numba."""

from __future__ import annotations

from contextlib import ExitStack
from typing import Any

import numba
from llvmlite import binding
from numba.core import types
from numba.core.compiler import Flags, compile_extra
from numba.core.cpu import CPUTargetOptions
from numba.core.registry import cpu_target

from urdfkit.compilation.load import TESTED_VERSIONS
from urdfkit.kinematics.serial.kernel import entry_functions
from urdfkit.kinematics.serial.kernel.compilation import FLOATS, INTEGERS, OPTIONS

TYPES = {"floats": FLOATS, "integers": INTEGERS, "count": types.int64, "number": types.float64}
"""Type of an argument → its type in numba."""


def compile_to_object(name: str, arguments: tuple[str, ...]) -> tuple[str, bytes]:
    """Return the symbol and the object code of a function.

    The function has numba's calling convention: addresses for its result and for an exception come first.

    Args:
        name: a function of `entry_functions`.
        arguments: types of its arguments.
    """
    function = getattr(entry_functions, name)
    flags = Flags()
    options: dict[str, Any] = {**OPTIONS, "nopython": True, "no_cpython_wrapper": True, "no_cfunc_wrapper": True}
    CPUTargetOptions.parse_as_flags(flags, options)
    with ExitStack() as stack:
        if numba.__version__ in TESTED_VERSIONS:
            from urdfkit.compilation.codegen import fixed_level
            from urdfkit.compilation.whole_program import whole_program

            stack.enter_context(fixed_level())
            stack.enter_context(whole_program(function.__qualname__))
        result = compile_extra(
            cpu_target.typing_context,
            cpu_target.target_context,
            function,
            tuple(TYPES[kind] for kind in arguments),
            types.int64,
            flags,
            {},
        )
        triple, processor, features = cpu_target.target_context.codegen().magic_tuple()
        machine = binding.Target.from_triple(triple).create_target_machine(
            cpu=processor, features=features, opt=3, reloc="pic", codemodel="small", jit=True
        )
        code = machine.emit_object(binding.parse_assembly(result.library.get_llvm_str()))
    return result.fndesc.llvm_func_name, code
