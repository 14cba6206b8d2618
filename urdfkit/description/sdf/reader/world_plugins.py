"""Plugins of worlds: plugins whose function is built into the simulator, and notes about unknown plugins."""

from collections.abc import Iterator

from urdfkit.defect_message import Suggestion
from urdfkit.description.plugins.lookup import match, stem
from urdfkit.description.plugins.unknown_plugins import nearest
from urdfkit.description.sdf.model import WorldModel
from urdfkit.description.sdf.reader.reading_state import Context
from urdfkit.description.sdf.shapes import plugins_of
from urdfkit.description.sdf.world import World
from urdfkit.description.urdf.robot import Plugin
from urdfkit.description.xml.source import Position

_OF_GZ = (
    "physics user-commands scene-broadcaster sensors contact imu navsat altimeter air-pressure magnetometer forcetorque"
    " label joint-state-publisher"
)
_OF_CLASSIC = "api_plugin paths_plugin init factory state force_system properties"

NEEDLESS = frozenset(
    {
        *(f"gz-sim-{name}-system" for name in _OF_GZ.split()),
        "ignition-gazebo-label-system",
        *(f"gazebo_ros_{name}" for name in _OF_CLASSIC.split()),
    }
)
"""File stems of plugins whose function is built into the simulator."""


def note_unknown_plugins(context: Context, world: World) -> tuple[Position, ...]:
    """Add a note for each unknown plugin of a world and its entities, with the most similar known name.

    Returns:
        Their positions.

    Args:
        context: the context of the world's file.
        world: the world.
    """
    found = []
    for plugin, owner in _plugins(world):
        name = stem(plugin.filename or "").replace("ignition-gazebo", "gz-sim")
        if name in NEEDLESS or match(plugin) is not None:
            continue
        found.append(plugin.element.origin.position)
        near = nearest(name, NEEDLESS)
        hint = Suggestion(near)
        text = f"unknown plugin `{plugin.filename or plugin.name or ''}` in {owner} is ignored" + hint
        context.note(plugin.element, text, "plugin")
    return tuple(found)


def _plugins(world: World) -> Iterator[tuple[Plugin, str]]:
    for plugin in world.plugins:
        yield plugin, "the world"
    for model in world.models:
        yield from _of(model)
    for robot in world.robots:
        for plugin in plugins_of(robot.kept):
            yield plugin, f"robot `{robot.name}`"


def _of(model: WorldModel) -> Iterator[tuple[Plugin, str]]:
    for plugin in model.plugins:
        yield plugin, f"model `{model.name}`"
    for link in model.links:
        for kept in link.kept:
            if kept.element.tag == "sensor":
                for element in kept.element.find_all("plugin"):
                    owner = f"sensor `{kept.element.get('name')}` of model `{model.name}`"
                    yield Plugin(element.get("name"), element.get("filename"), element), owner
        for plugin in plugins_of(link.kept):
            yield plugin, f"link `{link.name}` of model `{model.name}`"
    for nested in model.models:
        yield from _of(nested)
