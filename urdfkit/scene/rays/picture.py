"""What a camera sees: colours under lights with shadows, depth and which shape, in one pass over its pixels' rays.

Surfaces are matt (Lambert): colour · (ambient + Σ light · cos θ · falloff), each light seen or not by a ray of its own.
Falloff is ``1 / (constant + linear·r + quadratic·r²)`` within the light's range, as in OGRE's fixed functions, which
Gazebo draws with; a spot fades between its two cones.
"""

from __future__ import annotations

from math import inf
from typing import Any

from urdfkit.scene.rays.cast import load, walk
from urdfkit.scene.rays.compilation import compiled
from urdfkit.scene.rays.normals import normal
from urdfkit.scene.rays.packet import DX, FAR, HIT, OX, PART, REACH, WIDTH

LIGHT = 18
"""Numbers per light: kind, towards it or where it is (3), colour (3), range, constant, linear and quadratic falloff,
whether it casts shadows, where a spot points (3), cosines of half its inner and outer angle, its falloff."""

DIRECTIONAL, POINT, SPOT = 0, 1, 2
"""Kinds of lights."""

AT, FACING, COLOR, SHONE = (row * WIDTH for row in (0, 3, 6, 9))
"""What a packet met: where, which way the surface faces, its colour, the light on it (three rows each) …"""
DEPTH, SHAPE, GAIN = (row * WIDTH for row in (12, 13, 14))
"""… how far, which shape (-1: none), and what of one light gets there."""
DESK = 15 * WIDTH
"""Numbers that a picture works on besides a packet's."""

LIFT = 1e-6
"""Shadow rays begin so far above the surface, relative to how far it is [m/m]."""


def look(
    scene: Any,
    paint: Any,
    lights: Any,
    air: Any,
    frame: Any,
    directions: Any,
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
        scene: as for `cast.cast`.
        paint: colour of each shape, 0..1, shape (shapes, 3); whether its triangles have colours of their own, shape
            (shapes,); colour of each triangle, shape (triangles, 3).
        lights: `LIGHT` numbers each; shape (lights, `LIGHT`).
        air: light from everywhere and what is seen where nothing is, 0..1; shape (2, 3).
        frame: rotation by rows and position of the camera, which looks along x.
        directions: of length 1 in the camera's frame; shape (n, 3).
        near: where rays begin to see [m].
        far: where they end [m].
        work: shape (≥ `cast.SCRATCH`,).
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
        walk(work, scene, near)
        take_down(work, scene, paint, air, desk)
        for light in range(len(lights)):
            shine(work, scene, lights, light, desk)
        for k in range(min(WIDTH, len(directions) - first)):
            ray, shape = first + k, int(desk[SHAPE + k])
            hits[ray] = shape
            depths[ray] = desk[DEPTH + k] * directions[ray, 0] if shape >= 0 else inf
            for c in range(3):
                lit = desk[COLOR + c * WIDTH + k] * desk[SHONE + c * WIDTH + k]
                rgb[ray, c] = int(255.0 * min(lit if shape >= 0 else air[1, c], 1.0) + 0.5)


@compiled
def take_down(work: Any, scene: Any, paint: Any, air: Any, desk: Any) -> None:
    """Note what the packet met, before its rays are used for shadows."""
    colors, tinted, tints = paint
    for k in range(WIDTH):
        shape, part, depth = int(work[HIT + k]), int(work[PART + k]), work[REACH + k]
        desk[SHAPE + k], desk[DEPTH + k] = shape, depth
        facing = normal(work, scene, k)
        for c in range(3):
            row = c * WIDTH + k
            desk[AT + row] = work[OX + row] + depth * work[DX + row] + LIFT * depth * facing[c]
            desk[FACING + row] = facing[c]
            desk[SHONE + row] = air[0, c]
            if shape >= 0:
                desk[COLOR + row] = tints[part, c] if part >= 0 and tinted[shape] != 0 else colors[shape, c]


@compiled
def shine(work: Any, scene: Any, lights: Any, light: int, desk: Any) -> None:
    """Add one light to what the packet met, where nothing stands between."""
    wanted = -1
    for k in range(WIDTH):
        gain = 0.0
        if desk[SHAPE + k] >= 0:
            gain = reach_light(work, lights, light, desk, k)
        desk[GAIN + k] = gain
        if gain > 0.0:
            wanted = k
    if wanted < 0:
        return
    if lights[light, 11] != 0.0:
        for k in range(WIDTH):
            if desk[GAIN + k] <= 0.0:  # goes along with one that matters, and ends where it begins
                work[REACH + k] = 0.0
                for c in range(3):
                    desk_row, row = AT + c * WIDTH + wanted, c * WIDTH + k
                    work[OX + row] = desk[desk_row]
                    work[DX + row] = work[DX + c * WIDTH + wanted]
            work[HIT + k], work[PART + k] = -1.0, -1.0
        walk(work, scene, 0.0)
        for k in range(WIDTH):
            if work[HIT + k] >= 0.0:
                desk[GAIN + k] = 0.0
    for c in range(3):
        for k in range(WIDTH):
            desk[SHONE + c * WIDTH + k] += desk[GAIN + k] * lights[light, 4 + c]


@compiled
def reach_light(work: Any, lights: Any, light: int, desk: Any, k: int) -> float:
    """Aim ray `k` from what it met at a light; return how much gets there if nothing is between."""
    kind = int(lights[light, 0])
    x, y, z = lights[light, 1], lights[light, 2], lights[light, 3]
    reach, fall = FAR, 1.0
    if kind != DIRECTIONAL:
        x, y, z = x - desk[AT + k], y - desk[AT + WIDTH + k], z - desk[AT + 2 * WIDTH + k]
        reach = (x * x + y * y + z * z) ** 0.5
        if reach > lights[light, 7] or reach <= 0.0:
            return 0.0
        x, y, z = x / reach, y / reach, z / reach
        fall = 1.0 / max(lights[light, 8] + reach * (lights[light, 9] + reach * lights[light, 10]), 1e-9)
        if kind == SPOT:
            along = -(x * lights[light, 12] + y * lights[light, 13] + z * lights[light, 14])
            inner, outer = lights[light, 15], lights[light, 16]
            part = (along - outer) / max(inner - outer, 1e-9)
            fall *= min(max(part, 0.0), 1.0) ** lights[light, 17]
            if along <= outer:
                return 0.0
    work[OX + k], work[OX + WIDTH + k], work[OX + 2 * WIDTH + k] = (
        desk[AT + k],
        desk[AT + WIDTH + k],
        desk[AT + 2 * WIDTH + k],
    )
    work[DX + k], work[DX + WIDTH + k], work[DX + 2 * WIDTH + k] = x, y, z
    work[REACH + k] = reach
    straight = x * desk[FACING + k] + y * desk[FACING + WIDTH + k] + z * desk[FACING + 2 * WIDTH + k]
    return float(fall * max(straight, 0.0))
