"""Mass, centre of mass and inertia of a link computed from its shapes, and the edits that write them."""

from collections.abc import Iterator

from urdfkit.description.urdf.geometry import UNROTATED, rotation_of
from urdfkit.description.urdf.robot import Geometry, Link, Mesh, Pose, Vector
from urdfkit.description.urdf.volume_moments import Moments, of_primitive, union
from urdfkit.description.xml.element import Element
from urdfkit.description.xml.source import Position, Source
from urdfkit.errors import ResourceError, UrdfkitError
from urdfkit.lint.facts.inertia.inertia_from_shapes import COMPONENTS
from urdfkit.lint.finding import Edit
from urdfkit.lint.model.model import Model
from urdfkit.lint.model.tags import Tag
from urdfkit.record import record

KINDS = ("collision", "visual")
"""Kinds of shapes that an inertia can be computed from."""


@record
class ComputedInertial:
    """Inertial parameters computed from the shapes of a link.

    Attributes:
        kind: ``collision`` or ``visual``: the shapes used.
        count: number of shapes.
        volume: volume of the union of the shapes [m³].
        shared: volume of the overlaps of primitives [m³]; it counts once in `volume`.
        mass: mass [kg].
        xyz: centre of mass in the link's frame [m].
        tensor: ixx, ixy, ixz, iyy, iyz, izz about the centre of mass [kg·m²], along the axes of the inertial frame in
            the source.
        notes: assumptions, one line each.
    """

    kind: str
    count: int
    volume: float
    shared: float
    mass: float
    xyz: Vector
    tensor: tuple[float, ...]
    notes: tuple[str, ...]


def compute_inertial(
    model: Model, link: Link, *, mass: float | None = None, density: float | None = None, kind: str | None = None
) -> ComputedInertial:
    """Compute mass, centre of mass and inertia of a link's shapes with uniform density.

    Args:
        model: the model of the link.
        link: the link.
        mass: mass of the link [kg]; by default `density` times the volume, else the mass in the source.
        density: density of the material [kg/m³].
        kind: shapes to use; by default the collision shapes, or the visual shapes of a link without them.

    Raises:
        ResourceError: the link has no such shapes, no volume, no mass, or an unreadable mesh.
        MissingDependencyError: a mesh needs trimesh, which is not installed.
    """
    kind = kind or ("collision" if link.collisions or not link.visuals else "visual")
    items = link.collisions if kind == "collision" else link.visuals
    if not items:
        if not (link.collisions or link.visuals):
            raise ResourceError(
                f"link `{link.name}` has no shapes to compute an inertia from: add a <collision> or <visual> first"
            )
        others = "collision" if kind == "visual" else "visual"
        raise ResourceError(
            f"link `{link.name}` has no {kind} shapes to compute from; it has {others} shapes: --from {others}"
        )
    notes: dict[str, None] = {}
    shapes: list[tuple[Geometry, Pose, Moments]] = []
    for item in items:
        if item.geometry is None:
            raise ResourceError(f"a {kind} shape of link `{link.name}` cannot be read: lint the file first")
        shapes.append((item.geometry, item.origin, _moments(item.geometry, model, notes)))
    whole, shared, mixed = union(shapes)
    if mixed:
        notes["overlaps of meshes with other shapes count twice"] = None
    if whole.volume <= 0.0:
        raise ResourceError(f"the {kind} shapes of link `{link.name}` have no volume")
    written = link.inertial.mass if link.inertial is not None else None
    if mass is None:
        mass = density * whole.volume if density is not None else written
    if mass is None or mass <= 0.0:
        raise ResourceError(f"link `{link.name}` has no mass to compute with: pass --mass or --density")
    frame = rotation_of(link.inertial.origin.rpy) if link.inertial is not None else UNROTATED
    return ComputedInertial(
        kind, len(items), whole.volume, shared, mass, whole.middle, whole.tensor(mass, frame), tuple(notes)
    )


def _moments(geometry: Geometry, model: Model, notes: dict[str, None]) -> Moments:
    if not isinstance(geometry, Mesh):
        return of_primitive(geometry)
    from urdfkit.meshes.loader import MeshLoader
    from urdfkit.meshes.mesh_moments import moments

    path = model.expanded.packages.resolve(geometry.uri.strip(), model.expanded.path)
    found, note = moments(MeshLoader().load(path, geometry.scale), path.name)
    if note:
        notes[note] = None
    return found


def written(value: float, largest: float) -> str:
    """Format a number with six digits; values that are rounding errors relative to `largest` become 0."""
    return "0" if abs(value) < 1e-9 * abs(largest) or value == 0.0 else f"{value:.6g}"


