"""Wheels of the ``diff_drive_controller``, of steering and of mecanum controllers in YAML."""

from collections.abc import Iterator
from pathlib import Path

from urdfkit.description.packages.related_files import package_of
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.controller_settings import ControllerSettings, settings
from urdfkit.lint.facts.control.parameter_values import CORNER
from urdfkit.lint.facts.control.yaml_tree import Node, yamls
from urdfkit.lint.facts.gazebo.drive_wheels import Wheel, wheel_of
from urdfkit.lint.model.model import Model
from urdfkit.lint.project.description_files import descriptions


def diff_drives(model: Model) -> Iterator[tuple[Source, ControllerSettings]]:
    """Yield the controllers for differential drives in the YAML files of these packages."""
    for source in yamls(model):
        if "DiffDriveController" in source.text:
            for controller in settings(source):
                if controller.kind == "diff_drive_controller/DiffDriveController":
                    yield source, controller


def steering_wheels(model: Model) -> Iterator[tuple[Source, Node, str, list[Wheel]]]:
    """Yield the group and name of the radius of the wheels that a steering controller drives, and these wheels.

    Source: steering_controllers_library (steering_controllers_library.yaml) of Humble to Rolling.
    """
    for source in yamls(model):
        for controller in settings(source) if "_steering_controller" in source.text else ():
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
    for source in yamls(model):
        for controller in settings(source) if "MecanumDriveController" in source.text else ():
            if controller.kind != "mecanum_drive_controller/MecanumDriveController":
                continue
            named = [value.text for key, value in controller.group.entries if key.text.endswith(CORNER)]
            wheels = _all_wheels(model, named)
            if wheels and not any(wheel.joint.child in parents for wheel in wheels):
                yield source, controller.group, "kinematics.wheels_radius", wheels
                if (group := controller.group.find("kinematics")) is not None:
                    yield source, group, "wheels_radius", wheels


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
