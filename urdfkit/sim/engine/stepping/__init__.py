"""One step of the engine: a robot on its plane, or a world island by island.

The arrays of the engine go in and come out one step later.
"""
