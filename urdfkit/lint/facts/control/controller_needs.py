"""What ROS 2 controllers need: combinations of interfaces, and a section of parameters.

Source: ros2_controllers, *_parameters.yaml and joint_trajectory_controller (Humble to Rolling).
"""

import re
from collections.abc import Iterator

from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.ros2_controllers import PARAMETERS, DeclaredController, declared
from urdfkit.lint.facts.control.yaml_tree import Node, nodes, yamls
from urdfkit.lint.model.model import Model

_NEEDS = {
    "imu_sensor_broadcaster/IMUSensorBroadcaster": ("sensor_name", "frame_id"),
    "range_sensor_broadcaster/RangeSensorBroadcaster": ("sensor_name", "frame_id"),
    "joint_trajectory_controller/JointTrajectoryController": ("joints",),
    "diff_drive_controller/DiffDriveController": ("left_wheel_names", "right_wheel_names"),
}
"""Controller type → parameters that it needs."""


def unmet_needs(source: Source, model: Model) -> Iterator[tuple[Node, str]]:
    """Yield velocity states without position, and sections of no controller."""
    if PARAMETERS not in source.text:
        return
    controllers = declared(source)
    unset = [one for one in controllers if one.settings is None and one.kind.text in _NEEDS]
    if unset:
        yield from _renamed(source, unset, {one.name for one in controllers}, model)
    for one in controllers:
        states = one.settings.find("state_interfaces") if one.settings is not None else None
        if states is not None and one.kind.text == "joint_trajectory_controller/JointTrajectoryController":
            names = states.texts()
            lacking = next((need for name, need in _NEEDED_STATES if name in names and need not in names), None)
            if lacking is not None:
                yield states.items[0] if states.items else states, f"`state_interfaces` has no `{lacking}`"


_NEEDED_STATES = (("velocity", "position"), ("acceleration", "velocity"))


def _renamed(
    source: Source, unset: list[DeclaredController], controllers: set[str], model: Model
) -> Iterator[tuple[Node, str]]:
    """Yield sections with the parameters of a controller that has no section, if they belong to no other node."""
    others = [text.text for file, text in model.related_files.items() if not file.endswith((".yaml", ".yml"))]
    started = {word for text in others for word in re.findall(r"(?<=[\"'\s])[\w/-]+(?=[\"'\s])", text)}
    elsewhere = {
        name
        for other in yamls(model)
        if other is not source
        for name in re.findall(r"(?m)^\s*[\"']?/?([\w-]+)[\"']?:", other.text)
    }
    entries = (entry for node in nodes(source) for entry in node.entries)
    sections = [
        (key, group)
        for key, value in entries
        if (group := value.find(PARAMETERS)) is not None and key.text not in controllers and key.text not in started
    ]
    by_kind = {
        kind: [key for key, group in sections if all(group.find(name) is not None for name in names)]
        for kind, names in _NEEDS.items()
    }
    for one in unset:
        for key in by_kind[one.kind.text][:1] if one.name not in elsewhere else ():
            message = f"no controller has the name `{key.text}`, and controller `{one.name}` has no section; rename one"
            yield key, message
