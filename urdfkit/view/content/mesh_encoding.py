"""Binary format of meshes for the browser: quantized, delta-coded, one byte plane after the other.

A file is the length of a JSON header (uint32, little-endian), the header and its ``streams`` in order. A stream
contains a table of integers: the differences between consecutive rows, with the sign in the lowest bit (zigzag), column
by column and byte by byte, the lowest bytes first. Such planes compress well with gzip, and the browser decodes them in
some milliseconds. Vertices are numbered in the order of their first use. An index is stored as its distance below the
next unused number (the high-water mark), as in webgl-loader. A stream ``of`` contains, in the same way, the row of the
next stream that each vertex has. A part has triangles of one texture and one gloss (specular colour and exponent).
"""

import gzip
import json
import struct
from collections.abc import Iterator
from itertools import chain
from typing import Any

import numpy as np
from numpy.typing import NDArray

from urdfkit.meshes.triangle_mesh import unique_rows
from urdfkit.scene import TriMesh
from urdfkit.view.content.crease_normals import crease, flat_normals

FORMAT = "urdfkit mesh 4"
"""Part of the names of stored meshes, so that a browser does not use a cached mesh in another format."""

STEPS = 65535
"""Quantization of positions: steps along the longest edge of the bounding box; 8 µm per metre at most."""
NORMAL_STEPS = 1022
"""Quantization of normals in octahedral coordinates: at most 0.2 degrees, and exact along the axes."""
REPEATED = 0.6
"""A table with a smaller share of distinct rows is stored as these and the row of each vertex."""
UV_STEPS = 65536
"""Steps of texture coordinates per repetition of the texture."""


def pack(mesh: TriMesh, textures: list[str] | None = None) -> bytes:
    """Return a mesh in its binary format, compressed with gzip; missing normals are computed with sharp creases.

    Args:
        mesh: the triangles.
        textures: names of its textures for the browser.
    """
    points, normals, faces, source = _with_normals(mesh)
    which = np.full(len(faces), -1) if mesh.face_textures is None or mesh.uv is None else mesh.face_textures
    gloss = np.zeros((len(faces), 4), dtype=np.float32) if mesh.face_gloss is None else mesh.face_gloss
    kinds = np.column_stack([which, np.ascontiguousarray(gloss, dtype=np.float32).view(np.int32)])
    kinds, where = np.unique(kinds, axis=0, return_inverse=True)
    where = where.reshape(-1)
    order = np.argsort(where, kind="stable")
    faces, which, gloss = faces[order], which[order], gloss[order]
    used, codes = _high_water(faces.reshape(-1), len(points))
    source = source[used]
    low = points.min(axis=0, initial=np.inf) if len(points) else np.zeros(3)
    step = float(np.ptp(points, axis=0).max() / STEPS) if len(points) else 0.0
    step = step or 1.0
    tables: list[tuple[dict[str, Any], NDArray[Any]]] = [
        ({"name": "index"}, codes[:, None]),
        ({"name": "position", "low": low.tolist(), "step": step}, np.rint((points[used] - low) / step)),
        ({"name": "normal", "step": 2.0 / NORMAL_STEPS}, np.rint((octahedral(normals[used]) + 1.0) / 2 * NORMAL_STEPS)),
    ]
    if mesh.colors is not None:
        tables.append(({"name": "color"}, mesh.colors[source]))
    if mesh.uv is not None and (which >= 0).any():
        tables.append(({"name": "uv", "step": 1.0 / UV_STEPS}, np.rint(mesh.uv[source].astype(float) * UV_STEPS)))
    parts = []
    ends = np.cumsum(np.bincount(where, minlength=len(kinds))).tolist()
    for first, end in zip([0, *ends], ends, strict=False):
        image = int(which[first])
        if image >= 0:
            clear = bool((mesh.textures[image].pixels[..., 3] < 255).any())
        else:
            clear = mesh.colors is not None and bool((mesh.colors[:, 3] < 255).any())
        name = textures[image] if textures and image >= 0 else None
        part = {"first": first, "count": end - first, "texture": name, "clear": clear}
        parts.append(part if mesh.face_gloss is None else part | {"gloss": gloss[first].tolist()})
    streams, content = [], []
    for stream, rows in chain.from_iterable(_distinct(*each) for each in tables):
        depth, planes = _planes(rows.astype(np.int64), is_delta=stream["name"] not in ("index", "of"))
        streams.append({**stream, "width": rows.shape[1], "rows": len(rows), "bytes": depth})
        content.append(planes)
    size = {"vertices": len(used), "triangles": len(faces), "simplified_from": mesh.simplified_from}
    header = json.dumps({**size, "parts": parts, "streams": streams}).encode()
    return gzip.compress(b"".join([struct.pack("<I", len(header)), header, *content]), 6, mtime=0)


