"""Bodies and joint trees of a world, for the engine."""

from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any, cast

import numpy as np

from urdfkit.description.plugins import match
from urdfkit.description.sdf import Cone, Ellipsoid, Plane, World, WorldLink, WorldModel, WorldShape
from urdfkit.description.sdf.link_groups import Group, groups_of
from urdfkit.description.sdf.model_as_robot import Tree, all_kept, tree_of
from urdfkit.description.sdf.shapes import plugins_of
from urdfkit.description.urdf.geometry import compose
from urdfkit.description.urdf.robot import Geometry, Mesh, Pose
from urdfkit.errors import SimulationError
from urdfkit.linear_algebra import Array, inverse_placement, matmul
from urdfkit.scene import MeshLoader, Scene, Shape
from urdfkit.scene.colors import DEFAULT
from urdfkit.scene.pose_matrices import pose_matrix, upright
from urdfkit.scene.scene_table import Role
from urdfkit.scene.world_shapes import color_of
from urdfkit.sim.construction.primitive_hulls import hull_of
from urdfkit.sim.construction.validation import impossible
from urdfkit.sim.engine import Body, Piece, Surface
from urdfkit.sim.state.poses import seven

Placed = tuple[str, Pose, WorldLink]
"""Name in the model, pose in the model, and link."""


def require_no_joints(world: World) -> None:
    """Check that no joint connects two models.

    Raises:
        SimulationError: a joint connects two models; with its place.
    """
    for joint in world.joints:
        message = f"joint `{joint.name}` of the world cannot be simulated: joints must connect links of the same model"
        raise SimulationError(message, position=joint.position)


def parts_of(model: WorldModel) -> Iterator[tuple[str, bool, list[Placed]]]:
    """Yield the name, whether it is static, and the links of each body of a model; its frame is that of the first link.

    A body has the name of its model; if the model has several bodies, ``::`` and the name of the link are appended.
    """
    if model.static:
        links = list(model.all_links())
        for link in links:
            yield model.name if len(links) == 1 else f"{model.name}::{link[0]}", True, [link]
        return
    for group in groups_of(model):
        if is_tree(model, group):
            continue
        if not group.fixed_base:
            yield group.name, False, list(group.links)
            continue
        for link in group.links:
            yield group.name if len(group.links) == 1 else f"{model.name}::{link[0]}", True, [link]


def trees_of(model: WorldModel) -> tuple[Tree, ...]:
    """Return the trees of a model that are simulated like robots: with movable joints, plugins or sensors.

    Raises:
        SimulationError: a joint cannot be simulated; with its place.
    """
    if model.static:
        return ()
    return tuple(tree_of(model, group) for group in groups_of(model) if is_tree(model, group))


def is_tree(model: WorldModel, group: Group) -> bool:
    """Return whether links are simulated like a robot instead of a body."""
    return group.moves or (not group.fixed_base and has_plugins(model, group))


def has_plugins(model: WorldModel, group: Group) -> bool:
    """Return whether these links have sensors or supported plugins."""
    if any(kept.element.tag == "sensor" for _, _, link in group.links for kept in link.kept):
        return True
    return group.first and any(match(plugin) is not None for plugin in plugins_of(tuple(all_kept(model))))


def bodies_of_model(model: WorldModel, meshes: MeshLoader, *, is_ground: bool) -> Iterator[Body]:
    """Yield the bodies of a model. The plane that is the world's ground is omitted: the engine has its own.

    Raises:
        SimulationError: a link cannot be simulated; with its place.
    """
    for name, static, links in parts_of(model):
        if not static:
            yield _merged(name, model.pose, links, meshes)
            continue
        _, pose, link = links[0]
        pieces = tuple(
            _piece(shape, np.eye(4), name, meshes)
            for shape in touchable(link)
            if not (is_ground and isinstance(shape.geometry, Plane))
        )
        if pieces or not is_ground:
            yield Body(name, seven(compose(model.pose, pose)), pieces, static=True)


def scene_of_tree(tree: Tree, meshes: MeshLoader) -> Scene:
    """Return the shapes of a tree, by the names of its links in `Tree.robot`.

    Raises:
        SimulationError: a link cannot be simulated; with its place.
        ResourceError: a mesh is invalid.
    """
    shapes: list[Shape] = []
    for name, link in tree.links.items():
        _require_ordinary(link, tree.name)
        for shape in touchable(link):
            if isinstance(shape.geometry, Plane):
                raise _infinite_plane_error(tree.name, shape)
            shapes.append(_shape(shape, f"{name}/collision/{shape.name}", name, "collision", np.eye(4), meshes))
        shapes += _visuals(name, link, np.eye(4), meshes, len(shapes))
    return Scene(tuple(link.name for link in tree.robot.links), tuple(shapes))


def surfaces_of_tree(tree: Tree, note: Callable[[str], None]) -> dict[str, Surface]:
    """Return the surface of each link: all its collisions get the lowest friction coefficient of any of them.

    Args:
        tree: a tree of a world.
        note: reports a warning to the user.
    """
    found = {}
    for name, link in tree.links.items():
        surfaces = [_surface(shape) for shape in link.collisions]
        if not surfaces:
            continue
        found[name] = min(surfaces, key=lambda surface: surface.mu)
        if any(each.mu != found[name].mu for each in surfaces):
            note(
                f"{link.position}: the collisions of link `{link.name}` have different friction, which is not "
                f"supported for links with joints: all have mu {found[name].mu:g}"
            )
    return found


