"""What a camera sees: colours under lights with shadows, depth and which shape, in one pass over its pixels' rays.

Surfaces are matt (Lambert): colour · (ambient + Σ light · cos θ · falloff), each light seen or not by a ray of its own.
Those with a gloss shine besides: gloss · Σ specular light · falloff · max(n·h, 0) ^ exponent, h half way between light
and eye (Blinn, *Models of Light Reflection for Computer Synthesized Pictures*, 1977), as OGRE draws them.
Falloff is ``1 / (constant + linear·r + quadratic·r²)`` within the light's range, as in OGRE's fixed functions, which
Gazebo draws with; a spot fades between its two cones. Transparent surfaces are blended with what is behind them and
cast no shadow.
"""

from __future__ import annotations

from math import inf
from typing import Any

from urdfkit.scene.rays.compilation import compiled
from urdfkit.scene.rays.primitives import STRIDE
from urdfkit.scene.rays.ray_casting import load, walk
from urdfkit.scene.rays.ray_packet import DX, HIT, OX, PART, REACH, WIDTH
from urdfkit.scene.rays.shading.direct_lighting import shine
from urdfkit.scene.rays.shading.shading_buffers import (
    AT,
    BLENT,
    COLOR,
    DEPTH,
    DYE,
    EXPONENT,
    FACING,
    FIRST,
    LEFT,
    OPAQUE,
    PAST,
    SHAPE,
    SHEEN,
    SHONE,
    SPECULAR,
    TOWARDS,
)
from urdfkit.scene.rays.shading.surface_attributes import (
    GLOSS,
    HUE,
    OPACITY,
    OWN,
    SMOOTH,
    TEXTURE,
    UV,
    between,
    dye,
    place_in_triangle,
)
from urdfkit.scene.rays.surface_normals import normal, outwards, point, triangle_normal
from urdfkit.scene.rays.triangles import CORNERS

LAYERS = 16
"""Transparent surfaces that are seen behind each other."""

FAINT = 1.0 / 512.0
"""What is left of a ray when it has been taken up [share]: half a step of 0..255."""

LIFT = 1e-6
"""Shadow rays begin so far above the surface, relative to how far it is [m/m]."""


def look(
    scene: Any,
    cover: Any,
    paint: Any,
    lights: Any,
    air: Any,
    frame: Any,
    directions: Any,
    order: Any,
    near: float,
    far: float,
    work: Any,
    desk: Any,
    rgb: Any,
    depths: Any,
    hits: Any,
) -> None:
    """Look along rays that begin at a frame's origin, packets of neighbouring pixels at a time.

    Args:
        scene: as for `ray_casting.cast`.
        cover: as `scene`, but without what casts no shadow: its kind is none.
        paint: colour and opacity of each shape, 0..1, shape (shapes, 4); what it takes from skins, shape (shapes,);
            colour and exponent of its gloss, shape (shapes, 4); skins of the triangles, shape (triangles, `SKIN`);
            where each texture begins, its width and height, shape (textures, 3); texels, each texture followed by its
            smaller copies.
        lights: `LIGHT` numbers each; shape (lights, `LIGHT`).
        air: light from everywhere and what is seen where nothing is, 0..1; shape (2, 3).
        frame: rotation by rows and position of the camera, which looks along x; and how wide a pixel is at a distance
            of one [m/m].
        directions: of length 1 in the camera's frame; shape (n, 3).
        order: number of each ray's pixel in the results; shape (n,).
        near: where rays begin to see [m].
        far: where they end [m].
        work: shape (≥ `ray_casting.SCRATCH`,).
        desk: shape (≥ `DESK`,).
        rgb: becomes the picture, 0..255; shape (n, 3).
        depths: becomes the distance along the camera's x [m], infinite where nothing is seen; shape (n,).
        hits: becomes the numbers of the shapes, -1 where nothing is seen; shape (n,).
    """
    desk[:3] = 0.0
    origin = desk[:3].reshape((1, 3))
    for first in range(0, len(directions), WIDTH):
        desk[:3] = 0.0
        load(work, frame, origin, directions, first, far)
        for k in range(WIDTH):
            desk[LEFT + k], desk[PAST + k], desk[DEPTH + k], desk[FIRST + k] = 1.0, 0.0, inf, -1.0
            for c in range(3):
                row = c * WIDTH + k
                desk[TOWARDS + row], desk[BLENT + row] = work[DX + row], 0.0
        walk(work, scene, near)
        for layer in range(LAYERS):
            take_down(work, scene, paint, air, frame, desk)
            for light in range(len(lights)):
                shine(work, cover, lights, light, desk)
            if not go_on(work, air, frame, desk, far, layer == LAYERS - 1):
                break
            walk(work, scene, 0.0)
        for k in range(min(WIDTH, len(directions) - first)):
            pixel = order[first + k]
            hits[pixel] = int(desk[FIRST + k])
            depths[pixel] = desk[DEPTH + k] * directions[first + k, 0] if desk[FIRST + k] >= 0.0 else inf
            for c in range(3):
                rgb[pixel, c] = int(255.0 * min(desk[BLENT + c * WIDTH + k], 1.0) + 0.5)


