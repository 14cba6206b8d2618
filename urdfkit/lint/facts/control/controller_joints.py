"""Controllers in YAML: which there are, and the joints they name, with their places. Reads lines, not all of YAML."""

from __future__ import annotations

import re

from urdfkit.lint.facts.control.launch_files import uncommented
from urdfkit.record import record

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.description.xml.source import Source

_TYPE = r"(?m)^([ \t]*)type[ \t]*:[ \t]*[\"']?\w*(?:_controllers?|_broadcaster)/\w+[\"']?[ \t]*\r?$"
_IN_BRACES = (
    r"(?m)^[ \t]*[\"']?([\w/-]+)[\"']?[ \t]*:[ \t]*\{[^{}\n]*\btype[ \t]*:[ \t]*[\"']?"
    r"\w*(?:_controllers?|_broadcaster)/\w+"
)
_JOINTS = r"(?m)^([ \t]*)(joints?|(?:left|right)_wheel(?:_names)?)[ \t]*:[ \t]*"
_ITEM = r"[ \t]*-[ \t]+([\"']?)([\w./-]+)\1[ \t]*\r?$"
_ANCHOR = r"(?<=[:-][ \t])([ \t]*)(&[\w.-]+)(?=[ \t\r\n])"
_WORD = r"([\"']?)([\w./-]+)\1"

_OF_JOINTS = ("JointPositionController", "JointVelocityController", "JointEffortController")
_OF_GROUPS = ("JointGroupPositionController", "JointGroupVelocityController", "JointGroupEffortController")
TYPES = (
    *(
        f"{kind}_controllers/{name}"
        for kind in ("position", "velocity", "effort")
        for name in (*_OF_JOINTS, *_OF_GROUPS, "JointTrajectoryController", "GripperActionController")
    ),
    "pos_vel_controllers/JointTrajectoryController",
    "pos_vel_acc_controllers/JointTrajectoryController",
    "joint_state_controller/JointStateController",
    "joint_state_broadcaster/JointStateBroadcaster",
    "joint_trajectory_controller/JointTrajectoryController",
    "forward_command_controller/ForwardCommandController",
    "forward_command_controller/MultiInterfaceForwardCommandController",
    "diff_drive_controller/DiffDriveController",
    "ackermann_steering_controller/AckermannSteeringController",
    "bicycle_steering_controller/BicycleSteeringController",
    "tricycle_steering_controller/TricycleSteeringController",
    "tricycle_controller/TricycleController",
    "four_wheel_steering_controller/FourWheelSteeringController",
    "mecanum_drive_controller/MecanumDriveController",
    "admittance_controller/AdmittanceController",
    "pid_controller/PidController",
    "gpio_controllers/GpioCommandController",
    "gripper_controllers/GripperActionController",
    "parallel_gripper_action_controller/GripperActionController",
    "imu_sensor_controller/ImuSensorController",
    "imu_sensor_broadcaster/IMUSensorBroadcaster",
    "force_torque_sensor_controller/ForceTorqueSensorController",
    "force_torque_sensor_broadcaster/ForceTorqueSensorBroadcaster",
    "range_sensor_broadcaster/RangeSensorBroadcaster",
)
"""The types of ros_controllers (Noetic) and ros2_controllers (Rolling)."""

_WRITTEN_TYPE = r"(?m)(?:^|[{,])[ \t]*type[ \t]*:[ \t]*[\"']?([\w]+/[\w]+)[\"']?[ \t]*(?=\r?$|[},])"


@record
class Named:
    """A name in YAML, and the offset of its first letter."""

    name: str
    start: int


def typed(source: Source) -> Iterator[Named]:
    """Yield the plugin types in a YAML file: ``package/Class``."""
    for at in re.finditer(_WRITTEN_TYPE, uncommented(source)):
        yield Named(at[1], at.start(1))


def controllers(source: Source) -> list[str]:
    """Return the names of the controllers that a YAML file gives a type."""
    text = uncommented(source)
    found = [at[1].strip("/").rpartition("/")[2] for at in re.finditer(_IN_BRACES, text)]
    for at in re.finditer(_TYPE, text):
        indent = len(at[1])
        for line in reversed(
            text[: at.start()].splitlines()
        ):  # the nearest line that stands further left, and names it
            key = re.match(r"([ \t]*)[\"']?([\w/-]+)[\"']?[ \t]*:[ \t]*$", line)
            if key is None or len(key[1]) >= indent:
                continue
            if key[2] != "ros__parameters":
                found.append(key[2].strip("/").rpartition("/")[2])
                break
            indent = len(key[1])
    return found


def joints(source: Source) -> Iterator[Named]:
    """Yield the joints that controllers name in a YAML file, where it has any controllers."""
    text = uncommented(source)
    if not re.search(_TYPE, text) and not re.search(_IN_BRACES, text):
        return
    if "&" in text:
        text = re.sub(_ANCHOR, lambda at: at[1] + " " * len(at[2]), text)
    for at in re.finditer(_JOINTS, text):
        rest = text[at.end() : text.find("\n", at.end()) + 1 or len(text)]
        if rest.startswith("["):
            end = text.find("]", at.end())
            inside = text[at.end() + 1 : end] if end != -1 else ""
            for word in re.finditer(rf"(?<![^\s,]){_WORD}(?=\s*(?:,|$))", inside):
                yield Named(word[2], at.end() + 1 + word.start(2))
        elif not rest.strip():
            yield from _listed(text, at.end() + len(rest), len(at[1]))
        elif (only := re.fullmatch(rf"{_WORD}\s*", rest)) is not None:
            yield Named(only[2], at.end() + only.start(2))


def _listed(text: str, start: int, indent: int) -> Iterator[Named]:
    """Yield the items of a block list that begins at `start`, below a key that stands `indent` far in."""
    while start < len(text):
        end = text.find("\n", start) + 1 or len(text)
        line = text[start:end].rstrip("\n")
        item = re.match(_ITEM, line)
        if line.strip() and (item is None or len(line) - len(line.lstrip()) < indent):
            return
        if item is not None:
            yield Named(item[2], start + item.start(2))
        start = end


def joints_of(source: Source, kind: Named) -> list[str]:
    """Return the joints that stand in the same block as the type of a controller, as `typed` returns it.

    Of a block in braces none are known.
    """
    text = uncommented(source)
    line = text.rfind("\n", 0, kind.start) + 1
    if "{" in text[line : kind.start]:
        return []
    indent = len(text[line:]) - len(text[line:].lstrip(" "))

    def is_inside(row: str) -> bool:
        return not row.strip() or len(row) - len(row.lstrip(" ")) >= indent

    before, after = text[:line].splitlines(keepends=True), text[line:].splitlines(keepends=True)
    above = next((number for number, row in enumerate(reversed(before)) if not is_inside(row)), len(before))
    below = next((number for number, row in enumerate(after) if not is_inside(row)), len(after))
    start = line - sum(len(row) for row in before[len(before) - above :])
    end = line + sum(len(row) for row in after[:below])
    return [named.name for named in joints(source) if start <= named.start < end]
