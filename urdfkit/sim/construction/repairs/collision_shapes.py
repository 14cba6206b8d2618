"""Replacement of collision shapes that have no size or whose mesh cannot be read."""

from collections.abc import Iterator, Mapping
from dataclasses import replace

from urdfkit.defect_message import with_effect
from urdfkit.description.urdf.repair_record import Repair
from urdfkit.description.urdf.robot import Link, Problem, Robot
from urdfkit.description.xml.element import Element
from urdfkit.scene import Scene, Shape
from urdfkit.scene.placeholders import impossible_visuals, shape_problems, unknown_shapes
from urdfkit.sim.construction.repairs.inertia_tensors import repair_at
from urdfkit.sim.construction.validation import invalid_sizes, sizes_not_positive

_INVISIBLE = "the shape is ignored: it is invisible"
_SHOWN = 6
"""Largest number of links in a message."""


def without_empty_shapes(robot: Robot) -> tuple[Robot, list[Repair]]:
    """Return a robot without the shapes that are unknown and collision shapes whose size is not positive.

    Returns:
        The robot, and a repair for each such shape.
    """
    repairs: list[Repair] = []
    problems = shape_problems(robot)
    links = tuple([_without_empty(link, problems, repairs) for link in robot.links])
    return (replace(robot, links=links), repairs) if repairs else (robot, repairs)


def _without_empty(link: Link, problems: Mapping[Element, Problem], repairs: list[Repair]) -> Link:
    for visual in link.visuals:
        repairs += unknown_shapes(link, visual, problems, _INVISIBLE)
    if invisible := list(impossible_visuals(link, _INVISIBLE)):
        repairs += [repair for _, repair in invisible]
        left_out = {id(visual) for visual, _ in invisible}
        link = replace(link, visuals=tuple([visual for visual in link.visuals if id(visual) not in left_out]))
    kept = []
    for collision in link.collisions:
        if unknown := list(unknown_shapes(link, collision, problems, "the shape is ignored: it has no contacts")):
            repairs += unknown
            continue
        faults = list(invalid_sizes(link, collision))
        if not faults:
            kept.append(collision)
            continue
        message, element = faults[0]
        message += "; the shape is ignored: it has no contacts"
        attribute = next(sizes_not_positive(collision))[0]
        repairs.append(replace(repair_at(element, "shape", "G611", message, link=link.name), attribute=attribute))
    return link if len(kept) == len(link.collisions) else replace(link, collisions=tuple(kept))


def with_substitutes(scene: Scene) -> tuple[Scene, list[Repair]]:
    """Return a scene in which visual shapes replace the missing collision shapes, and a repair for each missing shape.

    A link whose collision shapes are all missing collides with its visual shapes, meshes as their convex hulls. Where
    other collision shapes remain, or no visual shape can be read, the missing ones are ignored. A missing package is
    one repair, at its first mesh.
    """
    missing = [problem for problem in scene.problems if problem.role == "collision"]
    packages: dict[str, list[str]] = {}
    if not missing:
        return scene, []
    left = {shape.body for shape in scene.with_role("collision")}
    replaced: dict[str, list[Shape]] = {}
    repairs = []
    for problem in missing:
        body = problem.body
        if body not in left and body not in replaced:
            replaced[body] = list(_substitutes(scene, body))
        if problem.code == "G602":
            packages.setdefault(problem.error.package, []).append(body)
            continue
        if replaced.get(body):
            effect = "the link collides with its visual shapes"
        else:
            effect = f"shape `{problem.name}` is ignored: it has no contacts"
        repairs.append(problem.repair(effect))
    for package, bodies in packages.items():
        first = next(problem for problem in scene.problems if problem.error.package == package)
        names = list(dict.fromkeys(bodies))
        shown = ", ".join(f"`{name}`" for name in names[:_SHOWN])
        more = f" and {len(names) - _SHOWN} others" if len(names) > _SHOWN else ""
        effect = f"the collision meshes of {shown}{more} are replaced by their visual shapes, if readable"
        repairs.append(replace(first.repair(effect), link=names[0]))
    shapes = [*scene.shapes, *(shape for found in replaced.values() for shape in found)]
    if not any(shape.role == "collision" for shape in shapes):
        message = with_effect(repairs[-1].message, "no collision shape of the robot is left, so nothing holds it up")
        repairs[-1] = replace(repairs[-1], message=message)
    order = scene.body_index
    shapes.sort(key=lambda shape: (order[shape.body], shape.role == "collision"))
    kept = tuple([problem for problem in scene.problems if problem.role != "collision"])
    return Scene(scene.bodies, tuple(shapes), kept), repairs


def _substitutes(scene: Scene, body: str) -> Iterator[Shape]:
    """Yield the visual shapes of a link as collision shapes."""
    visuals = [shape for shape in scene.with_role("visual") if shape.body == body]
    for shape in visuals:
        yield replace(shape, name=shape.name.replace("/visual/", "/collision/", 1), role="collision", has_color=False)
