"""Small linear algebra for the compiled kernel: spatial vectors on tuples, linear systems in place, SIMD loads.

Numbers in, numbers out; nothing knows the arrays of the engine.
"""
