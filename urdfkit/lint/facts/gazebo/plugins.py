"""Gazebo plugins: specifications, generations, references to links and joints, lumped links."""

from collections.abc import Iterator

from urdfkit.description.plugins import Parameter, PluginSpec
from urdfkit.description.urdf.robot import GazeboBlock, Plugin, Robot, SensorTag
from urdfkit.description.xml.element import Element
from urdfkit.lint.model.model import Model
from urdfkit.lint.project.target_platform import WITHOUT_CLASSIC

OUTSIDE_FRAMES = frozenset(("world", "map", "odom", "/world", "/map", "/odom", "base_footprint_odom"))
"""Frames outside of the robot."""


def plugins(robot: Robot) -> Iterator[tuple[Plugin, GazeboBlock, SensorTag | None]]:
    """Yield every plugin with its block and sensor."""
    for block in robot.gazebo:
        for plugin in block.plugins:
            yield plugin, block, None
        for sensor in block.sensors:
            for plugin in sensor.plugins:
                yield plugin, block, sensor


def specs(plugin: Plugin) -> list[PluginSpec]:
    """Return the specifications of a plugin's library in every generation that has it."""
    from urdfkit.description.plugins.unread_parameters import tables

    return tables(plugin)


def runs_ros2_control(robot: Robot) -> bool:
    """Return whether a Gazebo plugin of the robot runs the controllers of its ``<ros2_control>``."""
    return any(spec.kind == "ros2_control" for plugin, _, _ in plugins(robot) for spec in specs(plugin))


def runs_controllers(robot: Robot) -> bool:
    """Return whether a Gazebo plugin of the robot runs the controllers of ros_control or ros2_control."""
    names = ("gazebo_ros_control", "gazebo_ros2_control", "gz_ros2_control", "ign_ros2_control")
    return any(any(name in (plugin.filename or "") for name in names) for plugin, _, _ in plugins(robot))


def generations(plugin: Plugin) -> set[str]:
    """Return the generations that have a plugin's library, from its specifications or its name; empty if unknown."""
    from urdfkit.description.plugins.lookup import stem

    found: set[str] = {spec.generation for spec in specs(plugin)}
    name = stem("".join((plugin.filename or "").split()))
    if name.startswith("gazebo_ros") and not found:
        return {"ros1", "ros2"}
    if name.startswith(("gz-sim", "ignition-gazebo", "gz_ros2_control", "ign_ros2_control")):
        return {"gz"}
    return found


def allowed(model: Model) -> set[str]:
    """Return the generations that a model's target supports; all without a target."""
    if model.release in WITHOUT_CLASSIC:
        return {"gz"}
    every = {"ros1", "ros2", "gz"}
    return {"gz": {"gz"}, "classic": {"ros1", "ros2"}, "ros1": {"ros1"}, "ros2": {"ros2", "gz"}}.get(
        model.target or "", every
    )


def simulated_hardware(model: Model) -> tuple[str, ...] | None:
    """Return the packages with ros2_control hardware for the target's Gazebo; None if the target allows any."""
    if allowed(model) == {"gz"}:
        return ("gz_ros2_control", "ign_ros2_control")
    return ("gazebo_ros2_control",) if model.target == "classic" else None


def is_foreign(plugin: Plugin, model: Model) -> bool:
    """Return whether the target lacks the plugin; parameters of the plugin are then not checked."""
    found = generations(plugin)
    return bool(found) and found.isdisjoint(allowed(model))


def spec_of(plugin: Plugin, target: str | None) -> PluginSpec | None:
    """Return the specification of a plugin: of the target's generation, else the best match of its parameters."""
    found = specs(plugin)
    if len(found) > 1 and target in ("ros1", "ros2"):
        return next((spec for spec in found if spec.generation == target), found[0])
    if len(found) > 1:
        from urdfkit.description.plugins import match

        return match(plugin) or found[0]
    return found[0] if found else None


def references(model: Model, kinds: tuple[str, ...]) -> Iterator[tuple[str, Element, Parameter, Plugin]]:
    """Yield the names of the given kinds that plugin parameters contain, in the spelling of any generation.

    Args:
        model: the linted model.
        kinds: kinds of entities, see `Parameter.names`.

    Yields:
        The name, its element, the parameter and the plugin.
    """
    from urdfkit.description.plugins import values

    for plugin, _, _ in plugins(model.robot):
        seen: set[str] = set()
        for spec in specs(plugin):
            for parameter in spec.parameters:
                if parameter.names in kinds and parameter.tag not in seen:
                    seen.add(parameter.tag)
                    for text, element in values(plugin, parameter):
                        if text and "$" not in text and not model.is_unresolved(element):
                            yield text, element, parameter, plugin


def is_simulator(model: Model) -> bool:
    """Return whether the target is a simulator."""
    return model.target is not None and model.target not in ("ros1", "ros2", "moveit")


def is_simulated(model: Model) -> bool:
    """Return whether the target is a simulator, or the robot has plugins or sensors for Gazebo."""
    return is_simulator(model) or any(block.plugins or block.sensors for block in model.robot.gazebo)


def is_frame(text: str, robot: Robot) -> bool:
    """Return whether a frame is a link of the robot, with or without a namespace, or one of `OUTSIDE_FRAMES`."""
    return text in OUTSIDE_FRAMES or text in robot.link_by_name or text.rpartition("/")[2] in robot.link_by_name


def lumped(robot: Robot) -> set[str]:
    """Return the links that Gazebo lumps into their parents: children of fixed joints that are not preserved."""
    kept = set()
    for block in robot.gazebo:
        for child in block.element.children:
            value = (child.text or child.get("value") or "").strip().lower()
            if child.tag in ("preserveFixedJoint", "disableFixedJointLumping") and value in ("true", "1"):
                kept.add(block.reference)
    return {
        joint.child
        for joint in robot.joints
        if joint.type == "fixed" and joint.child and joint.name not in kept and joint.parent != "world"
    }
