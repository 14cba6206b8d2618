"""Compile functions with numba, once per machine and version.

A function and the types of its arguments go in; machine code comes out, loaded from the cache if possible (`load`), or
compiled as one program with all functions it calls (`whole_program`).
"""

from urdfkit.compilation.load import compile_or_load, own_sources

__all__ = ["compile_or_load", "own_sources"]
