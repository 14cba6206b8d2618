"""Collisions between pairs of shapes, compiled: `collide_pair`, hulls and meshes as arrays."""
