"""Strict reader of SDF 1.4 to 1.11: converts a file to a `World` or `Model` with resolved poses.

One module per part of the format.
"""
