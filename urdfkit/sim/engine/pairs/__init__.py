"""Collisions between pairs of shapes, compiled: `collide_pair`, the broad phase, hulls and meshes as arrays."""
