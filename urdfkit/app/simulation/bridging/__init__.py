"""Bridges of a running simulation: the services that peers call, and the servers that `sim run` and `sim teleop` start.

The servers use threads of their own; what peers send takes effect between two steps of the simulation.
"""
