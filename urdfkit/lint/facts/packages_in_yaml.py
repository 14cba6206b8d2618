"""Packages of the controllers and plugins that YAML files name.

Sources: ros_controllers and ros2_controllers (their package.xml and plugin descriptions), move_base (package.xml).
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from urdfkit.description.control.controller_types import TYPES
from urdfkit.description.packages.related_files import package_of
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.controller_joints import typed
from urdfkit.lint.facts.control.ros2_controllers import PARAMETERS, declared
from urdfkit.lint.facts.control.yaml_tree import start_of, yamls
from urdfkit.lint.facts.ros_packages import is_in_metapackage, names
from urdfkit.lint.model.model import Model
from urdfkit.record import record

_OF_ROS1 = ("joint_state_controller", "imu_sensor_controller", "force_torque_sensor_controller")
"""Packages of controllers that only ROS 1 has."""

_GRIPPERS = "gripper_controllers"
"""Package of ``GripperActionController`` in ROS 2, whose types have the names of other packages."""

_PACKAGES_OF_ROS1 = {
    "GripperActionController": "gripper_action_controller",
    "JointTrajectoryController": "joint_trajectory_controller",
}
"""Class of a controller in ROS 1 → its package; the other packages have the name before the class."""

_STARTING = frozenset(("controller_manager", "ros2_control", "ros_control", "gazebo_ros_control"))
"""Packages on which a package depends that starts controllers itself."""

_NAVIGATION_PLUGIN = (
    r"(?m)^[ \t]*(?:plugin:[ \t]*[\"']?(?=nav2_)|base_(?:local|global)_planner:[ \t]*[\"']?)(\w+)(?:::|/)\w+"
)
_OF_MOVE_BASE = ("base_local_planner", "clear_costmap_recovery", "costmap_2d", "navfn", "rotate_recovery")
"""Packages on which move_base depends."""


@record(eq=False)
class YamlUse:
    """A place in YAML that needs a package on which none depends.

    Attributes:
        source: the file.
        start: offset of the text that needs the package.
        end: offset after this text.
        package: the package.
        use: the end of a sentence that begins with the package, such as ``whose plugin this file uses``.
        is_type: whether the place is the type of a controller of ROS 1.
    """

    source: Source
    start: int
    end: int
    package: str
    use: str
    is_type: bool = False


def packages_of_controllers(model: Model, needed: set[str]) -> Iterator[YamlUse]:
    """Yield each package of a controller that is not among the needed ones, once.

    Args:
        model: the linted model.
        needed: names and dependencies of the packages around the robot; the yielded packages are added.
    """
    kinds = {kind.partition("/")[0] for kind in TYPES}
    files = list(yamls(model))
    if not files or needed.isdisjoint({*kinds, *_STARTING}):
        return  # another package starts the controllers
    for source in files:
        package = package_of(Path(source.file))
        if PARAMETERS not in source.text and package is not None:
            yield from _of_ros1(source, package, needed, model)
        for controller in declared(source) if package is not None else ():
            name, _, kind = controller.kind.text.partition("/")
            # controller-type-wrong-generation reports types of ROS 1.
            if name in _OF_ROS1 or controller.kind.text not in TYPES or name not in names():
                continue
            name = _GRIPPERS if kind == "GripperActionController" else name
            if name not in needed and not is_in_metapackage(name, needed):
                needed.add(name)
                start = start_of(source, controller.kind)
                use = f"which provides controller `{controller.name}`"
                yield YamlUse(source, start, start + len(controller.kind.text), name, use)


def _of_ros1(source: Source, package: Path, needed: set[str], model: Model) -> Iterator[YamlUse]:
    if "catkin" not in model.manifest(package) or (package / ".setup_assistant").is_file():
        return
    for reference in typed(source):
        space, _, kind = reference.name.partition("/")
        name = _PACKAGES_OF_ROS1.get(kind, space)
        is_released = reference.name in TYPES and name in names()
        if is_released and name not in needed and not is_in_metapackage(name, needed):
            needed.add(name)
            use = f"which has the controller type `{reference.name}`"
            yield YamlUse(source, reference.start, reference.end, name, use, is_type=True)


def packages_of_plugins(model: Model, needed: set[str]) -> Iterator[YamlUse]:
    """Yield each package of plugins of Nav2 or move_base on which none depends, unlike on those of the others.

    Args:
        model: the linted model.
        needed: names and dependencies of the packages around the robot; the yielded packages are added.
    """
    for source in yamls(model):
        uses: dict[str, re.Match[str]] = {}
        for match in re.finditer(_NAVIGATION_PLUGIN, source.text):
            if match[1] not in _OF_MOVE_BASE or "move_base" not in needed:
                uses.setdefault(match[1], match)
        missing = [name for name in uses if name not in needed and not is_in_metapackage(name, needed)]
        is_listed = len(missing) < len(uses) / 2 or "move_base" in needed
        for name in missing if is_listed else ():
            if name in names():
                needed.add(name)
                yield YamlUse(source, *uses[name].span(1), name, "whose plugin this file uses")
