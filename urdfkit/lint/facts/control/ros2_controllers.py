"""ROS 2 controllers in YAML, the interfaces they use, and the interfaces of the hardware."""

import re
from collections.abc import Iterator
from functools import lru_cache
from pathlib import Path

from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.yaml_tree import Node, documents
from urdfkit.lint.model.model import Model
from urdfkit.record import record

PARAMETERS = "ros__parameters"


@record(eq=False)
class DeclaredController:
    """A controller that a controller manager loads.

    Attributes:
        name: name of the controller, without namespaces.
        kind: YAML node of the controller's type.
        settings: parameters of the controller; None if the file has none.
    """

    name: str
    kind: Node
    settings: Node | None


@record(eq=False)
class Wanted:
    """A joint interface that a controller requires.

    Attributes:
        joint: name of the joint.
        interface: ``position``, ``velocity`` …
        is_command: whether it is a command interface; else it is a state interface.
        where: YAML node that names the interface, or else the joint.
    """

    joint: str
    interface: str
    is_command: bool
    where: Node


def declared(source: Source) -> tuple[DeclaredController, ...]:
    """Return the controllers with a type in the parameters of a ROS 2 controller manager in a YAML file."""
    return _declared(documents(source))


@lru_cache(maxsize=400)
def _declared(roots: tuple[Node, ...]) -> tuple[DeclaredController, ...]:
    groups = [each for root in roots for each in _parameters(root, "", 0)]
    settings: dict[str, Node] = {}
    for name, group in groups:
        settings.setdefault(name, group)
    return tuple(
        DeclaredController(key.text, kind, settings.get(key.text))
        for _, group in groups
        for key, value in group.entries
        if (kind := value.find("type")) is not None and re.fullmatch(r"\w+/\w+", kind.text)
    )


def _parameters(node: Node, name: str, depth: int) -> Iterator[tuple[str, Node]]:
    """Yield the parameters of each node, with the last part of the node's name."""
    for key, value in node.entries:
        if key.text == PARAMETERS:
            yield name, value
        elif depth < 4:
            yield from _parameters(value, key.last_name, depth + 1)


_GROUPS = {
    "position_controllers/JointGroupPositionController": "position",
    "velocity_controllers/JointGroupVelocityController": "velocity",
    "effort_controllers/JointGroupEffortController": "effort",
}
_GRIPPERS = {
    "position_controllers/GripperActionController": "position",
    "effort_controllers/GripperActionController": "effort",
    "parallel_gripper_action_controller/GripperActionController": "position",
}


def wanted(controller: DeclaredController) -> Iterator[Wanted]:
    """Yield the joint interfaces that a controller of ros2_controllers requires (Humble to Rolling)."""
    settings, kind = controller.settings, controller.kind.text
    if settings is None:
        return

    def joints(*names: str) -> list[Node]:
        nodes = (settings.find(name) for name in names)
        return [one for node in nodes if node is not None for one in (node, *node.items) if one.text]

    def each(names: list[Node], interfaces: str, is_command: bool) -> Iterator[Wanted]:
        requested = settings.find(interfaces)
        for interface in (requested, *requested.items) if requested is not None else ():
            if interface.text:
                yield from (Wanted(name.text, interface.text, is_command, interface) for name in names)

    def all_of(names: list[Node], interface: str, is_command: bool) -> Iterator[Wanted]:
        yield from (Wanted(name.text, interface, is_command, name) for name in names)

    if kind == "joint_trajectory_controller/JointTrajectoryController":
        yield from each(joints("command_joints") or joints("joints"), "command_interfaces", True)
        yield from each(joints("joints"), "state_interfaces", False)
    elif kind == "forward_command_controller/ForwardCommandController":
        yield from each(joints("joints"), "interface_name", True)
    elif kind == "forward_command_controller/MultiInterfaceForwardCommandController":
        yield from each(joints("joint"), "interface_names", True)
    elif kind in _GROUPS:
        yield from all_of(joints("joints"), _GROUPS[kind], True)
    elif kind in _GRIPPERS:
        yield from all_of(joints("joint"), _GRIPPERS[kind], True)
    elif kind == "diff_drive_controller/DiffDriveController":
        wheels = joints("left_wheel_names", "right_wheel_names")
        yield from all_of(wheels, "velocity", True)
        if _truth(settings, "open_loop") is not True:
            is_position = _truth(settings, "position_feedback") is not False
            yield from all_of(wheels, "position" if is_position else "velocity", False)
    elif kind == "tricycle_controller/TricycleController":
        yield from all_of(joints("traction_joint_name"), "velocity", True)
        yield from all_of(joints("steering_joint_name"), "position", True)
    elif re.fullmatch(r"(ackermann|bicycle|tricycle)_steering_controller/\w+", kind):
        yield from all_of(joints("traction_joints_names"), "velocity", True)
        yield from all_of(joints("steering_joints_names"), "position", True)
        drive, steering = ("front", "rear") if _truth(settings, "front_steering") is False else ("rear", "front")
        yield from all_of(joints(f"{drive}_wheels_names"), "velocity", True)  # until Jazzy
        yield from all_of(joints(f"{steering}_wheels_names"), "position", True)
    elif kind == "mecanum_drive_controller/MecanumDriveController":
        for corner in ("front_left", "front_right", "rear_right", "rear_left"):
            commanded = joints(f"{corner}_wheel_command_joint_name")
            yield from all_of(commanded, "velocity", True)
            yield from all_of(joints(f"{corner}_wheel_state_joint_name") or commanded, "velocity", False)


