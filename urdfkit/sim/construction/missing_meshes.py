"""Omission of shapes with missing or invalid meshes, with a warning for each."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from urdfkit.description.sdf import WorldLink, WorldModel, WorldShape
from urdfkit.description.urdf.repair_record import Severity
from urdfkit.description.urdf.robot import Mesh, Robot
from urdfkit.errors import ResourceError, SimulationError
from urdfkit.notice import Notice
from urdfkit.scene import MeshLoader, Scene
from urdfkit.sim.construction.repairs.collector import Repairs

_SEEING = ("camera", "gpu", "depth")
"""Parts of the types of sensors that see visual shapes."""


def report_omitted_shapes(robot: Robot, scene: Scene, repairs: Repairs) -> None:
    """Report every omitted shape of a robot by name; without a sensor that sees them, they are notes.

    Args:
        robot: the robot.
        scene: the shapes of the robot.
        repairs: collects the repairs.

    Raises:
        ResourceError: a mesh of a collision shape cannot be read.
        SimulationError: a sensor sees visual shapes, one is omitted, and robots that need a repair are refused.
    """
    types = [sensor.type or "" for block in robot.gazebo for sensor in block.sensors]
    severity: Severity = "warning" if any(part in kind for kind in types for part in _SEEING) else "note"
    found = []
    for each in scene.problems:
        if each.role == "collision":
            raise each.error
        found.append(each.repair(f"shape `{each.name}` is ignored: it is invisible", severity))
    repairs.add(*found)


def without_broken(model: WorldModel, meshes: MeshLoader, note: Callable[[str], None]) -> WorldModel:
    """Return a model of a world without the shapes whose mesh is invalid, with a warning for each.

    Args:
        model: the model; a shape with a missing mesh has no file, and was reported when the model was read.
        meshes: loads the mesh files.
        note: reports a warning to the user.

    Raises:
        SimulationError: a movable model has no collision shape left, so it would fall through the ground.
    """
    found = _without(model, meshes, note)

    def touched(of: WorldModel) -> int:
        return sum(len(link.collisions) for _, _, link in of.all_links())

    if touched(model) and not touched(found) and not model.static:
        raise SimulationError(
            f"model `{model.name}` has no collision with a readable mesh, so it would fall through the ground; repair "
            "a mesh, or make the model <static>",
            position=model.position,
        )
    return found


def _without(model: WorldModel, meshes: MeshLoader, note: Callable[[str], None]) -> WorldModel:
    """Return a model without unreadable shapes; the same object if no shape is omitted."""

    def is_readable(shape: WorldShape, *, visual: bool) -> bool:
        if not isinstance(shape.geometry, Mesh):
            return True
        if not shape.file:
            return False
        try:
            meshes.load(Path(shape.file), shape.geometry.scale)
        except ResourceError as error:
            at, package = shape.position, error.package
            omitted = f"{error}; collision `{shape.name}` is ignored: it has no contacts"
            message = f"visual `{shape.name}` is invisible: {error}" if visual else omitted
            text = f"{at or model.name}: {message}"
            note(Notice(text, position=at, cause=("mesh", visual), package=package))
            return False
        return True

    def readable(link: WorldLink) -> WorldLink:
        visuals = tuple([shape for shape in link.visuals if is_readable(shape, visual=True)])
        collisions = tuple([shape for shape in link.collisions if is_readable(shape, visual=False)])
        same = visuals == link.visuals and collisions == link.collisions
        return link if same else replace(link, visuals=visuals, collisions=collisions)

    links = tuple([readable(link) for link in model.links])
    models = tuple([_without(each, meshes, note) for each in model.models])
    same = all(a is b for a, b in zip((*links, *models), (*model.links, *model.models), strict=True))
    return model if same else replace(model, links=links, models=models)
