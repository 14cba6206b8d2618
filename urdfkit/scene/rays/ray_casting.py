"""Ray casting: traversal of the tree of shapes and, for meshes, of the tree of triangles."""

from math import inf
from typing import Any

from urdfkit.scene.rays.bvh import DEPTH
from urdfkit.scene.rays.compilation import compiled, inlined
from urdfkit.scene.rays.primitives import (
    BOX,
    CAPSULE,
    CONE,
    CYLINDER,
    ELLIPSOID,
    MESH,
    PLANE,
    SPHERE,
    STRIDE,
    box,
    capsule,
    cone,
    cylinder,
    ellipsoid,
    plane,
    sphere,
)
from urdfkit.scene.rays.ray_packet import (
    BEAM,
    CHILDREN,
    DX,
    HIT,
    LOCAL_BEAM,
    LX,
    MX,
    OX,
    PACKET,
    PART,
    REACH,
    WIDTH,
    bound,
    entered_children,
    entry,
    farthest,
)
from urdfkit.scene.rays.surface_normals import normal
from urdfkit.scene.rays.triangles import CORNERS, rays_in_mesh, triangle

TOP_STACK = PACKET
MESH_STACK = TOP_STACK + 2 * CHILDREN * DEPTH
SCRATCH = MESH_STACK + 2 * CHILDREN * DEPTH
"""Size of the work array: a packet and two stacks of (child of a node, distance at which the packet enters it)."""


@compiled
def cast_at_shape(work: Any, scene: Any, shape: int, near: float) -> None:
    """Cast the packet at one shape."""
    shapes, kinds, roots, _, _, _, _, _, _ = scene
    at, kind, number = shape * STRIDE, kinds[shape], float(shape)
    if kind == BOX:
        box(work, shapes, at, number, near)
    elif kind == CYLINDER:
        cylinder(work, shapes, at, number, near)
    elif kind == SPHERE:
        sphere(work, shapes, at, number, near)
    elif kind == CAPSULE:
        capsule(work, shapes, at, number, near)
    elif kind == ELLIPSOID:
        ellipsoid(work, shapes, at, number, near)
    elif kind == CONE:
        cone(work, shapes, at, number, near)
    elif kind == PLANE:
        plane(work, shapes, at, number, near)
    elif kind == MESH:
        rays_in_mesh(work, shapes, at)
        bound(work, LX, MX, LOCAL_BEAM)
        traverse_mesh(work, scene, roots[shape], number, near)


@compiled
def traverse_mesh(work: Any, scene: Any, root: int, shape: float, near: float) -> None:
    """Traverse the tree of a mesh, the nearest children first."""
    _, _, _, _, _, _, boxes, links, corners = scene
    reach = farthest(work)
    waiting = push(work, LOCAL_BEAM, boxes, root, MESH_STACK, near, reach)
    while waiting > 0:
        waiting -= 1
        top = MESH_STACK + 2 * waiting
        if work[top + 1] > reach:
            continue
        child = 3 * int(work[top])
        first, size = links[child], links[child + 1]
        if size > 0:
            for k in range(first, first + size):
                triangle(work, corners, CORNERS * k, shape, float(k), near)
            reach = farthest(work)
        else:
            waiting += push(work, LOCAL_BEAM, boxes, first, top, near, reach)


@inlined
def push(work: Any, beam: int, boxes: Any, node: int, top: int, near: float, reach: float) -> int:
    """Push the children of a node that the packet enters onto a stack, the nearest on top; return their number."""
    found = entered_children(work, beam, boxes, node, near, reach)
    c = count = 0
    while found != 0:
        if found & 1 != 0:
            enter = entry(work, beam, boxes, node, c, near)
            at = top + 2 * count
            while at > top and work[at - 1] < enter:
                work[at], work[at + 1] = work[at - 2], work[at - 1]
                at -= 2
            work[at], work[at + 1] = CHILDREN * node + c, enter
            count += 1
        found >>= 1
        c += 1
    return count


@compiled
def traverse(work: Any, scene: Any, near: float) -> None:
    """Find the first hit of each ray of the packet: its `REACH`, `HIT` and `PART`."""
    _, kinds, _, order, boxes, links, _, _, _ = scene
    bound(work, OX, DX, BEAM)
    for shape in range(len(order), len(kinds)):
        cast_at_shape(work, scene, shape, near)
    reach = farthest(work)
    waiting = push(work, BEAM, boxes, 0, TOP_STACK, near, reach) if len(order) > 0 else 0
    while waiting > 0:
        waiting -= 1
        top = TOP_STACK + 2 * waiting
        if work[top + 1] > reach:
            continue
        child = 3 * int(work[top])
        first, size = links[child], links[child + 1]
        if size > 0:
            for k in range(first, first + size):
                cast_at_shape(work, scene, order[k], near)
            reach = farthest(work)
        else:
            waiting += push(work, BEAM, boxes, first, top, near, reach)


@inlined
def load(work: Any, frame: Any, origins: Any, directions: Any, first: int, far: float) -> None:
    """Fill the packet with rays, transformed from their frame; the last ray is repeated to fill the packet."""
    for k in range(WIDTH):
        ray = min(first + k, len(directions) - 1)
        source = ray if len(origins) > 1 else 0
        x, y, z = origins[source, 0], origins[source, 1], origins[source, 2]
        a, b, c = directions[ray, 0], directions[ray, 1], directions[ray, 2]
        for axis in range(3):
            u, v, w = frame[3 * axis], frame[3 * axis + 1], frame[3 * axis + 2]
            work[OX + axis * WIDTH + k] = u * x + v * y + w * z + frame[9 + axis]
            work[DX + axis * WIDTH + k] = u * a + v * b + w * c
        work[REACH + k], work[HIT + k], work[PART + k] = far, -1.0, -1.0


def cast(
    scene: Any,
    frame: Any,
    origins: Any,
    directions: Any,
    near: float,
    far: float,
    work: Any,
    distances: Any,
    hits: Any,
    parts: Any,
    normals: Any,
) -> None:
    """Cast rays in packets, in the order of the array.

    Args:
        scene: frames, kinds and roots of shapes; order, boxes and children of the tree over them (see `wide_bvh`);
            boxes, children and triangles of all meshes. Infinite shapes are not in the tree and come last.
        frame: rotation by rows and position of the frame of the rays.
        origins: [m], one for all or one each; shape (1 or n, 3).
        directions: of length 1; shape (n, 3).
        near: minimum distance of a hit [m].
        far: maximum distance of a hit [m].
        work: shape (≥ `SCRATCH`,).
        distances: output, distances of the nearest hits [m], infinite without a hit; shape (n,).
        hits: output, indices of the hit shapes, -1 without a hit; shape (n,).
        parts: output, indices of the hit triangles, -1 for other shapes; shape (n,).
        normals: output, unit normals at the hits, towards the ray; shape (n, 3), or (0, 3) to skip them.
    """
    for first in range(0, len(directions), WIDTH):
        load(work, frame, origins, directions, first, far)
        traverse(work, scene, near)
        for k in range(min(WIDTH, len(directions) - first)):
            ray, hit = first + k, int(work[HIT + k])
            hits[ray], parts[ray] = hit, int(work[PART + k])
            distances[ray] = work[REACH + k] if hit >= 0 else inf
            if len(normals) > 0:
                normals[ray, 0], normals[ray, 1], normals[ray, 2] = normal(work, scene, k)