def _truth(settings: Node, name: str) -> bool | None:
    node = settings.find(name)
    return {"true": True, "false": False}.get(node.text.lower()) if node is not None else None


def offered(model: Model) -> dict[str, dict[bool, list[str]]] | None:
    """Return joint → its command interfaces (True) and state interfaces (False) in ``<ros2_control>``.

    None if xacro arguments or another description of the package may define different hardware.
    """
    from urdfkit.description.packages.related_files import package_of
    from urdfkit.lint.facts.conditions import is_conditional
    from urdfkit.lint.project.description_files import descriptions

    robot = model.robot
    if not robot.ros2_control or model.is_incomplete or model.package is None:
        return None
    found: dict[str, dict[bool, list[str]]] = {}
    for block in robot.ros2_control:
        for part in block.element.children:
            if part.tag not in ("joint", "sensor", "gpio"):
                continue
            has = found.setdefault(part.get("name") or "", {True: [], False: []})
            has[True] += [child.get("name") or "" for child in part.find_all("command_interface")]
            has[False] += [child.get("name") or "" for child in part.find_all("state_interface")]
    if any("$" in name for name in found):
        return None
    own = {str(Path(name).absolute()): source.text for name, source in model.expanded.sources.items()}
    conditional = [name for name, text in own.items() if "_interface" in text and is_conditional(text, _PARTS)]
    if conditional and any(_has_skipped_parts(model, name) for name in conditional):
        return None
    packages = {package_of(Path(file)) for file in model.related_files}
    for folder in sorted({model.package, *(package for package in packages if package is not None)}):
        for path, text in descriptions(folder):
            if str(path.absolute()) not in own and ("<ros2_control" in text or "_interface" in text):
                return None
    return found


def _has_skipped_parts(model: Model, path: str) -> bool:
    """Return whether a file has a condition with interfaces or macro calls that adds nothing to the expanded robot."""
    shown = next(name for name in model.expanded.sources if str(Path(name).absolute()) == path)
    root = model.expanded.root
    places = set()
    for element in root.walk() if root is not None else ():
        for position in (element.origin.position, *(call.position for call in element.origin.expansions)):
            if position.file == shown:
                places.add((position.line, position.column))
    source = model.document(shown).source
    for tag in model.document(shown).walk():
        if tag.name in ("xacro:if", "xacro:unless") and re.search(_PARTS, source.text[tag.end : tag.close_end]):
            start, end = source.position(tag.end), source.position(tag.close_end)
            first, last = (start.line, start.column), (end.line, end.column)
            if not any(first <= place < last for place in places):
                return True
    return False


_PARTS = r"_interface|<xacro:(?!if|unless|property|arg)\w"
"""Source text that may add an interface: an interface element or a macro call."""
