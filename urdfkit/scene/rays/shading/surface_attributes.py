"""Surface attributes at a hit point: normals, colours and textures, interpolated between the corners of a triangle."""

from math import ceil, floor, hypot, log2
from typing import Any

from urdfkit.scene.rays.compilation import compiled, inlined

ATTRIBUTES = 30
"""Numbers per triangle: normals of its corners (9), their colours (9), their texture coordinates (6), index of the
texture (-1: none), opacity, specular colour and exponent (4)."""

COLORS, UV, TEXTURE, OPACITY, GLOSS = 9, 18, 24, 25, 26
"""Offsets of these attributes."""

FINEST = 8
"""Maximum number of texture samples per pixel (the same anisotropy as in Gazebo Classic)."""

SMOOTH, COLORED = 1, 2
"""Flags of a shape that uses the attributes of its triangles: normals; colours and textures."""


@compiled
def barycentric(corners: Any, at: int, x: float, y: float, z: float) -> tuple[float, float]:
    """Return the barycentric coordinates of a point of a triangle for its second and third corner."""
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
def interpolate(attributes: Any, part: int, at: int, step: int, u: float, v: float) -> float:
    """Interpolate an attribute between the corners of a triangle."""
    return float(
        (1.0 - u - v) * attributes[part, at] + u * attributes[part, at + step] + v * attributes[part, at + 2 * step]
    )


@compiled
def texel(texels: Any, first: int, width: int, height: int, s: float, t: float, channel: int) -> float:
    """Return a channel of a texture, 0..1, interpolated between four texels; the texture repeats in both directions.

    Args:
        texels: texels of all textures, four numbers each.
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
def sample_texture(
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
    """Sample a texture over the footprint of a pixel.

    Source: the OpenGL extension EXT_texture_filter_anisotropic. The number of samples along the longer side of the
    footprint is the ratio of its sides; the mip level follows from the shorter side.

    Args:
        texels: texels of all textures, each followed by its mip levels down to one texel.
        first: where this one begins.
        width: of the texture [px].
        height: of the texture [px].
        s: to the right, 0..1.
        t: upwards, 0..1.
        across: distance on the texture to the next pixel to the right.
        down: distance on the texture to the next pixel below.
        color: output, red, green, blue and opacity, 0..1; shape (4,).
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
