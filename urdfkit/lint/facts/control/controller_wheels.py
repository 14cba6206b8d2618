"""Wheels of the ``diff_drive_controller``, of steering and of mecanum controllers in YAML."""

import re
from collections.abc import Iterator
from pathlib import Path

from urdfkit.description.packages.related_files import package_of
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.controller_settings import ControllerSettings, settings
from urdfkit.lint.facts.control.parameter_values import CORNER
from urdfkit.lint.facts.control.yaml_tree import Node, number_of, yamls_of_robot
from urdfkit.lint.facts.gazebo.drive_wheels import Wheel, wheel_of
from urdfkit.lint.model.model import Model
from urdfkit.lint.project.description_files import descriptions


def diff_drives(model: Model) -> Iterator[tuple[Source, ControllerSettings]]:
    """Yield the controllers for differential drives in the YAML files of these packages."""
    for source in yamls_of_robot(model):
        if "DiffDriveController" in source.text:
            for controller in settings(source):
                if controller.kind == "diff_drive_controller/DiffDriveController":
                    yield source, controller


def simulated_diff_drives(model: Model) -> Iterator[tuple[ControllerSettings, list[Wheel], list[Wheel]]]:
    """Yield the controllers of differential drives that Gazebo runs, with their left and right wheels.

    Yields nothing for a robot whose wheels can belong to another drive.
    """
    from urdfkit.lint.facts.gazebo.plugins import runs_controllers

    if not runs_controllers(model.robot) or has_other_wheels(model):
        return
    for _, controller in diff_drives(model):
        left, right = ([wheel for _, wheel in wheels_of(controller, model, side)] for side in ("left", "right"))
        yield controller, left, right


def steering_wheels(model: Model) -> Iterator[tuple[Source, Node, str, list[Wheel]]]:
    """Yield the group and name of the radius of the wheels that a steering controller drives, and these wheels.

    Sources: steering_controllers_library (steering_controllers_library.yaml) and tricycle_controller (README) of Humble
    to Rolling.
    """
    for source in yamls_of_robot(model):
        for controller in settings(source) if re.search(r"_steering_controller|tricycle_con", source.text) else ():
            if controller.kind == "tricycle_controller/TricycleController":
                named = controller.group.find("traction_joint_name")
                if wheels := _all_wheels(model, [named.text] if named is not None else []):
                    yield source, controller.group, "wheel_radius", wheels
            if "_steering_controller/" not in controller.kind:
                continue
            front = controller.group.find("front_steering")
            driven = "front" if front is not None and front.text.lower() == "false" else "rear"
            for side in ("traction_joints", f"{driven}_wheels"):
                listed = controller.group.find(f"{side}_names")
                if wheels := _all_wheels(model, listed.texts() if listed is not None else []):
                    yield source, controller.group, f"{side.replace('joints', 'wheels')}_radius", wheels


def mecanum_wheels(model: Model) -> Iterator[tuple[Source, Node, str, list[Wheel]]]:
    """Yield the group and name of the radius of the wheels of a mecanum controller, and these wheels.

    Wheels whose rollers are links are left out, because the radius of such a wheel is not that of its own shape.
    Source: mecanum_drive_controller (mecanum_drive_controller.yaml) of Jazzy to Rolling.
    """
    parents = {joint.parent for joint in model.robot.joints}
    for source in yamls_of_robot(model):
        for controller in settings(source) if "MecanumDriveController" in source.text else ():
            if controller.kind != "mecanum_drive_controller/MecanumDriveController":
                continue
            named = [value.text for key, value in controller.group.entries if key.text.endswith(CORNER)]
            wheels = _all_wheels(model, named)
            if wheels and not any(wheel.joint.child in parents for wheel in wheels):
                yield source, controller.group, "kinematics.wheels_radius", wheels
                if (group := controller.group.find("kinematics")) is not None:
                    yield source, group, "wheels_radius", wheels


