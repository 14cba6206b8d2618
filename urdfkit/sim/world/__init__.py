"""A world as it runs: robots, bodies and models that are stepped, spawned, removed, pushed and saved.

Descriptions and requests go in; the live state comes out.
"""
