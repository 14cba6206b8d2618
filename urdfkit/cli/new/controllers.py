"""``urdfkit new controllers``: controllers for the joints of a description that is there."""

from __future__ import annotations

import argparse
import sys
from datetime import datetime, timezone
from pathlib import Path

from urdfkit.cli.new.description_changes import add_description, apply, description, shown
from urdfkit.errors import ResourceError, UsageError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from urdfkit.description.urdf.robot import Robot
    from urdfkit.resources import ModelArgument
    from urdfkit.scaffold.additions.existing_hardware import Hardware
    from urdfkit.scaffold.additions.file_changes import Alteration
    from urdfkit.scaffold.additions.joint_controllers import Controller

SUMMARY = "controllers for the joints of a description that is there"


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser.description = (
        "Write controllers: a differential drive for wheels, trajectories for arms and fingers; "
        "what is driven already stays"
    )
    parser.epilog = (
        "examples:\n"
        "  urdfkit new controllers --into arm_description --diff\n"
        "  urdfkit new controllers --into arm_description --name arm_control"
    )
    add_description(parser)
    parser.add_argument(
        "--name", help="of the new package, beside the description's or the file (default: ROBOT_control)"
    )


def run(arguments: argparse.Namespace) -> int:
    """Load, tell what the joints are for, write a package, change the model.

    Raises:
        UrdfkitError: it could not be done; nothing was written then.
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
    there = hardware(robot, model.path, generation=generation)
    found = roles(robot, there, follow=generation != "classic")
    made = controllers(found)
    for note in () if arguments.quiet else (*found.notes, *_still(robot, made)):
        print(f"urdfkit: {note}", file=sys.stderr)
    if not made:
        raise ResourceError(f"robot `{robot.name}` has no joint left that a controller could move; nothing was changed")
    own = package_of(model.path)
    named = own.name if own is not None and own.name.endswith("_description") else robot.name or model.path.stem
    name = sanitised(named.removesuffix("_description"))
    if there.loop is not None and generation != "classic":
        return _added(model, robot, made, arguments, there, name, generation)
    if is_without_ros(model.path):
        return _without_ros(model, robot, made, arguments, generation)
    package = check_package_name(arguments.name or f"{name}_control")
    folder = own.parent if own is not None else model.path.parent
    if (folder / package).exists():
        raise ResourceError(f"{folder / package} is already there; nothing is overwritten: another --name")
    namespace = (there.loop_says("robotNamespace") or robot.name or name) if there.loop is not None else name
    with staging(folder) as stage:
        _render(stage, package, name, made, robot, generation, namespace=namespace.strip("/"))
        alterations = _altered(model.path, robot, made, name, generation, package, looped=there.loop is not None)
        code = apply(alterations, model, arguments, stage=stage, folder=folder)
    if not arguments.quiet and not arguments.diff:
        launch = (
            "roslaunch {0} {1}_control.launch" if generation == "classic" else "ros2 launch {0} {1}_control.launch.py"
        )
        print(f"  {launch.format(package, name)}  # once the robot is in Gazebo")
        for line in _to_add(folder, package, name):
            print(line)
    _tell(made, arguments)
    return code


def _to_add(folder: Path, package: str, name: str) -> Iterator[str]:
    """Yield what to add to the launch file of all of the robot, and to its package, for the controllers to start too.

    Args:
        folder: of the packages.
        package: of the controllers.
        name: of the robot.
    """
    for whole in (folder / f"{name}_bringup", folder / f"{name}_gazebo"):
        for launch in (whole / f"launch/{name}.launch.py", whole / f"launch/{name}.launch"):
            if not launch.is_file() or not (whole / "package.xml").is_file():
                continue
            yield f"\nto start them with the rest, add to {shown(launch)}:"
            if launch.suffix == ".py":
                yield "        IncludeLaunchDescription(PythonLaunchDescriptionSource(PathJoinSubstitution("
                yield f'            [FindPackageShare("{package}"), "launch", "{name}_control.launch.py"]))),'
            else:
                yield f'  <include file="$(find {package})/launch/{name}_control.launch"/>'
            yield f"and to {shown(whole / 'package.xml')}:"
            yield f"  <exec_depend>{package}</exec_depend>"
            return


def _without_ros(
    model: ModelArgument, robot: Robot, made: list[Controller], arguments: argparse.Namespace, generation: str
) -> int:
    """Write plugins of Gazebo beside the model.

    Raises:
        UsageError: Gazebo Classic, or a name for the package that there is not.
    """
    from urdfkit.scaffold.additions.gz_only_control import plugins, topics

    if generation != "gz":
        raise UsageError("--sim classic needs ROS for controllers, and this robot is made without: --sim gz")
    if arguments.name is not None:
        raise UsageError("--name is for a package of ROS, and this robot is made without: leave it out")
    title = "What moves the joints without ROS: each goes where its topic says, as fast as its motor may."
    code = apply(_beside(model.path, plugins(robot, made), title), model, arguments)
    for joint, topic in () if arguments.quiet else topics(made).items():
        print(f"urdfkit: {joint}: topic {topic}", file=sys.stderr)
    return code


def _tell(made: list[Controller], arguments: argparse.Namespace) -> None:
    for each in () if arguments.quiet else made:
        by = f" ({each.interface}, as the model has it)" if each.interface else ""
        print(f"urdfkit: {each.name}: {', '.join(each.joints)}{by}", file=sys.stderr)


def _still(robot: Robot, made: list[Controller]) -> Iterator[str]:
    """Yield which joints get a controller and have limits that let nothing move them, with the place."""
    for joint in (robot.joint_by_name[name] for each in made for name in each.joints):
        limit = joint.limit
        zero = [word for word in ("effort", "velocity") if limit is not None and getattr(limit, word) == 0.0]
        if zero and limit is not None:
            place = limit.element.origin.position
            yield f"{place}: `{joint.name}` may have no {' and no '.join(zero)}: its controller will not move it"


def _added(
    model: ModelArgument,
    robot: Robot,
    made: list[Controller],
    arguments: argparse.Namespace,
    there: Hardware,
    name: str,
    generation: str,
) -> int:
    """Write controllers into the file of parameters that the model names: its controller manager reads no other.

    Raises:
        ResourceError: it names none that can be changed.
    """
    from urdfkit.scaffold.additions.controller_parameters import parameters, with_controllers
    from urdfkit.scaffold.additions.file_changes import Alteration

    said = there.loop_says("parameters")
    plugin = there.loop.name if there.loop is not None else None
    if said is None or not Path(said).is_file():
        wrong = f"names {said}, which is not there" if said else "names no <parameters>"
        raise ResourceError(f"plugin `{plugin}` {wrong}: controllers go into the file that it reads")
    if arguments.name is not None:
        raise UsageError(f"--name is for a new package; plugin `{plugin}` reads {said}, so controllers go into it")
    path = Path(said)
    before = path.read_bytes()
    more = parameters(robot, made, generation=generation, base=robot.roots()[0].name)
    after = with_controllers(before.decode("utf-8", "surrogateescape"), more, [each.name for each in made], path=path)
    changes = _altered(model.path, robot, made, name, generation, path.parents[1].name, looped=True)
    changed = Alteration(path, before, after.encode("utf-8", "surrogateescape"))
    code = apply([changed, *changes], model, arguments)
    if not arguments.quiet and not arguments.diff:
        spawned = " ".join(each.name for each in made)
        print(f"  ros2 run controller_manager spawner {spawned}  # once the robot is in Gazebo")
    _tell(made, arguments)
    return code


def _is_fortress(robot: Robot) -> bool:
    return any("ignition-gazebo-" in file.read_text("utf-8", "replace") for file in robot.files if file.is_file())


def _render(
    stage: Path, package: str, name: str, made: list[Controller], robot: Robot, generation: str, *, namespace: str
) -> None:
    from urdfkit.cli.git_identity import identity
    from urdfkit.resources import templates_dir
    from urdfkit.scaffold import computed, load_template
    from urdfkit.scaffold.additions.controller_parameters import at_root, parameters
    from urdfkit.scaffold.additions.joint_controllers import needs

    template = load_template(templates_dir() / "package")
    ros = {"classic": "noetic", "fortress": "humble", "classic-ros2": "humble"}.get(generation, "jazzy")
    given = {"name": package, "kind": "control", "ros": ros, "depends": " ".join(needs(made, generation))}
    given["about"] = f"The controllers of the robot {name}."
    answers: Mapping[str, str] = template.answers({**identity(template), **given})
    more = parameters(robot, made, generation=generation, base=robot.roots()[0].name)
    more["namespace"] = namespace or name
    year = {"year": str(datetime.now(timezone.utc).year), "into": "."}
    template.render({**answers, **computed("package", answers), **more, **year, "robot": name}, stage)
    if generation == "classic" and not namespace:
        at_root(stage / package, name)


def _altered(
    path: Path, robot: Robot, made: list[Controller], name: str, generation: str, package: str, *, looped: bool
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
                f"{path} is no xacro, so that it cannot find its controllers: call it {path.stem}.urdf.xacro first"
            )
        changes = [Alteration(path, before, insert_before_end(before, text, path=path))]
        return [*_told(path, package, generation), *changes]
    if (path.parent / "control.xacro").exists():
        raise ResourceError(f"{path.parent / 'control.xacro'} is already there; nothing is overwritten")
    changes = _beside(path, text, f"Which joints are moved, and how; the controllers are in {package}.")
    home = changes[0].path
    installed = with_installed(own, path, home) if (own := package_of(path)) is not None else None
    return [*_told(path, package, generation), *([installed] if installed is not None else []), *changes]


def _beside(path: Path, text: str, title: str) -> list[Alteration]:
    """Return a new file with elements beside a model, and the model that includes it; a URDF alone."""
    from urdfkit.scaffold.additions.file_changes import Alteration
    from urdfkit.scaffold.additions.xml_insertion import insert_before_end, xacro_prefix
    from urdfkit.scaffold.templates.names import free

    before = path.read_bytes()
    prefix = xacro_prefix(before) if path.suffix == ".xacro" else None
    if prefix is None:
        return [Alteration(path, before, insert_before_end(before, text, path=path))]
    home = path.parent / f"{free('control', lambda each: (path.parent / f'{each}.xacro').exists())}.xacro"
    body = "\n".join(f"  {line}" for line in text.splitlines())
    whole = (
        f'<?xml version="1.0"?>\n<!-- {title} -->\n'
        f'<robot xmlns:xacro="http://www.ros.org/wiki/xacro">\n{body}\n</robot>\n'
    )
    after = insert_before_end(before, f'<{prefix}:include filename="{home.name}"/>', path=path)
    return [Alteration(home, None, whole.encode()), Alteration(path, before, after)]


def _told(path: Path, package: str, generation: str) -> list[Alteration]:
    """Return the change to package.xml of a description that says where its controllers are."""
    from urdfkit.scaffold.additions.package_manifest import package_of, with_dependency

    own = package_of(path)
    if own is None or generation == "classic":
        return []
    needed = with_dependency(own, package, alone=True)
    return [needed] if needed is not None else []
