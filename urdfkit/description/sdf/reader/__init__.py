"""Read SDF 1.4 to 1.11 strictly: a file goes in, a `World` or `Model` with resolved poses comes out.

One module per part of the format.
"""
