"""Limits of mesh files: larger files are not read."""

MAX_BYTES = 256 * 2**20
"""Largest supported mesh file [byte]."""

MAX_TRIANGLES = 5_000_000
"""Largest number of triangles in one mesh."""
