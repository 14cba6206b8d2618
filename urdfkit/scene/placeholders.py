"""Placeholders: boxes in place of shapes that cannot be shown, with an estimated size."""

from collections.abc import Iterator, Mapping
from dataclasses import replace

import numpy as np

from urdfkit.defect_message import with_effect
from urdfkit.description.urdf.repair_record import Repair
from urdfkit.description.urdf.robot import Box, Capsule, Collision, Cylinder, Link, Mesh, Problem, Robot, Sphere, Visual
from urdfkit.description.xacro.evaluation.failures import chain_words
from urdfkit.description.xml.element import Element
from urdfkit.errors import ModelError
from urdfkit.linear_algebra import Array
from urdfkit.scene.colors import DEFAULT
from urdfkit.scene.placeholder_sizes import PlaceholderSizes
from urdfkit.scene.scene_table import Role, Scene, Shape

_SHAPELESS = {"missing": "E014", "unknown-value": "E008"}
"""Kind of a problem without which a shape would have a geometry → code of the lint rule that reports it."""
_EFFECT = "a placeholder is shown"
_CLEAR = 0.5
"""Opacity of a placeholder that may cover other shapes of its link."""


def with_placeholders(robot: Robot, scene: Scene) -> tuple[Scene, list[Repair]]:
    """Return a scene with a placeholder for each link that lacks shapes, and repairs of missing shapes and textures.

    A shape is missing if its mesh cannot be loaded or has no area, its geometry is unknown, or a size is negative.
    The placeholder of visual shapes has the bounding box of the collision shapes, and vice versa. A link with neither
    has a box around its frame, its child joints and the solid box of its inertia. Negative sizes become positive.

    Args:
        robot: the robot.
        scene: its scene, with the missing meshes in `Scene.problems`.
    """
    repairs = [each.repair(_EFFECT) for each in scene.problems]
    repairs += textures(scene)
    problems = shape_problems(robot)
    wanted = dict.fromkeys((each.body, each.role) for each in scene.problems)
    for link in robot.link_by_name_in_order():
        for role, item in _items(link):
            if item.geometry is None:
                wanted[link.name, role] = None
                repairs += unknown_shapes(link, item, problems, _EFFECT)
            elif (size := _impossible(item.geometry)) is not None:
                repairs.append(_impossible_size(link, role, item, size, _EFFECT))
                if isinstance(item.geometry, Mesh):
                    wanted[link.name, role] = None
    if not wanted and not repairs:
        return scene, []
    shapes = [_positive(shape) for shape in scene.shapes if not _is_empty(shape.geometry)]
    sizes = PlaceholderSizes(robot, shapes)
    placeholders = [
        _placeholder(body, role, sizes.bounds(body, role), covers_shapes=sizes.has_shapes(body, role))
        for body, role in wanted
    ]
    order = scene.body_index
    found = sorted([*shapes, *placeholders], key=lambda shape: (order[shape.body], shape.role == "collision"))
    return replace(scene, shapes=tuple(found)), repairs


def textures(scene: Scene) -> Iterator[Repair]:
    """Yield a repair for each visual shape that is shown without an image of its textures."""
    for shape in scene.with_role("visual"):
        mesh = shape.mesh
        if mesh is None or shape.has_color:
            continue
        faults = dict(mesh.broken)
        for name in mesh.missing:
            fault = faults.get(name, "does not exist")
            message = with_effect(f"texture `{name}` of `{shape.name}` {fault}", "the shape is shown without it")
            yield Repair("mesh", "G618", message, shape.position, shape.body, attribute="filename")


def _placeholder(body: str, role: Role, bounds: Array, *, covers_shapes: bool) -> Shape:
    x, y, z = (bounds[1] - bounds[0]).tolist()
    placement = np.eye(4)
    placement[:3, 3] = bounds.mean(axis=0)
    rgba = (*DEFAULT[:3], _CLEAR if covers_shapes else 1.0)
    return Shape(f"{body}/{role}/placeholder", body, role, Box((x, y, z)), placement, rgba, is_placeholder=True)


def _items(link: Link) -> Iterator[tuple[Role, Visual | Collision]]:
    yield from (("visual", item) for item in link.visuals)
    yield from (("collision", item) for item in link.collisions)


def _lengths(geometry: object) -> tuple[float, ...]:
    """Return the sizes of a primitive [m]; nothing for other shapes."""
    match geometry:
        case Box(size=size):
            return size
        case Sphere(radius=radius):
            return (radius,)
        case Cylinder(radius=radius, length=length) | Capsule(radius=radius, length=length):
            return (radius, length)
    return ()