def mecanum_defects(model: Model) -> Iterator[tuple[Source, Node, str, str, str]]:
    """Yield corners and distances of a mecanum controller that contradict the wheels: file, node, message, joint, help.

    Source: mecanum_drive_controller (userdoc.rst: half of the wheelbase plus half of the track), Jazzy to Rolling.
    """
    for source in yamls_of_robot(model):
        for controller in settings(source) if "MecanumDriveController" in source.text else ():
            named = {
                key.text.removesuffix(CORNER): value for key, value in controller.group.entries if CORNER in key.text
            }
            wheels = dict(zip(named, _all_wheels(model, [value.text for value in named.values()]), strict=False))
            if not {"front_left", "front_right", "rear_left", "rear_right"} <= wheels.keys():
                continue
            places = {name: wheel.place for name, wheel in wheels.items()}
            x, y = (sum(place[k] for place in places.values()) / len(places) for k in (0, 1))
            wrong = [
                (name, next(other for other, at in places.items() if other != name and _corner(at, x, y) == name))
                for name, place in places.items()
                if _corner(place, x, y) != name
                and sum(_corner(at, x, y) == name for other, at in places.items() if other != name) == 1
            ]
            for name, other in wrong[:1]:
                place, help = places[name], f"swap it with `{named[other].text}`"
                where = f"x = {place[0]:g} m, y = {place[1]:g} m"
                message = f"wheel `{named[name].text}` of `{name}{CORNER}` is at {where}"
                yield source, named[name], message, named[name].text, help
            group = controller.group.find("kinematics") or controller.group
            value = group.find(_SUM) or group.find(f"kinematics.{_SUM}")
            total, actual = (
                number_of(value),
                sum(abs(place[0] - x) + abs(place[1] - y) for place in places.values()) / len(places),
            )
            if value is not None and total and not wrong and abs(total - actual) > _MAX_DEVIATION * actual:
                message = f"`{_SUM}` is {total:g} m, but half of the wheelbase and half of the track are {actual:.6g} m"
                yield source, value, message, next(iter(wheels.values())).joint.name, f"write {actual:.6g}"


_SUM = "sum_of_robot_center_projection_on_X_Y_axis"
_MAX_DEVIATION = 0.1


def _corner(place: tuple[float, float, float], x: float, y: float) -> str:
    return f"{'front' if place[0] > x else 'rear'}_{'left' if place[1] > y else 'right'}"


def _all_wheels(model: Model, names: list[str]) -> list[Wheel]:
    """Return the wheels of joints; empty if the robot lacks one of them."""
    joints = [model.robot.joint_by_name.get(name) for name in names]
    wheels = [wheel for joint in joints if joint is not None and (wheel := wheel_of(model, joint, None))]
    return wheels if len(wheels) == len(joints) else []


def wheels_of(controller: ControllerSettings, model: Model, side: str) -> list[tuple[Node, Wheel]]:
    """Return the wheels of one side with their nodes in YAML; empty if the robot lacks one of them."""
    names = controller.group.find(f"{side}_wheel_names") or controller.group.find(f"{side}_wheel")
    nodes = [node for node in (names, *names.items) if node.text] if names is not None else []
    joints = [model.robot.joint_by_name.get(node.text) for node in nodes]
    wheels = [wheel_of(model, joint, None) if joint is not None else None for joint in joints]
    named_wheels = [(node, wheel) for node, wheel in zip(nodes, wheels, strict=True) if wheel is not None]
    return named_wheels if len(named_wheels) == len(nodes) else []


def has_other_wheels(model: Model) -> bool:
    """Return whether another description in these packages has continuous joints."""
    included = {str(Path(name).absolute()) for name in model.expanded.sources}
    packages = {model.package, *(package_of(Path(file)) for file in model.related_files)}
    folders = sorted(package for package in packages if package is not None)
    texts = (description for folder in folders for description in descriptions(folder))
    return any("continuous" in text for path, text in texts if str(path.absolute()) not in included)
