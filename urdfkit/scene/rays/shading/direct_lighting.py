"""What lights add to the surfaces that a packet has met, each seen or not by a ray of its own."""

from __future__ import annotations

from typing import Any

from urdfkit.scene.rays.compilation import compiled
from urdfkit.scene.rays.ray_casting import walk
from urdfkit.scene.rays.ray_packet import DX, FAR, HIT, OX, PART, REACH, WIDTH
from urdfkit.scene.rays.shading.shading_buffers import (
    AT,
    EXPONENT,
    FACING,
    GAIN,
    SHAPE,
    SHEEN,
    SHONE,
    SPECULAR,
    TOWARDS,
)

LIGHT = 21
"""Numbers per light: kind, towards it or where it is (3), colour (3), range, constant, linear and quadratic falloff,
whether it casts shadows, where a spot points (3), cosines of half its inner and outer angle, its falloff, its specular
colour (3)."""

DIRECTIONAL, POINT, SPOT = 0, 1, 2
"""Kinds of lights."""


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
    for k in range(WIDTH):
        if desk[EXPONENT + k] > 0.0 and desk[GAIN + k] > 0.0:
            throw_back(work, lights, light, desk, k)


@compiled
def throw_back(work: Any, lights: Any, light: int, desk: Any, k: int) -> None:
    """Add what the gloss of a surface throws back of a light, along ray `k`, which is still aimed at it."""
    straight = facing = size = 0.0
    for row in range(k, k + 3 * WIDTH, WIDTH):
        half = work[DX + row] - desk[TOWARDS + row]
        straight += work[DX + row] * desk[FACING + row]
        facing += half * desk[FACING + row]
        size += half * half
    if straight <= 0.0 or facing <= 0.0:
        return
    back = desk[GAIN + k] / straight * (facing / size**0.5) ** desk[EXPONENT + k]
    for c in range(3):
        desk[SHEEN + c * WIDTH + k] += back * lights[light, 18 + c] * desk[SPECULAR + c * WIDTH + k]


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
