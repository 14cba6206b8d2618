"""Rays against the triangles of a mesh, a packet at a time."""

from typing import Any

from urdfkit.scene.rays.compilation import compiled
from urdfkit.scene.rays.primitives import frame_of, ray_in_frame
from urdfkit.scene.rays.ray_packet import HIT, LX, LY, LZ, MX, MY, MZ, PART, REACH, WIDTH

CORNERS = 9
"""Numbers per triangle: one corner and the two edges from it."""


@compiled
def rays_in_mesh(packet: Any, shapes: Any, at: int) -> None:
    """Transform the rays to the frame of a mesh."""
    frame = frame_of(shapes, at)
    for k in range(WIDTH):
        x, y, z, dx, dy, dz = ray_in_frame(packet, k, frame)
        packet[LX + k], packet[LY + k], packet[LZ + k] = x, y, z
        packet[MX + k], packet[MY + k], packet[MZ + k] = dx, dy, dz


@compiled
def triangle(packet: Any, corners: Any, at: int, shape: float, part: float, near: float) -> None:
    """Cast a packet at a triangle, from either side (Möller and Trumbore, 1997)."""
    x0, y0, z0 = corners[at], corners[at + 1], corners[at + 2]
    ax, ay, az = corners[at + 3], corners[at + 4], corners[at + 5]
    bx, by, bz = corners[at + 6], corners[at + 7], corners[at + 8]
    for k in range(WIDTH):
        dx, dy, dz = packet[MX + k], packet[MY + k], packet[MZ + k]
        px, py, pz = dy * bz - dz * by, dz * bx - dx * bz, dx * by - dy * bx
        det = ax * px + ay * py + az * pz
        inverse = 1.0 / det if det != 0.0 else 0.0
        x, y, z = packet[LX + k] - x0, packet[LY + k] - y0, packet[LZ + k] - z0
        u = (x * px + y * py + z * pz) * inverse
        qx, qy, qz = y * az - z * ay, z * ax - x * az, x * ay - y * ax
        v = (dx * qx + dy * qy + dz * qz) * inverse
        t = (bx * qx + by * qy + bz * qz) * inverse
        reach, hit = packet[REACH + k], packet[HIT + k]
        inside = (det != 0.0) & (u >= 0.0) & (v >= 0.0) & (u + v <= 1.0) & (t >= near)
        better = inside & ((t < reach) | ((t == reach) & (shape < hit)))
        packet[REACH + k] = t if better else reach
        packet[HIT + k] = shape if better else hit
        packet[PART + k] = part if better else packet[PART + k]
