"""Meshes: a file → triangles in metres, each file read once."""

import hashlib
import io
import logging
import re
import warnings
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from urdfkit.description.lfs_pointer import LFS, POINTER
from urdfkit.description.meshes.format_faults import (
    dae_fault,
    glb_fault,
    obj_fault,
    other_format,
    reading_fault,
    text_fault,
    wrong_format,
)
from urdfkit.description.meshes.limits import MAX_BYTES, MAX_TRIANGLES
from urdfkit.description.packages.similar_names import near_path
from urdfkit.description.urdf.robot import Vector
from urdfkit.errors import MissingDependencyError, ResourceError, did_you_mean
from urdfkit.linear_algebra import matmul
from urdfkit.meshes.collada_checks import metres_per_unit, rejection_reason
from urdfkit.meshes.collada_effects import plain_effects
from urdfkit.meshes.mesh_appearance import colors_in, gloss_in, normals_in, places_in, texture_in
from urdfkit.meshes.simplification import CHUNK, MOST_TRIANGLES, clustered, simplified
from urdfkit.meshes.stl import corners_of
from urdfkit.meshes.textures import SideFiles, Texture, is_as_read
from urdfkit.meshes.triangle_mesh import TriMesh, unique_rows

FORMATS = (".stl", ".obj", ".dae", ".glb", ".gltf", ".ply")
"""The supported file formats."""

_PULLS = re.compile(rb"<init_from>|\"uri\"")
"""Matches references to image files next to the mesh file."""


class MeshError(ResourceError):
    """A mesh file that cannot be read.

    Args:
        path: the file.
        fault: the reason, as the rest of a sentence about the mesh.
        kind: see `ResourceError`.
    """

    def __init__(self, path: Path, fault: str, kind: str = "") -> None:
        super().__init__(f"mesh {path.name} {fault}", kind=kind)
        self.fault = fault


class MeshLoader:
    """Reads mesh files and caches them by content, so that a mesh used several times is read once.

    With one loader for several scenes (live reload) only changed files are read again.

    Args:
        is_for_screen: simplify meshes of more than a million triangles (`simplification`). Large STL files are never
            in the memory as a whole mesh then.

    Examples:
        >>> import trimesh
        >>> from pathlib import Path
        >>> from urdfkit.scene import MeshLoader
        >>> data = trimesh.creation.box((1, 2, 3)).export("box.stl")
        >>> meshes = MeshLoader()
        >>> meshes.load(Path("box.stl"), scale=(2, 1, 1)).bounds
        array([[-1. , -1. , -1.5],
               [ 1. ,  1. ,  1.5]])
    """

    def __init__(self, *, is_for_screen: bool = False) -> None:
        self._is_for_screen = is_for_screen
        self._cached: dict[tuple[str, str, Vector, str, bool], tuple[TriMesh, dict[Path, tuple[int, int]]]] = {}

    def load(self, path: Path, scale: Vector = (1.0, 1.0, 1.0), *, places: bool = False) -> TriMesh:
        """Return the triangles of a file.

        A COLLADA file is converted to metres with its ``<unit meter="…">``; its ``<up_axis>`` is ignored, as RViz and
        Gazebo do. Instances are flattened; the scale may be negative.

        Args:
            path: the mesh file.
            scale: factors along x, y, z.
            places: keep texture coordinates even if the file references no texture.

        Raises:
            ResourceError: the file is missing, too large, not a mesh, a Git LFS pointer or invalid.
            MissingDependencyError: trimesh is not installed.
        """
        if path.suffix.lower() not in FORMATS:
            near = did_you_mean(path.suffix, FORMATS)
            message = f"has an unsupported format{near}{' Supported' if near else '; supported'}: {' '.join(FORMATS)}"
            raise MeshError(path, message, kind="format")
        content = _read(path)
        materials = b"".join(_material_libraries(path, content))
        is_stl = path.suffix.lower() == ".stl"
        folder = str(path.parent) if materials or (not is_stl and _PULLS.search(content)) else ""
        key = (hashlib.sha256(content + materials).hexdigest(), path.suffix.lower(), scale, folder, places)
        cached = self._cached.get(key)
        if cached is None or not is_as_read(cached[1]):
            files = SideFiles(path, MAX_BYTES)
            mesh = _parse(path, content, scale, files, places, self._is_for_screen)
            cached = self._cached[key] = simplified(mesh) if self._is_for_screen else mesh, files.read
        return cached[0]


def _read(path: Path) -> bytes:
    """Return the content of a mesh file after a check of size and header."""
    try:
        if path.is_dir():
            raise MeshError(path, "is a folder")
        if not path.is_file():
            raise ResourceError(f"missing mesh file {path}" + near_path(path), kind="file")
        if (size := path.stat().st_size) > MAX_BYTES:
            raise MeshError(
                path, f"has {size / 2**20:.0f} MiB; at most {MAX_BYTES // 2**20} are supported; decimate it"
            )
        content = path.read_bytes()
    except OSError as error:
        raise ResourceError(f"cannot read mesh {path}: {error.strerror or error}") from error
    if not content:
        raise MeshError(path, "is empty")
    if content.startswith(LFS):
        raise MeshError(path, POINTER)
    if fault := _fault(path.suffix.lower(), content):
        raise MeshError(path, fault)
    if path.suffix.lower() == ".dae" and (reason := rejection_reason(content)) is not None:
        raise MeshError(path, f"is rejected: {reason}")
    return content


