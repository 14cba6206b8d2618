"""Images from rays: lights, shadows, textures and anti-aliasing of edges.

Input: ray hits. Output: colour, depth and shape number of each pixel.
"""