def visuals_of(world: World) -> tuple[Shape, ...]:
    """Return the visuals of the bodies of a world, by the names of their bodies.

    Planes, and visuals with a missing mesh, are omitted.

    Raises:
        ResourceError: a mesh is invalid.
    """
    meshes = MeshLoader()
    found: list[Shape] = []
    for model in world.models:
        for body, _, links in parts_of(model):
            into = inverse_placement(pose_matrix(links[0][1]))
            for _, pose, link in links:
                found += _visuals(body, link, matmul(into, pose_matrix(pose)), meshes, len(found))
    return tuple(found)


def _visuals(body: str, link: WorldLink, frame: Array, meshes: MeshLoader, number: int) -> list[Shape]:
    shown = [s for s in link.visuals if not isinstance(s.geometry, Plane) and (s.file or type(s.geometry) is not Mesh)]
    return [
        _shape(shape, f"{body}/visual/{number + k}", body, "visual", frame, meshes) for k, shape in enumerate(shown)
    ]


def _merged(name: str, around: Pose, links: Sequence[Placed], meshes: MeshLoader) -> Body:
    """Return one movable body of rigidly connected links, in the frame of the first."""
    frame = pose_matrix(links[0][1])
    masses, centres, tensors, pieces = [], [], [], []
    for _, pose, link in links:
        _require_ordinary(link, name)
        inside = matmul(inverse_placement(frame), pose_matrix(pose))
        inertial = link.inertial
        axes = matmul(inside, pose_matrix(inertial.pose))
        ixx, ixy, ixz, iyy, iyz, izz = (
            getattr(inertial, entry) for entry in ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
        )
        tensor = np.array([[ixx, ixy, ixz], [ixy, iyy, iyz], [ixz, iyz, izz]])
        masses.append(inertial.mass)
        centres.append(axes[:3, 3])
        tensors.append(matmul(matmul(axes[:3, :3], tensor), axes[:3, :3].T))
        for shape in touchable(link):
            if isinstance(shape.geometry, Plane):
                raise _infinite_plane_error(name, shape)
            pieces.append(_piece(shape, inside, name, meshes))
    mass = float(sum(masses))
    weights = np.array(masses) / mass if mass > 0.0 else np.full(len(masses), 1.0 / len(masses))
    centre = matmul(weights, np.array(centres))
    inertia = np.zeros((3, 3))
    for m, c, tensor in zip(masses, centres, tensors, strict=True):
        off = c - centre
        inertia += tensor + m * (matmul(off, off) * np.eye(3) - np.outer(off, off))
    where = seven(compose(around, links[0][1]))
    light = [0.0 if link.gravity else m for (_, _, link), m in zip(links, masses, strict=True)]
    light_centre = matmul(np.array(light), np.array(centres)) / sum(light) if any(light) else np.zeros(3)
    return Body(
        name,
        where,
        tuple(pieces),
        mass=mass,
        centre=tuple(centre.tolist()),
        inertia=inertia.tolist(),
        weightless=float(sum(light)),
        weightless_centre=tuple(light_centre.tolist()),
    )


def _require_ordinary(link: WorldLink, name: str) -> None:
    if why := impossible(link.inertial.rows):
        raise SimulationError(
            f"the inertia of link `{link.name}` of `{name}` is impossible: {why}", position=link.position
        )
    if link.kinematic:
        raise SimulationError(
            f"link `{link.name}` of `{name}` is kinematic, which is not supported", position=link.position
        )


def _infinite_plane_error(name: str, shape: WorldShape) -> SimulationError:
    return SimulationError(f"`{name}` is movable and has an infinite plane; make it static", position=shape.position)


def touchable(link: WorldLink) -> Iterator[WorldShape]:
    """Yield the collision shapes of a link that generate contacts."""
    for shape in link.collisions:
        if shape.surface.collide_bitmask and not shape.surface.collide_without_contact:
            yield shape


def _piece(shape: WorldShape, frame: Array, name: str, meshes: MeshLoader) -> Piece:
    return Piece(_shape(shape, shape.name, name, "collision", frame, meshes), _surface(shape))


def _surface(shape: WorldShape) -> Surface:
    return Surface(shape.surface.mu, shape.surface.mu2, shape.surface.fdir1 if any(shape.surface.fdir1) else None)


def _shape(shape: WorldShape, name: str, body: str, role: Role, frame: Array, meshes: MeshLoader) -> Shape:
    """Return a shape of a world as a shape of the scene; `frame` is the pose of its link."""
    geometry: Any = shape.geometry
    placement = matmul(frame, pose_matrix(shape.pose))
    mesh = None
    if isinstance(geometry, Plane):
        placement[:3, :3] = matmul(placement[:3, :3], upright(geometry.normal))
    elif isinstance(geometry, (Cone, Ellipsoid)):
        mesh, geometry = hull_of(geometry), Mesh("")
    elif isinstance(geometry, Mesh):
        mesh = meshes.load(Path(shape.file), geometry.scale)
    rgba = color_of(shape) if role == "visual" else None
    return Shape(
        name, body, role, cast("Geometry", geometry), placement, rgba or DEFAULT, rgba is not None, mesh,
        shape.laser_retro,
    )  # fmt: skip
