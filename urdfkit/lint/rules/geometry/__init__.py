"""Rules on shapes, meshes and materials."""
