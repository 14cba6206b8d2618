"""Image of a camera: colour with lights and shadows, depth and shape of each pixel, in one pass over the rays.

Surfaces are matt (Lambert): colour · (ambient + Σ light · cos θ · falloff), with one shadow ray per light. A specular
colour adds specular · Σ specular light · falloff · max(n·h, 0) ^ exponent, with h half way between light and eye
(Blinn, *Models of Light Reflection for Computer Synthesized Pictures*, 1977), like OGRE. The falloff is
``1 / (constant + linear·r + quadratic·r²)`` within the range of the light, as in OGRE's fixed functions, which Gazebo
uses; a spot fades between its two cones. Transparent surfaces are blended with the surfaces behind them and cast no
shadow.
"""

from math import inf
from typing import Any

from urdfkit.scene.rays.compilation import compiled
from urdfkit.scene.rays.primitives import STRIDE
from urdfkit.scene.rays.ray_casting import load, traverse
from urdfkit.scene.rays.ray_packet import DX, HIT, OX, PART, REACH, WIDTH
from urdfkit.scene.rays.shading.direct_lighting import add_light
from urdfkit.scene.rays.shading.shading_buffers import (
    ALPHA,
    AT,
    BLENDED,
    COLOR,
    DEPTH,
    EXPONENT,
    FIRST,
    HIGHLIGHT,
    LIGHT_SUM,
    NORMAL,
    SHAPE,
    SPECULAR,
    TEXTURE_COLOR,
    TRANSMITTED,
    TRAVELLED,
    VIEW,
)
from urdfkit.scene.rays.shading.surface_attributes import (
    COLORED,
    COLORS,
    GLOSS,
    OPACITY,
    SMOOTH,
    TEXTURE,
    UV,
    barycentric,
    interpolate,
    sample_texture,
)
from urdfkit.scene.rays.surface_normals import normal, outwards, point, triangle_normal
from urdfkit.scene.rays.triangles import CORNERS

LAYERS = 16
"""Maximum number of transparent surfaces behind each other."""

FAINT = 1.0 / 512.0
"""Transmitted share at which a ray ends: half a step of 0..255."""

LIFT = 1e-6
"""Offset of shadow rays from the surface, relative to its distance [m/m]."""


def trace(
    scene: Any,
    occluders: Any,
    paint: Any,
    lights: Any,
    air: Any,
    frame: Any,
    directions: Any,
    order: Any,
    near: float,
    far: float,
    work: Any,
    buffers: Any,
    rgb: Any,
    depths: Any,
    hits: Any,
) -> None:
    """Trace rays from the origin of a frame, in packets of neighbouring pixels.

    Args:
        scene: as for `ray_casting.cast`.
        occluders: as `scene`, with the kind `materials.NOTHING` for shapes that cast no shadow.
        paint: colour and opacity of each shape, 0..1, shape (shapes, 4); its flags, see `surface_attributes.COLORED`,
            shape (shapes,); its specular colour and exponent, shape (shapes, 4); attributes of the triangles, shape
            (triangles, `ATTRIBUTES`); offset, width and height of each texture, shape (textures, 3); texels, each
            texture followed by its mip levels.
        lights: the lights; shape (lights, `LIGHT`).
        air: ambient light and background colour, 0..1; shape (2, 3).
        frame: rotation by rows and position of the camera, which looks along x; and the width of a pixel at a distance
            of one [m/m].
        directions: of length 1 in the camera's frame; shape (n, 3).
        order: index of each ray's pixel in the results; shape (n,).
        near: minimum distance of a hit [m].
        far: maximum distance of a hit [m].
        work: scratch; shape (≥ `ray_casting.SCRATCH`,).
        buffers: scratch; shape (≥ `BUFFER_SIZE`,).
        rgb: output, the image, 0..255; shape (n, 3).
        depths: output, the distance along the camera's x [m], infinite without a hit; shape (n,).
        hits: output, the indices of the shapes, -1 without a hit; shape (n,).
    """
    buffers[:3] = 0.0
    origin = buffers[:3].reshape((1, 3))
    for first in range(0, len(directions), WIDTH):
        buffers[:3] = 0.0
        load(work, frame, origin, directions, first, far)
        for k in range(WIDTH):
            buffers[TRANSMITTED + k], buffers[TRAVELLED + k], buffers[DEPTH + k], buffers[FIRST + k] = (
                1.0,
                0.0,
                inf,
                -1.0,
            )
            for c in range(3):
                row = c * WIDTH + k
                buffers[VIEW + row], buffers[BLENDED + row] = work[DX + row], 0.0
        traverse(work, scene, near)
        for layer in range(LAYERS):
            gather_hits(work, scene, paint, air, frame, buffers)
            for light in range(len(lights)):
                add_light(work, occluders, lights, light, buffers)
            if not continue_rays(work, air, frame, buffers, far, layer == LAYERS - 1):
                break
            traverse(work, scene, 0.0)
        for k in range(min(WIDTH, len(directions) - first)):
            pixel = order[first + k]
            hits[pixel] = int(buffers[FIRST + k])
            depths[pixel] = buffers[DEPTH + k] * directions[first + k, 0] if buffers[FIRST + k] >= 0.0 else inf
            for c in range(3):
                rgb[pixel, c] = int(255.0 * min(buffers[BLENDED + c * WIDTH + k], 1.0) + 0.5)


