"""Mistakes in YAML: controllers, MoveIt's files and the bridge of Gazebo."""

from __future__ import annotations

import math
import random
import re
from collections.abc import Iterator

from tests.bench.package_mutants.mutant import Mutant, Workspace, kind, match, typo

_YAML = kind("YAML")
_FILES = r"/config/[\w.]+\.yaml$"
_LIST = (
    r"(?m)^ *(?:- )?((?:joints|command_interfaces|state_interfaces|controller_names|left_wheel_names|planner_configs):"
    r"( *\[([\w\", ]+)\]|((?:\n +- \w+)+)))"
)
Mutants = Iterator[Mutant]


def _pairs(ws: Workspace, *keys: str) -> Iterator[tuple[str, re.Match[str]]]:
    """Yield the lines `KEY: VALUE`: indentation is group 1, the key group 3, the value group 4."""
    for file, text in ws.of(_FILES):
        for found in re.finditer(r"(?m)^( *)(- )?([\w./]+): *([^\n#]*?)[ ]*(?:#.*)?$", text):
            if not keys or found[3] in keys:
                yield file, found


def _in(text: str, at: int) -> tuple[int, int]:
    """Return the block of the key above, as offsets."""
    line = text.rfind("\n", 0, at) + 1
    indent = len(text[line:]) - len(text[line:].lstrip(" "))
    above = line
    for found in re.finditer(r"(?m)^( *)[^\s#][^\n]*$", text[:line]):
        if len(found[1]) < indent:
            above = found.start()
    end = len(text)
    for found in re.compile(r"(?m)^( *)[^\s#][^\n]*$").finditer(
        text, min(text.find("\n", at) % (len(text) + 1), len(text))
    ):
        if len(found[1]) < indent:
            end = found.start()
            break
    return above, end


def _value(ws: Workspace, file: str, found: re.Match[str], new: str, **more: object) -> Mutant:
    return match(file, found, new, 4, around=_in(ws.files[file], found.start(3)), **more)


def _key(ws: Workspace, file: str, found: re.Match[str], new: str, **more: object) -> Mutant:
    around = _in(ws.files[file], found.start(3))
    return match(file, found, new, 3, around=around, names=(new, found[3]), **more)


def _block_end(text: str, found: re.Match[str]) -> int:
    """Return the offset of the line after the block that a key begins."""
    at = text.find("\n", found.end()) + 1 or len(text)
    while at < len(text):
        line = text[at : text.find("\n", at) % (len(text) + 1)]
        inside = len(line) - len(line.lstrip(" ")) > len(found[1]) or (
            line.startswith(f"{found[1]}- ") and not found[2]
        )
        if line.strip() and not inside:
            break
        at += len(line) + 1
    return min(at, len(text))


def _without(ws: Workspace, file: str, found: re.Match[str], **more: object) -> Mutant:
    """Remove a key with its block; it is missing in the block above."""
    text = ws.files[file]
    above = _in(text, found.start(3))
    first = (above[0], text.find("\n", above[0]))
    return Mutant(file, found.start(), _block_end(text, found), "", first, above, **more)  # type: ignore[arg-type]


def _joints(ws: Workspace) -> Iterator[tuple[str, re.Match[str], int]]:
    """Yield the places where a YAML file names a joint, and the group of the name."""
    for file, text in ws.of(_FILES):
        for found in re.finditer(r"[A-Za-z_]\w*", text):
            if found[0] in ws.joints:
                yield file, found, 0


@_YAML
def unknown_joint(ws: Workspace, lot: random.Random) -> Mutants:
    """The controller or MoveIt does not find the joint."""
    for file, found, group in _joints(ws):
        wrong = typo(found[group], lot, ws.joints)
        yield match(file, found, wrong, group, names=(wrong,), around=_in(ws.files[file], found.start()))


@_YAML
def controller_type_misspelt(ws: Workspace, lot: random.Random) -> Mutants:
    """The controller manager does not load the class."""
    for file, found in _pairs(ws, "type", "joint_state_broadcaster", "arm_controller", "gripper_controller"):
        cls = re.search(r"(\w+)/(\w+)", found[4])
        if cls is not None:
            space, name = cls.groups()
            wrong = lot.choice([f"{space}/{typo(name, lot)}", f"{typo(space, lot)}/{name}", name, f"{space}::{name}"])
            yield _value(ws, file, found, found[4].replace(cls[0], wrong), names=(wrong, cls[0]))


