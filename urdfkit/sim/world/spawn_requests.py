"""Requests to spawn a model or robot: by name, from a file, from text, or already loaded."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from urdfkit.description.loading import load_repaired, repaired_robot_of_text
from urdfkit.description.sdf import WorldModel, WorldRobot, load_model, model_names, model_of_text
from urdfkit.description.urdf.robot import Robot
from urdfkit.errors import ResourceError, did_you_mean
from urdfkit.resources import robot_names

_ROBOTS = (".urdf", ".xacro")


@dataclass(frozen=True)
class SpawnRequest:
    """A model or robot to spawn.

    Attributes:
        source: the model, or the file of the robot.
        robot: the loaded robot; None for a model.
    """

    source: WorldModel | WorldRobot
    robot: Robot | None = None


def spawn_request(
    model: str | Path | WorldModel | Robot | SpawnRequest, package_path: Sequence[str | Path] = ()
) -> SpawnRequest:
    """Return the model or robot to spawn.

    Args:
        model: see `LiveWorld.spawn`.
        package_path: folders that are searched first for models and packages.

    Raises:
        UrdfkitError: the model does not exist or is invalid; with the place and the nearest name.
    """
    if isinstance(model, SpawnRequest):
        return model
    if isinstance(model, WorldModel):
        return SpawnRequest(model)
    if isinstance(model, Robot):
        return _robot(model)
    text = str(model)
    path = Path(text)
    if path.suffix in _ROBOTS or (path.is_dir() and not (path / "model.config").is_file()):
        return _robot(load_repaired(path, package_path=package_path))
    if path.is_dir():
        return SpawnRequest(load_model(f"model://{path.name}", package_path=[path.parent, *package_path]))
    if path.suffix in (".sdf", ".world") or text.startswith("model://"):
        return SpawnRequest(load_model(text, package_path=package_path))
    if path.suffix or "/" in text:
        raise ResourceError(f"`{text}` is not a model: use an .sdf, .urdf or .xacro file, or the name of a bundled one")
    try:
        return SpawnRequest(load_model(text, package_path=package_path))
    except ResourceError as error:
        if error.position is not None:
            raise
        robots = robot_names()
        if text not in robots:
            names = model_names()
            raise ResourceError(
                f"no model or robot `{text}`{did_you_mean(text, [*names, *robots])} "
                f"(models: {', '.join(names)}; robots: {', '.join(robots)})"
            ) from None
    return _robot(load_repaired(text, package_path=package_path))


def spawn_request_of_text(text: str, package_path: Sequence[str | Path] = ()) -> SpawnRequest:
    """Return the model or robot of an SDF or URDF document.

    Raises:
        UrdfkitError: the document is invalid.
    """
    if "<robot" in text:
        robot = repaired_robot_of_text(text, package_path=package_path)
        return SpawnRequest(WorldRobot(robot.name or "robot", "", ""), robot)
    if text.lstrip().startswith("<model"):  # as gz's EntityFactory allows
        text = f'<sdf version="1.9">{text}</sdf>'
    return SpawnRequest(model_of_text(text, package_path=package_path))


def _robot(robot: Robot) -> SpawnRequest:
    file = str(robot.files[0]) if robot.files else ""
    return SpawnRequest(WorldRobot(robot.name or "robot", f"file://{file}" if file else "", file), robot)
