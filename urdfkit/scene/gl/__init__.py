"""Pictures by OpenGL: the same pictures as `scene.ray_images` takes by casting rays, faster, where a driver is there.

The table of shapes, colours, textures and lights are the same; only how a picture comes about differs. Whether OpenGL
works here is tried in a process of its own (`driver_probe`), because a broken driver may take its process down.
"""
