"""Read mesh files: STL, COLLADA, OBJ and their textures.

A file goes in; triangles in metres with colours and texture coordinates come out, each file read once.
"""
