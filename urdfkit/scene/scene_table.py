"""The scene table: all shapes of all bodies, for sensors and viewer."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from urdfkit.defect_message import with_effect
from urdfkit.description.packages.existence import is_absolute
from urdfkit.description.sdf import Cone, Ellipsoid, Plane
from urdfkit.description.urdf.parser import EMPTY_NAME
from urdfkit.description.urdf.repair_record import Repair, Severity
from urdfkit.description.urdf.robot import Collision, Geometry, Link, Material, Mesh, Robot, Visual
from urdfkit.description.xml.element import Element
from urdfkit.description.xml.source import Position
from urdfkit.description.xml.start_tag import WrittenAttributes
from urdfkit.errors import KinematicsError, ResourceError
from urdfkit.meshes.loader import MeshLoader
from urdfkit.meshes.specular import MATT, Gloss
from urdfkit.meshes.texture_mapping import Wrapper
from urdfkit.meshes.triangle_mesh import TriMesh
from urdfkit.scene.colors import DEFAULT, Palette, Rgba
from urdfkit.scene.pose_matrices import pose_matrices, pose_matrix
from urdfkit.scene.segmentation_labels import labels_of

Role = Literal["visual", "collision"]


@dataclass(frozen=True, slots=True, eq=False)
class Shape:
    """A visual or collision shape.

    Attributes:
        name: unique in the scene, ``body/role/…`` with the name written in the description or a number.
        body: name of the body (link) it is fixed to.
        role: ``visual`` or ``collision``.
        geometry: box, cylinder, sphere, capsule or mesh as written; in a world, plane, ellipsoid and cone, too.
        placement: of the shape in its body, shape (4, 4), read-only.
        rgba: colour and opacity, 0..1; the colour is `DEFAULT`'s where the description names none.
        has_color: whether `rgba` replaces the mesh's own colours; if not, these are shown with the opacity of `rgba`.
        mesh: the triangles of a mesh, its scale applied; None for the other geometries.
        laser_retro: intensity that a lidar measures.
        label: label that a segmentation camera measures; 0 for none.
        gloss: specular colour, 0..1, and exponent; an exponent of zero means matt.
        position: source position of its texture, else of its mesh; None without either.
        is_placeholder: whether it stands for a shape that cannot be shown; see `with_placeholders`.

    Examples:
        >>> import urdfkit
        >>> from urdfkit.scene import scene_of
        >>> shape = scene_of(urdfkit.load("simpleton")).shapes[0]
        >>> shape.name, shape.role, shape.geometry
        ('chassis/visual/0', 'visual', Box(size=(0.5, 0.3, 0.1)))
    """

    name: str
    body: str
    role: Role
    geometry: Geometry | Plane | Ellipsoid | Cone
    placement: NDArray[np.float64] = field(repr=False)
    rgba: Rgba = DEFAULT
    has_color: bool = False
    mesh: TriMesh | None = None
    laser_retro: float = 0.0
    label: int = 0
    gloss: Gloss = MATT
    position: Position | None = None
    is_placeholder: bool = False


_CODES = {"name": "E014", "package": "G602", "file": "G601", "format": "G606"}
"""Kind of the error of a mesh → code of the lint rule that reports it."""


@dataclass(frozen=True)
class MissingMesh:
    """A shape that is missing because its mesh cannot be loaded.

    Attributes:
        name: as its `Shape` would have.
        body: name of the link it would be fixed to.
        role: ``visual`` or ``collision``.
        error: the reason, with the source position of the mesh.
        uri: the mesh in the description.
        is_absolute: whether the source has the absolute path of a file, which is valid on one machine only.
    """

    name: str
    body: str
    role: Role
    error: ResourceError
    uri: str
    is_absolute: bool = False

    @property
    def code(self) -> str:
        """Code of the lint rule that reports the mesh."""
        if self.is_absolute and self.error.kind == "file":
            return "G603"
        return _CODES.get(self.error.kind, "G607")

    def repair(self, effect: str, severity: Severity = "warning") -> Repair:
        """Return the repair of a robot without the shape, with the consequence."""
        message, at, package = with_effect(self.error.message, effect), self.error.position, self.error.package
        return Repair("mesh", self.code, message, at, self.body, severity=severity, package=package)


@dataclass(frozen=True, eq=False)
class Scene:
    """The bodies and shapes of a scene.

    Attributes:
        bodies: names of the bodies; poses come as arrays of shape (len(bodies), 7) in this order.
        shapes: all shapes, body by body.
        problems: the missing shapes, unless errors are raised.

    Examples:
        >>> import urdfkit
        >>> from urdfkit.scene import scene_of
        >>> kinematics = urdfkit.Kinematics("simpleton")
        >>> scene = scene_of(kinematics.robot)
        >>> scene.bodies[:2], len(scene.shapes), len(scene.with_role("collision"))
        (('base_footprint', 'chassis'), 10, 5)
        >>> poses = kinematics.link_poses(kinematics.neutral())
        >>> poses[scene.body_index["chassis"], :3]  # [m]
        array([0. , 0. , 0.1])
        >>> scene.to_trimesh(poses, role="collision").extents.round(2)  # [m]
        array([0.5 , 0.52, 0.26])
    """

    bodies: tuple[str, ...]
    shapes: tuple[Shape, ...]
    problems: tuple[MissingMesh, ...] = ()

    @cached_property
    def body_index(self) -> dict[str, int]:
        """Body name → its row in an array of poses."""
        return {name: row for row, name in enumerate(self.bodies)}

    def with_role(self, role: Role) -> tuple[Shape, ...]:
        """Return the visuals or the collisions."""
        return tuple(shape for shape in self.shapes if shape.role == role)

    def to_trimesh(self, poses: ArrayLike, *, role: Role = "visual") -> Any:
        """Return the scene as ``trimesh.Scene``: a node for each body, below it the nodes of its shapes.

        Args:
            poses: x y z [m] and quaternion x y z w of the bodies in the world, such as those of
                `Kinematics.link_poses`; shape (len(bodies), 7).
            role: which shapes.

        Raises:
            MissingDependencyError: trimesh is not installed.
            KinematicsError: another number of poses.
        """
        from urdfkit.scene.trimesh_shapes import empty_scene, meshes_of

        matrices = pose_matrices(poses)
        if len(matrices) != len(self.bodies):
            raise KinematicsError(f"{len(matrices)} poses for {len(self.bodies)} bodies")
        base = "world"
        while base in self.body_index:
            base += "_"
        scene = empty_scene(base)
        for body, matrix in zip(self.bodies, matrices, strict=True):
            scene.graph.update(frame_from=base, frame_to=body, matrix=matrix)
        for shape in self.with_role(role):
            for k, mesh in enumerate(meshes_of(shape.geometry, shape.mesh, shape.rgba, has_color=shape.has_color)):
                name = f"{shape.name}/{k}" if k else shape.name
                scene.add_geometry(mesh, name, name, shape.body, shape.placement)
        return scene


def scene_of(robot: Robot, *, strict: bool = True, meshes: MeshLoader | None = None) -> Scene:
    """Return the scene of one robot; its bodies are the links in document order.

    Args:
        robot: a loaded robot; its `packages` resolve the URIs of meshes.
        strict: raise an error for the first missing mesh; otherwise its shape is omitted and listed in `problems`.
        meshes: loader of the mesh files; with the same loader, only changed files are read again.

    Raises:
        ResourceError: a mesh is missing or broken (`strict`), with the place where it is named.

    Examples:
        >>> import urdfkit
        >>> from urdfkit.scene import scene_of
        >>> scene = scene_of(urdfkit.load("simpleton"))
        >>> [shape.body for shape in scene.with_role("collision")]
        ['chassis', 'left_wheel', 'right_wheel', 'caster', 'camera']
    """
    meshes = meshes or MeshLoader()
    palette, wrapper = Palette(robot), Wrapper(lambda name: _resolve(robot, name))
    links = robot.link_by_name_in_order()
    retros, labels = _laser_retros(robot), labels_of(robot)
    shapes: list[Shape] = []
    problems: list[MissingMesh] = []
    sources = WrittenAttributes()
    for link in links:
        names: set[str] = set()
        for role, number, item in _items(link):
            if item.geometry is None:
                continue
            name = f"{link.name}/{role}/{item.name or number}"
            while name in names:
                name += "_"
            names.add(name)
            mesh = None
            material = palette.textured(item) if isinstance(item, Visual) else None
            picture, position = (material.texture, _texture_position(material)) if material else (None, None)
            if isinstance(item.geometry, Mesh):
                position = position or _mesh_position(item)
                try:
                    mesh = _load(robot, item, item.geometry, meshes, places=bool(picture))
                except ResourceError as error:
                    if strict:
                        raise
                    uri, tag = item.geometry.uri, _mesh_position(item)
                    written = sources.at(tag, "filename")
                    is_literal = is_absolute(uri) and written is not None and written.raw == uri
                    if written is not None and written.name.start.line != tag.line:
                        error.position = written.name.start  # As the linter reports it.
                    problems.append(MissingMesh(name, link.name, role, error, uri, is_literal))
                    continue
            color = palette.of(link.name, item) if isinstance(item, Visual) else None
            own = role == "visual" and mesh is not None and mesh.has_own_colors
            covered = wrapper.wrapped(item.geometry, mesh, picture) if picture else None
            mesh = covered or mesh
            rgba = color or DEFAULT
            if own and mesh is not None:  # the colour is that of parts without material; its opacity is that of all
                mesh, rgba = mesh.with_open_color((*rgba[:3], 1.0)), (*DEFAULT[:3], rgba[3])
            if role == "visual" and (opacity := palette.opacity(link.name)) < 1.0:
                rgba = (*rgba[:3], rgba[3] * opacity)
            placed = pose_matrix(item.origin)
            retro, label = retros.get(link.name, 0.0), labels.get(link.name, labels.get("", 0))
            gloss = palette.gloss(link.name) if role == "visual" else MATT
            shown = bool(color and not covered and not own)
            looks = rgba, shown, mesh, retro, label, gloss, position
            shapes.append(Shape(name, link.name, role, item.geometry, placed, *looks))
    return Scene(tuple(link.name for link in links), tuple(shapes), tuple(problems))


def _laser_retros(robot: Robot) -> dict[str, float]:
    """Return link → the ``<laserRetro>`` of its ``<gazebo reference=…>`` block, where it is a number."""
    found: dict[str, float] = {}
    for block in robot.gazebo:
        written: Element | None = block.element.find("laserRetro") or block.element.find("laser_retro")
        if block.reference and written is not None:
            try:
                found[block.reference] = float(written.text)
            except ValueError:
                continue
    return found


def _items(link: Link) -> list[tuple[Role, int, Visual | Collision]]:
    visuals: Sequence[Visual | Collision] = link.visuals
    found: list[tuple[Role, int, Visual | Collision]] = [("visual", k, item) for k, item in enumerate(visuals)]
    return [*found, *(("collision", k, item) for k, item in enumerate(link.collisions))]


def _load(
    robot: Robot, item: Visual | Collision, geometry: Mesh, meshes: MeshLoader, *, places: bool = False
) -> TriMesh:
    """Return the triangles of a mesh.

    Raises:
        ResourceError: with the position of the ``<mesh>`` element.
    """
    if not geometry.uri.strip():
        raise ResourceError(EMPTY_NAME, position=_mesh_position(item), kind="name")
    try:
        return meshes.load(_resolve(robot, geometry.uri, _mesh_position(item)), geometry.scale, places=places)
    except ResourceError as error:
        raise error.at(_mesh_position(item)) from error


def _mesh_position(item: Visual | Collision) -> Position:
    """Return the source position of the mesh of a shape."""
    return next((e for e in item.element.walk() if e.tag == "mesh"), item.element).origin.position


def _texture_position(material: Material) -> Position:
    """Return the source position of the texture of a material."""
    return (material.element.find("texture") or material.element).origin.position


def _resolve(robot: Robot, uri: str, position: Position | None = None) -> Path:
    """Return the file of a mesh URI; a relative path is relative to the entry file of the description."""
    entry = robot.files[0] if robot.files else Path("robot.urdf")
    if robot.packages is not None:
        return robot.packages.resolve_in_any_case(uri, entry, position)
    if uri.startswith(("package://", "model://")):
        raise ResourceError(f"mesh `{uri}` cannot be found: the robot was not loaded from a file")
    return entry.parent / uri.removeprefix("file://")