def _is_empty(geometry: object) -> bool:
    """Return whether the scale of a mesh leaves no area."""
    return isinstance(geometry, Mesh) and geometry.scale.count(0.0) > 1


def _impossible(geometry: object) -> float | None:
    """Return the first negative size of a shape [m], or the scale of a mesh without area; None without one."""
    return 0.0 if _is_empty(geometry) else next((size for size in _lengths(geometry) if size < 0.0), None)


def _positive(shape: Shape) -> Shape:
    """Return a placeholder for a shape with a negative size; other shapes unchanged."""
    if _impossible(shape.geometry) is None:
        return shape
    edges = [abs(size) for size in _lengths(shape.geometry)]
    if not isinstance(shape.geometry, Box):
        radius, *length = edges
        height = length[0] if length else 2.0 * radius
        edges = [2.0 * radius, 2.0 * radius, height + 2.0 * radius * isinstance(shape.geometry, Capsule)]
    return replace(shape, geometry=Box((edges[0], edges[1], edges[2])), mesh=None, rgba=DEFAULT, is_placeholder=True)


def shape_problems(robot: Robot) -> dict[Element, Problem]:
    """Return element → the problem without which a shape could have a geometry there."""
    return {problem.element: problem for problem in reversed(robot.problems) if problem.kind in _SHAPELESS}


def unknown_shapes(
    link: Link, item: Visual | Collision, problems: Mapping[Element, Problem], effect: str
) -> Iterator[Repair]:
    """Yield the repairs of a shape without a readable geometry, except those of the robot's structure.

    Args:
        link: the link of the shape.
        item: the shape.
        problems: see `shape_problems`.
        effect: what happens to the shape, for the message.
    """
    for problem in _unknown(item, problems):
        origin = problem.element.origin
        message = with_effect(problem.message, effect) + chain_words(origin.expansions)
        code, attribute = _SHAPELESS[problem.kind], problem.attribute
        yield Repair("shape", code, message, origin.position, link.name, attribute=attribute)


def require_valid_shapes(robot: Robot) -> None:
    """Refuse a robot with a shape that has no readable geometry, or a negative size.

    Raises:
        ModelError: the first such shape.
    """
    problems = shape_problems(robot)
    for link in robot.links:
        for role, item in _items(link):
            for problem in _unknown(item, problems):
                origin = problem.element.origin
                raise ModelError(problem.message + chain_words(origin.expansions), position=origin.position)
            if item.geometry is not None and (size := _impossible(item.geometry)) is not None:
                message, element = _size_message(link, role, item, size)
                raise ModelError(message + chain_words(element.origin.expansions), position=element.origin.position)


def _unknown(item: Visual | Collision, problems: Mapping[Element, Problem]) -> Iterator[Problem]:
    """Yield the problems of a shape without a readable geometry."""
    if item.geometry is None:
        yield from (problems[element] for element in item.element.walk() if element in problems)


def impossible_visuals(link: Link, effect: str) -> Iterator[tuple[Visual, Repair]]:
    """Yield each visual shape with a negative size and each mesh without area, and its repair.

    Args:
        link: the link.
        effect: what happens to the shape, for the message.
    """
    for item in link.visuals:
        if item.geometry is not None and (size := _impossible(item.geometry)) is not None:
            yield item, _impossible_size(link, "visual", item, size, effect)


def _impossible_size(link: Link, role: Role, item: Visual | Collision, size: float, effect: str) -> Repair:
    message, element = _size_message(link, role, item, size)
    origin = element.origin
    message = with_effect(message, effect) + chain_words(origin.expansions)
    sizes = {"scale": (0.0,)} if isinstance(item.geometry, Mesh) else vars(item.geometry)
    attribute = next((name for name, value in sizes.items() if size in np.atleast_1d(value)), None)
    return Repair("shape", "G611", message, origin.position, link.name, attribute=attribute)


def _size_message(link: Link, role: Role, item: Visual | Collision, size: float) -> tuple[str, Element]:
    kind = type(item.geometry).__name__.lower()
    geometry = item.element.find("geometry") or item.element
    fault = "a scale of 0" if kind == "mesh" else f"the size {size:g} m"
    return f"link `{link.name}`: the <{kind}> of a {role} shape has {fault}", geometry.find(kind) or geometry
