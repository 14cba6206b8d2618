"""Benchmarks next to MuJoCo and PyBullet: the same scenes, the same step, in turns.

Scenes go in; speeds, ratios and whether each engine did what the scene demands come out.
"""
