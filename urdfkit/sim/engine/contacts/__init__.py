"""Find contacts: broad phase, narrow phase, the ground plane, and the impulses of the last step as a warm start.

Poses of shapes go in; contact points with normals, gaps and friction directions come out.
"""