@_YAML
def controller_type_missing(ws: Workspace, lot: random.Random) -> Mutants:
    """A controller without a type is not loaded."""
    for file, found in _pairs(ws, "type"):
        if "controller" in found[4] or "broadcaster" in found[4]:
            yield _without(ws, file, found)


@_YAML
def controller_section_renamed(ws: Workspace, lot: random.Random) -> Mutants:
    """The controller has no parameters under its own name, or the spawner does not find it."""
    taken = {found[3] for _, found in _pairs(ws)}
    for file, found in _pairs(ws):
        if found[3].endswith(("_controller", "_broadcaster")) and not found[4]:
            wrong = typo(found[3], lot, taken)
            yield _key(ws, file, found, wrong, uses=True)


@_YAML
def parameter_misspelt(ws: Workspace, lot: random.Random) -> Mutants:
    """The parameter is not read; a required one is missing."""
    names = (
        "update_rate", "publish_rate", "joints", "joint", "command_interfaces", "state_interfaces", "constraints",
        "gains",
        "left_wheel_names", "right_wheel_names", "wheel_separation", "wheel_radius", "base_frame_id", "odom_frame_id",
        "stopped_velocity_tolerance", "goal_time", "allow_partial_joints_goal", "cmd_vel_timeout", "goal_tolerance",
        "velocity_ff", "state_publish_rate", "open_loop",
    )  # fmt: skip
    for file, found in _pairs(ws, *names):
        yield _key(ws, file, found, typo(found[3], lot).replace("-", ""))


@_YAML
def moveit_parameter_misspelt(ws: Workspace, lot: random.Random) -> Mutants:
    """MoveIt does not read the value."""
    names = (
        "kinematics_solver", "kinematics_solver_timeout", "kinematics_solver_search_resolution", "max_velocity",
        "has_velocity_limits", "max_acceleration", "has_acceleration_limits", "min_position", "max_position",
        "joint_limits", "controller_list", "controller_names", "action_ns", "planner_configs",
        "default_velocity_scaling_factor", "moveit_simple_controller_manager", "moveit_controller_manager",
        "projection_evaluator", "planning_plugins",
    )  # fmt: skip
    for file, found in _pairs(ws, *names):
        yield _key(ws, file, found, typo(found[3], lot).replace("-", ""))


@_YAML
def interface_misspelt(ws: Workspace, lot: random.Random) -> Mutants:
    """The hardware does not offer the interface."""
    for file, text in ws.of(r"controllers\.yaml$"):
        for block in re.finditer(r"(?:command|state)_interfaces:(?: *\[[^\]]*\]|(?:\n +- \w+)+)", text):
            for found in re.finditer(r"\b(position|velocity|effort)\b", block[0]):
                start = block.start() + found.start()
                wrong = lot.choice([typo(found[0], lot), "torque", "pos"])
                around = (block.start(), block.end())
                yield Mutant(file, start, start + len(found[0]), wrong, None, around, (wrong,))


@_YAML
def interface_without_hardware(ws: Workspace, lot: random.Random) -> Mutants:
    """The controller needs an interface that the joints do not have."""
    for file, text in ws.of(r"controllers\.yaml$"):
        for found in re.finditer(r"command_interfaces:\s*(?:\[|- )(\w+)", text):
            wrong = "effort"
            yield match(file, found, wrong, 1, names=(wrong,), around=(found.start(), found.end()))
    if ws.ros == 1:
        for file, found in _pairs(ws, "type"):
            if "JointTrajectoryController" in found[4] and "velocity_" in found[4] + "velocity_":
                wrong = "position_controllers/JointTrajectoryController"
                yield _value(ws, file, found, wrong, names=(wrong,), uses=True)


@_YAML
def tab(ws: Workspace, lot: random.Random) -> Mutants:
    """YAML forbids tabs."""
    for file, found in _pairs(ws):
        if len(found[1]) >= 2:
            yield match(file, found, "\t", 1)


@_YAML
def space_after_colon_missing(ws: Workspace, lot: random.Random) -> Mutants:
    """The line is a string, not a key with a value."""
    for file, found in _pairs(ws):
        if found[4] and not found[4].startswith(("[", "{", '"')):
            text = ws.files[file]
            colon = text.index(":", found.end(3))
            yield Mutant(file, colon, found.start(4), ":", None, _in(text, found.start(3)), (found[3],))


