"""Markers of visualization_msgs: kept by namespace and number until they are deleted or their lifetime ends."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from urdfkit.app.simulation.displays.drawings import Item, finite, seven, xyz_of
from urdfkit.errors import UrdfkitError

MARKER, MARKERS = "visualization_msgs/msg/Marker", "visualization_msgs/msg/MarkerArray"
SHAPES = {1: "cube", 2: "sphere", 3: "cylinder"}
LISTS = {6: "cube", 7: "sphere"}
ARROW, STRIP, LINES, POINTS, TEXT, MESH, TRIANGLES = 0, 4, 5, 8, 9, 10, 11
DELETE, DELETE_ALL = 2, 3
MOST = 5000
"""Maximum number of markers of a topic."""


@dataclass(slots=True)
class _Kept:
    frame: str
    items: list[Item]
    ends: float
    fault: str


class MarkerStore:
    """The markers of one topic.

    Args:
        now: the time of the simulation [s].
        mesh: function that returns the name of the mesh at a URI for the page; it raises `UrdfkitError`.

    Attributes:
        changes: number of changes.
    """

    def __init__(self, now: Callable[[], float], mesh: Callable[[str], str]) -> None:
        self._now, self._mesh = now, mesh
        self._kept: dict[tuple[str, int], _Kept] = {}
        self.changes = 0

    def take(self, message: Any) -> None:
        """Apply a Marker or MarkerArray."""
        self.changes += 1
        for marker in getattr(message, "markers", [message]):
            key = (marker.ns, int(marker.id))
            if marker.action == DELETE_ALL:
                self._kept.clear()
            elif marker.action == DELETE:
                self._kept.pop(key, None)
            elif len(self._kept) < MOST or key in self._kept:
                life = marker.lifetime.sec + 1e-9 * marker.lifetime.nanosec
                drawn, fault = drawn_marker(marker, self._mesh)
                ends = self._now() + life if life > 0 else math.inf
                self._kept[key] = _Kept(marker.header.frame_id, drawn, ends, fault)

    def groups(self) -> list[tuple[str, list[Item]]]:
        """Return frame and items of the present markers; drop those whose lifetime has ended."""
        now = self._now()
        ended = [key for key, kept in self._kept.items() if kept.ends < now]
        for key in ended:
            del self._kept[key]
        self.changes += bool(ended)
        return [(kept.frame, kept.items) for kept in self._kept.values()]

    @property
    def fault(self) -> str:
        """Why a marker with a mesh is not drawn; empty if all are."""
        return next((kept.fault for kept in self._kept.values() if kept.fault), "")


def drawn_marker(marker: Any, mesh: Callable[[str], str]) -> tuple[list[Item], str]:
    """Return the items of a marker in its frame, and why a mesh cannot be read, empty otherwise.

    Args:
        marker: the Marker.
        mesh: function that returns the name of the mesh at a URI for the page; it raises `UrdfkitError`.
    """
    if marker.type != MESH:
        return items(marker), ""
    try:
        name = mesh(marker.mesh_resource)
    except UrdfkitError as error:
        return [], f"a marker is not shown: {error}"
    look = {"color": _rgba(marker.color), "own": bool(marker.mesh_use_embedded_materials)}
    return [{"mesh": name, "pose": seven(marker.pose), "scale": xyz_of(marker.scale), **look}], ""


def items(marker: Any) -> list[Item]:
    """Return the items of one marker in its frame."""
    pose, scale = seven(marker.pose), xyz_of(marker.scale)
    points = [xyz_of(point) for point in marker.points]
    flat = [x for point in points for x in point]
    look: Item = {"color": _rgba(marker.color)}
    if len(marker.colors) == len(points) and points:
        look["colors"] = [_rgba(each) for each in marker.colors]
    if marker.type in SHAPES:
        return [{"shape": SHAPES[marker.type], "pose": pose, "scale": scale, **look}]
    if marker.type in LISTS:
        return [{"shape": LISTS[marker.type], "pose": pose, "scale": scale, "at": flat, **look}]
    if marker.type == ARROW:
        return [_arrow(pose, points, scale, look)]
    if marker.type in (STRIP, LINES):
        return [{"line" if marker.type == STRIP else "segments": flat, "pose": pose, "width": scale[0], **look}]
    if marker.type == POINTS:
        return [{"dots": flat, "pose": pose, "size": scale[0], **look}]
    if marker.type == TEXT:
        return [{"text": str(marker.text)[:400], "pose": pose, "size": scale[2] or 0.2, **look}]
    if marker.type == TRIANGLES:
        return [{"triangles": flat, "pose": pose, "scale": scale, **look}]
    return []


def _arrow(pose: list[float], points: list[list[float]], scale: list[float], look: Item) -> Item:
    """Return an arrow with the diameters of its shaft and head and the length of its head, as RViz draws them."""
    if len(points) != 2:
        length = scale[0] or 1.0
        thick = {"thick": [scale[1], 2.0 * scale[1], 0.23 * length]} if scale[1] > 0.0 else {}
        return {"arrow": pose, "length": length, **thick, **look}
    vector = [b - a for a, b in zip(*points, strict=True)]
    thick = {"thick": [scale[0], scale[1], scale[2] or 0.23 * math.hypot(*vector)]} if min(scale[:2]) > 0.0 else {}
    return {"vector": vector, "from": points[0], "pose": pose, **thick, **look}


def _rgba(color: Any) -> list[float]:
    return [min(1.0, max(0.0, finite(part))) for part in (color.r, color.g, color.b, color.a)]