def _fault(suffix: str, content: bytes) -> str:
    """Return the fault of the content of a mesh file that is found without its reader; else an empty text."""
    if suffix == ".obj":
        return obj_fault(content)
    if suffix == ".dae":
        return text_fault(suffix, content) or dae_fault(content)
    if suffix == ".glb":
        return glb_fault(content, len(content))
    if suffix != ".stl":
        return text_fault(suffix, content)
    size, wanted = len(content), 84 + 50 * int.from_bytes(content[80:84], "little")  # binary: header, count, triangles
    if b"facet" in content or 84 <= size >= wanted:
        return ""
    return wrong_format(content, suffix) if other_format(content) else f"is truncated: {size} bytes instead of {wanted}"


def _material_libraries(path: Path, content: bytes) -> Iterator[bytes]:
    """Yield the material libraries of an OBJ file, which contain its colours."""
    if path.suffix.lower() == ".obj":
        for name in re.findall(rb"^\s*mtllib[ \t]+(.+?)\s*$", content, re.MULTILINE):
            try:
                yield SideFiles(path, MAX_BYTES)[name.decode(errors="replace")]
            except KeyError:
                continue


def _parse(
    path: Path, content: bytes, scale: Vector, side_files: SideFiles, places: bool, is_for_screen: bool
) -> TriMesh:
    if path.suffix.lower() == ".stl" and (corners := corners_of(content)) is not None and not places:
        read = _of_many_corners if is_for_screen and len(corners) > MOST_TRIANGLES else _of_corners
        return read(path, corners, np.array(scale, dtype=float))
    try:
        import trimesh
    except ImportError as error:
        raise MissingDependencyError("meshes need trimesh: pip install 'urdfkit[view]'") from error
    suffix = path.suffix.lower()
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            logging.getLogger("trimesh").setLevel(logging.CRITICAL)
            plain = plain_effects(content) if suffix == ".dae" else content
            scene = trimesh.load_scene(io.BytesIO(plain), file_type=suffix[1:], resolver=side_files, process=False)
            factor = metres_per_unit(content) if suffix == ".dae" else 1.0
            mesh = _merge(path, list(_parts(scene)), np.array(scale, dtype=float) * factor, places)
    except ResourceError:
        raise
    except Exception as error:  # any error of the reader of the format, which evaluates properties when they are used
        raise MeshError(path, f"cannot be read: {reading_fault(suffix, content)}") from error
    missing, broken = tuple(dict.fromkeys(side_files.missing)), tuple(dict.fromkeys(side_files.broken))
    return replace(mesh, missing=missing, broken=broken) if missing else mesh


def _parts(scene: Any) -> Iterator[tuple[Any, Any]]:
    """Yield every instance of a mesh in a loaded scene, with its transform."""
    total = 0
    for node in scene.graph.nodes_geometry:
        transform, name = scene.graph[node]
        geometry = scene.geometry[name]
        if hasattr(geometry, "faces"):
            total += len(geometry.faces)
            if total > MAX_TRIANGLES:
                raise ResourceError(f"mesh has more than {MAX_TRIANGLES} triangles; decimate it")
            yield geometry, np.asarray(transform, dtype=float)


def _of_many_corners(path: Path, corners: NDArray[np.float32], scale: NDArray[np.float64]) -> TriMesh:
    """Return a simplified mesh from triangles of shape (m, 3, 3), scaled."""
    if len(corners) > MAX_TRIANGLES:
        raise ResourceError(f"mesh has more than {MAX_TRIANGLES} triangles; decimate it")
    if not all(np.isfinite(corners[at : at + CHUNK]).all() for at in range(0, len(corners), CHUNK)):
        raise MeshError(path, "is invalid: a vertex is not finite")
    found = clustered(len(corners), lambda chunk: corners[chunk] * scale)
    faces = found.faces[:, ::-1] if np.prod(scale) < 0 else found.faces
    return TriMesh(found.vertices, np.ascontiguousarray(faces), simplified_from=len(corners))


def _of_corners(path: Path, corners: NDArray[np.float32], scale: NDArray[np.float64]) -> TriMesh:
    """Return a mesh from triangles of shape (m, 3, 3), scaled; equal corners become one vertex."""
    if len(corners) > MAX_TRIANGLES:
        raise ResourceError(f"mesh has more than {MAX_TRIANGLES} triangles; decimate it")
    points = (corners.reshape(-1, 3).astype(float) * scale).astype(np.float32) + np.float32(0)
    if not np.isfinite(points).all():
        raise MeshError(path, "is invalid: a vertex is not finite")
    rows, index = _unique(points.view(np.uint32))
    faces = index.astype(np.int32).reshape(-1, 3)
    if np.prod(scale) < 0:  # a mirrored mesh has reversed triangles
        faces = faces[:, ::-1]
    return TriMesh(vertices=rows.view(np.float32), faces=np.ascontiguousarray(faces))