@_YAML
def colon_missing(ws: Workspace, lot: random.Random) -> Mutants:
    """The block has no key."""
    for file, found in _pairs(ws):
        text = ws.files[file]
        colon = text.index(":", found.end(3))
        end = text.find("\n", text.find("\n", colon) + 1)
        yield Mutant(file, colon, colon + 1, "", (found.start(3), max(end, colon)), _in(text, found.start(3)))


@_YAML
def wrong_indentation(ws: Workspace, lot: random.Random) -> Mutants:
    """A key belongs to another block than it should."""
    for file, found in _pairs(ws):
        text = ws.files[file]
        first = text.find("\n", found.end()) + 1
        if len(found[1]) >= 2 and not found[2] and found[3] not in ws.joints:
            end = _block_end(text, found)
            block = text[found.start() : end]
            less = re.sub(r"(?m)^  ", "", block) if lot.random() < 0.5 else re.sub(r"(?m)^(?=[^\n])", "  ", block)
            around = _in(text, found.start(3))
            yield Mutant(file, found.start(), end, less, (around[0], max(first, found.end())), around, (found[3],))


@_YAML
def ros_parameters_level(ws: Workspace, lot: random.Random) -> Mutants:
    """The node does not get the parameters: the level ros__parameters is missing or misspelt."""
    for file, found in _pairs(ws, "ros__parameters"):
        text = ws.files[file]
        for wrong in ("ros_parameters", "ros__parameter", "ros__paramters"):
            yield _key(ws, file, found, wrong)
        end = _block_end(text, found)
        inner = text[text.find("\n", found.start()) + 1 : end]
        above = _in(text, found.start(3))
        yield Mutant(file, found.start(), end, re.sub(r"(?m)^  ", "", inner), (above[0], above[0] + 1), above)


@_YAML
def text_for_a_number(ws: Workspace, lot: random.Random) -> Mutants:
    """A quoted number, a unit or a list is no number: the node refuses the parameter."""
    for file, found in _pairs(ws):
        if re.fullmatch(r"-?\d+(\.\d+)?", found[4]) and not found[3].startswith("default_"):
            yield _value(ws, file, found, lot.choice([f'"{found[4]}"', f"[{found[4]}]", f"{found[4]} Hz", "fast"]))


@_YAML
def text_for_a_list(ws: Workspace, lot: random.Random) -> Mutants:
    """A list of names is required."""
    for file, text in ws.of(_FILES):
        for found in re.finditer(_LIST, text):
            names = re.findall(r"\w+", found[3] or found[4].replace("- ", ""))
            new = lot.choice([f" {names[0]}", f" {', '.join(names)}"]) if len(names) > 1 else f" {names[0]}"
            yield Mutant(
                file, found.start(2), found.end(2), new, (found.start(1), found.end(1)), _in(text, found.start(1))
            )


@_YAML
def text_for_a_truth(ws: Workspace, lot: random.Random) -> Mutants:
    """A quoted or misspelt truth value is a string."""
    for file, found in _pairs(ws):
        if found[4] in ("true", "false"):
            yield _value(
                ws, file, found, lot.choice([f'"{found[4]}"', found[4][:-1], "1" if found[4] == "true" else "0"])
            )


@_YAML
def negative_or_zero(ws: Workspace, lot: random.Random) -> Mutants:
    """A rate, a size or a limit below 0, or 0."""
    names = (
        "update_rate", "publish_rate", "wheel_separation", "wheel_radius", "max_velocity", "max_acceleration",
        "kinematics_solver_timeout", "kinematics_solver_search_resolution", "state_publish_rate", "action_monitor_rate",
    )  # fmt: skip
    for file, found in _pairs(ws, *names):
        yield _value(ws, file, found, lot.choice([f"-{found[4]}", f"-{found[4]}", "0"]))


@_YAML
def duplicated_key(ws: Workspace, lot: random.Random) -> Mutants:
    """Of two equal keys one is lost."""
    for file, found in _pairs(ws):
        text = ws.files[file]
        if not found[2] and len(found[1]) >= 2:
            end = _block_end(text, found)
            block = text[found.start() : end]
            changed = re.sub(r"\d\.?\d*", lambda number: f"{number[0]}1", block, count=1)
            if changed != block:
                yield Mutant(
                    file, end, end, changed, (found.start(), found.end()), _in(text, found.start(3)), (found[3],)
                )


@_YAML
def joint_listed_twice(ws: Workspace, lot: random.Random) -> Mutants:
    """The controller claims an interface twice."""
    for file, text in ws.of(_FILES):
        for found in re.finditer(r"(?m)^ +- (\w+)\n +- (\w+)$", text):
            if found[1] in ws.joints and found[2] in ws.joints:
                yield match(file, found, found[1], 2, names=(found[1],), around=_in(text, found.start(2)))


