"""Direct lighting of the hit points of a packet, with one shadow ray per light."""

from typing import Any

from urdfkit.scene.rays.compilation import compiled
from urdfkit.scene.rays.ray_casting import traverse
from urdfkit.scene.rays.ray_packet import DX, FAR, HIT, OX, PART, REACH, WIDTH
from urdfkit.scene.rays.shading.shading_buffers import (
    AT,
    EXPONENT,
    GAIN,
    HIGHLIGHT,
    LIGHT_SUM,
    NORMAL,
    SHAPE,
    SPECULAR,
    TRAVELLED,
    VIEW,
    WAITING,
)

LIGHT = 21
"""Numbers per light: kind, direction or position (3), colour (3), range, constant, linear and quadratic falloff,
whether it casts shadows, direction of a spot (3), cosines of half its inner and outer angle, its falloff, its specular
colour (3)."""

DIRECTIONAL, POINT, SPOT = 0, 1, 2
"""Kinds of lights."""

NEIGHBOURING = 0.02
"""Largest difference between the distances of hit points whose shadow rays share a packet, of the distance."""

CASTING = -1.0
"""Marks the rays of the current packet of shadow rays."""


@compiled
def add_light(work: Any, scene: Any, lights: Any, light: int, buffers: Any) -> None:
    """Add one light to the hit points that it reaches."""
    lit = 0
    for k in range(WIDTH):
        gain = 0.0
        if buffers[SHAPE + k] >= 0:
            gain = aim_at_light(work, lights, light, buffers, k)
        buffers[GAIN + k] = gain
        lit += 1 if gain > 0.0 else 0
    if lit == 0:
        return
    if lights[light, 11] != 0.0:
        cast_shadows(work, scene, lights, light, buffers, lit)
    for c in range(3):
        for k in range(WIDTH):
            buffers[LIGHT_SUM + c * WIDTH + k] += buffers[GAIN + k] * lights[light, 4 + c]
    for k in range(WIDTH):
        if buffers[EXPONENT + k] > 0.0 and buffers[GAIN + k] > 0.0:
            add_highlight(work, lights, light, buffers, k)


@compiled
def cast_shadows(work: Any, scene: Any, lights: Any, light: int, buffers: Any, lit: int) -> None:
    """Cast the rays that are aimed at a light; set the gain of the blocked ones to zero.

    Hit points at an outline are far apart. Rays from them would enter most of the scene together, so each packet has
    the rays of one surface only.

    Args:
        work: the packet, with the aimed rays.
        scene: see `camera_picture.trace`.
        lights: see there.
        light: index of the light.
        buffers: see there; the gain of rays without light is zero.
        lit: number of rays with light.
    """
    for k in range(WIDTH):
        buffers[WAITING + k] = buffers[GAIN + k]
    leader, waiting, packets = 0, lit, 0
    while waiting > 0:
        while buffers[WAITING + leader] <= 0.0:
            leader += 1
        shape, depth = buffers[SHAPE + leader], buffers[TRAVELLED + leader]
        for k in range(WIDTH):
            is_near = abs(buffers[TRAVELLED + k] - depth) <= NEIGHBOURING * depth
            if is_near and buffers[WAITING + k] > 0.0 and buffers[SHAPE + k] == shape:
                buffers[WAITING + k] = CASTING
                waiting -= 1
                if packets > 0:  # an earlier packet of this light had another ray in its place
                    aim_at_light(work, lights, light, buffers, k)
        for k in range(WIDTH):
            if buffers[WAITING + k] != CASTING:  # an inactive ray: a copy of an active one with length zero
                work[REACH + k] = 0.0
                for c in range(3):
                    row = c * WIDTH
                    work[OX + row + k] = work[OX + row + leader]
                    work[DX + row + k] = work[DX + row + leader]
            work[HIT + k], work[PART + k] = -1.0, -1.0
        traverse(work, scene, 0.0)
        for k in range(WIDTH):
            if buffers[WAITING + k] == CASTING:
                buffers[WAITING + k] = 0.0
                if work[HIT + k] >= 0.0:
                    buffers[GAIN + k] = 0.0
        packets += 1
    if packets > 1:  # highlights need the rays of all packets
        for k in range(WIDTH):
            if buffers[GAIN + k] > 0.0:
                aim_at_light(work, lights, light, buffers, k)


@compiled
def add_highlight(work: Any, lights: Any, light: int, buffers: Any, k: int) -> None:
    """Add the specular reflection of a light; ray `k` is still aimed at the light."""
    straight = facing = size = 0.0
    for row in range(k, k + 3 * WIDTH, WIDTH):
        half = work[DX + row] - buffers[VIEW + row]
        straight += work[DX + row] * buffers[NORMAL + row]
        facing += half * buffers[NORMAL + row]
        size += half * half
    if straight <= 0.0 or facing <= 0.0:
        return
    back = buffers[GAIN + k] / straight * (facing / size**0.5) ** buffers[EXPONENT + k]
    for c in range(3):
        buffers[HIGHLIGHT + c * WIDTH + k] += back * lights[light, 18 + c] * buffers[SPECULAR + c * WIDTH + k]


@compiled
def aim_at_light(work: Any, lights: Any, light: int, buffers: Any, k: int) -> float:
    """Aim ray `k` from its hit point at a light; return the share of the light without occlusion."""
    kind = int(lights[light, 0])
    x, y, z = lights[light, 1], lights[light, 2], lights[light, 3]
    reach, fall = FAR, 1.0
    if kind != DIRECTIONAL:
        x, y, z = x - buffers[AT + k], y - buffers[AT + WIDTH + k], z - buffers[AT + 2 * WIDTH + k]
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
        buffers[AT + k],
        buffers[AT + WIDTH + k],
        buffers[AT + 2 * WIDTH + k],
    )
    work[DX + k], work[DX + WIDTH + k], work[DX + 2 * WIDTH + k] = x, y, z
    work[REACH + k] = reach
    straight = x * buffers[NORMAL + k] + y * buffers[NORMAL + WIDTH + k] + z * buffers[NORMAL + 2 * WIDTH + k]
    return float(fall * max(straight, 0.0))
