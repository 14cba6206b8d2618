"""Bounding boxes of the meshes of a robot: estimated first, exact for the links in which a rule finds something."""

from __future__ import annotations

from urdfkit.lint.model.mesh_files import meshes, path_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable
    from pathlib import Path

    from urdfkit.description.meshes.points import Corners
    from urdfkit.description.urdf.robot import Mesh, Robot, Vector
    from urdfkit.description.xacro.expanded import Expanded


class MeshBoxes:
    """Bounding boxes of the meshes of one check.

    Reading all vertices of the meshes of a robot takes many times as long as its check. A box is therefore estimated
    from a sample of the vertices of a large mesh, which makes it slightly too small, until `measure` is called. A
    rule that found something with estimated boxes is run again with exact ones.

    Attributes:
        were_used: whether a rule has read a box; the caller resets it.
        version: increases when boxes become exact.
    """

    def __init__(self) -> None:
        self.were_used = False
        self.version = 0
        self._faults: dict[str, str] = {}
        self._boxes: dict[Mesh, tuple[Vector, Vector] | None] = {}
        self._measured: set[str] = set()

    def box(self, mesh: Mesh, expanded: Expanded) -> tuple[Vector, Vector] | None:
        """Return centre and size of a mesh's bounding box [m], scale included; None if it cannot be read."""
        self.were_used = True
        if mesh not in self._boxes:
            path = path_of(mesh, expanded)
            corners = None if path is None else self._corners(mesh, path)
            self._boxes[mesh] = None if corners is None else _scaled(corners, mesh.scale)
        return self._boxes[mesh]

    def fault(self, mesh: Mesh) -> str:
        """Return why the file of a mesh whose box has been requested cannot be read; empty if it can."""
        return self._faults.get(mesh.uri, "")

    def measure(self, robot: Robot, links: Iterable[str | None]) -> bool:
        """Make the boxes of the meshes of links exact, or those of all links if a name is None.

        Returns:
            whether a box was estimated before.
        """
        names = set(links)
        uris = {mesh.uri for mesh, _, link in meshes(robot) if None in names or link.name in names} - self._measured
        self._measured |= uris
        changed = [mesh for mesh in self._boxes if mesh.uri in uris]
        for mesh in changed:
            del self._boxes[mesh]
        self.version += bool(changed)
        return bool(changed)

    def _corners(self, mesh: Mesh, path: Path) -> Corners | None:
        """Return the corners of a mesh; trimesh reads the formats that the quick readers do not read."""
        from urdfkit.description.meshes.bounds import bounds

        corners = bounds(path, estimated=mesh.uri not in self._measured)
        if corners is not None:
            return corners
        from urdfkit.errors import UrdfkitError

        try:
            from urdfkit.meshes.loader import MeshLoader

            low, high = MeshLoader().load(path).bounds.tolist()
        except ImportError:
            return None
        except UrdfkitError as error:
            self._faults[mesh.uri] = getattr(error, "fault", str(error))
            return None
        return tuple(low), tuple(high)


def _scaled(corners: Corners, scale: Vector) -> tuple[Vector, Vector]:
    """Return centre and size of a bounding box after scaling."""
    low, high = ([part * factor for part, factor in zip(corner, scale, strict=True)] for corner in corners)
    centre = [(a + b) / 2.0 for a, b in zip(low, high, strict=True)]
    size = [abs(b - a) for a, b in zip(low, high, strict=True)]
    return (centre[0], centre[1], centre[2]), (size[0], size[1], size[2])
