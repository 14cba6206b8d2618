"""load_world, load_model: read SDF 1.4 to 1.11 strictly and resolve all poses.

Elements whose absence changes the simulation raise an error with the position (heightmaps, polylines, missing models);
ignored visual elements and plugins are listed in `World.notes`.
"""

from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

from urdfkit.defect_message import DefectMessage
from urdfkit.description.packages.existence import exists, is_folder
from urdfkit.description.packages.resolver import Packages
from urdfkit.description.sdf.frame_graph import Scope
from urdfkit.description.sdf.model import WorldModel
from urdfkit.description.sdf.model_library import model_file, model_names, world_file, world_names
from urdfkit.description.sdf.reader.joints import read_joint
from urdfkit.description.sdf.reader.links import read_light
from urdfkit.description.sdf.reader.models import ReadEntity, add_frame, read_include, read_model
from urdfkit.description.sdf.reader.reading_state import Context, root_error
from urdfkit.description.sdf.reader.saved_state import SavedState
from urdfkit.description.sdf.reader.vocabulary import note_unknown_elements
from urdfkit.description.sdf.reader.world_plugins import note_unknown_plugins
from urdfkit.description.sdf.shapes import Light, keep
from urdfkit.description.sdf.values import raw_pose, scalar, vector, wrong
from urdfkit.description.sdf.world import GRAVITY, Physics, World, WorldRobot
from urdfkit.description.urdf.robot import Pose
from urdfkit.description.xml.element import Element
from urdfkit.description.xml.reader import shown_path
from urdfkit.errors import DescriptionError, ResourceError, did_you_mean, nearest
from urdfkit.missing_files import missing_path

_SUFFIXES = (".world", ".sdf")
_ROBOT_SUFFIXES = (".urdf", ".xacro")
_READ = {"frame", "gravity", "include", "joint", "light", "magnetic_field", "model", "physics", "state"}
_PHYSICS_READ = {"max_step_size", "real_time_factor", "real_time_update_rate", "gravity", "magnetic_field"}
_NOT_SIMULATED = {
    "actor": "actors are not simulated",
    "population": "populations are not simulated; list their models instead",
    "road": "roads are not shown",
}


def load_world(world: str | Path, *, package_path: Iterable[str | Path] = ()) -> World:
    """Load a world by name or from a file.

    Args:
        world: the name of a bundled world, or a ``.world`` or ``.sdf`` file. A file with only a model becomes a world
            with that model.
        package_path: folders to search for models and packages first.

    Raises:
        ResourceError: the world, or a model it includes, does not exist.
        XmlError: a file is not well-formed, declares entities, or exceeds a limit.
        DescriptionError: the world cannot be read or simulated; with the position.
    """
    path = world_file(str(world)) or Path(world)
    names = world_names()
    if path.suffix in _ROBOT_SUFFIXES:
        raise ResourceError(f"`{world}` is a robot, not a world; pass it as ROBOT, or include it in a world")
    if is_folder(path):
        raise ResourceError(f"`{world}` is a folder; a world is a .world or .sdf file (worlds: {', '.join(names)})")
    if path.suffix in _SUFFIXES and not exists(path):
        message = missing_path(shown_path(path))
        if path.stem in names:
            message = f"no such file: {shown_path(path)}; did you mean the bundled world `{path.stem}`?"
        elif not isinstance(message, DefectMessage):  # without a similar file
            message += did_you_mean(path.stem, names) or f" (bundled worlds: {', '.join(names)})"
        raise ResourceError(message)
    if path.suffix not in _SUFFIXES:
        raise ResourceError(
            f"no world `{world}`{did_you_mean(str(world), names)}"
            f" (worlds: {', '.join(names)}, or a path to a .world or .sdf file)"
        )
    context = Context(Packages(package_path, path), path)
    root = context.open()
    if root.tag != "sdf":
        raise root_error(root)
    note_unknown_elements(context, root)
    written = root.find("world")
    if written is not None:
        found = _world(context, written)
    elif (model := root.find("model")) is not None:
        found = _alone(read_model(context, model))
    else:
        raise root_error(root)
    for each in found.models:
        _require_masses(each, static=False)
    unknown = note_unknown_plugins(context, found)
    return replace(found, notes=tuple(context.notes), files=tuple(context.files), unknown_plugins=unknown)


