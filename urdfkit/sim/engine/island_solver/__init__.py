"""Solve the rows of an island of several trees, in blocks: active sets, augmented Lagrangian, Gauss-Seidel.

Rows and mass matrices of the trees go in; velocities and impulses come out.
"""
