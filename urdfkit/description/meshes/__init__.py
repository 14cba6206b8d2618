"""Bounding boxes of mesh files, without a library.

A path goes in; the lowest and highest corner come out, from all vertices or estimated from a sample of them.
"""
