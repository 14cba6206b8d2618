"""Axles of steering controllers: wheelbase, tracks, order of the joints and the smallest turning radius.

Sources: ros2_controllers (steering_controllers_library.yaml, ackermann_steering_controller.yaml and .hpp: the right
wheel is the first of a pair; tricycle_controller.cpp: one wheel that steers and drives), Humble to Rolling;
navigation2 (smac_planner_hybrid.cpp, regulated_pure_pursuit_controller: parameter_handler.cpp).
"""

import math
import re
from collections.abc import Iterator

from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.controller_settings import ControllerSettings, settings
from urdfkit.lint.facts.control.yaml_tree import Node, nodes, number_of, yamls_of_robot
from urdfkit.lint.facts.gazebo.drive_wheels import Wheel, wheel_of
from urdfkit.lint.model.model import Model
from urdfkit.record import record

_TRACKS = {
    "traction_track_width": "traction",
    "wheel_track": "traction",
    "steering_track_width": "steering",
    "rear_wheel_track": "rear",
    "front_wheel_track": "front",
}
"""Parameter → the axle whose track it is."""

_TRICYCLE = "tricycle_controller/"
_STEERED = r"_steering_controller/|\btricycle_controller/"
"""Matches the types of controllers that steer."""

_TOLERANCES = {"wheelbase": 0.1, "steering": 0.25}
"""Accepted relative deviation; the wheels of a steered axle can be some distance from their steering joints."""


@record(eq=False)
class Axles:
    """The axles of a steering controller.

    Attributes:
        source: the YAML file.
        controller: the controller.
        wheels: axle, ``traction``, ``steering``, ``front`` or ``rear``, → nodes and wheels of its joints.
    """

    source: Source
    controller: ControllerSettings
    wheels: dict[str, list[tuple[Node, Wheel]]]


def axles(model: Model) -> Iterator[Axles]:
    """Yield the steering controllers whose joints all exist."""
    for source in yamls_of_robot(model):
        for controller in settings(source) if re.search(_STEERED, source.text) else ():
            if not re.search(_STEERED, controller.kind):
                continue
            if controller.kind.startswith(_TRICYCLE):
                yield _tricycle(source, controller, model)
                continue
            flag = controller.group.find("front_steering")
            front_steers = flag is None or flag.text.lower() != "false"
            names = {
                "traction": ("traction_joints_names", "rear_wheels_names" if front_steers else "front_wheels_names"),
                "steering": ("steering_joints_names", "front_wheels_names" if front_steers else "rear_wheels_names"),
            }
            found = {axle: _wheels(controller, model, keys) for axle, keys in names.items()}
            found["front"], found["rear"] = (
                found[axle] for axle in (("steering", "traction") if front_steers else ("traction", "steering"))
            )
            yield Axles(source, controller, found)


def _tricycle(source: Source, controller: ControllerSettings, model: Model) -> Axles:
    """Return the axles of a controller of one steered and driven wheel; the passive wheels of the robot are the rear.

    The passive wheels are the continuous joints that turn about y and are not on the steered link, if they are all on
    one axle.
    """
    driven, steered = (_wheels(controller, model, (f"{name}_joint_name",)) for name in ("traction", "steering"))
    found = [wheel_of(model, joint, None) for joint in model.robot.joints if joint.type == "continuous"]
    own = {wheel.joint.name for _, wheel in driven} | {wheel.joint.parent for _, wheel in driven}
    passive = [
        wheel
        for wheel in found
        if wheel is not None and abs(wheel.axis[1]) > 0.7 and own.isdisjoint((wheel.joint.name, wheel.joint.parent))
    ]
    middles = [wheel.place[0] for wheel in passive]
    is_axle = len(passive) > 1 and max(middles) - min(middles) < 0.01
    rear = [(node, wheel) for node, _ in driven for wheel in passive] if is_axle and len(driven) == 1 else []
    return Axles(source, controller, {"traction": rear, "steering": steered, "front": steered, "rear": rear})


def _wheels(controller: ControllerSettings, model: Model, keys: tuple[str, ...]) -> list[tuple[Node, Wheel]]:
    listed = next((node for key in keys if (node := controller.group.find(key)) is not None), None)
    nodes = [node for node in (listed, *listed.items) if node.text] if listed is not None else []
    joints = [model.robot.joint_by_name.get(node.text) for node in nodes]
    found = [(node, wheel_of(model, joint, None)) for node, joint in zip(nodes, joints, strict=True) if joint]
    wheels = [(node, wheel) for node, wheel in found if wheel is not None]
    return wheels if len(wheels) == len(nodes) else []


