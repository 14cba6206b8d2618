"""Snapshots: the state of a simulation as bytes, to restore it later or in another process.

`object_state` saves the objects of plugins, `contents` the whole simulation, and `snapshot` adds a header.
"""
