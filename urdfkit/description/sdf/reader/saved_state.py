"""``<state>``: the poses of a world that Gazebo Classic saved."""

from dataclasses import replace

from urdfkit.description.sdf.model import WorldLink, WorldModel
from urdfkit.description.sdf.reader.reading_state import Context
from urdfkit.description.sdf.shapes import Cone, Ellipsoid, Light, Plane, WorldGeometry
from urdfkit.description.sdf.values import name_of, raw_pose, vector, wrong
from urdfkit.description.urdf.geometry import between, compose, difference
from urdfkit.description.urdf.robot import Box, Capsule, Cylinder, Mesh, Pose, Sphere, Vector
from urdfkit.description.xml.element import Element
from urdfkit.errors import did_you_mean

_ROUNDED = 1e-4
"""Maximum difference of a saved pose that counts as a rounded copy: [m], and entries of the rotation matrix."""


class SavedState:
    """The state of a world: saved poses of models, links and lights.

    Gazebo Classic saves the world poses of all models and links, nested ones included (gazebo, LinkState.cc).
    Velocities are ignored. A saved scale applies to the sizes in the model, as in Gazebo.

    Args:
        context: the file.
        element: the ``<state>``.
    """

    def __init__(self, context: Context, element: Element) -> None:
        self._context, self._element = context, element
        deletions = element.find("deletions")
        self.deleted = {name.text for name in deletions.find_all("name")} if deletions is not None else set()
        insertions = element.find("insertions")
        self.inserted = [] if insertions is None else insertions.children

    def note_unknown_models(self, models: list[str]) -> None:
        """Add a note for each model of the state that the world lacks."""
        for model in self._element.find_all("model"):
            if name_of(model) not in models:
                hint = did_you_mean(name_of(model), models)
                self._context.note(model, f"<state> places the unknown model `{model.get('name')}`" + hint)

    def model(self, model: WorldModel) -> WorldModel:
        """Return a model of the world at its saved pose.

        Raises:
            DescriptionError: a value cannot be used.
        """
        saved = self._saved("model", model.name)
        return model if saved is None else _moved(model, saved, Pose())

    def light(self, light: Light) -> Light:
        """Return a light at its saved pose."""
        saved = self._saved("light", light.name)
        return light if saved is None or saved.find("pose") is None else replace(light, pose=raw_pose(saved).pose)

    def _saved(self, tag: str, name: str) -> Element | None:
        return next((each for each in self._element.find_all(tag) if each.get("name") == name), None)


def _moved(model: WorldModel, saved: Element, around: Pose) -> WorldModel:
    """Return a model at its saved pose; `around` is the pose of its parent."""
    scale = vector(saved, "scale", (1.0, 1.0, 1.0))
    if min(scale) <= 0:
        raise wrong(saved.find("scale") or saved, f"<scale> of model `{model.name}` must be greater than zero")
    if scale != (1.0, 1.0, 1.0):
        model = replace(model, links=tuple([_scaled(link, scale) for link in model.links]))
    pose = _unless_near(compose(around, model.pose), saved)
    links = {name_of(link): link for link in saved.find_all("link")}
    models = {name_of(nested): nested for nested in saved.find_all("model")}
    return replace(
        model,
        pose=model.pose if pose is None else between(around, pose),
        links=tuple([_link(link, links.get(link.name), pose or compose(around, model.pose)) for link in model.links]),
        models=tuple(
            [
                _moved(nested, models[nested.name], pose or compose(around, model.pose))
                if nested.name in models
                else nested
                for nested in model.models
            ]
        ),
    )


def _scaled(link: WorldLink, scale: Vector) -> WorldLink:
    """Return a link with its shapes scaled; poses and masses stay, as in Gazebo Classic (Link::SetScale)."""
    return replace(
        link,
        collisions=tuple([replace(each, geometry=scaled(each.geometry, scale)) for each in link.collisions]),
        visuals=tuple([replace(each, geometry=scaled(each.geometry, scale)) for each in link.visuals]),
    )


def scaled(geometry: WorldGeometry, scale: Vector) -> WorldGeometry:
    """Return a shape scaled by `scale` along x, y and z; round shapes use the larger factor."""
    x, y, z = scale
    if isinstance(geometry, Box):
        return Box((geometry.size[0] * x, geometry.size[1] * y, geometry.size[2] * z))
    if isinstance(geometry, Ellipsoid):
        return Ellipsoid((geometry.radii[0] * x, geometry.radii[1] * y, geometry.radii[2] * z))
    if isinstance(geometry, Mesh):
        return Mesh(geometry.uri, (geometry.scale[0] * x, geometry.scale[1] * y, geometry.scale[2] * z))
    if isinstance(geometry, Sphere):
        return Sphere(geometry.radius * max(scale))
    if isinstance(geometry, Cylinder | Capsule | Cone):
        return type(geometry)(geometry.radius * max(x, y), geometry.length * z)
    return Plane(geometry.normal, (geometry.size[0] * x, geometry.size[1] * y))


def _link(link: WorldLink, saved: Element | None, model: Pose) -> WorldLink:
    pose = None if saved is None else _unless_near(compose(model, link.pose), saved)
    return link if pose is None else replace(link, pose=between(model, pose))


def _unless_near(pose: Pose, saved: Element) -> Pose | None:
    """Return the saved pose; None if it is missing or equal to the pose of the model."""
    if saved.find("pose") is None:
        return None
    found = raw_pose(saved).pose
    return found if difference(pose, found) > _ROUNDED else None