def wrong_lengths(each: Axles) -> Iterator[tuple[Node, str, float]]:
    """Yield the wheelbase and the tracks that differ from the robot: value, message and the length in the robot [m]."""
    for name, axle in (("wheelbase", "wheelbase"), *_TRACKS.items()):
        node = each.controller.group.find(name)
        value = number_of(node) if node is not None and node.kind == "text" else None
        actual = wheelbase(each) if name == "wheelbase" else _track(each.wheels[axle])
        if node is None or value is None or value <= 0.0 or actual is None or actual < 0.01:
            continue
        is_steered = axle != "wheelbase" and each.wheels[axle] is each.wheels["steering"]
        tolerance = _TOLERANCES["steering" if is_steered else "wheelbase"]
        if abs(value - actual) > tolerance * actual:
            what = "axles" if name == "wheelbase" else "wheels"
            yield node, f"`{name}` is {value:g} m, but the {what} are {actual:.6g} m apart", actual


def exchanged(each: Axles) -> Iterator[tuple[Node, str]]:
    """Yield the first joint of a pair that is on the left of the second one, and the message."""
    for axle in ("traction", "steering") if not each.controller.kind.startswith(_TRICYCLE) else ():
        pair = each.wheels[axle]
        if len(pair) == 2 and pair[0][1].place[1] > pair[1][1].place[1] + 0.01 and _points_forward(each):
            node = pair[0][0]
            yield node, f"`{node.text}` is on the left; the controller reads the right joint of a pair first"


def wheelbase(each: Axles) -> float | None:
    """Return the distance of the axles [m]; None if a joint is unknown."""
    middles = [_mean_x(each.wheels[axle]) for axle in ("traction", "steering")]
    return abs(middles[0] - middles[1]) if middles[0] is not None and middles[1] is not None else None


def turning_radius(each: Axles) -> float | None:
    """Return the smallest turning radius at the middle of the axle that does not steer [m]; None if it is unknown."""
    length = wheelbase(each)
    limits = [wheel.joint.limit for _, wheel in each.wheels["steering"]]
    angles = [
        min(-limit.lower, limit.upper)
        for limit in limits
        if limit is not None and limit.lower is not None and limit.upper is not None
    ]
    if not length or not angles or len(angles) != len(limits) or not 0.0 < min(angles) < 1.5:
        return None
    return length / math.tan(max(angles))


def tight_turns(model: Model) -> Iterator[tuple[Source, Node, str]]:
    """Yield the parameters of planners and controllers that need tighter turns than the robot can make."""
    radii = [radius for each in axles(model) if (radius := turning_radius(each)) is not None]
    if not radii:
        return
    radius = min(radii)
    for source in yamls_of_robot(model):
        for group in (each for each in nodes(source) if each.kind == "group"):
            for name in ("minimum_turning_radius", "min_turning_r", "min_turning_radius"):
                node = group.find(name)
                value = number_of(node) if node is not None and node.kind == "text" else None
                if node is not None and value is not None and 0.0 < value < 0.9 * radius:
                    message = f"`{name}` is {value:g} m, but the steering joints allow at least {radius:.3g} m"
                    yield source, node, message
            node, plugin = group.find("use_rotate_to_heading"), group.find("plugin")
            is_pursuit = plugin is not None and "RegulatedPurePursuit" in plugin.text
            if node is not None and is_pursuit and node.text.lower() == "true":
                yield (
                    source,
                    node,
                    "the controller rotates in place, which steered wheels do not allow; set this to false",
                )


def _points_forward(each: Axles) -> bool:
    front, rear = _mean_x(each.wheels["front"]), _mean_x(each.wheels["rear"])
    return front is not None and rear is not None and front > rear


def _mean_x(pairs: list[tuple[Node, Wheel]]) -> float | None:
    return sum(wheel.place[0] for _, wheel in pairs) / len(pairs) if pairs else None


def _track(pairs: list[tuple[Node, Wheel]]) -> float | None:
    return abs(pairs[0][1].place[1] - pairs[1][1].place[1]) if len(pairs) == 2 else None
