"""From robots, bodies and shapes to the engine's arrays.

Kinematic models and scene shapes go in; one block of floats and one of integers come out.
"""
