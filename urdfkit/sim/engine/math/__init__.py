"""Small linear algebra for the compiled kernel: spatial vectors on tuples, linear systems in place, SIMD loads.

Numbers go in and come out; the functions are independent of the engine's arrays.
"""