@compiled
def gather_hits(work: Any, scene: Any, paint: Any, air: Any, frame: Any, buffers: Any) -> None:
    """Store hit points, normals and materials in the buffers, before the rays are used for shadows."""
    shapes, _, _, _, _, _, _, _, corners = scene
    colors, features, glosses, attributes, textures, texels = paint
    for k in range(WIDTH):
        shape, part, depth = int(work[HIT + k]), int(work[PART + k]), work[REACH + k]
        buffers[SHAPE + k] = shape
        buffers[TRAVELLED + k] += depth
        facing = normal(work, scene, k)
        for c in range(3):
            row = c * WIDTH + k
            buffers[AT + row] = work[OX + row] + depth * work[DX + row] + LIFT * buffers[TRAVELLED + k] * facing[c]
            buffers[NORMAL + row] = facing[c]
            buffers[LIGHT_SUM + row], buffers[HIGHLIGHT + row] = air[0, c], 0.0
            if shape >= 0:
                buffers[COLOR + row], buffers[SPECULAR + row] = colors[shape, c], glosses[shape, c]
        buffers[EXPONENT + k] = glosses[shape, 3] if shape >= 0 else 0.0
        buffers[ALPHA + k] = colors[shape, 3] if shape >= 0 else 1.0
        if shape < 0 or part < 0 or features[shape] == 0:
            continue
        at = shape * STRIDE
        x, y, z = point(work, shapes, k, at)
        u, v = barycentric(corners, CORNERS * part, x, y, z)
        if features[shape] & SMOOTH != 0:
            nx, ny, nz = outwards(
                shapes, at, interpolate(attributes, part, 0, 3, u, v), interpolate(attributes, part, 1, 3, u, v),
                interpolate(attributes, part, 2, 3, u, v),
            )  # fmt: skip
            side = 1.0 if nx * facing[0] + ny * facing[1] + nz * facing[2] >= 0.0 else -1.0
            buffers[NORMAL + k], buffers[NORMAL + WIDTH + k] = side * nx, side * ny
            buffers[NORMAL + 2 * WIDTH + k] = side * nz
        if features[shape] & COLORED != 0:
            which = int(attributes[part, TEXTURE])
            buffers[ALPHA + k] *= attributes[part, OPACITY]
            buffers[EXPONENT + k] = attributes[part, GLOSS + 3]
            for c in range(3):
                buffers[SPECULAR + c * WIDTH + k] = attributes[part, GLOSS + c]
            if which < 0:
                for c in range(3):
                    buffers[COLOR + c * WIDTH + k] = interpolate(attributes, part, COLORS + c, 3, u, v)
                continue
            s, t = interpolate(attributes, part, UV, 2, u, v), interpolate(attributes, part, UV + 1, 2, u, v)
            across = texture_footprint(shapes, at, corners, attributes, part, frame, buffers, k, 1)
            down = texture_footprint(shapes, at, corners, attributes, part, frame, buffers, k, 2)
            color = buffers[TEXTURE_COLOR : TEXTURE_COLOR + 4]
            sample_texture(
                texels, textures[which, 0], textures[which, 1], textures[which, 2], s, t, across, down, color
            )
            for c in range(3):
                buffers[COLOR + c * WIDTH + k] = color[c]
            buffers[ALPHA + k] *= color[3]


