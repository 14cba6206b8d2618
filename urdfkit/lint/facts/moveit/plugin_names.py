"""Names of plugins of MoveIt and of navigation that the version of ROS of their file does not have.

Sources: moveit (moveit_planners, moveit_plugins, planning_request_adapter_plugins) of Noetic and moveit2 of Humble to
Rolling, their plugin descriptions; ros-planning/navigation of Noetic.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from urdfkit.defect_message import Suggestion
from urdfkit.description.xml.source import Source
from urdfkit.errors import nearest
from urdfkit.lint.facts.control.controller_joints import Named
from urdfkit.lint.facts.launch.actions import all_elements
from urdfkit.lint.facts.launch.ros_version import reads_version

_ADAPTERS_UNTIL_IRON = """
AddIterativeSplineParameterization AddRuckigTrajectorySmoothing AddTimeOptimalParameterization AddTimeParameterization
Empty FixStartStateBounds FixStartStateCollision FixStartStatePathConstraints FixWorkspaceBounds ResolveConstraintFrames
SetMaxCartesianEndEffectorSpeed
"""

_CLASSES: dict[int, dict[str, str]] = {
    1: {
        "base_local_planner": "TrajectoryPlannerROS",
        "carrot_planner": "CarrotPlanner",
        "chomp_interface": "CHOMPPlanner",
        "default_planner_request_adapters": _ADAPTERS_UNTIL_IRON,
        "dwa_local_planner": "DWAPlannerROS",
        "eband_local_planner": "EBandPlannerROS",
        "global_planner": "GlobalPlanner",
        "moveit_fake_controller_manager": "MoveItFakeControllerManager",
        "moveit_ros_control_interface": "MoveItControllerManager MoveItMultiControllerManager",
        "moveit_simple_controller_manager": "MoveItSimpleControllerManager",
        "navfn": "NavfnROS",
        "ompl_interface": "OMPLPlanner",
        "pilz_industrial_motion_planner": "CommandPlanner",
        "teb_local_planner": "TebLocalPlannerROS",
    },
    2: {
        "chomp_interface": "CHOMPPlanner",
        "default_planner_request_adapters": _ADAPTERS_UNTIL_IRON,
        "moveit_simple_controller_manager": "MoveItSimpleControllerManager",
        "ompl_interface": "OMPLPlanner",
        "pilz_industrial_motion_planner": "CommandPlanner",
    },
}
"""Version of ROS → package → classes of its plugins; others that are not similar to them may exist."""

_ONLY_IN = {
    1: ("moveit_fake_controller_manager",),
    2: ("default_planning_request_adapters", "default_planning_response_adapters", "dwb_core"),
}
"""Version of ROS → packages of plugins that the other version does not have; all of ``nav2_`` have no ROS 1 form."""

_REPLACED = {
    (1, "default_planning_request_adapters"): "default_planner_request_adapters",
    (1, "dwb_core"): "dwa_local_planner",
    (1, "nav2_navfn_planner"): "navfn",
    (2, "moveit_fake_controller_manager"): "moveit_simple_controller_manager",
}
"""Version of ROS and package of the other one → the package that has such plugins."""

PLUGINS = r"(?:plugins?|adapters|planner|controller_manager)$"
"""Matches the names of parameters and arguments with plugins."""

_PLUGIN = r"(?<![\w/:$)])([A-Za-z]\w*)(/|::)(\w+)(?![\w/:(])"


def wrong_plugins(text: str, version: int) -> Iterator[tuple[int, str, str]]:
    """Yield the offset, the name and the message of each plugin in a text that a version of ROS does not have."""
    for at in re.finditer(_PLUGIN, text):
        package, separator, kind = at.groups()
        classes = _CLASSES[version].get(package, "").split()
        is_foreign = package in _ONLY_IN[3 - version] or (version == 1 and package.startswith("nav2_"))
        if is_foreign:
            other = _REPLACED.get((version, package))
            own = _CLASSES[version].get(other or "", "").split()
            near = (kind if kind in own else own[0] if len(own) == 1 else None) if own else None
            message = f"plugin `{at[0]}` belongs to ROS {3 - version}, and this file is for ROS {version}"
            right = f"{other}{separator if other == package else '/'}{near}" if near is not None else None
            yield at.start(), at[0], message + Suggestion(right, at[0])
        elif kind not in classes and (similar := nearest(kind, classes, cutoff=0.6)) is not None:
            right = f"{package}{separator}{similar}"
            yield at.start(), at[0], f"`{package}` has no plugin `{kind}`" + Suggestion(right, at[0])


def wrong_plugins_in_launch(source: Source) -> Iterator[tuple[Named, str]]:
    """Yield the plugins in parameters and arguments of an XML or YAML launch file that its ROS does not have."""
    version = reads_version(source)
    for element in all_elements(source) if version else ():
        name = element.attributes.get("name")
        if element.tag not in ("param", "arg", "let") or name is None or not re.search(PLUGINS, name.name):
            continue
        for value in (element.attributes.get(key) for key in ("value", "default")):
            if value is not None:
                for start, plugin, message in wrong_plugins(value.name, version):
                    yield Named(plugin, value.start + start), message