def load_model(
    model: str | Path, *, name: str = "", pose: Pose | None = None, package_path: Iterable[str | Path] = ()
) -> WorldModel:
    """Load a model to add to a world.

    Args:
        model: the name of a bundled model, ``model://name``, or an ``.sdf`` file.
        name: name in the world; the name in the file when empty.
        pose: pose in the world; the pose in the file when None.
        package_path: folders to search for models and packages first.

    Raises:
        ResourceError: unknown model.
        XmlError: a file is not well-formed, declares entities, or exceeds a limit.
        DescriptionError: the file cannot be read, or is not a model.
    """
    path = model_file(str(model)) or Path(model)
    if str(model).startswith("model://") or (path.suffix != ".sdf" and "/" not in str(model)):
        path = _named(str(model).removeprefix("model://"), package_path)
    return _model(Context(Packages(package_path, path), path), name, pose)


def model_of_text(text: str, *, package_path: Iterable[str | Path] = ()) -> WorldModel:
    """Return the model of an SDF document.

    Args:
        text: the document.
        package_path: folders to search for models and packages.

    Raises:
        UrdfkitError: see `load_model`.
    """
    path = Path("spawned.sdf")
    return _model(Context(Packages(package_path, path), path, text), "", None)


def _model(context: Context, name: str, pose: Pose | None) -> WorldModel:
    root = context.open()
    written = root.find("model") if root.tag == "sdf" else None
    if written is None and root.tag == "sdf" and root.find("world") is not None:
        raise wrong(root, "this is a world, not a model; pass it with --world, or save its models one by one")
    if written is None:
        raise wrong(root, "an SDF model starts with <sdf> and contains a <model>")
    found = read_model(context, written)
    if not isinstance(found.entity, WorldModel):
        raise wrong(written, "this is not a model")
    loaded = _alone(found).models[0]
    _require_masses(loaded, static=False)
    return replace(loaded, name=name or loaded.name, pose=loaded.pose if pose is None else pose)


def _named(name: str, package_path: Iterable[str | Path]) -> Path:
    from urdfkit.description.sdf.reader.uris import find_model
    from urdfkit.description.xml.source import Origin, Position

    here = Path.cwd() / "model"
    uri = Element("uri", {}, [], f"model://{name}", Origin(Position("", 0, 0)))
    try:
        return find_model(Context(Packages(package_path, here), here), uri)
    except ResourceError as error:
        names = f" (models: {', '.join(model_names())})"
        raise ResourceError(error.message + ("" if nearest(name, model_names()) is not None else names)) from None


def _alone(found: ReadEntity) -> World:
    scope = Scope("world", "the world")
    found.add_to(scope, strict=True)
    model = found.placed(scope)
    assert isinstance(model, WorldModel)
    return World(model.name, models=(model,), position=model.position)