@compiled
def texture_footprint(
    shapes: Any, at: int, corners: Any, attributes: Any, part: int, frame: Any, buffers: Any, k: int, axis: int
) -> tuple[float, float]:
    """Return the distance on the texture to the next pixel to the right (axis 1) or below (axis 2) of ray `k`.

    If a ray d hits a plane with normal n at the depth z along the camera's axis, the ray of the pixel that is a step e
    away hits it approximately at the offset z (e - d (n·e) / (n·d)).
    """
    nx, ny, nz = triangle_normal(corners, CORNERS * part)
    nx, ny, nz = outwards(shapes, at, nx, ny, nz)
    dx, dy, dz = buffers[VIEW + k], buffers[VIEW + WIDTH + k], buffers[VIEW + 2 * WIDTH + k]
    ahead = dx * frame[0] + dy * frame[3] + dz * frame[6]
    facing = nx * dx + ny * dy + nz * dz
    if ahead <= 0.0 or facing == 0.0:
        return 0.0, 0.0
    depth, step = buffers[TRAVELLED + k] * ahead, frame[12]
    ex, ey, ez = step * frame[axis], step * frame[3 + axis], step * frame[6 + axis]
    share = (nx * ex + ny * ey + nz * ez) / facing
    x, y, z = depth * (ex - share * dx), depth * (ey - share * dy), depth * (ez - share * dz)
    # In the frame of the shape, and as barycentric coordinates of the triangle.
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
    s = u * (attributes[part, UV + 2] - attributes[part, UV]) + v * (attributes[part, UV + 4] - attributes[part, UV])
    t = u * (attributes[part, UV + 3] - attributes[part, UV + 1]) + v * (
        attributes[part, UV + 5] - attributes[part, UV + 1]
    )
    return s, t


@compiled
def continue_rays(work: Any, air: Any, frame: Any, buffers: Any, far: float, last: bool) -> bool:
    """Blend the hit surfaces into the image; return whether rays continue behind them, and aim these rays."""
    wanted = -1
    for k in range(WIDTH):
        shape, left = int(buffers[SHAPE + k]), buffers[TRANSMITTED + k]
        opaque = buffers[ALPHA + k] if shape >= 0 and not last else 1.0
        for c in range(3):
            row = c * WIDTH + k
            seen = (
                min(buffers[COLOR + row] * buffers[LIGHT_SUM + row] + buffers[HIGHLIGHT + row], 1.0)
                if shape >= 0
                else air[1, c]
            )
            buffers[BLENDED + row] += left * opaque * seen
        if shape >= 0 and buffers[FIRST + k] < 0.0 and opaque > 0.0 and left > 0.0:
            buffers[FIRST + k], buffers[DEPTH + k] = shape, buffers[TRAVELLED + k]
        left *= 1.0 - opaque
        buffers[TRANSMITTED + k] = left if left > FAINT else 0.0
        if buffers[TRANSMITTED + k] > 0.0:
            wanted = k
    if wanted < 0:
        return False
    for k in range(WIDTH):
        goes = buffers[TRANSMITTED + k] > 0.0
        ray = k if goes else wanted  # an inactive ray: a copy of an active one with length zero
        past = buffers[TRAVELLED + ray] * (1.0 + LIFT)
        for c in range(3):
            towards = buffers[VIEW + c * WIDTH + ray]
            work[DX + c * WIDTH + k] = towards
            work[OX + c * WIDTH + k] = frame[9 + c] + past * towards
        work[REACH + k] = max(far - past, 0.0) if goes else 0.0
        work[HIT + k], work[PART + k] = -1.0, -1.0
    for k in range(WIDTH):
        buffers[TRAVELLED + k] *= 1.0 + LIFT
    return True
