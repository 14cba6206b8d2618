"""Edit worlds: return a copy with a model added or removed."""

from dataclasses import replace

from urdfkit.description.sdf.model import WorldModel
from urdfkit.description.sdf.world import World
from urdfkit.errors import ResourceError, did_you_mean


def add_model(world: World, model: WorldModel) -> World:
    """Return a world with one more model.

    Raises:
        ResourceError: the name already exists; suggests an unused name.
    """
    name, taken = model.name, set(_names(world))
    if name in taken:
        free = next(f"{name}_{number}" for number in range(1, len(taken) + 2) if f"{name}_{number}" not in taken)
        raise ResourceError(f"world `{world.name}` already has a model `{name}`; name it `{free}`")
    return replace(world, models=(*world.models, model))


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


def _names(world: World) -> list[str]:
    return [*(model.name for model in world.models), *(robot.name for robot in world.robots)]


def _model(link: str) -> str:
    return link.partition("::")[0]


def _unknown(world: World, name: str, names: list[str]) -> ResourceError:
    return ResourceError(f"no model `{name}` in world `{world.name}`" + did_you_mean(name, names))
