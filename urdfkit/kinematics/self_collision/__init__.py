"""Which pairs of links of a robot collide with each other: always, sometimes or never.

A robot goes in; for each pair the number of samples, of collisions among them and the closest approach come out.
"""

from urdfkit.kinematics.self_collision.collision_matrix import CollisionMatrix, Pair, collision_matrix

__all__ = ["CollisionMatrix", "Pair", "collision_matrix"]
