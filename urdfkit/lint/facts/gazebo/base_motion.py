"""Whether the base can move sideways, and the parameters of navigation and filters that assume the contrary.

Sources: nav2_mppi_controller (motion_models.hpp), nav2_amcl and amcl (motion models), nav2_velocity_smoother,
teb_local_planner (config.h), dwb_plugins (kinematic_parameters.cpp), robot_localization (state_estimation_nodes.rst).
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator

from urdfkit.description.plugins.lookup import ALL_SPECS
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.controller_settings import settings
from urdfkit.lint.facts.control.controller_wheels import has_other_wheels
from urdfkit.lint.facts.control.yaml_tree import Node, nodes, number_of, yamls, yamls_of_robot
from urdfkit.lint.facts.gazebo.plugins import plugins, specs
from urdfkit.lint.model.model import Model

Defects = Iterator[tuple[Source, Node, str]]

_SIDEWAYS = ("mecanum_drive", "planar_move")
_FORWARDS = ("diff_drive", "skid_steer", "ackermann", "ackermann_steering", "tricycle")
"""Kinds of drive plugins with and without sideways motion."""

_CONTROLLERS = (
    (r"(?:mecanum|omni_wheel)_drive_controller/", True),
    (r"(?:(?:diff_drive|tricycle|ackermann)_controller|\w+_steering_controller)/", False),
)
"""Type of a controller → whether its base moves sideways."""

_PARAMETER = r"motion_model|robot_model_type|odom_model_type|max_vel_y|vy_max|max_velocity|min_velocity"


def moves_sideways(model: Model) -> bool | None:
    """Return whether the drive of the robot moves it sideways; None if unknown.

    It is unknown in packages that have drives of both kinds, since either robot may load a parameter file. Therefore
    files of controllers that only another robot loads are read too.
    """
    found = {
        value
        for source in yamls(model)
        if "_controller/" in source.text
        for one in settings(source)
        for pattern, value in _CONTROLLERS
        if re.match(pattern, one.kind)
    }
    kinds = {spec.kind for plugin, _, _ in plugins(model.robot) for spec in specs(plugin)}
    found |= {value for names, value in ((_SIDEWAYS, True), (_FORWARDS, False)) if not kinds.isdisjoint(names)}
    if len(found) != 1:
        return None
    base = found.pop()
    others = [spec for spec in ALL_SPECS if spec.kind in (_FORWARDS if base else _SIDEWAYS)]
    near = model.neighbouring_descriptions
    names = {name for spec in others for name in (*spec.filenames, *spec.class_names)}
    return None if any(near.mention(name) for name in names) else base


def contradictions(model: Model) -> Defects:
    """Yield the parameters of navigation that forbid or assume sideways motion, against the drive of the robot.

    A base that can move sideways may be used without that: nothing is yielded unless another parameter allows it.
    """
    found = [(source, *each) for source in yamls_of_robot(model) for each in _assumptions(source)]
    base = moves_sideways(model) if found else None
    if base is None or has_other_wheels(model):
        yield from _between_nodes(found)
        return
    if base and not any(is_sideways for *_, is_sideways, _ in found):
        return
    for source, name, value, is_sideways, is_harmful in found:
        if is_sideways != base and (base or is_harmful):
            what = "can move sideways" if base else "cannot move sideways"
            yield source, value, f"{name} is {value.text}, but the base {what}"


def _between_nodes(found: list[tuple[Source, str, Node, bool, bool]]) -> Defects:
    """Yield a motion model of AMCL that contradicts all controllers of its file."""
    for source, name, value, is_sideways, _ in found:
        speeds = [moves for other, what, _, moves, _ in found if other is source and what in _SPEEDS]
        if "robot_model" in name and speeds and is_sideways not in speeds:
            does = "does not drive" if is_sideways else "drives"
            yield source, value, f"{name} is `{value.text}`, but the controller {does} sideways"


_SPEEDS = ("`max_vel_y`", "`vy_max`")


def _assumptions(source: Source) -> Iterator[tuple[str, Node, bool, bool]]:
    """Yield the parameters on sideways motion: name, value, whether it assumes it, whether that harms other bases."""
    if not re.search(_PARAMETER, source.text):
        return
    for node in (each for each in nodes(source) if each.entries):
        for name, is_sideways in _MODELS.items():
            value = node.find(name)
            if value is not None and (assumed := is_sideways(value.text)) is not None:
                yield f"`{name}`", value, assumed, True
        is_mppi = node.find("motion_model") is not None or "MPPI" in _text(node, "plugin")
        names = ("vy_max",) if is_mppi and _text(node, "motion_model") == "Omni" else ()
        for name in (*names, "max_vel_y"):
            value = node.find(name)
            if (speed := number_of(value)) is not None and value is not None:
                yield f"`{name}`", value, speed > 0.0, name == "max_vel_y"
        for name in ("max_velocity", "min_velocity") if node.find("smoothing_frequency") is not None else ():
            value = node.find(name)
            second = value.items[1] if value is not None and len(value.items) == 3 else None
            speed = number_of(second)
            if second is not None and speed is not None:
                yield f"y of `{name}`", second, speed != 0.0, False


def _text(node: Node, name: str) -> str:
    value = node.find(name)
    return value.text if value is not None else ""


def _model(sideways: str, forwards: str) -> Callable[[str], bool | None]:
    return lambda text: True if re.search(sideways, text) else False if re.search(forwards, text) else None


_MODELS = {
    "motion_model": _model(r"^Omni$", r"^(?:DiffDrive|Ackermann)$"),
    "robot_model_type": _model(r"(?:^o|O)mni", r"(?:^d|D)iff"),
    "odom_model_type": _model(r"^omni", r"^diff"),
}
"""Parameter → whether a value is a model of sideways motion; None for other values."""
