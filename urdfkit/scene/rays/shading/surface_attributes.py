"""What a surface looks like where a ray met it: smooth normals, colours and textures between a triangle's corners."""

from __future__ import annotations

from math import ceil, floor, hypot, log2
from typing import Any

from urdfkit.scene.rays.compilation import compiled, inlined

SKIN = 30
"""Numbers per triangle: normals of its corners (9), their colours (9), where on the texture they are (6), which texture
(-1: none), opacity, colour and exponent of its gloss (4)."""

HUE, UV, TEXTURE, OPACITY, GLOSS = 9, 18, 24, 25, 26
"""Where in a skin these begin."""

FINEST = 8
"""Places on a texture that a pixel takes its colour from, at most (Gazebo classic filters as anisotropically)."""

SMOOTH, OWN = 1, 2
"""What a shape takes from its triangles' skins: normals; colours and textures."""


@compiled
def place_in_triangle(corners: Any, at: int, x: float, y: float, z: float) -> tuple[float, float]:
    """Return how much of a triangle's second and third corner there is at a point on it."""
    px, py, pz = x - corners[at], y - corners[at + 1], z - corners[at + 2]
    ax, ay, az = corners[at + 3], corners[at + 4], corners[at + 5]
    bx, by, bz = corners[at + 6], corners[at + 7], corners[at + 8]
    aa, ab, bb = ax * ax + ay * ay + az * az, ax * bx + ay * by + az * bz, bx * bx + by * by + bz * bz
    pa, pb = px * ax + py * ay + pz * az, px * bx + py * by + pz * bz
    under = aa * bb - ab * ab
    if under <= 0.0:
        return 0.0, 0.0
    u = min(max((bb * pa - ab * pb) / under, 0.0), 1.0)
    v = min(max((aa * pb - ab * pa) / under, 0.0), 1.0 - u)
    return u, v


@inlined
def between(skins: Any, part: int, at: int, step: int, u: float, v: float) -> float:
    """Return a number that a skin gives at the corners, between them."""
    return float((1.0 - u - v) * skins[part, at] + u * skins[part, at + step] + v * skins[part, at + 2 * step])


@compiled
def texel(texels: Any, first: int, width: int, height: int, s: float, t: float, channel: int) -> float:
    """Return a texture's channel, 0..1, between four texels; it repeats in both directions.

    Args:
        texels: of all textures, four numbers each.
        first: where this one begins.
        width: of the texture [px].
        height: of the texture [px].
        s: to the right, 0..1.
        t: upwards, 0..1.
        channel: red, green, blue or opacity.
    """
    x, y = (s - floor(s)) * width - 0.5, (1.0 - (t - floor(t))) * height - 0.5
    left, top = floor(x), floor(y)
    fx, fy = x - left, y - top
    x0, y0 = int(left) % width, int(top) % height
    x1, y1 = (x0 + 1) % width, (y0 + 1) % height
    a = texels[first + 4 * (y0 * width + x0) + channel]
    b = texels[first + 4 * (y0 * width + x1) + channel]
    c = texels[first + 4 * (y1 * width + x0) + channel]
    d = texels[first + 4 * (y1 * width + x1) + channel]
    return float(((1.0 - fy) * ((1.0 - fx) * a + fx * b) + fy * ((1.0 - fx) * c + fx * d)) / 255.0)


@compiled
def dye(
    texels: Any,
    first: int,
    width: int,
    height: int,
    s: float,
    t: float,
    across: tuple[float, float],
    down: tuple[float, float],
    color: Any,
) -> None:
    """Take a colour from what a pixel covers of a texture.

    Source: the OpenGL extension EXT_texture_filter_anisotropic: as many places along the longer side of what is covered
    as the shorter goes into it, each as blurred as that.

    Args:
        texels: of all textures, each followed by its smaller copies, halved until one texel is left.
        first: where this one begins.
        width: of the texture [px].
        height: of the texture [px].
        s: to the right, 0..1.
        t: upwards, 0..1.
        across: how far the next pixel beside is on the texture.
        down: how far the next one below.
        color: becomes red, green, blue and opacity, 0..1; shape (4,).
    """
    long, short = hypot(across[0] * width, across[1] * height), hypot(down[0] * width, down[1] * height)
    along_s, along_t = across
    if short > long:
        long, short = short, long
        along_s, along_t = down
    count = int(min(max(ceil(long / max(short, 1.0)), 1.0), FINEST))
    level, lower = log2(max(long / count, 1.0)), 0
    while lower + 1 <= level and (width > 1 or height > 1):
        first += 4 * width * height
        width, height = max(width // 2, 1), max(height // 2, 1)
        lower += 1
    part = level - lower if width > 1 or height > 1 else 0.0
    after, wide, high = first + 4 * width * height, max(width // 2, 1), max(height // 2, 1)
    for c in range(4):
        color[c] = 0.0
    for k in range(count):
        shift = (k + 0.5) / count - 0.5
        u, v = s + shift * along_s, t + shift * along_t
        for c in range(4):
            found = texel(texels, first, width, height, u, v, c)
            if part > 0.0:
                found += part * (texel(texels, after, wide, high, u, v, c) - found)
            color[c] += found / count
