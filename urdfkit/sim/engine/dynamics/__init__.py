"""Rigid-body dynamics of trees: mass matrix, bias forces, integration of configurations.

Configurations and velocities go in; mass matrices, forces and moved configurations come out.
"""
