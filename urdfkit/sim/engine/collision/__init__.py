"""Collisions between pairs of shapes, compiled: primitives, convex hulls (GJK, EPA) and meshes.

Two shapes and their placements go in; contact points with normals and gaps come out.
"""
