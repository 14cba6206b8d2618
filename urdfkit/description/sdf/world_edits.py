"""Edit worlds: return a copy with a model added, removed or moved."""

from dataclasses import replace

from urdfkit.description.sdf.model import WorldModel
from urdfkit.description.sdf.world import World
from urdfkit.description.urdf.robot import Pose
from urdfkit.errors import ResourceError, did_you_mean


def add_model(world: World, model: WorldModel, *, name: str = "", pose: Pose | None = None) -> World:
    """Return a world with one more model.

    Args:
        world: the original world.
        model: the model to add.
        name: name in the world; the name of `model` when empty.
        pose: pose in the world; the pose of `model` when None.

    Raises:
        ResourceError: the name already exists; suggests an unused name.
    """
    called = name or model.name
    taken = set(_names(world))
    if called in taken:
        free = next(f"{called}_{number}" for number in range(1, len(taken) + 2) if f"{called}_{number}" not in taken)
        raise ResourceError(f"world `{world.name}` already has a model `{called}`; name it `{free}`")
    added = replace(model, name=called, pose=model.pose if pose is None else pose)
    return replace(world, models=(*world.models, added))


def remove_model(world: World, name: str) -> World:
    """Return a world without one of its models, robots or lights.

    Raises:
        ResourceError: no entity has that name; names the most similar entity.
    """
    names = [*_names(world), *(light.name for light in world.lights)]
    if name not in names:
        raise _unknown(world, name, names)
    if any(name == each for joint in world.joints for each in (_model(joint.parent), _model(joint.child))):
        joint = next(j for j in world.joints if name in (_model(j.parent), _model(j.child)))
        raise ResourceError(f"model `{name}` is connected by joint `{joint.name}` of world `{world.name}`")
    return replace(
        world,
        models=tuple([each for each in world.models if each.name != name]),
        robots=tuple([each for each in world.robots if each.name != name]),
        lights=tuple([each for each in world.lights if each.name != name]),
    )


def move_model(world: World, name: str, pose: Pose) -> World:
    """Return a world with one of its models or robots moved.

    Args:
        world: the original world.
        name: name of the model.
        pose: new pose in the world.

    Raises:
        ResourceError: no entity has that name; names the most similar entity.
    """
    if name not in _names(world):
        raise _unknown(world, name, _names(world))
    return replace(
        world,
        models=tuple([replace(each, pose=pose) if each.name == name else each for each in world.models]),
        robots=tuple([replace(each, pose=pose) if each.name == name else each for each in world.robots]),
    )


def _names(world: World) -> list[str]:
    return [*(model.name for model in world.models), *(robot.name for robot in world.robots)]


def _model(link: str) -> str:
    return link.partition("::")[0]


def _unknown(world: World, name: str, names: list[str]) -> ResourceError:
    return ResourceError(f"no model `{name}` in world `{world.name}`" + did_you_mean(name, names))
