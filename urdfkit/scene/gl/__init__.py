"""Images by OpenGL: the same images as `scene.ray_renderer`, faster with a suitable driver.

Input: the same table of shapes, colours, textures and lights. Output: images. `driver_probe` tests OpenGL in a separate
process, because a broken driver may crash its process.
"""