@_YAML
def joint_of_list_missing(ws: Workspace, lot: random.Random) -> Mutants:
    """MoveIt plans for a joint that no controller moves."""
    for file, text in ws.of(r"_moveit_config/config/\w*controllers\.yaml$"):
        for found in re.finditer(r"(?m)^ +- (\w+)\n(?= +- )", text):
            if found[1] in ws.joints:
                first = text.rfind("joints:", 0, found.start())
                yield match(file, found, "", also=(first, found.start()), around=_in(text, first), names=(found[1],))


@_YAML
def limits_swapped(ws: Workspace, lot: random.Random) -> Mutants:
    """The least value is above the greatest."""
    for file, text in ws.of(_FILES):
        for found in re.finditer(r"min_position: (\S+)\n( +)max_position: (\S+)", text):
            new = f"min_position: {found[3]}\n{found[2]}max_position: {found[1]}"
            yield match(file, found, new, around=_in(text, found.start()))
        for found in re.finditer(r"(\S+)\.max_velocity: (\S+)\n( +)\S+\.min_velocity: (\S+)", text):
            new = f"{found[1]}.max_velocity: {found[4]}\n{found[3]}{found[1]}.min_velocity: {found[2]}"
            yield match(file, found, new, around=(found.start(), found.end()))


@_YAML
def limit_in_degrees(ws: Workspace, lot: random.Random) -> Mutants:
    """MoveIt uses limits that are far above those of the description."""
    for file, found in _pairs(ws, "max_velocity", "min_position", "max_position"):
        if re.fullmatch(r"-?\d+(\.\d+)?", found[4]) and abs(float(found[4])) > 0.5:
            yield _value(ws, file, found, f"{math.degrees(float(found[4])):.1f}")


@_YAML
def limit_without_value(ws: Workspace, lot: random.Random) -> Mutants:
    """MoveIt stops or ignores the limit: it has no value."""
    for file, found in _pairs(ws, "max_velocity", "max_acceleration", "min_position", "max_position"):
        yield _without(ws, file, found)


@_YAML
def length_in_millimetres(ws: Workspace, lot: random.Random) -> Mutants:
    """Odometry is a thousand times too large."""
    for file, found in _pairs(ws, "wheel_separation", "wheel_radius", "goal_tolerance"):
        yield _value(ws, file, found, f"{1000 * float(found[4]):g}")


@_YAML
def wheel_size(ws: Workspace, lot: random.Random) -> Mutants:
    """Odometry is wrong: the diameter for the radius, or the distance of another robot."""
    for file, found in _pairs(ws, "wheel_separation", "wheel_radius"):
        yield _value(ws, file, found, f"{lot.choice([0.5, 2, 3]) * float(found[4]):g}")


@_YAML
def wheels_swapped(ws: Workspace, lot: random.Random) -> Mutants:
    """The robot turns the wrong way."""
    for file, found in _pairs(ws, "left_wheel_names", "right_wheel_names"):
        side, other = ("left", "right") if "left" in found[3] else ("right", "left")
        yield _value(ws, file, found, found[4].replace(side, other), names=(f"{other}_wheel_joint",))


@_YAML
def unknown_frame(ws: Workspace, lot: random.Random) -> Mutants:
    """Odometry is published for a frame that the robot does not have."""
    for file, found in _pairs(ws, "base_frame_id"):
        for _ in range(3):
            wrong = typo(found[4], lot, ws.links)
            yield _value(ws, file, found, wrong, names=(wrong,))


@_YAML
def required_parameter_missing(ws: Workspace, lot: random.Random) -> Mutants:
    """The controller, MoveIt or the bridge refuses the configuration."""
    names = (
        "joints", "joint", "command_interfaces", "left_wheel_names", "right_wheel_names", "kinematics_solver",
        "action_ns", "controller_names", "ros_topic_name", "ros_type_name", "gz_type_name", "update_rate", "name",
        "gains", "moveit_controller_manager",
    )  # fmt: skip
    for file, found in _pairs(ws, *names):
        if file.endswith("ompl_planning.yaml") or (found[3] == "update_rate" and "bridge" in file):
            continue
        if found[2]:
            text = ws.files[file]
            end = text.find("\n", found.end()) + 1
            after = text[end:].lstrip(" ")
            new = f"{found[1]}- "
            block = (found.start(), min(end + 200, len(text)))
            yield Mutant(file, found.start(), len(text) - len(after), new, None, block, ())
        else:
            yield _without(ws, file, found)


