"""What a world holds besides robots, as bodies of the engine."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from urdfkit.description.robot import Geometry, Mesh
from urdfkit.description.world import Ellipsoid, Plane, World, WorldJoint, WorldLink, WorldModel, WorldRobot, WorldShape
from urdfkit.errors import SimulationError
from urdfkit.scene import MeshLoader, Shape
from urdfkit.scene.colors import DEFAULT, GAZEBO
from urdfkit.scene.placement import pose_matrix
from urdfkit.sim.engine import Body, Piece, Surface

Array = NDArray[np.float64]
Placed = tuple[str, Array, WorldLink]
"""Name, pose in the world as a matrix, and link."""


def bodies_of(world: World) -> tuple[Body, ...]:
    """Return the bodies of a world: each model is one if all its links hold together, else each link is.

    A body has the name of its model, with ``::`` and the name of the link where there are several. The plane that is
    the world's ground is left to the engine.

    Raises:
        SimulationError: something in it cannot be simulated, with its place.
    """
    things: tuple[WorldRobot | WorldJoint, ...] = (*world.robots, *world.joints)
    for thing in things:
        raise SimulationError(
            f"`{thing.name}` cannot be simulated yet: a world holds bodies without joints", position=thing.position
        )
    meshes = MeshLoader()
    ground = None if world.ground is None else world.ground.name
    return tuple(body for model in world.models for body in _bodies(model, meshes, is_ground=model.name == ground))


def _bodies(model: WorldModel, meshes: MeshLoader, *, is_ground: bool) -> Iterator[Body]:
    for name, static, links in groups_of(model):
        if not static:
            yield _merged(name, links, meshes)
            continue
        _, pose, link = links[0]
        pieces = tuple(
            _piece(shape, np.eye(4), name, meshes)
            for shape in link.collisions
            if not (is_ground and isinstance(shape.geometry, Plane))
        )
        if pieces or not is_ground:
            yield Body(name, _seven(pose), pieces, static=True)


def groups_of(model: WorldModel) -> Iterator[tuple[str, bool, list[Placed]]]:
    """Yield name, whether it is static, and the links of each body of a model; the first link's frame is the body's.

    Raises:
        SimulationError: a joint that cannot be simulated, with its place.
    """
    root = pose_matrix(model.pose)
    links: list[Placed] = [(name, root @ pose_matrix(pose), link) for name, pose, link in model.all_links()]
    static, joined = model.static, False
    for prefix, joint in model.all_joints():
        if static:
            continue
        if joint.type != "fixed":
            raise SimulationError(
                f"joint `{prefix}{joint.name}` of model `{model.name}` cannot be simulated yet: "
                "models of a world hold fixed joints only",
                position=joint.position,
            )
        joined = True
        static = joint.parent == "world"
    if joined and not static and len(list(model.all_joints())) < len(links) - 1:
        raise SimulationError(
            f"model `{model.name}` cannot be simulated yet: fixed joints hold some of its links together, but not all",
            position=model.position,
        )
    if joined and not static:
        yield model.name, False, links
        return
    for link in links:
        yield model.name if len(links) == 1 else f"{model.name}::{link[0]}", static, [link]


def _merged(name: str, links: list[Placed], meshes: MeshLoader) -> Body:
    """Return one free body of links that hold together, in the frame of the first."""
    frame = links[0][1]
    masses, centres, tensors, pieces = [], [], [], []
    for _, pose, link in links:
        if not link.gravity or link.kinematic:
            wish = "to float without gravity" if not link.gravity else "to be moved by command only"
            raise SimulationError(
                f"link `{link.name}` of `{name}` asks {wish}, which cannot be simulated yet", position=link.position
            )
        inside = np.linalg.inv(frame) @ pose
        inertial = link.inertial
        axes = inside @ pose_matrix(inertial.pose)
        ixx, ixy, ixz, iyy, iyz, izz = (
            getattr(inertial, entry) for entry in ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
        )
        tensor = np.array([[ixx, ixy, ixz], [ixy, iyy, iyz], [ixz, iyz, izz]])
        masses.append(inertial.mass)
        centres.append(axes[:3, 3])
        tensors.append(axes[:3, :3] @ tensor @ axes[:3, :3].T)
        for shape in link.collisions:
            if isinstance(shape.geometry, Plane):
                raise SimulationError(
                    f"`{name}` is free to move and holds a plane without end: make it static", position=shape.position
                )
            pieces.append(_piece(shape, inside, name, meshes))
    mass = float(sum(masses))
    weights = np.array(masses) / mass if mass > 0.0 else np.full(len(masses), 1.0 / len(masses))
    centre = weights @ np.array(centres)
    inertia = np.zeros((3, 3))
    for m, c, tensor in zip(masses, centres, tensors, strict=True):
        off = c - centre
        inertia += tensor + m * (off @ off * np.eye(3) - np.outer(off, off))
    return Body(name, _seven(frame), tuple(pieces), mass=mass, centre=tuple(centre.tolist()), inertia=inertia.tolist())


def looks_of(world: World) -> tuple[Shape, ...]:
    """Return what the bodies of a world look like, each shape under the name that its body has in `bodies_of`.

    Planes and ellipsoids, and visuals whose mesh is not there, are left out.

    Raises:
        ResourceError: a mesh is broken.
    """
    meshes = MeshLoader()
    found: list[Shape] = []
    for model in world.models:
        for body, _, links in groups_of(model):
            into = np.linalg.inv(links[0][1])
            for _, pose, link in links:
                for shape in link.visuals:
                    geometry: Any = shape.geometry
                    if isinstance(geometry, (Plane, Ellipsoid)) or (isinstance(geometry, Mesh) and not shape.file):
                        continue
                    mesh = meshes.load(Path(shape.file), geometry.scale) if isinstance(geometry, Mesh) else None
                    placement = into @ pose @ pose_matrix(shape.pose)
                    name = f"{body}/visual/{len(found)}"
                    rgba = _color(shape)
                    found.append(
                        Shape(name, body, "visual", geometry, placement, rgba or DEFAULT, rgba is not None, mesh)
                    )
    return tuple(found)


def _color(shape: WorldShape) -> tuple[float, float, float, float] | None:
    rgba = shape.rgba or GAZEBO.get(shape.material.removeprefix("Gazebo/"))
    return None if rgba is None else (*rgba[:3], rgba[3] * (1.0 - shape.transparency))


def _piece(shape: WorldShape, frame: Array, name: str, meshes: MeshLoader) -> Piece:
    geometry: Any = shape.geometry
    if isinstance(geometry, Ellipsoid):
        raise SimulationError(
            f"collision `{shape.name}` of `{name}` is an ellipsoid, which cannot be simulated yet; take a sphere",
            position=shape.position,
        )
    placement = frame @ pose_matrix(shape.pose)
    if isinstance(geometry, Plane):
        placement[:3, :3] = placement[:3, :3] @ _upright(np.array(geometry.normal))
    mesh = meshes.load(Path(shape.file), geometry.scale) if isinstance(geometry, Mesh) else None
    surface = Surface(shape.surface.mu, shape.surface.mu2, shape.surface.fdir1 if any(shape.surface.fdir1) else None)
    return Piece(Shape(shape.name, name, "collision", cast("Geometry", geometry), placement, mesh=mesh), surface)


def _upright(normal: Array) -> Array:
    """Return a rotation that takes z to a unit vector."""
    across = np.eye(3)[int(np.argmin(np.abs(normal)))]
    x = np.cross(across, normal)
    x /= np.linalg.norm(x)
    return np.column_stack([x, np.cross(normal, x), normal])


def _seven(matrix: Array) -> tuple[float, ...]:
    import pinocchio as pin

    return tuple(pin.SE3ToXYZQUAT(pin.SE3(matrix)).tolist())
