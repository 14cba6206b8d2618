"""The argument of the functions that load a robot: a path, a name or a loaded robot, as a file and its arguments."""

import os
from collections.abc import Iterable, Mapping
from pathlib import Path

from urdfkit.description.urdf.robot import Robot
from urdfkit.errors import UsageError
from urdfkit.resources import ModelArgument, find_model


def model_argument(
    robot: Robot | str | Path,
    *,
    arguments: Mapping[str, str] | None = None,
    package_path: Iterable[str | Path] = (),
    macro: str | None = None,
) -> ModelArgument:
    """Return the file of a robot and the arguments to load it with.

    Args:
        robot: see `load`.
        arguments: xacro arguments, added to the arguments of a loaded robot.
        package_path: folders to search for packages first.
        macro: macro of the file to instantiate.

    Raises:
        UsageError: `robot` is neither a path, a name nor a robot that was loaded from a file.
        ResourceError: no such file, folder or bundled robot.
    """
    arguments, folders = dict(arguments or {}), tuple(Path(folder) for folder in package_path)
    if isinstance(robot, Robot):
        if not robot.files:
            raise UsageError(f"robot `{robot.name}` was not read from a file; pass a robot returned by urdfkit.load()")
        if robot.packages is not None:
            folders += robot.packages.search
        name = robot.name or robot.files[0].stem
        return ModelArgument(robot.files[0], {**robot.arguments, **arguments}, folders, name, macro)
    if not isinstance(robot, (str, os.PathLike)):
        raise UsageError(f"{robot!r} is not a robot: pass a file, a package folder, a bundled name or a loaded robot")
    path = Path(robot)
    if path.is_file():
        return ModelArgument(path, arguments, folders, path.name.split(".")[0], macro)
    found = find_model([str(robot)], package_path=folders)
    return ModelArgument(found.path, {**found.arguments, **arguments}, found.package_path, found.name, macro)
