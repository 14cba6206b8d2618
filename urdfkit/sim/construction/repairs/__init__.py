"""Repairs of defective robots: inertia tensors, masses and collision shapes.

A loaded robot goes in; a robot that can be simulated and a list of repairs come out.
"""