def edits(model: Model, link: Link, value: ComputedInertial) -> list[Edit]:
    """Return the edits that write the computed values into the ``<inertial>`` of the source.

    Raises:
        UrdfkitError: several links share the source of the ``<inertial>`` (macro or include), or the source has no
            element to write to.
    """
    reach = max(abs(value.volume) ** (1.0 / 3.0), *map(abs, value.xyz))
    largest = max(value.tensor)
    texts = {
        "origin": {"xyz": " ".join(written(part, 1e3 * reach) for part in value.xyz)},
        "mass": {"value": written(value.mass, value.mass)},
        "inertia": {n: written(part, largest) for n, part in zip(COMPONENTS, value.tensor, strict=True)},
    }
    inertial = link.element.find("inertial")
    if inertial is None:
        return [_new_block(model, link, texts)]
    found: list[Edit] = []
    missing: list[str] = []
    for tag, attributes in texts.items():
        children = list(inertial.find_all(tag))
        if len(children) > 1:
            raise UrdfkitError(
                f"link `{link.name}` has {len(children)} <{tag}>: remove one first", position=_at(children[1])
            )
        if children:
            found += _replaced(model, link, children[0], attributes)
        elif tag != "origin" or any(abs(part) > 1e-6 * reach for part in value.xyz):
            missing.append(_element(tag, attributes))
    if missing:
        found.append(_inserted(model, link, inertial, missing))
    return found


def _at(element: Element) -> Position:
    return element.origin.position


def _alone(model: Model, link: Link, element: Element) -> Tag:
    """Return the source tag of an element, which must belong to this link only.

    Raises:
        UrdfkitError: the tag is in a macro with several calls, so other links share it.
    """
    position = element.origin.position
    same = [other for other in model.robot.element.walk() if other.origin.position == position]
    if len(same) > 1:
        chain = element.origin.expansions
        macro = f"macro `{chain[0].macro}`" if chain else "a place"
        message = f"<{element.tag}> of link `{link.name}` is written in {macro} that has {len(same)} expansions: "
        message += "give the macro parameters for it, or write <inertial> into the link"
        raise UrdfkitError(message, position=position)
    tag = model.tag(position)
    if tag is None or tag.name != element.tag:
        raise UrdfkitError(f"<{element.tag}> of link `{link.name}` is not written at this position", position=position)
    return tag


def _replaced(model: Model, link: Link, element: Element, values: dict[str, str]) -> Iterator[Edit]:
    tag = _alone(model, link, element)
    source = model.document(element.origin.position.file).source
    absent = []
    for name, text in values.items():
        attribute = tag.attributes.get(name)
        if attribute is None:
            if not (name == "xyz" and set(text.split()) == {"0"}):
                absent.append(f'{name}="{text}"')
        elif not _same(element.get(name), text):
            yield Edit(source.span(attribute.value_start, attribute.value_end), text)
    if absent:
        end = max((attribute.end for attribute in tag.attributes.values()), default=tag.start + 1 + len(tag.name))
        yield Edit(source.span(end, end), f" {' '.join(absent)}")


def _same(text: str | None, other: str) -> bool:
    """Return whether two texts contain equal numbers to six digits."""
    from urdfkit.description.xml.numbers import numbers

    values, others = numbers(text or ""), numbers(other)
    return (
        values is not None
        and others is not None
        and len(values) == len(others)
        and all(abs(a - b) <= 1e-6 * abs(b) for a, b in zip(values, others, strict=True))
    )


def _element(tag: str, attributes: dict[str, str]) -> str:
    return f"<{tag} {' '.join(f'{name}={chr(34)}{text}{chr(34)}' for name, text in attributes.items())}/>"


def _indent(source: Source, start: int) -> str:
    before = source.line_before(start)
    return before if not before.strip() else ""


def _inserted(model: Model, link: Link, inertial: Element, elements: list[str]) -> Edit:
    tag = _alone(model, link, inertial)
    source = model.document(inertial.origin.position.file).source
    if tag.close is None:
        raise UrdfkitError(f"<inertial> of link `{link.name}` is empty: write it out first", position=_at(inertial))
    if tag.children:
        place = tag.children[-1].close_end
        indent = _indent(source, tag.children[-1].start)
    else:
        place, indent = tag.end, f"{_indent(source, tag.start)}  "
    return Edit(source.span(place, place), "".join(f"{source.line_end}{indent}{element}" for element in elements))


def _new_block(model: Model, link: Link, texts: dict[str, dict[str, str]]) -> Edit:
    tag = _alone(model, link, link.element)
    source = model.document(link.element.origin.position.file).source
    outer = _indent(source, tag.start)
    inner = f"{outer}  "
    if tag.children and not source.line_before(tag.children[0].start).strip():
        inner = _indent(source, tag.children[0].start)
    step = inner.removeprefix(outer) or "  "
    lines = [f"{inner}<inertial>", *(f"{inner}{step}{_element(t, a)}" for t, a in texts.items()), f"{inner}</inertial>"]
    block = "".join(f"{source.line_end}{line}" for line in lines)
    if tag.close is None:  # <link name="…"/>
        end = len(source.text[: tag.end - 2].rstrip())
        return Edit(source.span(end, tag.end), f">{block}{source.line_end}{outer}</link>")
    return Edit(source.span(tag.end, tag.end), block)
