"""Arguments of static_transform_publisher: their number, their order, the rotation and the frames.

Sources: tf and tf2_ros of Noetic (static_transform_publisher.cpp), tf2_ros of Humble to Rolling
(static_transform_broadcaster_program.cpp).
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator

from urdfkit.defect_message import Suggestion
from urdfkit.description.xml.numbers import number
from urdfkit.lint.facts.control.controller_joints import Named
from urdfkit.lint.facts.control.launch_package_paths import uncommented
from urdfkit.lint.facts.control.launched_nodes import launches, started
from urdfkit.lint.facts.moveit.srdf import semantics_of
from urdfkit.lint.facts.ros_packages import is_slip
from urdfkit.lint.fix_builders import nearest

TYPE_CHECKING = False
if TYPE_CHECKING:
    from urdfkit.description.xml.source import Source
    from urdfkit.lint.model.model import Model

    Words = tuple[Named, ...]

_FRAMES = ("--frame-id", "--child-frame-id")
_ANGLES = ("--roll", "--pitch", "--yaw")
_QUATERNION = ("--qx", "--qy", "--qz", "--qw")
_NUMBERS = ("--x", "--y", "--z", *_QUATERNION, *_ANGLES)
_OF_OTHERS = r"map|odom|world|earth|utm|base|cam|imu|laser|lidar|scan|gps|gnss|rtk|marker|tag|vicon|mocap|optitrack|/"
"""Matches frames that nodes outside of the packages may publish."""

_FIXED = r"map|world|earth|utm"
"""Matches frames below which robots move."""

_PLACING = (
    r"\b(?:amcl|cartographer_ros|gmapping|hector_mapping|nav2_(?:amcl|bringup)|robot_localization|slam_toolbox)\b"
)
"""Matches a package in launch files whose nodes place the root of the robot below another frame."""

_MAX_ANGLE = 2.0 * math.pi + 0.01
_MAX_ERROR = 0.05
"""Difference of the length of a quaternion from 1; tf2 rounds the length of 0.7071 0 0 0.7071."""


def static_transform_defects(model: Model) -> Iterator[tuple[Source, Named, str]]:
    """Yield the launch file, the word and the message of each wrong argument."""
    for source in launches(model):
        for node in started(source):
            if node.program != "static_transform_publisher" or node.package not in ("tf", "tf2_ros"):
                continue
            names = [word.name if word is not None else "" for word in node.arguments]
            arguments = node.arguments[: names.index("--ros-args")] if "--ros-args" in names else node.arguments
            words = tuple(word for word in arguments if word is not None)
            if any(word.name.startswith("--") for word in words):
                yield from ((source, *defect) for defect in _of_options(arguments, model))
            elif len(words) == len(arguments) > 1:  # one is the name of a parameter
                yield from ((source, *defect) for defect in _of_words(words, node.package == "tf", model))


def _of_options(arguments: tuple[Named | None, ...], model: Model) -> Iterator[tuple[Named, str]]:
    """Yield the defects of arguments such as ``--x 0.1 --frame-id base_link --child-frame-id laser``."""
    options = [(at, word) for at, word in enumerate(arguments) if word is not None and word.name.startswith("--")]
    written = {word.name for _, word in options}
    values: dict[str, Named | None] = {}
    for at, word in options:
        if word.name not in (*_FRAMES, *_NUMBERS):
            near = nearest(word.name, [each for each in (*_FRAMES, *_NUMBERS) if each not in written], cutoff=0.8)
            yield word, f"unknown option `{word.name}`" + Suggestion(near, word.name)
            return
        values[word.name] = arguments[at + 1] if at + 1 < len(arguments) else None
    missing = [name for name in _FRAMES if name not in values]
    if missing:
        yield options[0][1], f"`{missing[0]}` is missing"
        return
    mixed = (
        [word for _, word in options if word.name in _ANGLES],
        [word for _, word in options if word.name in _QUATERNION],
    )
    if all(mixed):
        message = "the rotation is written as Euler angles and as a quaternion; remove one of the two"
        yield max((each[0] for each in mixed), key=lambda word: word.start), message
        return
    angles = [values.get(name) for name in _ANGLES]
    yield from _angles(tuple(angle for angle in angles if angle is not None))
    yield from _frames(values["--frame-id"], values["--child-frame-id"], model)


def _of_words(words: Words, has_period: bool, model: Model) -> Iterator[tuple[Named, str]]:
    """Yield the defects of arguments in a fixed order: ``x y z yaw pitch roll frame child``."""
    count = next((at for at, word in enumerate(words) if number(word.name) is None), len(words))
    frames = words[count:]
    last = words[-1]
    if count not in (6, 7):
        yield words[min(count, len(words) - 1)], f"expected 6 or 7 numbers before the frames, found {count}"
    elif len(frames) < 2:
        yield last, "the child frame is missing after the parent frame" if frames else "both frames are missing"
    elif has_period and len(frames) == 2:
        yield last, "the period in milliseconds is missing after the frames"
    elif len(frames) > 2 + has_period:
        is_period = len(frames) == 3 and number(last.name) is not None
        yield last, f"tf2_ros has no argument for a period; remove {last.name}" if is_period else "too many arguments"
    else:
        yield from _quaternion(words[3:7]) if count == 7 else _angles(words[3:6])
        yield from _frames(frames[0], frames[1], model)


def _angles(words: Words) -> Iterator[tuple[Named, str]]:
    for word in words:
        value = number(word.name)
        if value is not None and abs(value) > _MAX_ANGLE:
            yield (
                word,
                f"angle {value:g} rad is more than one full turn; write {math.radians(value):.6g} if it is in degrees",
            )
            return


def _quaternion(words: Words) -> Iterator[tuple[Named, str]]:
    values = [number(word.name) or 0.0 for word in words]
    length = math.hypot(*values)
    if abs(length - 1.0) > _MAX_ERROR:
        shown = " ".join(word.name for word in words)
        yield words[0], f"quaternion {shown} has the length {length:.4g} instead of 1"


def _frames(parent: Named | None, child: Named | None, model: Model) -> Iterator[tuple[Named, str]]:
    """Yield the misspelt frames, and a child that already has a parent in the robot."""
    links = model.robot.link_by_name
    names = [word.name.strip("/") if word is not None else "" for word in (parent, child)]
    if parent is not None and names[0] and names[0] == names[1]:
        yield parent, f"frame `{names[0]}` is its own parent"
        return
    if child is not None and any(
        (names[0], names[1]) == (joint.get("child_link"), joint.get("parent_frame"))
        for root in semantics_of(model)
        for joint in root.find_all("virtual_joint")
    ):
        yield child, f"the virtual joint of the SRDF puts `{names[0]}` below `{names[1]}`; swap the frames"
        return
    roots = model.robot.root_by_name
    is_reversed = names[0] in roots and re.fullmatch(_FIXED, names[1]) and not re.search(_FIXED, names[0])
    if child is not None and is_reversed and _is_placed(names[0], model):
        message = f"`{names[1]}` cannot be below `{names[0]}`, the root of robot `{model.robot.name}`; swap the frames"
        yield child, message
        return
    if parent is not None and names[0] and not _is_defined(parent, names[0], model):
        near = _meant(names[0], links)
        is_separate = child is not None and names[1] not in links and not re.search(_OF_OTHERS, names[0])
        if near is not None or (is_separate and not model.is_incomplete):
            yield parent, f"robot `{model.robot.name}` has no link `{names[0]}`" + Suggestion(near, names[0])
    if child is None or names[1] not in links or model.is_incomplete:
        return
    joint = next((joint for joint in model.robot.joints if joint.child == names[1]), None)
    if joint is not None and joint.parent != names[0]:
        yield child, f"`{names[1]}` is the child of joint `{joint.name}` and has the parent `{joint.parent}`"
    elif joint is None and names[0] in links:
        yield child, f"`{names[1]}` is the root of robot `{model.robot.name}` and cannot be below `{names[0]}`"


def _is_placed(root: str, model: Model) -> bool:
    """Return whether a node for localization, or a virtual joint, places the root of the robot below another frame."""
    joints = [joint for semantics in semantics_of(model) for joint in semantics.find_all("virtual_joint")]
    is_virtual = any(joint.get("child_link") == root for joint in joints)
    return is_virtual or any(re.search(_PLACING, uncommented(source)) for source in launches(model))


def _is_defined(word: Named, name: str, model: Model) -> bool:
    """Return whether a description or another place of the related files names a frame."""
    if name in model.robot.link_by_name or model.neighbouring_descriptions.define("link", name):
        return True
    pattern = rf"(?<![\w/]){re.escape(name)}(?![\w/])"
    return sum(len(re.findall(pattern, source.text)) for source in model.related_files.values()) > 1


def _meant(name: str, links: Iterable[str]) -> str | None:
    """Return the link that a parent frame intends: the link with a similar name, or the only one with one more word."""
    slips = [link for link in links if is_slip(name, link)]
    longer = [link for link in links if link.startswith(f"{name}_") or link.endswith(f"_{name}")]
    return next((group[0] for group in (slips, longer) if len(group) == 1), None)