@compiled
def take_down(work: Any, scene: Any, paint: Any, air: Any, frame: Any, desk: Any) -> None:
    """Note what the packet met, before its rays are used for shadows."""
    shapes, _, _, _, _, _, _, _, corners = scene
    colors, worn, glosses, skins, textures, texels = paint
    for k in range(WIDTH):
        shape, part, depth = int(work[HIT + k]), int(work[PART + k]), work[REACH + k]
        desk[SHAPE + k] = shape
        desk[PAST + k] += depth
        facing = normal(work, scene, k)
        for c in range(3):
            row = c * WIDTH + k
            desk[AT + row] = work[OX + row] + depth * work[DX + row] + LIFT * desk[PAST + k] * facing[c]
            desk[FACING + row] = facing[c]
            desk[SHONE + row], desk[SHEEN + row] = air[0, c], 0.0
            if shape >= 0:
                desk[COLOR + row], desk[SPECULAR + row] = colors[shape, c], glosses[shape, c]
        desk[EXPONENT + k] = glosses[shape, 3] if shape >= 0 else 0.0
        desk[OPAQUE + k] = colors[shape, 3] if shape >= 0 else 1.0
        if shape < 0 or part < 0 or worn[shape] == 0:
            continue
        at = shape * STRIDE
        x, y, z = point(work, shapes, k, at)
        u, v = place_in_triangle(corners, CORNERS * part, x, y, z)
        if worn[shape] & SMOOTH != 0:
            nx, ny, nz = outwards(
                shapes, at, between(skins, part, 0, 3, u, v), between(skins, part, 1, 3, u, v),
                between(skins, part, 2, 3, u, v),
            )  # fmt: skip
            side = 1.0 if nx * facing[0] + ny * facing[1] + nz * facing[2] >= 0.0 else -1.0
            desk[FACING + k], desk[FACING + WIDTH + k] = side * nx, side * ny
            desk[FACING + 2 * WIDTH + k] = side * nz
        if worn[shape] & OWN != 0:
            which = int(skins[part, TEXTURE])
            desk[OPAQUE + k] *= skins[part, OPACITY]
            desk[EXPONENT + k] = skins[part, GLOSS + 3]
            for c in range(3):
                desk[SPECULAR + c * WIDTH + k] = skins[part, GLOSS + c]
            if which < 0:
                for c in range(3):
                    desk[COLOR + c * WIDTH + k] = between(skins, part, HUE + c, 3, u, v)
                continue
            s, t = between(skins, part, UV, 2, u, v), between(skins, part, UV + 1, 2, u, v)
            across = cover(shapes, at, corners, skins, part, frame, desk, k, 1)
            down = cover(shapes, at, corners, skins, part, frame, desk, k, 2)
            color = desk[DYE : DYE + 4]
            dye(texels, textures[which, 0], textures[which, 1], textures[which, 2], s, t, across, down, color)
            for c in range(3):
                desk[COLOR + c * WIDTH + k] = color[c]
            desk[OPAQUE + k] *= color[3]


