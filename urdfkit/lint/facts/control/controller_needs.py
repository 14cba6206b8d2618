"""What controllers of ROS 2 need: combinations of interfaces, and a section of parameters.

Source: ros2_controllers, *_parameters.yaml and joint_trajectory_controller (Humble to Rolling).
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.ros2_controllers import PARAMETERS, declared
from urdfkit.lint.facts.control.yaml_tree import Node, documents, walk, yamls
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
    for one in controllers:
        kind, group = one.kind.text, one.settings
        if group is None:
            yield from _renamed(source, one.name, kind, {each.name for each in controllers}, model)
            continue
        states = group.find("state_interfaces")
        if states is not None and kind == "joint_trajectory_controller/JointTrajectoryController":
            names = states.texts()
            lacking = next((need for name, need in _NEEDED_STATES if name in names and need not in names), None)
            if lacking is not None:
                yield states.items[0] if states.items else states, f"`state_interfaces` has no `{lacking}`"


_NEEDED_STATES = (("velocity", "position"), ("acceleration", "velocity"))


def _renamed(source: Source, name: str, kind: str, controllers: set[str], model: Model) -> Iterator[tuple[Node, str]]:
    """Yield the section with the parameters of a controller that has no section, if it belongs to no other node."""
    needs = _NEEDS.get(kind)
    texts = [text.text for file, text in model.related_files.items() if not file.endswith((".yaml", ".yml"))]
    others = [other for other in yamls(model) if other is not source]
    if needs is None or any(re.search(rf"(?m)^\s*[\"']?/?{re.escape(name)}[\"']?:", other.text) for other in others):
        return
    for root in documents(source)[0]:
        for key, value in (entry for node in walk(root) for entry in node.entries):
            group = value.find(PARAMETERS)
            is_started = any(re.search(rf"[\"'\s]{re.escape(key.text)}[\"'\s]", text) for text in texts)
            if group is None or key.text in controllers or is_started or not _has(group, needs):
                continue
            yield key, f"no controller has the name `{key.text}`, and controller `{name}` has no section; rename one"


def _has(group: Node, names: tuple[str, ...]) -> bool:
    return all(group.find(name) is not None for name in names)