@_YAML
def unknown_group(ws: Workspace, lot: random.Random) -> Mutants:
    """MoveIt has no solver or no planner for the group."""
    for file, text in ws.of(r"/(kinematics|ompl_planning)\.yaml$"):
        for found in re.finditer(r"(?m)^(arm|gripper|manipulator)(?=:)", text):
            wrong = lot.choice([typo(found[0], lot), f"{found[0]}_group"])
            yield match(file, found, wrong, names=(wrong,), uses=True)


@_YAML
def solver_or_planner_misspelt(ws: Workspace, lot: random.Random) -> Mutants:
    """The plugin is not loaded."""
    names = ("kinematics_solver", "type", "moveit_controller_manager", "default_planner_config", "action_ns")
    for file, found in _pairs(ws, *names):
        if "_moveit_config/" in file and found[4]:
            wrong = found[4].replace(word := lot.choice(re.findall(r"[A-Za-z]\w+", found[4])), typo(word, lot))
            yield _value(ws, file, found, wrong, names=(wrong, found[4]))
    for file, text in ws.of(r"/ompl_planning\.yaml$"):
        for found in re.finditer(r"(?m)^ +- ([\w/]+)$", text):
            wrong = typo(found[1], lot)
            yield match(file, found, wrong, 1, names=(wrong,))


@_YAML
def unknown_controller(ws: Workspace, lot: random.Random) -> Mutants:
    """MoveIt waits for the action of a controller that is not started."""
    for file, text in ws.of(r"_moveit_config/config/\w*controllers\.yaml$"):
        for found in re.finditer(r"(?m)^ +- (?:name: )?([\w/]*_controller)$|^  (\w+_controller)(?=:)", text):
            group = 1 if found[1] else 2
            wrong = typo(found[group], lot)
            if "/" in found[group] and lot.random() < 0.5:
                wrong = found[group].partition("/")[2]
            yield match(file, found, wrong, group, names=(wrong,), uses=True)


@_YAML
def wrong_namespace(ws: Workspace, lot: random.Random) -> Mutants:
    """The spawner expects the controllers in another namespace."""
    for file, text in ws.of(r"controllers\.yaml$"):
        for found in re.finditer(r"(?m)^(titan|picker|scout)(?=:)", text):
            for wrong in (typo(found[0], lot), f"{found[0]}_arm", "robot"):
                yield match(file, found, wrong, names=(wrong, found[0]), uses=True)


@_YAML
def bridge_misspelt(ws: Workspace, lot: random.Random) -> Mutants:
    """The bridge refuses the type or the direction."""
    for file, found in _pairs(ws, "ros_type_name", "gz_type_name", "direction"):
        if found[3] == "direction":
            wrong = lot.choice(["GZ_TO_ROS2", "gz_to_ros", "ROS2_TO_GZ", "BOTH"])
        else:
            last = re.split(r"[/.]", found[4])[-1]
            wrong = found[4].replace(last, typo(last, lot)) if lot.random() < 0.6 else found[4].replace("msg", "mgs")
        yield _value(ws, file, found, wrong, names=(wrong,))


@_YAML
def bridge_of_other_types(ws: Workspace, lot: random.Random) -> Mutants:
    """The bridge cannot convert between these two types."""
    for file, found in _pairs(ws, "ros_type_name"):
        wrong = lot.choice(["sensor_msgs/msg/PointCloud2", "std_msgs/msg/String", "geometry_msgs/msg/TwistStamped"])
        yield _value(ws, file, found, wrong, names=(wrong,))


@_YAML
def negative_gain(ws: Workspace, lot: random.Random) -> Mutants:
    """The controller pushes the joint away from its goal."""
    for file, text in ws.of(r"controllers\.yaml$"):
        for found in re.finditer(r"\bp: (\d+\.\d+)", text):
            yield match(file, found, f"-{found[1]}", 1, around=_in(text, found.start()))


@_YAML
def bracket_missing(ws: Workspace, lot: random.Random) -> Mutants:
    """The file is no YAML: a bracket or a quote is not closed."""
    for file, found in _pairs(ws):
        if found[4].endswith(("]", "}", '"')) or re.fullmatch(r"[A-Za-z_/]+", found[4]):
            new = found[4][:-1] if found[4].endswith(("]", "}", '"')) else f'"{found[4]}'
            text = ws.files[file]
            yield match(file, found, new, 4, around=(found.start(), len(text)))
