"""Mistakes in transmissions, ros2_control and the elements of Gazebo."""

from __future__ import annotations

import random
import re
from collections.abc import Iterator

from tests.bench.package_mutants.mutant import (
    Mutant,
    Workspace,
    attribute,
    content,
    element,
    kind,
    literal,
    renamed_tag,
    text_of,
    typo,
    value,
    wrong_name,
)

_MODEL = kind("model")
Mutants = Iterator[Mutant]


@_MODEL
def transmission_of_unknown_joint(ws: Workspace, lot: random.Random) -> Mutants:
    """The controller manager does not find the joint."""
    for file, tag in ws.model_tags("joint", parent="transmission"):
        if literal(tag, "name"):
            yield wrong_name(file, tag, "name", typo(literal(tag, "name"), lot, ws.joints))
    for file, tag in ws.model_tags("xacro:motor"):
        yield wrong_name(file, tag, "joint", typo(literal(tag, "joint"), lot, ws.joints))


@_MODEL
def unknown_hardware_interface(ws: Workspace, lot: random.Random) -> Mutants:
    """No such interface exists, or the controller uses another one."""
    for file, tag in ws.model_tags("hardwareInterface"):
        name = text_of(tag)
        if "$" not in name:
            wrong = [f"hardware_interface/{typo(name.split('/')[1], lot)}", name.replace("Interface", "Inteface")]
            wrong.append("hardware_interface/PositionJointInterface")
            new = lot.choice(wrong)
            yield content(file, tag, new, names=(new, name))
    for file, tag in ws.model_tags("xacro:motor"):
        if literal(tag, "interface"):
            yield wrong_name(file, tag, "interface", typo(literal(tag, "interface"), lot))


@_MODEL
def transmission_element(ws: Workspace, lot: random.Random) -> Mutants:
    """The transmission is not loaded: its type, its actuator or its interface is missing or unknown."""
    for file, tag in ws.model_tags("type", "actuator", "hardwareInterface"):
        if tag.parent is not None and tag.parent.name == "transmission":
            yield element(file, tag)
        if tag.name == "type" and text_of(tag).startswith("transmission_interface/"):
            wrong = f"transmission_interface/{typo(text_of(tag).split('/')[1], lot)}"
            yield content(file, tag, wrong, names=(wrong,))


@_MODEL
def unknown_gazebo_reference(ws: Workspace, lot: random.Random) -> Mutants:
    """The settings are lost."""
    for file, tag in ws.model_tags("gazebo"):
        if literal(tag, "reference"):
            yield wrong_name(file, tag, "reference", typo(literal(tag, "reference"), lot, [*ws.links, *ws.joints]))
    for file, tag in ws.model_tags("xacro:tyre"):
        yield wrong_name(file, tag, "link", typo(literal(tag, "link"), lot, ws.links))


@_MODEL
def unknown_plugin(ws: Workspace, lot: random.Random) -> Mutants:
    """The library is not found."""
    for file, tag in ws.model_tags("plugin"):
        if literal(tag, "filename"):
            name = literal(tag, "filename")
            core = re.sub(r"^lib|\.so$", "", name)
            yield wrong_name(file, tag, "filename", name.replace(core, typo(core, lot)))


@_MODEL
def plugin_names_unknown_part(ws: Workspace, lot: random.Random) -> Mutants:
    """The plugin does not find its joint or its link."""
    for file, tag in ws.model_tags():
        name = text_of(tag).strip()
        inside = any(above.name in ("plugin", "sensor") for above in tag.ancestors())
        if inside and (name in ws.joints or name in ws.links):
            wrong = typo(name, lot, [*ws.joints, *ws.links])
            yield content(file, tag, wrong, names=(wrong, name))


@_MODEL
def plugin_parameter_misspelt(ws: Workspace, lot: random.Random) -> Mutants:
    """The plugin does not read the parameter."""
    for file, tag in ws.model_tags():
        if tag.parent is not None and tag.parent.name == "plugin" and text_of(tag).strip():
            yield renamed_tag(file, tag, typo(tag.name, lot).replace("-", "_"))


@_MODEL
def plugin_value(ws: Workspace, lot: random.Random) -> Mutants:
    """The wheels have another size or distance than in the model; odometry is wrong."""
    names = ("wheel_separation", "wheelSeparation", "wheel_radius", "wheel_diameter", "wheelDiameter")
    for file, tag in ws.model_tags(*names):
        yield content(file, tag, lot.choice(["3.6", "360", "-0.1", "0"]))


@_MODEL
def wheels_swapped(ws: Workspace, lot: random.Random) -> Mutants:
    """The robot turns the wrong way."""
    for file, tag in ws.model_tags("left_joint", "leftJoint", "right_joint", "rightJoint"):
        name = text_of(tag)
        other = name.replace("left", "right") if "left" in name else name.replace("right", "left")
        if other != name:
            yield content(file, tag, other, names=(other,))


