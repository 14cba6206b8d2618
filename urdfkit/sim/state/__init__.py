"""State and commands of a robot: poses, velocities, joint commands, energy, and when periodic work is due.

Reads the arrays of the engine and gives plugins, subscribers and users read-only views of them.
"""
