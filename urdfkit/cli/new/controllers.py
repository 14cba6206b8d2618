"""``urdfkit new controllers``: add controllers for the joints of an existing description."""

from __future__ import annotations

import argparse
import sys
from datetime import datetime, timezone
from pathlib import Path

from urdfkit.cli.new.change_workflow import add_description, apply, description, shown
from urdfkit.errors import ResourceError, UsageError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from urdfkit.description.urdf.robot import Robot
    from urdfkit.resources import ModelArgument
    from urdfkit.scaffold.additions.existing_hardware import ExistingHardware
    from urdfkit.scaffold.additions.file_changes import Alteration
    from urdfkit.scaffold.additions.joint_controllers import ChosenController

SUMMARY = "controllers for the joints of an existing description"


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser.description = (
        "write controllers: a differential drive controller for wheels, trajectory controllers for arms and fingers; "
        "joints that a plugin or a controller already drives stay unchanged"
    )
    parser.epilog = (
        "examples:\n"
        "  urdfkit new controllers --into arm_description --diff\n"
        "  urdfkit new controllers --into arm_description --name arm_control"
    )
    add_description(parser)
    parser.add_argument(
        "--name", help="name of the new package, created next to the description (default: ROBOT_control)"
    )


def run(arguments: argparse.Namespace) -> int:
    """Load the description, classify its joints, write a package, change the model.

    Raises:
        UrdfkitError: the controllers could not be added; nothing was written.
    """
    from urdfkit.atomic import staging
    from urdfkit.scaffold import check_package_name, sanitised
    from urdfkit.scaffold.additions.existing_hardware import hardware
    from urdfkit.scaffold.additions.gz_only_control import is_without_ros
    from urdfkit.scaffold.additions.joint_controllers import controllers
    from urdfkit.scaffold.additions.joint_roles import roles
    from urdfkit.scaffold.additions.package_manifest import package_of

    model, robot, generation = description(arguments)
    if generation == "gz" and _is_fortress(robot):
        generation = "fortress"
    existing = hardware(robot, model.path, generation=generation)
    joint_roles = roles(robot, existing, follow=generation != "classic")
    made = controllers(joint_roles)
    for note in () if arguments.quiet else (*joint_roles.notes, *_immovable_joints(robot, made)):
        print(f"urdfkit: {note}", file=sys.stderr)
    if not made:
        raise ResourceError(f"robot `{robot.name}` has no joint without a controller; nothing was changed")
    own = package_of(model.path)
    named = own.name if own is not None and own.name.endswith("_description") else robot.name or model.path.stem
    name = sanitised(named.removesuffix("_description"))
    if existing.loop is not None and generation != "classic":
        return _add_to_existing(model, robot, made, arguments, existing, name, generation)
    if is_without_ros(model.path):
        return _without_ros(model, robot, made, arguments, generation)
    package = check_package_name(arguments.name or f"{name}_control")
    folder = own.parent if own is not None else model.path.parent
    if (folder / package).exists():
        raise ResourceError(f"{folder / package} already exists; choose another --name")
    namespace = (existing.loop_parameter("robotNamespace") or robot.name or name) if existing.loop is not None else name
    with staging(folder) as staged:
        _render(staged, package, name, made, robot, generation, namespace=namespace.strip("/"))
        alterations = _altered(model.path, robot, made, name, generation, package, looped=existing.loop is not None)
        code = apply(alterations, model, arguments, staged=staged, folder=folder)
    if not arguments.quiet and not arguments.diff:
        launch = (
            "roslaunch {0} {1}_control.launch" if generation == "classic" else "ros2 launch {0} {1}_control.launch.py"
        )
        print(f"  {launch.format(package, name)}  # once the robot is in Gazebo")
        for line in _launch_additions(folder, package, name):
            print(line)
    _print_controllers(made, arguments)
    return code