@_MODEL
def sensor_value(ws: Workspace, lot: random.Random) -> Mutants:
    """The sensor measures nothing, or Gazebo refuses it."""
    wrong = {
        "update_rate": ["0", "-10"],
        "samples": ["0", "-1"],
        "horizontal_fov": ["80", "-1.4", "0"],
        "min_angle": ["${radians(170)}", "-135"],
        "max_angle": ["135", "${radians(-170)}"],
        "near": ["200", "-1", "0"],
        "width": ["0", "-640"],
        "height": ["0", "-480"],
        "min": ["500", "-1"],
        "max": ["0.01", "0"],
        "stddev": ["-0.01"],
    }
    for file, tag in ws.model_tags(*wrong):
        if any(above.name == "sensor" for above in tag.ancestors()) and tag.close is not None and not tag.children:
            yield content(file, tag, lot.choice(wrong[tag.name]))


@_MODEL
def sensor_type_misspelt(ws: Workspace, lot: random.Random) -> Mutants:
    """Gazebo does not create the sensor."""
    for file, tag in ws.model_tags("sensor"):
        if literal(tag, "type"):
            yield wrong_name(file, tag, "type", typo(literal(tag, "type"), lot))


@_MODEL
def control_joint_misspelt(ws: Workspace, lot: random.Random) -> Mutants:
    """ros2_control names a joint that does not exist."""
    for file, tag in ws.model_tags("joint", parent="ros2_control"):
        if literal(tag, "name"):
            yield wrong_name(file, tag, "name", typo(literal(tag, "name"), lot, ws.joints), uses=True)
    for file, tag in ws.model_tags("xacro:positioned_joint"):
        yield wrong_name(file, tag, "name", typo(literal(tag, "name"), lot, ws.joints), uses=True)


@_MODEL
def control_joint_missing(ws: Workspace, lot: random.Random) -> Mutants:
    """A controller claims an interface that no hardware offers."""
    for file, tag in ws.model_tags("joint", "xacro:positioned_joint"):
        name = literal(tag, "name")
        inside = tag.parent is not None and tag.parent.name == "ros2_control"
        if inside and name in ws.joints and "right_finger" not in name:
            yield element(file, tag, names=(name, "command_interfaces"), uses=True)


@_MODEL
def control_interface_misspelt(ws: Workspace, lot: random.Random) -> Mutants:
    """The hardware offers an interface that is not used; the controller does not find its own."""
    for file, tag in ws.model_tags("command_interface", "state_interface"):
        name = literal(tag, "name")
        if name:
            yield wrong_name(file, tag, "name", typo(name, lot), uses=True)


@_MODEL
def control_interface_missing(ws: Workspace, lot: random.Random) -> Mutants:
    """The controller does not find the command interface that it needs; its own list of interfaces is right too."""
    for file, tag in ws.model_tags("command_interface"):
        above = tag.parent
        names = tuple(
            name for name in (literal(tag, "name"), literal(above, "name") if above is not None else "") if name
        )
        yield element(file, tag, names=names, uses=True)


@_MODEL
def hardware_plugin(ws: Workspace, lot: random.Random) -> Mutants:
    """The hardware component is not loaded."""
    for file, tag in ws.model_tags("plugin", parent="hardware"):
        name = text_of(tag)
        space, _, cls = name.partition("/")
        wrong = lot.choice([f"{space}/{typo(cls, lot)}", f"{typo(space, lot)}/{cls}"])
        yield content(file, tag, wrong, names=(wrong, name))
        yield element(file, tag)
    for file, tag in ws.model_tags("hardware"):
        yield element(file, tag)


@_MODEL
def control_type_misspelt(ws: Workspace, lot: random.Random) -> Mutants:
    """The kind of hardware is system, actuator or sensor."""
    for file, tag in ws.model_tags("ros2_control"):
        yield wrong_name(file, tag, "type", lot.choice(["systems", "System", "robot", "sytem"]))
        yield attribute(file, tag, "type", "")


@_MODEL
def negative_dynamics(ws: Workspace, lot: random.Random) -> Mutants:
    """Damping below 0 adds energy: the joint runs away."""
    for file, tag in ws.model_tags("dynamics"):
        for name in ("damping", "friction"):
            if literal(tag, name) and float(literal(tag, name)) > 0:
                yield value(file, tag, name, f"-{literal(tag, name)}")


@_MODEL
def controllers_file_misspelt(ws: Workspace, lot: random.Random) -> Mutants:
    """gz_ros2_control does not find the file, and stops Gazebo."""
    for file, tag in ws.model_tags("parameters"):
        written = text_of(tag)
        found = re.search(r"(\w+)\.yaml", written)
        if found is not None:
            wrong = typo(found[1], lot)
            yield content(file, tag, written.replace(found[1], wrong), names=(f"{wrong}.yaml",))
