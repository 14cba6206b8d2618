"""What to do with shapes whose mesh is missing or broken, and what to say of them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from urdfkit.description.sdf import WorldLink, WorldModel, WorldShape
from urdfkit.description.urdf.robot import Mesh
from urdfkit.errors import ResourceError, SimulationError
from urdfkit.scene import MeshLoader, Scene


def remark_left_out(scene: Scene, note: Callable[[str], None]) -> None:
    """Note every shape of a robot that is left out, by name.

    Raises:
        ResourceError: that of the first collision, where no other is left: such a robot would fall through the floor.
    """
    touched = [each for each in scene.problems if each.role == "collision"]
    if touched and not scene.with_role("collision"):
        raise touched[0].error
    for each in scene.problems:
        what = "nothing touches it there" if each.role == "collision" else "what it would look like is not seen"
        note(f"{each.error}; shape `{each.name}` is left out: {what}")


def without_broken(model: WorldModel, meshes: MeshLoader, note: Callable[[str], None]) -> WorldModel:
    """Return a model of a world without the shapes whose mesh is broken, each noted by name.

    Args:
        model: as read; a shape whose mesh is not there names no file, and was noted then.
        meshes: reads the mesh files.
        note: tells the user something.

    Raises:
        SimulationError: no collision is left of what is free to move: it would fall through the floor.
    """
    found = _without(model, meshes, note)

    def touched(of: WorldModel) -> int:
        return sum(len(link.collisions) for _, _, link in of.all_links())

    if touched(model) and not touched(found) and not model.static:
        raise SimulationError(
            f"no collision of model `{model.name}` has a mesh that can be read: it would fall through the floor; mend "
            "one, or make the model <static>",
            position=model.position,
        )
    return found


def _without(model: WorldModel, meshes: MeshLoader, note: Callable[[str], None]) -> WorldModel:
    """Return a model with the shapes that can be had; the very same where these are all."""

    def is_had(shape: WorldShape, *, seen: bool) -> bool:
        if not isinstance(shape.geometry, Mesh):
            return True
        if not shape.file:
            return False
        try:
            meshes.load(Path(shape.file), shape.geometry.scale)
        except ResourceError as error:
            touched = f"{error}; collision `{shape.name}` is left out: nothing touches it there"
            told = f"visual `{shape.name}` is not seen: {error}" if seen else touched
            note(f"{shape.position or model.name}: {told}")
            return False
        return True

    def sound(link: WorldLink) -> WorldLink:
        visuals = tuple([shape for shape in link.visuals if is_had(shape, seen=True)])
        collisions = tuple([shape for shape in link.collisions if is_had(shape, seen=False)])
        same = visuals == link.visuals and collisions == link.collisions
        return link if same else replace(link, visuals=visuals, collisions=collisions)

    links = tuple([sound(link) for link in model.links])
    models = tuple([_without(each, meshes, note) for each in model.models])
    same = all(a is b for a, b in zip((*links, *models), (*model.links, *model.models), strict=True))
    return model if same else replace(model, links=links, models=models)
