"""Pictures from rays: lights, shadows, textures and anti-aliasing of edges.

Ray hits go in; colours, depths and shape numbers per pixel come out.
"""