def _launch_additions(folder: Path, package: str, name: str) -> Iterator[str]:
    """Yield the lines to add to the robot's launch file and package.xml, so that the controllers start with the robot.

    Args:
        folder: folder of the packages.
        package: package of the controllers.
        name: name of the robot.
    """
    for whole in (folder / f"{name}_bringup", folder / f"{name}_gazebo"):
        for launch in (whole / f"launch/{name}.launch.py", whole / f"launch/{name}.launch"):
            if not launch.is_file() or not (whole / "package.xml").is_file():
                continue
            yield f"\nto start the controllers with the robot, add to {shown(launch)}:"
            if launch.suffix == ".py":
                yield "        IncludeLaunchDescription(PythonLaunchDescriptionSource(PathJoinSubstitution("
                yield f'            [FindPackageShare("{package}"), "launch", "{name}_control.launch.py"]))),'
            else:
                yield f'  <include file="$(find {package})/launch/{name}_control.launch"/>'
            yield f"and to {shown(whole / 'package.xml')}:"
            yield f"  <exec_depend>{package}</exec_depend>"
            return


def _without_ros(
    model: ModelArgument, robot: Robot, made: list[ChosenController], arguments: argparse.Namespace, generation: str
) -> int:
    """Write plugins of Gazebo into a file next to the model.

    Raises:
        UsageError: the simulator is Gazebo Classic, or a package name is set.
    """
    from urdfkit.scaffold.additions.gz_only_control import plugins, topics

    if generation != "gz":
        raise UsageError("--sim classic needs ROS for controllers, and this robot has no ROS packages: use --sim gz")
    if arguments.name is not None:
        raise UsageError("--name is for a ROS package, and this robot has none: remove the option")
    title = "Joint controllers without ROS: each joint follows the commands on its topic."
    code = apply(_included(model.path, plugins(robot, made), title), model, arguments)
    for joint, topic in () if arguments.quiet else topics(made).items():
        print(f"urdfkit: {joint}: topic {topic}", file=sys.stderr)
    return code


def _print_controllers(made: list[ChosenController], arguments: argparse.Namespace) -> None:
    for each in () if arguments.quiet else made:
        by = f" ({each.interface}, as in the model)" if each.interface else ""
        print(f"urdfkit: controller `{each.name}` for {', '.join(each.joints)}{by}", file=sys.stderr)


def _immovable_joints(robot: Robot, made: list[ChosenController]) -> Iterator[str]:
    """Yield one message per joint with a new controller whose limits prevent any motion, with its position."""
    for joint in (robot.joint_by_name[name] for each in made for name in each.joints):
        limit = joint.limit
        zero = [word for word in ("effort", "velocity") if limit is not None and getattr(limit, word) == 0.0]
        if zero and limit is not None:
            place = limit.element.origin.position
            limits = " and ".join(f"{word} 0" for word in zero)
            yield f"{place}: `{joint.name}` has the limit {limits}: its controller cannot move it"


def _add_to_existing(
    model: ModelArgument,
    robot: Robot,
    made: list[ChosenController],
    arguments: argparse.Namespace,
    existing: ExistingHardware,
    name: str,
    generation: str,
) -> int:
    """Add controllers to the parameter file that the model names; its controller manager reads no other file.

    Raises:
        ResourceError: the model names no parameter file that can be changed.
    """
    from urdfkit.scaffold.additions.controller_parameters import parameters, with_controllers
    from urdfkit.scaffold.additions.file_changes import Alteration

    parameter_file = existing.loop_parameter("parameters")
    plugin = existing.loop.name if existing.loop is not None else None
    if parameter_file is None or not Path(parameter_file).is_file():
        wrong = f"names {parameter_file}, which does not exist" if parameter_file else "names no <parameters>"
        raise ResourceError(f"plugin `{plugin}` {wrong}: new controllers are added to that file")
    if arguments.name is not None:
        raise UsageError(
            f"--name is for a new package; the controllers are added to {parameter_file}, which plugin `{plugin}` reads"
        )
    path = Path(parameter_file)
    before = path.read_bytes()
    more = parameters(robot, made, generation=generation, base=robot.roots()[0].name)
    after = with_controllers(before.decode("utf-8", "surrogateescape"), more, [each.name for each in made], path=path)
    changes = _altered(model.path, robot, made, name, generation, path.parents[1].name, looped=True)
    changed = Alteration(path, before, after.encode("utf-8", "surrogateescape"))
    code = apply([changed, *changes], model, arguments)
    if not arguments.quiet and not arguments.diff:
        spawned = " ".join(each.name for each in made)
        print(f"  ros2 run controller_manager spawner {spawned}  # once the robot is in Gazebo")
    _print_controllers(made, arguments)
    return code


def _is_fortress(robot: Robot) -> bool:
    return any("ignition-gazebo-" in file.read_text("utf-8", "replace") for file in robot.files if file.is_file())