def _world(context: Context, element: Element) -> World:
    note_unknown_elements(context, element)
    scope = Scope("world", f"world `{element.get('name') or ''}`")
    strict = context.version >= (1, 7)
    states = element.find_all("state")
    state = SavedState(context, states[-1]) if states else None
    read = [_entity(context, child) for child in (*element.children, *(state.inserted if state else ()))]
    found = [each for each in read if each is not None]
    if state is not None:
        found = [each for each in found if each.entity.name not in state.deleted]
    for each in found:
        each.add_to(scope, strict=strict)
    for child in element.children:
        if child.tag in ("frame", "joint"):
            add_frame(scope, child, strict=strict)
        elif child.tag in _NOT_SIMULATED:
            context.note(child, _NOT_SIMULATED[child.tag])
        elif child.tag == "wind" and any(vector(child, "linear_velocity", (0.0, 0.0, 0.0))):
            context.note(child, "wind is not simulated: <wind> is kept but has no effect")
    placed = [each.placed(scope) for each in found]
    models = [each for each in placed if isinstance(each, WorldModel)]
    lights = [each for each in placed if isinstance(each, Light)]
    if state is not None:
        state.note_unknown_models([each.name for each in models])
        models, lights = [state.model(each) for each in models], [state.light(each) for each in lights]
    physics = _physics_element(element)
    gravity = vector(physics, "gravity", GRAVITY)  # location in SDF 1.5 and older
    default = World("")
    return World(
        element.get("name") or context.path.stem,
        vector(element, "gravity", gravity),
        tuple(models),
        tuple(lights),
        Physics() if physics is None else _physics(context, physics),
        tuple([each for each in placed if isinstance(each, WorldRobot)]),
        tuple([read_joint(context, joint, scope) for joint in element.find_all("joint")]),
        vector(element, "magnetic_field", default.magnetic_field),
        tuple([keep(child) for child in element.children if child.tag not in _READ]),
        position=element.origin.position,
    )


def _entity(context: Context, element: Element) -> ReadEntity | None:
    if element.tag == "model":
        return read_model(context, element)
    if element.tag == "light":
        return ReadEntity(read_light(context, element, Pose()), raw_pose(element))
    if element.tag == "include" and element.get("merge", "false") in ("true", "1"):
        raise wrong(element, 'merge="true" is supported only for models inside models; remove it')
    return read_include(context, element) if element.tag == "include" else None


def _physics_element(world: Element) -> Element | None:
    profiles = world.find_all("physics")
    chosen = [each for each in profiles if (each.get("default") or "").lower() in ("true", "1")]
    return next(iter(chosen or profiles), None)


def _physics(context: Context, element: Element) -> Physics:
    default = Physics()
    step = scalar(element, "max_step_size", default.max_step_size)
    if step <= 0:
        raise wrong(
            element.find("max_step_size") or element, f"<max_step_size> is {step:g} s; it must be greater than zero"
        )
    pace = scalar(element, "real_time_factor", default.real_time_factor)
    if pace not in (0, default.real_time_factor):
        message = f"<real_time_factor> {pace:g} is kept but ignored: teleop runs in real time"
        context.note(element.find("real_time_factor") or element, message)
    return Physics(
        step,
        pace,
        scalar(element, "real_time_update_rate", default.real_time_update_rate),
        element.get("type") or default.engine,
        element.get("name") or "",
        tuple([keep(child) for child in element.children if child.tag not in _PHYSICS_READ]),
    )


def _require_masses(model: WorldModel, *, static: bool) -> None:
    """Reject moving links without mass or with an invalid inertia."""
    static = static or model.static
    if not (model.static or model.links or model.models):  # like sdformat
        raise DescriptionError(
            f"model `{model.name}` has no link; add a link or make the model <static>", position=model.position
        )
    for link in () if static else model.links:
        body = link.inertial
        fault = ""
        if body.mass <= 0:
            fault = f"its mass is {body.mass:g} kg"
        elif not _is_positive_definite(body.ixx, body.ixy, body.ixz, body.iyy, body.iyz, body.izz):
            fault = "its inertia tensor is not positive definite"
        if fault:
            raise DescriptionError(
                f"link `{link.name}` of model `{model.name}` cannot move: {fault}; make the model <static> or fix it",
                position=link.position,
            )
    for nested in model.models:
        _require_masses(nested, static=static)


def _is_positive_definite(ixx: float, ixy: float, ixz: float, iyy: float, iyz: float, izz: float) -> bool:
    """Return whether a tensor is positive definite, by Sylvester's criterion."""
    minor = ixx * iyy - ixy * ixy
    whole = ixx * (iyy * izz - iyz * iyz) - ixy * (ixy * izz - iyz * ixz) + ixz * (ixy * iyz - iyy * ixz)
    return ixx > 0 and minor > 0 and whole > 0
