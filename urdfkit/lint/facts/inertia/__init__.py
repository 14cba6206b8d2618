"""Mass properties in plain Python: inertia of solids and links, principal moments, inertia formulas in macros.

Shapes and tensors go in; volumes, inertia and the nearest known formula come out.
"""