def _merge(path: Path, parts: list[tuple[Any, Any]], scale: NDArray[np.float64], places: bool) -> TriMesh:
    """Merge the parts into one mesh, scaled; vertices with equal attributes become one."""
    vertices, faces, normals, colors, uvs, wrapped, glosses = [], [], [], [], [], [], []
    textures: dict[str, Texture] = {}
    linear_colors = path.suffix.lower() in (".glb", ".gltf")
    start = 0
    for part, transform in parts:
        linear = scale[:, None] * transform[:3, :3]
        if np.shape(part.vertices)[1:] != (3,):
            raise MeshError(path, "is invalid: a vertex does not have three coordinates")
        points = matmul(np.asarray(part.vertices, dtype=float), linear.T) + scale * transform[:3, 3]
        triangles = np.asarray(part.faces, dtype=np.int64).reshape(-1, 3)
        if triangles.size and (triangles.min() < 0 or triangles.max() >= len(points)):
            raise MeshError(path, "is invalid: a triangle refers to a missing vertex")
        if np.linalg.det(linear) < 0:  # a mirrored mesh has reversed triangles
            triangles = triangles[:, ::-1]
        vertices.append(points)
        faces.append(triangles + start)
        normals.append(normals_in(part, linear))
        colors.append(colors_in(part, linear=linear_colors))
        texture = texture_in(part, linear=linear_colors)
        uvs.append(places_in(part) if places or texture is not None else None)
        if texture is not None:
            textures.setdefault(texture.hash, texture)
        wrapped.append(np.full(len(triangles), -1 if texture is None else list(textures).index(texture.hash)))
        glosses.append(np.tile(np.array(gloss_in(part), dtype=np.float32), (len(triangles), 1)))
        start += len(points)
    if not start or not sum(map(len, faces)):
        raise MeshError(path, "has no triangles")
    fields: list[tuple[str, Any, int] | tuple[str, Any]] = [("position", np.float32, 3)]
    if has_uv := any(uv is not None for uv in uvs):
        fields.append(("uv", np.float32, 2))
    if has_normals := all(each is not None for each in normals):
        fields.append(("normal", np.float32, 3))
    if has_colors := any(each is not None for each in colors):
        fields.append(("color", np.uint8, 4))
    if is_open := has_colors and any(each is None for each in colors):
        fields.append(("open", np.uint32))
    corners = np.zeros(start, dtype=fields)
    corners["position"] = np.concatenate(vertices).astype(np.float32) + np.float32(0)  # -0.0 becomes 0.0
    if not np.isfinite(corners["position"]).all():
        raise MeshError(path, "is invalid: a vertex is not finite")
    if has_uv:
        corners["uv"] = _filled(uvs, vertices, 2, 0.0) + np.float32(0)
    if has_normals:
        corners["normal"] = _filled(normals, vertices, 3, 0.0)
    if has_colors:
        corners["color"] = _filled(colors, vertices, 4, 255.0)
    if is_open:
        corners["open"] = np.repeat([each is None for each in colors], [len(points) for points in vertices])
    rows, index = _unique(corners.view(np.uint32).reshape(start, -1))
    unique = rows.view(corners.dtype).reshape(-1)
    return TriMesh(
        vertices=np.ascontiguousarray(unique["position"]),
        faces=np.ascontiguousarray(index[np.concatenate(faces)].astype(np.int32)),
        normals=np.ascontiguousarray(unique["normal"]) if has_normals else None,
        colors=np.ascontiguousarray(unique["color"]) if has_colors else None,
        uv=np.ascontiguousarray(unique["uv"]) if has_uv else None,
        textures=tuple(textures.values()),
        face_textures=np.concatenate(wrapped).astype(np.int32) if textures else None,
        open_vertices=unique["open"] != 0 if is_open else None,
        face_gloss=np.concatenate(glosses) if any(each[:, 3].any() for each in glosses) else None,
    )


def _filled(parts: list[Any], vertices: list[Any], width: int, default: float) -> NDArray[np.float32]:
    """Concatenate an attribute of all parts; parts without it get a default value."""
    return np.concatenate(
        [
            np.full((len(points), width), default) if part is None else part
            for points, part in zip(vertices, parts, strict=True)
        ]
    ).astype(np.float32)


def _unique(rows: NDArray[np.uint32]) -> tuple[NDArray[np.uint32], NDArray[np.int64]]:
    """Return the distinct rows in order of first appearance, and the index of each row among them."""
    first, inverse = unique_rows(rows)
    order = np.argsort(first)
    rank = np.empty_like(order)
    rank[order] = np.arange(len(order))
    return rows[first[order]], rank[inverse]
