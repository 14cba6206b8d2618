"""Mass properties in plain Python: inertia of solids and links, principal moments, inertia formulas in macros.

Input: shapes and tensors; output: volumes, inertia tensors and the most similar formula.
"""
