"""Extent of a scene: the lowest point and axis-aligned bounds.

Exact: in closed form for boxes, spheres, cylinders and capsules; by all vertices for meshes.
"""

from collections.abc import Container

import numpy as np
from numpy.typing import ArrayLike

from urdfkit.description.urdf.robot import Box, Capsule, Cylinder, Sphere
from urdfkit.linear_algebra import Array, matmul
from urdfkit.scene.pose_matrices import pose_matrices
from urdfkit.scene.scene_table import Role, Scene, Shape


def bounds(
    scene: Scene, poses: ArrayLike, *, role: Role | None = None, of: Container[str] | None = None
) -> Array | None:
    """Return the lowest and highest corner of the axis-aligned bounding box of the scene [m]; shape (2, 3).

    Args:
        scene: the shapes.
        poses: of the bodies, x y z [m] and quaternion x y z w, shape (len(scene.bodies), 7).
        role: only visuals or only collisions; both when None.
        of: names of the bodies; all when None.

    Returns:
        None where there is no shape.

    Examples:
        >>> import urdfkit
        >>> from urdfkit.scene import bounds, scene_of
        >>> kinematics = urdfkit.Kinematics("simpleton")
        >>> bounds(scene_of(kinematics.robot), kinematics.link_poses(kinematics.neutral())).round(2)
        array([[-0.38, -0.26,  0.  ],
               [ 0.13,  0.26,  0.26]])
    """
    matrices = pose_matrices(poses)
    found = [
        shape_bounds(shape, matrices[scene.body_index[shape.body]])
        for shape in scene.shapes
        if (role is None or shape.role == role) and (of is None or shape.body in of)
    ]
    if not found:
        return None
    corners = np.array(found)
    return np.array([corners[:, 0].min(axis=0), corners[:, 1].max(axis=0)])


def lowest_point(scene: Scene, poses: ArrayLike, *, of: Container[str] | None = None) -> float | None:
    """Return the lowest z of all collision shapes [m]; None without collision shapes.

    Args:
        scene: the shapes.
        poses: of the bodies, shape (len(scene.bodies), 7).
        of: names of the bodies; all when None.

    Examples:
        >>> import urdfkit
        >>> from urdfkit.scene import lowest_point, scene_of
        >>> kinematics = urdfkit.Kinematics("simpleton")
        >>> lowest_point(scene_of(kinematics.robot), kinematics.link_poses(kinematics.neutral()))
        0.0
    """
    box = bounds(scene, poses, role="collision", of=of)
    return None if box is None else float(box[0, 2])


def shape_bounds(shape: Shape, body: Array) -> Array:
    """Return the lowest and highest corner of one shape [m]; shape (2, 3).

    Args:
        shape: the shape.
        body: placement of its body in the world, shape (4, 4).
    """
    placement = matmul(body, shape.placement)
    R, center = placement[:3, :3], placement[:3, 3]
    if shape.mesh is not None:
        points = matmul(shape.mesh.vertices.astype(float), R.T) + center
        return np.array([points.min(axis=0), points.max(axis=0)])
    # The support of a solid along ±e is its reach from the centre; along world axis k, R[k] is e in the solid's frame.
    along = np.abs(R[:, 2])
    match shape.geometry:
        case Box(size=size):
            reach = matmul(np.abs(R), np.array(size) / 2)
        case Sphere(radius=radius):
            reach = np.full(3, radius)
        case Cylinder(radius=radius, length=length):
            reach = along * length / 2 + radius * np.sqrt(np.maximum(0.0, 1.0 - along**2))
        case Capsule(radius=radius, length=length):
            reach = along * length / 2 + radius
        case _:
            reach = np.zeros(3)
    return np.array([center - reach, center + reach])
