"""Compiling functions with numba, once per machine and version: see `load` and `whole_program`."""

from urdfkit.compilation.load import compile_or_load, own_sources

__all__ = ["compile_or_load", "own_sources"]