@compiled
def cover(
    shapes: Any, at: int, corners: Any, skins: Any, part: int, frame: Any, desk: Any, k: int, axis: int
) -> tuple[float, float]:
    """Return how far on its texture the pixel beside (axis 1) or below that of ray `k` meets a plane.

    Where a ray d meets a plane with normal n at the depth z along the camera's axis, the ray of the pixel that is a
    step e away meets it about z (e - d (n·e) / (n·d)) from there.
    """
    nx, ny, nz = triangle_normal(corners, CORNERS * part)
    nx, ny, nz = outwards(shapes, at, nx, ny, nz)
    dx, dy, dz = desk[TOWARDS + k], desk[TOWARDS + WIDTH + k], desk[TOWARDS + 2 * WIDTH + k]
    ahead = dx * frame[0] + dy * frame[3] + dz * frame[6]
    facing = nx * dx + ny * dy + nz * dz
    if ahead <= 0.0 or facing == 0.0:
        return 0.0, 0.0
    depth, step = desk[PAST + k] * ahead, frame[12]
    ex, ey, ez = step * frame[axis], step * frame[3 + axis], step * frame[6 + axis]
    share = (nx * ex + ny * ey + nz * ez) / facing
    x, y, z = depth * (ex - share * dx), depth * (ey - share * dy), depth * (ez - share * dz)
    # In the frame of the shape, and as parts of the triangle's second and third corner.
    px = shapes[at] * x + shapes[at + 3] * y + shapes[at + 6] * z
    py = shapes[at + 1] * x + shapes[at + 4] * y + shapes[at + 7] * z
    pz = shapes[at + 2] * x + shapes[at + 5] * y + shapes[at + 8] * z
    first = CORNERS * part
    ax, ay, az = corners[first + 3], corners[first + 4], corners[first + 5]
    bx, by, bz = corners[first + 6], corners[first + 7], corners[first + 8]
    aa, ab, bb = ax * ax + ay * ay + az * az, ax * bx + ay * by + az * bz, bx * bx + by * by + bz * bz
    pa, pb = px * ax + py * ay + pz * az, px * bx + py * by + pz * bz
    under = aa * bb - ab * ab
    if under <= 0.0:
        return 0.0, 0.0
    u, v = (bb * pa - ab * pb) / under, (aa * pb - ab * pa) / under
    s = u * (skins[part, UV + 2] - skins[part, UV]) + v * (skins[part, UV + 4] - skins[part, UV])
    t = u * (skins[part, UV + 3] - skins[part, UV + 1]) + v * (skins[part, UV + 5] - skins[part, UV + 1])
    return s, t


@compiled
def go_on(work: Any, air: Any, frame: Any, desk: Any, far: float, last: bool) -> bool:
    """Blend what was met into what was seen; return whether rays go on behind it, and aim them."""
    wanted = -1
    for k in range(WIDTH):
        shape, left = int(desk[SHAPE + k]), desk[LEFT + k]
        opaque = desk[OPAQUE + k] if shape >= 0 and not last else 1.0
        for c in range(3):
            row = c * WIDTH + k
            seen = min(desk[COLOR + row] * desk[SHONE + row] + desk[SHEEN + row], 1.0) if shape >= 0 else air[1, c]
            desk[BLENT + row] += left * opaque * seen
        if shape >= 0 and desk[FIRST + k] < 0.0 and opaque > 0.0 and left > 0.0:
            desk[FIRST + k], desk[DEPTH + k] = shape, desk[PAST + k]
        left *= 1.0 - opaque
        desk[LEFT + k] = left if left > FAINT else 0.0
        if desk[LEFT + k] > 0.0:
            wanted = k
    if wanted < 0:
        return False
    for k in range(WIDTH):
        goes = desk[LEFT + k] > 0.0
        ray = k if goes else wanted  # goes along with one that matters, and ends where it begins
        past = desk[PAST + ray] * (1.0 + LIFT)
        for c in range(3):
            towards = desk[TOWARDS + c * WIDTH + ray]
            work[DX + c * WIDTH + k] = towards
            work[OX + c * WIDTH + k] = frame[9 + c] + past * towards
        work[REACH + k] = max(far - past, 0.0) if goes else 0.0
        work[HIT + k], work[PART + k] = -1.0, -1.0
    for k in range(WIDTH):
        desk[PAST + k] *= 1.0 + LIFT
    return True