def _with_normals(mesh: TriMesh) -> tuple[NDArray[Any], NDArray[Any], NDArray[Any], NDArray[np.int64]]:
    """Return points, normals, faces, and the vertex of the mesh of each point."""
    points, faces = mesh.vertices.astype(float), mesh.faces
    if mesh.normals is not None:
        return points, mesh.normals.astype(float), faces, np.arange(len(points))
    if not mesh.has_own_colors:
        creased = crease(points, faces.astype(np.int64))
        return *creased, np.zeros(len(creased[0]), dtype=np.int64)
    # Corners at the same position may differ in colour: shade flat, with separate corners.
    corners = faces.reshape(-1).astype(np.int64)
    points = points[corners]
    separate = np.arange(len(corners)).reshape(-1, 3)
    return points, np.repeat(flat_normals(points[separate])[1], 3, axis=0), separate, corners


def _high_water(flat: NDArray[Any], count: int) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return the used vertices in the order of their first use, and the codes of the indices."""
    first = np.full(count, len(flat), dtype=np.int64)
    first[flat[::-1]] = np.arange(len(flat) - 1, -1, -1)
    used = np.argsort(first, kind="stable")[: int((first < len(flat)).sum())]
    rank = np.zeros(count, dtype=np.int64)
    rank[used] = np.arange(len(used))
    index = rank[flat]
    mark = np.concatenate([[0], np.maximum.accumulate(index)[:-1] + 1]) if len(index) else index
    return used, mark - index


def _distinct(entry: dict[str, Any], table: NDArray[Any]) -> Iterator[tuple[dict[str, Any], NDArray[Any]]]:
    """Yield a table, or its distinct rows and the row of each vertex if few rows are distinct."""
    if entry["name"] != "index" and len(table):
        first, where = unique_rows(table.astype(np.int64))
        if len(first) < REPEATED * len(table):
            used, codes = _high_water(where, len(first))
            yield {"name": "of"}, codes[:, None]
            table = table[first[used]]
    yield entry, table


def octahedral(normals: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return unit vectors as points of a square, -1..1, shape (n, 2).

    Source: Cigolle et al., *A Survey of Efficient Representations for Independent Unit Vectors* (JCGT 2014).
    """
    flat = normals / np.maximum(np.abs(normals).sum(axis=1, keepdims=True), 1e-12)
    folded = (1.0 - np.abs(flat[:, 1::-1])) * np.where(flat[:, :2] >= 0.0, 1.0, -1.0)
    found: NDArray[np.float64] = np.where(flat[:, 2:] >= 0.0, flat[:, :2], folded)
    return found


def _planes(table: NDArray[np.int64], *, is_delta: bool) -> tuple[int, bytes]:
    """Return the number of bytes per integer, and the table as byte planes."""
    if is_delta:
        table = np.diff(table, axis=0, prepend=np.zeros((1, table.shape[1]), dtype=np.int64))
        table = (table << 1) ^ (table >> 63)
    depth = max((int(table.max(initial=0)).bit_length() + 7) // 8, 1)
    columns = np.ascontiguousarray(table.T.astype("<u4"))
    planes = columns.view(np.uint8).reshape(table.shape[1], len(table), 4)[:, :, :depth]
    return depth, np.ascontiguousarray(planes.transpose(0, 2, 1)).tobytes()