def _render(
    staged: Path,
    package: str,
    name: str,
    made: list[ChosenController],
    robot: Robot,
    generation: str,
    *,
    namespace: str,
) -> None:
    from urdfkit.cli.new.git_identity import identity
    from urdfkit.resources import templates_dir
    from urdfkit.scaffold import computed, load_template
    from urdfkit.scaffold.additions.controller_parameters import move_to_root_namespace, parameters
    from urdfkit.scaffold.additions.joint_controllers import needs

    template = load_template(templates_dir() / "package")
    ros = {"classic": "noetic", "fortress": "humble", "classic-ros2": "humble"}.get(generation, "jazzy")
    answered = {"name": package, "kind": "control", "ros": ros, "depends": " ".join(needs(made, generation))}
    answered["about"] = f"The controllers of the robot {name}."
    answers: Mapping[str, str] = template.answers({**identity(template), **answered})
    more = parameters(robot, made, generation=generation, base=robot.roots()[0].name)
    more["namespace"] = namespace or name
    year = {"year": str(datetime.now(timezone.utc).year), "into": "."}
    template.render({**answers, **computed("package", answers), **more, **year, "robot": name}, staged)
    if generation == "classic" and not namespace:
        move_to_root_namespace(staged / package, name)


def _altered(
    path: Path, robot: Robot, made: list[ChosenController], name: str, generation: str, package: str, *, looped: bool
) -> list[Alteration]:
    from urdfkit.scaffold.additions.file_changes import Alteration
    from urdfkit.scaffold.additions.joint_controllers import markup
    from urdfkit.scaffold.additions.package_manifest import package_of, with_installed
    from urdfkit.scaffold.additions.xml_insertion import insert_before_end, xacro_prefix

    before = path.read_bytes()
    text = markup(robot, made, name=name, generation=generation, package=package, looped=looped)
    if not text:
        return []
    prefix = xacro_prefix(before) if path.suffix == ".xacro" else None
    if prefix is None:
        if generation != "classic" and path.suffix != ".xacro":
            raise ResourceError(
                f"{path} is not a xacro file and cannot name its controllers: rename it to {path.stem}.urdf.xacro first"
            )
        changes = [Alteration(path, before, insert_before_end(before, text, path=path))]
        return [*_dependency(path, package, generation), *changes]
    if (path.parent / "control.xacro").exists():
        raise ResourceError(f"{path.parent / 'control.xacro'} already exists; rename or remove it")
    changes = _included(path, text, f"Command and state interfaces of the joints; the controllers are in {package}.")
    home = changes[0].path
    installed = with_installed(own, path, home) if (own := package_of(path)) is not None else None
    return [*_dependency(path, package, generation), *([installed] if installed is not None else []), *changes]


def _included(path: Path, text: str, title: str) -> list[Alteration]:
    """Return a new file with elements next to a model, and the model that includes the file; only the model if URDF."""
    from urdfkit.scaffold.additions.file_changes import Alteration
    from urdfkit.scaffold.additions.xml_insertion import insert_before_end, xacro_prefix
    from urdfkit.scaffold.templates.names import unused_name

    before = path.read_bytes()
    prefix = xacro_prefix(before) if path.suffix == ".xacro" else None
    if prefix is None:
        return [Alteration(path, before, insert_before_end(before, text, path=path))]
    home = path.parent / f"{unused_name('control', lambda each: (path.parent / f'{each}.xacro').exists())}.xacro"
    body = "\n".join(f"  {line}" for line in text.splitlines())
    whole = (
        f'<?xml version="1.0"?>\n<!-- {title} -->\n'
        f'<robot xmlns:xacro="http://www.ros.org/wiki/xacro">\n{body}\n</robot>\n'
    )
    after = insert_before_end(before, f'<{prefix}:include filename="{home.name}"/>', path=path)
    return [Alteration(home, None, whole.encode()), Alteration(path, before, after)]


def _dependency(path: Path, package: str, generation: str) -> list[Alteration]:
    """Return the change to package.xml that adds the dependency on the controllers' package; in ROS 1, the plugin's."""
    from urdfkit.scaffold.additions.package_manifest import package_of, with_dependency

    own = package_of(path)
    if own is None:
        return []
    is_ros1 = generation == "classic"
    needed = with_dependency(own, "gazebo_ros_control" if is_ros1 else package, alone=not is_ros1)
    return [needed] if needed is not None else []
