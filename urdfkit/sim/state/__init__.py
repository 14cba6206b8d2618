"""State and commands of a robot: poses, velocities, joint commands, energy, and when periodic work is due.

Arrays of the engine go in; read-only views for plugins, subscribers and users come out.
"""
