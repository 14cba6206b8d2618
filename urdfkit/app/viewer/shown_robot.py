"""ShownRobot: a robot with its kinematics and shapes, repaired where its description is defective."""

from __future__ import annotations

import time
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from urdfkit.description import Robot
from urdfkit.description.packages.resolver import Packages
from urdfkit.description.urdf.repair_record import Repair
from urdfkit.description.urdf.robot import Collision, Mesh, Visual
from urdfkit.errors import ResourceError
from urdfkit.kinematics import Kinematics
from urdfkit.resources import ModelArgument
from urdfkit.scene import MeshLoader, Scene

SEARCH_PERIOD = 0.3
"""Seconds between two searches for missing mesh files."""
_SHARE = 20.0
"""Least ratio of the time between two searches to the time of a search."""


@dataclass(frozen=True)
class ShownRobot:
    """A robot with its kinematics and shapes.

    Attributes:
        kinematics: the robot, whose links are one tree.
        scene: its shapes, with placeholders for shapes that cannot be shown.
        files: the files of the description.
        meshes: the mesh files, if they exist.
        missing: the URIs of meshes without a file.
        repairs: the repairs.
        loader: read the mesh files.
    """

    kinematics: Kinematics
    scene: Scene
    files: tuple[Path, ...]
    meshes: tuple[Path, ...]
    missing: tuple[str, ...]
    repairs: tuple[Repair, ...]
    loader: MeshLoader

    @classmethod
    def read(cls, model: ModelArgument, *, strict: bool = False, loader: MeshLoader | None = None) -> ShownRobot:
        """Load a robot.

        Args:
            model: the robot as it was given.
            strict: refuse robots that need a repair.
            loader: reads the mesh files; with the same loader, only changed files are read again.

        Raises:
            UrdfkitError: there is no robot in the file, or it needs a repair (`strict`).
        """
        from urdfkit.description.loading import load_repaired, load_valid
        from urdfkit.description.repair_positions import at_attributes
        from urdfkit.description.xml.cost_limit import loading_limit
        from urdfkit.kinematics.mimic import without_impossible_mimics
        from urdfkit.scene import scene_of
        from urdfkit.scene.placeholders import require_valid_shapes, with_placeholders

        loader = loader or MeshLoader(is_for_screen=True)
        replaced: list[Repair] = []
        with loading_limit():
            robot = load_valid(model) if strict else without_impossible_mimics(load_repaired(model))
            if strict:
                require_valid_shapes(robot)
            scene = scene_of(robot, strict=strict, meshes=loader)
            if not strict:
                scene, replaced = with_placeholders(robot, scene)
            found, missing = mesh_files(robot)
            files = robot.files or (model.path,)
            return cls(
                Kinematics(robot),
                scene,
                files,
                found,
                missing,
                tuple(at_attributes((*robot.repairs, *replaced))),
                loader,
            )


def mesh_files(robot: Robot) -> tuple[tuple[Path, ...], tuple[str, ...]]:
    """Return the mesh files of a robot, and the URIs of its missing mesh files."""
    entry = robot.files[0] if robot.files else Path("robot.urdf")
    shapes: list[Visual | Collision] = []
    for link in robot.links:
        shapes += [*link.visuals, *link.collisions]
    found: list[Path] = []
    missing = []
    for uri in dict.fromkeys(shape.geometry.uri for shape in shapes if isinstance(shape.geometry, Mesh)):
        try:
            found += [robot.packages.resolve(uri, entry)] if robot.packages is not None else []
        except ResourceError:
            missing.append(uri)
    return tuple(dict.fromkeys(found)), tuple(missing)


class MissingMeshes:
    """Search for missing mesh files until one of them exists.

    Args:
        model: the robot as it was given.
        uris: the meshes without a file.
    """

    def __init__(self, model: ModelArgument, uris: Iterable[str]) -> None:
        self._model, self._uris = model, tuple(uris)
        self._due = 0.0

    def found(self) -> bool:
        """Return whether one of the files exists now; searches at most every `SEARCH_PERIOD`."""
        if not self._uris or (start := time.monotonic()) < self._due:
            return False
        packages = Packages(self._model.package_path, self._model.path)
        found = any(_exists(packages, uri, self._model.path) for uri in self._uris)
        now = time.monotonic()
        self._due = now + max(SEARCH_PERIOD, _SHARE * (now - start))
        return found


def _exists(packages: Packages, uri: str, entry: Path) -> bool:
    try:
        packages.resolve(uri, entry)
    except ResourceError:
        return False
    return True
