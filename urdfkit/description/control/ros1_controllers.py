"""Find the controller configuration of a ROS 1 robot.

The model does not name it: a launch file loads the parameters and starts the controllers. The search order is:

1. explicitly named files replace all others; a file without the robot's namespace is treated as if it had been
   loaded into it;
2. launch files in the robot's package and in neighbouring packages, similarly named packages first: the first file
   that loads controllers into the robot's namespace, preferably a file that also starts controllers;
3. without one, the YAML files in the ``config`` folders of the same packages that configure controllers there.
"""

from contextlib import suppress
from pathlib import Path

from urdfkit.description.control.parameter_yaml import read_settings
from urdfkit.description.control.ros1_launch import Launch, read_launch
from urdfkit.description.control.settings import Settings
from urdfkit.description.packages.resolver import Packages
from urdfkit.description.urdf.robot import Robot
from urdfkit.description.xml.reader import shown_path
from urdfkit.errors import UrdfkitError
from urdfkit.record import field, record

_ENDINGS = ("_description", "_gazebo", "_control", "_bringup", "_moveit_config", "_robot")
_MAX_PACKAGES = 200

SIMULATED_INTERFACES = {
    "EffortJointInterface": "effort",
    "PositionJointInterface": "position",
    "VelocityJointInterface": "velocity",
}
"""Hardware interfaces that gazebo_ros_control simulates (DefaultRobotHWSim)."""


@record(eq=False)
class Configuration:
    """The parameters of the controllers in one namespace.

    Attributes:
        settings: the parameters of the namespace.
        files: the files they were read from.
        started: the controllers that are started, by their names in the namespace; None for all.
        launch: the launch file that loads them; None without one.
        root: all parameters of those files, in their namespaces.
    """

    settings: Settings = field(repr=False)
    files: tuple[Path, ...]
    started: tuple[str, ...] | None = None
    launch: Path | None = None
    root: Settings | None = field(default=None, repr=False)

    @property
    def source(self) -> str:
        """Description of the source for messages."""
        files = ", ".join(shown_path(file) for file in self.files) or "no file"
        return f"{files} (loaded by {shown_path(self.launch)})" if self.launch else files


def find_configuration(robot: Robot, namespace: str, named: tuple[Path, ...] = ()) -> Configuration | None:
    """Return the controller configuration of a namespace; None if it was not found.

    Args:
        robot: the robot.
        namespace: namespace of its controller manager, e.g. ``/rrbot``.
        named: parameter files to use instead of a search.

    Raises:
        UrdfkitError: a named or chosen file cannot be read; with the position.
    """
    if named:
        found: Settings | None = None
        for path in named:
            read = read_settings(path)
            inside = read.find(namespace)
            read = read if inside is not None and inside.children else read.below(namespace)
            found = read if found is None else found.merged(read)
        root = found or Settings("", read.position)
        return Configuration(root.group(namespace), named, root=root)
    near, others = packages_around(Path(robot.files[0])) if robot.files else ([], [])
    folders = [*near, *others]
    packages = robot.packages or Packages(near=folders[0] if folders else None)
    launched = [launch for folder in near for launch in _launches(folder, packages, namespace)]
    for folder in others:
        with suppress(UrdfkitError):  # ignore broken files of other robots
            launched += _launches(folder, packages, namespace)
    starting = [launch for launch in launched if _spawned(launch, namespace)]
    for launch in starting or launched:
        if launch.settings is not None:
            started = _spawned(launch, namespace) or None
            inside = launch.settings.group(namespace)
            return Configuration(inside, launch.files, started, launch.path, launch.settings)
    return _unlaunched_yaml(folders, namespace)


def _launches(folder: Path, packages: Packages, namespace: str) -> list[Launch]:
    found = []
    for path in sorted((folder / "launch").glob("*.launch")) + sorted((folder / "launch").glob("*.launch.xml")):
        launch = read_launch(path, packages)
        if launch is not None and launch.settings is not None and controllers(launch.settings.group(namespace)):
            found.append(launch)
    return found


def _spawned(launch: Launch, namespace: str) -> tuple[str, ...]:
    start = "/" + namespace.strip("/")
    names = ["/" + name.strip("/") for name in launch.spawned]
    prefix = start.rstrip("/") + "/"
    return tuple(name[len(prefix) :] for name in names if name.startswith(prefix))


def _unlaunched_yaml(folders: list[Path], namespace: str) -> Configuration | None:
    for folder in folders:
        found: Settings | None = None
        files = []
        for path in sorted((folder / "config").glob("*.yaml")):
            try:
                read = read_settings(path)
            except UrdfkitError:
                continue  # the file may have no controllers
            if read.group(namespace).children:
                files.append(path)
                found = read if found is None else found.merged(read)
        if found is not None and controllers(found.group(namespace)):
            return Configuration(found.group(namespace), tuple(files), root=found)
    return None


def controllers(settings: Settings) -> dict[str, Settings]:
    """Return the controllers in a namespace: the groups with a ``type`` such as ``pkg/Controller``.

    Args:
        settings: the parameters of the namespace.
    """
    found = {}
    for name, child in settings.children.items():
        kind = child.children.get("type")
        if kind is not None and kind.value and "/" in kind.value:
            found[name] = child
    return found


def packages_around(description: Path) -> tuple[list[Path], list[Path]]:
    """Return the package of a description with similarly named neighbours, and the other neighbouring packages."""
    file = description.resolve()
    own = next((folder for folder in file.parents if (folder / "package.xml").is_file()), None)
    if own is None:
        return [file.parent, *([file.parent.parent] if file.parent.name in ("urdf", "xacro", "robots") else [])], []
    stem = own.name
    for ending in _ENDINGS:
        stem = stem.removesuffix(ending)
    try:
        siblings = sorted(own.parent.iterdir())[:_MAX_PACKAGES]
    except OSError:
        siblings = []
    others = [folder for folder in siblings if folder != own and (folder / "package.xml").is_file()]
    near = [folder for folder in others if folder.name.startswith(stem) or stem.startswith(folder.name)]
    return [own, *near], [folder for folder in others if folder not in near]
