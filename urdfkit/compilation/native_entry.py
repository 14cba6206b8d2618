"""Entry of compiled code that Python calls without numba.

It is a built-in function of Python (``METH_FASTCALL``). Its arguments are the numbers, and its ``self`` is a bytes
object with the address and the length of each array.
"""

from __future__ import annotations

from typing import Any

from llvmlite import ir
from numba.core import cgutils
from numba.core import types as numba_types
from numba.np.arrayobj import make_array, populate_array

from urdfkit.compilation.native import ENTRY

types: Any = numba_types
_INT = ir.IntType(64)
_OBJECT = ir.IntType(8).as_pointer()
FAILED = -(1 << 63)
"""Result of a function that raised an exception."""


def add_native_entry(target: Any, library: Any, function: Any) -> None:
    """Add `ENTRY` to a library, which releases the lock of the interpreter while the function runs.

    Functions with other arguments than arrays of one dimension, integers, truth values and pointers, or with another
    result than an integer, get no entry.

    Args:
        target: numba's target context.
        library: library with the function.
        function: numba's descriptor of the function.
    """
    kinds = function.argtypes
    arrays = [isinstance(kind, types.Array) and kind.ndim == 1 and kind.layout == "C" for kind in kinds]
    numbers = [isinstance(kind, (types.Integer, types.Boolean, types.CPointer)) for kind in kinds]
    ordered = arrays == sorted(arrays, reverse=True)
    result_type = types.unliteral(function.restype)
    if not ordered or not all(a or b for a, b in zip(arrays, numbers, strict=True)) or result_type != types.int64:
        return
    module = target.create_module("native_entry")
    called = ir.Function(module, target.call_conv.get_function_type(function.restype, kinds), function.llvm_func_name)
    entry = ir.Function(module, ir.FunctionType(_OBJECT, [_OBJECT, _OBJECT.as_pointer(), _INT]), ENTRY)
    owner, arguments, count = entry.args
    builder = ir.IRBuilder(entry.append_basic_block("entry"))
    with builder.if_then(builder.icmp_signed("!=", count, ir.Constant(_INT, numbers.count(True))), likely=False):
        _call(builder, "PyErr_BadArgument", ir.IntType(32))
        builder.ret(_OBJECT(None))
    places = [builder.load(builder.gep(arguments, [ir.Constant(_INT, k)])) for k in range(numbers.count(True))]
    values = [_call(builder, "PyLong_AsLongLong", _INT, place) for place in places]
    blocks = builder.bitcast(_call(builder, "PyBytes_AsString", _OBJECT, owner), _INT.as_pointer())
    passed = []
    for k, kind in enumerate(kinds):
        if arrays[k]:
            address, length = (builder.load(builder.gep(blocks, [ir.Constant(_INT, 2 * k + j)])) for j in (0, 1))
            passed.append(_array(target, builder, kind, address, length))
        elif isinstance(kind, types.Boolean):
            passed.append(builder.icmp_signed("!=", values.pop(0), ir.Constant(_INT, 0)))
        elif isinstance(kind, types.CPointer):
            passed.append(builder.inttoptr(values.pop(0), target.get_value_type(kind)))
        else:
            passed.append(values.pop(0))
    thread = _call(builder, "PyEval_SaveThread", _OBJECT)
    status, result = target.call_conv.call_function(builder, called, function.restype, kinds, passed)
    _call(builder, "PyEval_RestoreThread", ir.VoidType(), thread)
    result = builder.select(status.is_error, ir.Constant(_INT, FAILED), result)
    builder.ret(_call(builder, "PyLong_FromLongLong", _OBJECT, result))
    library.add_ir_module(module)


def _call(builder: Any, name: str, result: Any, *arguments: Any) -> Any:
    """Call a function of Python's C interface."""
    kind = ir.FunctionType(result, [each.type for each in arguments])
    return builder.call(cgutils.get_or_insert_function(builder.module, kind, name), arguments)


def _array(target: Any, builder: Any, kind: Any, address: Any, length: Any) -> Any:
    """Return an array of compiled code with entries at an address."""
    array = make_array(kind)(target, builder)
    size = target.get_constant(types.intp, target.get_abi_sizeof(target.get_data_type(kind.dtype)))
    populate_array(
        array,
        data=builder.inttoptr(address, array.data.type),
        shape=cgutils.pack_array(builder, [length]),
        strides=cgutils.pack_array(builder, [size]),
        itemsize=size,
        meminfo=None,
    )
    return array._getvalue()
