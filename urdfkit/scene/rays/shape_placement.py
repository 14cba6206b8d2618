"""Placement of the shapes: poses of bodies → frames and boxes of shapes, and the tree over them."""

from typing import Any

from urdfkit.scene.rays.bvh import build_compiled, refit
from urdfkit.scene.rays.compilation import inlined
from urdfkit.scene.rays.primitives import BOX, CAPSULE, CONE, CYLINDER, ELLIPSOID, MESH, PLANE, SPHERE, STRIDE
from urdfkit.scene.rays.wide_bvh import fill_compiled, widen_compiled

REBUILD = 1.3
"""A tree is rebuilt when its boxes have grown by this factor."""


def place(
    poses: Any,
    before: Any,
    local: Any,
    body: Any,
    kinds: Any,
    mesh_boxes: Any,
    shapes: Any,
    boxes: Any,
    order: Any,
    bounds: Any,
    links: Any,
    wide: Any,
    origins: Any,
    children: Any,
    health: Any,
    scratch: Any,
) -> None:
    """Move every shape with its body, and update the tree; unmoved bodies are skipped.

    Args:
        poses: of the bodies, x y z [m] and quaternion x y z w; shape (bodies, 7).
        before: the poses of the last call, NaN initially; output, a copy of `poses`.
        local: frames of the shapes in their bodies, and sizes; `STRIDE` numbers each.
        body: index of each shape's body.
        kinds: kinds of the shapes.
        mesh_boxes: box of each shape's mesh in its own frame; shape (shapes, 6).
        shapes: output, frames in the world and sizes.
        boxes: output, boxes of the finite shapes in the world; shape (finite shapes, 6).
        order: of the tree.
        bounds: of the tree.
        links: of the tree.
        wide: the tree with eight children per node, see `wide_bvh.widen`.
        origins: its scratch array.
        children: boxes of its nodes' children.
        health: number of nodes (zero: not built yet), the sum of their areas when the tree was built, nodes in `wide`.
        scratch: scratch array of `bvh.build`.
    """
    inside, moved = len(boxes), False
    for k in range(len(kinds)):
        at, b = k * STRIDE, body[k]
        if is_unmoved(poses, before, b):
            continue
        moved = True
        x, y, z, w = poses[b, 3], poses[b, 4], poses[b, 5], poses[b, 6]
        s = 2.0 / (x * x + y * y + z * z + w * w)
        r00, r01, r02 = 1.0 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w)
        r10, r11, r12 = s * (x * y + z * w), 1.0 - s * (x * x + z * z), s * (y * z - x * w)
        r20, r21, r22 = s * (x * z - y * w), s * (y * z + x * w), 1.0 - s * (x * x + y * y)
        for c in range(3):
            a0, a1, a2 = local[at + c], local[at + 3 + c], local[at + 6 + c]
            shapes[at + c] = r00 * a0 + r01 * a1 + r02 * a2
            shapes[at + 3 + c] = r10 * a0 + r11 * a1 + r12 * a2
            shapes[at + 6 + c] = r20 * a0 + r21 * a1 + r22 * a2
        a0, a1, a2 = local[at + 9], local[at + 10], local[at + 11]
        shapes[at + 9] = poses[b, 0] + r00 * a0 + r01 * a1 + r02 * a2
        shapes[at + 10] = poses[b, 1] + r10 * a0 + r11 * a1 + r12 * a2
        shapes[at + 11] = poses[b, 2] + r20 * a0 + r21 * a1 + r22 * a2
        for c in range(12, 16):
            shapes[at + c] = local[at + c]
        if k < inside:
            update_box(shapes, at, kinds[k], mesh_boxes, boxes, k)
    for b in range(len(poses)):
        for c in range(7):
            before[b, c] = poses[b, c]
    if moved and inside > 0:
        nodes, area = int(health[0]), health[1]
        now = refit(boxes, order, bounds, links, nodes) if nodes > 0 else 0.0
        if nodes == 0 or now > REBUILD * area:
            nodes = build_compiled(boxes, order, bounds, links, 1, scratch)
            health[0] = nodes
            health[1] = refit(boxes, order, bounds, links, nodes)
            health[2] = widen_compiled(bounds, links, wide, origins)
        fill_compiled(bounds, wide, int(health[2]), children)


@inlined
def is_unmoved(poses: Any, before: Any, b: int) -> bool:
    """Return whether a body has not moved."""
    same = True
    for c in range(7):
        same &= poses[b, c] == before[b, c]
    return same


@inlined
def update_box(shapes: Any, at: int, kind: int, mesh_boxes: Any, boxes: Any, k: int) -> None:
    """Compute the axis-aligned box of a shape in the world, with a small margin."""
    a, b, c = shapes[at + 12], shapes[at + 13], shapes[at + 14]
    for axis in range(3):
        u, v, w = shapes[at + 3 * axis], shapes[at + 3 * axis + 1], shapes[at + 3 * axis + 2]
        centre, reach = shapes[at + 9 + axis], 0.0
        if kind == BOX:
            reach = abs(u) * a + abs(v) * b + abs(w) * c
        elif kind == SPHERE:
            reach = a
        elif kind in (CYLINDER, CONE):
            reach = abs(w) * b + a * (u * u + v * v) ** 0.5
        elif kind == CAPSULE:
            reach = abs(w) * b + a
        elif kind == ELLIPSOID:
            reach = (u * u * a * a + v * v * b * b + w * w * c * c) ** 0.5
        elif kind == PLANE:
            reach = abs(u) * a + abs(v) * b
        elif kind == MESH:
            m0, m1, m2 = (
                0.5 * (mesh_boxes[k, 0] + mesh_boxes[k, 3]),
                0.5 * (mesh_boxes[k, 1] + mesh_boxes[k, 4]),
                0.5 * (mesh_boxes[k, 2] + mesh_boxes[k, 5]),
            )
            h0, h1, h2 = (
                0.5 * (mesh_boxes[k, 3] - mesh_boxes[k, 0]),
                0.5 * (mesh_boxes[k, 4] - mesh_boxes[k, 1]),
                0.5 * (mesh_boxes[k, 5] - mesh_boxes[k, 2]),
            )
            centre += u * m0 + v * m1 + w * m2
            reach = abs(u) * h0 + abs(v) * h1 + abs(w) * h2
        margin = 1e-9 * (1.0 + abs(centre) + reach)
        boxes[k, axis] = centre - reach - margin
        boxes[k, axis + 3] = centre + reach + margin
