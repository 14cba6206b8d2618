"""What the page shows, as messages: meshcat objects, meshes, joints, properties of links.

A robot or a scene goes in; commands for the browser come out.
"""
