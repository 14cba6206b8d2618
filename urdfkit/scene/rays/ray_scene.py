"""RayTable: the shapes of a scene for ray casting; built once, then only the poses of bodies change."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from math import inf
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from urdfkit.description.sdf import Cone, Ellipsoid, Plane
from urdfkit.description.urdf.robot import Box, Capsule, Cylinder, Sphere
from urdfkit.linear_algebra import Array, matmul
from urdfkit.meshes.triangle_mesh import TriMesh
from urdfkit.scene.pose_matrices import upright
from urdfkit.scene.rays import primitives
from urdfkit.scene.rays.bvh import SCRATCH as TREE_SCRATCH
from urdfkit.scene.rays.bvh_cache import mesh_tree
from urdfkit.scene.rays.kernels import kernel
from urdfkit.scene.rays.ray_casting import SCRATCH
from urdfkit.scene.rays.ray_packet import CHILDREN, FAR
from urdfkit.scene.rays.triangles import CORNERS
from urdfkit.scene.rays.wide_bvh import BOXES
from urdfkit.scene.scene_table import Scene, Shape

Numbers = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class Hits:
    """First hits of rays.

    Attributes:
        distances: [m], infinite without a hit; shape (n,).
        shapes: indices into `RayTable.shapes`, -1 without a hit; shape (n,).
        normals: unit normals of the surface, towards the ray, zero without a hit; shape (n, 3); None if not requested.
        triangles: indices of the triangles in their mesh, -1 for other shapes; shape (n,).
    """

    distances: Array
    shapes: NDArray[np.int64]
    normals: Array | None
    triangles: NDArray[np.int64]


class RayTable:
    """Shapes of a scene for ray casting. Several threads may cast at the same time, but not while `place` runs.

    Args:
        scene: the bodies, whose order `place` uses.
        shapes: the shapes that rays can hit, such as ``scene.with_role("collision")``.

    Attributes:
        shapes: the shapes in the order of the indices in `Hits.shapes`; infinite planes come last.
        bodies: index of the body of each shape; shape (len(shapes),).
        kernel_scene: arguments of the kernels.
    """

    def __init__(self, scene: Scene, shapes: Iterable[Shape]) -> None:
        listed = sorted(shapes, key=_is_infinite)
        self.shapes: tuple[Shape, ...] = tuple(listed)
        count, inside = len(listed), sum(not _is_infinite(shape) for shape in listed)
        self.bodies = np.array([scene.body_index[shape.body] for shape in listed], dtype=np.int64)
        self._kinds = np.zeros(count, dtype=np.int64)
        local = np.zeros((count, primitives.STRIDE))
        self._mesh_boxes = np.zeros((count, 6))
        self._roots = np.zeros(count, dtype=np.int64)
        self._place_meshes(listed)
        for k, shape in enumerate(listed):
            kind, size, turn = _numbers(shape)
            self._kinds[k] = kind
            local[k, :9] = matmul(shape.placement[:3, :3], turn).ravel()
            local[k, 9:12] = shape.placement[:3, 3]
            local[k, 12:15] = size
        self._local = local.ravel()
        self._world = np.zeros_like(self._local)
        self._boxes = np.zeros((inside, 6))
        self._order = np.zeros(inside, dtype=np.int64)
        self._bounds = np.zeros((max(2 * inside - 1, 1), 6))
        self._links = np.zeros((max(2 * inside - 1, 1), 2), dtype=np.int64)
        self._wide = np.zeros((max(inside, 1), CHILDREN, 3), dtype=np.int64)
        self._origins = np.zeros(max(inside, 1), dtype=np.int64)
        self._children = np.zeros((max(inside, 1), BOXES))
        self._health = np.zeros(3)
        self._scratch = np.empty(TREE_SCRATCH)
        self._poses = np.full((len(scene.bodies), 7), np.nan)
        self.kernel_scene: tuple[Any, ...] = (
            self._world, self._kinds, self._roots, self._order, self._children, self._wide.reshape(-1),
            *self._in_meshes,
        )  # fmt: skip

    def _place_meshes(self, shapes: list[Shape]) -> None:
        """Concatenate the trees of all meshes, each mesh once."""
        starts: dict[str, tuple[int, Array]] = {}
        boxes, children = [np.empty((0, BOXES))], [np.empty((0, CHILDREN, 3), dtype=np.int64)]
        orders, corners = [np.empty(0, dtype=np.int64)], [np.empty((0, CORNERS))]
        self._meshes: list[tuple[int, int, TriMesh]] = []
        nodes = triangles = 0
        for k, shape in enumerate(shapes):
            if shape.mesh is None:
                continue
            if shape.mesh.hash not in starts:
                tree = mesh_tree(shape.mesh)
                held, below = widened(tree.bounds, tree.links)
                below[..., 0] += np.where(below[..., 1] > 0, triangles, nodes)
                boxes.append(held)
                children.append(below)
                orders.append(tree.order)
                corners.append(tree.corners)
                starts[shape.mesh.hash] = nodes, tree.bounds[0]
                self._meshes.append((triangles, len(tree.order), shape.mesh))
                nodes, triangles = nodes + len(below), triangles + len(tree.order)
            self._roots[k], self._mesh_boxes[k] = starts[shape.mesh.hash]
        self._faces = np.concatenate(orders)
        self._corners = np.concatenate(corners).ravel()
        self._in_meshes = np.concatenate(boxes), np.concatenate(children).ravel(), self._corners

    @property
    def sizes(self) -> Array:
        """Size of each shape in the format of the kernels [m]; shape (shapes, 3)."""
        found: Array = self._local.reshape(-1, primitives.STRIDE)[:, 12:15]
        return found

    @property
    def frames(self) -> Array:
        """Pose of each shape: rotation by rows and position; shape (shapes, 12)."""
        found: Array = self._world.reshape(-1, primitives.STRIDE)[:, :12]
        return found

    @property
    def boxes(self) -> Array:
        """Lowest and highest corner of each finite shape [m]; shape (shapes, 6)."""
        return self._boxes

    def triangles_of(self, shape: int) -> tuple[int, NDArray[np.int64]]:
        """Return the index of the first triangle of a shape's mesh, and the mesh's own indices of its triangles."""
        mesh = self.shapes[shape].mesh
        return next((first, faces) for first, faces, each in self.meshes if mesh is not None and each.hash == mesh.hash)

    @property
    def triangle_count(self) -> int:
        """Number of triangles of all meshes."""
        return len(self._faces)

    @property
    def meshes(self) -> Iterator[tuple[int, NDArray[np.int64], TriMesh]]:
        """Index of the first triangle of each mesh, its own indices of its triangles, and the mesh."""
        for first, count, mesh in self._meshes:
            yield first, self._faces[first : first + count], mesh

    def place(self, poses: ArrayLike) -> None:
        """Move the bodies.

        Args:
            poses: x y z [m] and quaternion x y z w of every body of the scene, in its order; shape (bodies, 7).
        """
        rows = np.ascontiguousarray(poses, dtype=float).reshape(self._poses.shape)
        kernel("place")(
            rows, self._poses, self._local, self.bodies, self._kinds, self._mesh_boxes, self._world, self._boxes,
            self._order, self._bounds, self._links, self._wide, self._origins, self._children, self._health,
            self._scratch,
        )  # fmt: skip

    def cast(
        self,
        origins: ArrayLike,
        directions: ArrayLike,
        *,
        near: float = 0.0,
        far: float = inf,
        frame: ArrayLike | None = None,
        normals: bool = False,
    ) -> Hits:
        """Cast rays at the shapes in their current poses.

        Casting is fastest if neighbouring rays in the array are neighbours in space.

        Args:
            origins: [m], one for all rays or one each; shape (3,) or (n, 3).
            directions: of length 1; shape (n, 3).
            near: minimum distance of a hit [m].
            far: maximum distance of a hit [m].
            frame: placement of the frame of the rays, shape (4, 4); None for the world.
            normals: whether to compute normals.
        """
        directions = np.ascontiguousarray(directions, dtype=float).reshape(-1, 3)
        count = len(directions)
        origins = np.ascontiguousarray(origins, dtype=float).reshape(-1, 3)
        if len(origins) not in (1, count):
            raise ValueError(f"{len(origins)} origins for {count} rays")
        placed = np.eye(4) if frame is None else np.asarray(frame, dtype=float)
        distances, facing = np.empty(count), np.empty((count if normals else 0, 3))
        hits, parts = np.empty(count, dtype=np.int64), np.empty(count, dtype=np.int64)
        kernel("cast")(
            self.kernel_scene, np.concatenate([placed[:3, :3].ravel(), placed[:3, 3]]), origins, directions,
            float(near), float(min(far, FAR)), np.empty(SCRATCH), distances, hits, parts, facing,
        )  # fmt: skip
        if len(self._faces):
            parts = np.where(parts >= 0, self._faces[parts], -1)
        return Hits(distances, hits, facing if normals else None, parts)


def widened(bounds: Array, links: Numbers) -> tuple[Array, Numbers]:
    """Return boxes and children of the tree with eight children per node, see `wide_bvh.widen`.

    Args:
        bounds: boxes of the nodes of the binary tree; shape (nodes, 6).
        links: links of these nodes, see `bvh.build`; shape (nodes, 2).
    """
    most = len(links) // 2 + 1
    children, origins = np.empty((most, CHILDREN, 3), dtype=np.int64), np.empty(most, dtype=np.int64)
    nodes = kernel("widen")(bounds, links, children, origins)
    boxes = np.empty((nodes, BOXES))
    kernel("fill")(bounds, children, nodes, boxes)
    return boxes, children[:nodes].copy()


def _is_infinite(shape: Shape) -> bool:
    return isinstance(shape.geometry, Plane) and shape.role == "collision"


def _numbers(shape: Shape) -> tuple[int, tuple[float, float, float], Array]:
    """Return the kind of a shape, its size in the format of the kernels, and the rotation of its frame."""
    straight = np.eye(3)
    if shape.mesh is not None:
        return primitives.MESH, (0.0, 0.0, 0.0), straight
    match shape.geometry:
        case Box(size=(x, y, z)):
            return primitives.BOX, (x / 2, y / 2, z / 2), straight
        case Sphere(radius=radius):
            return primitives.SPHERE, (radius, 0.0, 0.0), straight
        case Cylinder(radius=radius, length=length):
            return primitives.CYLINDER, (radius, length / 2, 0.0), straight
        case Capsule(radius=radius, length=length):
            return primitives.CAPSULE, (radius, length / 2, 0.0), straight
        case Cone(radius=radius, length=length):
            return primitives.CONE, (radius, length / 2, 0.0), straight
        case Ellipsoid(radii=radii):
            return primitives.ELLIPSOID, radii, straight
        case Plane(normal=normal, size=(x, y)):
            wide = (FAR, FAR, 0.0) if shape.role == "collision" else (x / 2, y / 2, 0.0)
            return primitives.PLANE, wide, upright(normal)
        case _:
            return primitives.MESH, (0.0, 0.0, 0.0), straight
