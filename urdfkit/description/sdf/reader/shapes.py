"""Collisions and visuals of SDF: geometry, surface, colour."""

from collections.abc import Callable
from math import sqrt

from urdfkit.defect_message import Suggestion
from urdfkit.description.plugins.gazebo_materials import unknown_material
from urdfkit.description.sdf.reader.reading_state import Context
from urdfkit.description.sdf.reader.vocabulary import note_unknown_elements
from urdfkit.description.sdf.shapes import Cone, Ellipsoid, Kept, Plane, Rgba, Surface, WorldGeometry, WorldShape, keep
from urdfkit.description.sdf.values import boolean, color, floats, name_of, positive, scalar, text, vector, wrong
from urdfkit.description.urdf.robot import Box, Capsule, Cylinder, Mesh, Pose, Sphere
from urdfkit.description.xml.element import Element
from urdfkit.errors import ResourceError, did_you_mean

_REFUSED = {
    "heightmap": "model the ground as boxes or as a mesh",
    "polyline": "extrude it to a mesh, or build it from boxes",
    "image": "build it from boxes",
}
LARGEST = 1e6
"""Largest accepted length [m]; double precision resolves 0.1 nm at this size."""
_READ = frozenset(
    (
        *("auto_inertia_params", "density", "frame", "geometry", "laser_retro", "material", "pose"),
        *("surface", "transparency"),
    )
)


def read_shape(context: Context, element: Element, pose: Pose) -> WorldShape | None:
    """Read a ``<collision>`` or ``<visual>``.

    Args:
        context: the file.
        element: the shape.
        pose: pose of the shape in its link.

    Returns:
        The shape; None if its geometry is ``<empty/>``, or for a visual with a missing mesh (with a note). A collision
        with a missing mesh (with a note) has no file.

    Raises:
        DescriptionError: the shape cannot be read, or its kind is not supported.
    """
    note_unknown_elements(context, element)
    name = name_of(element)
    found = _geometry(context, element)
    if found is None:
        return None
    geometry, file = found
    kept = tuple([keep(child) for child in element.children if child.tag not in _READ])
    position = element.origin.position
    retro = scalar(element, "laser_retro", 0.0)
    if element.tag == "collision":
        surface = _surface(context, element.find("surface"))
        return WorldShape(name, geometry, pose, surface, laser_retro=retro, file=file, kept=kept, position=position)
    rgba, material, more = _material(context, element)
    return WorldShape(
        name,
        geometry,
        pose,
        rgba=rgba,
        transparency=scalar(element, "transparency", 0.0),
        material=material,
        laser_retro=retro,
        file=file,
        kept=kept + more,
        position=position,
    )


def _geometry(context: Context, shape: Element) -> tuple[WorldGeometry, str] | None:
    element = shape.find("geometry")
    if element is None:
        raise wrong(shape, f"<{shape.tag}> has no <geometry>")
    note_unknown_elements(context, element)
    for child in element.children:
        if child.tag in _REFUSED:
            raise wrong(child, f"<{child.tag}> cannot be simulated; {_REFUSED[child.tag]}")
        if child.tag == "mesh":
            return _mesh(context, shape, child)
        if child.tag in _SOLIDS:
            solid = _SOLIDS[child.tag](child)
            if child.tag != "plane" and (largest := max(_lengths(solid))) > LARGEST:
                raise wrong(child, f"<{child.tag}> is {largest:g} m large; at most {LARGEST:g} m can be simulated")
            return solid, ""
    if element.find("empty") is None and element.children:
        child = element.children[0]
        raise wrong(child, f"unknown geometry <{child.tag}>" + did_you_mean(child.tag, [*_SOLIDS, "mesh"]))
    return None


def _lengths(solid: WorldGeometry) -> tuple[float, ...]:
    if isinstance(solid, Box):
        return solid.size
    if isinstance(solid, Ellipsoid):
        return solid.radii
    return tuple([each for name in ("radius", "length") if (each := getattr(solid, name, None)) is not None])


def _three(element: Element, tag: str, condition: str) -> tuple[float, float, float]:
    """Return three positive lengths [m]; without the child, those of sdformat's default (box_shape.sdf)."""
    child = element.find(tag)
    if child is None:
        return 1.0, 1.0, 1.0
    x, y, z = floats(child, 3)
    if min(x, y, z) <= 0:
        raise wrong(child, f"<{tag}> is `{child.text}`; every {condition} than zero")
    return x, y, z


def _plane(element: Element) -> Plane:
    x, y, z = vector(element, "normal", (0.0, 0.0, 1.0))
    length = sqrt(x * x + y * y + z * z)
    if length == 0:
        raise wrong(element, "<normal> of <plane> is zero")
    if abs(length - 1) > 1e-12:
        x, y, z = x / length, y / length, z / length
    size = element.find("size")
    width, depth = (1.0, 1.0) if size is None else floats(size, 2)
    return Plane((x, y, z), (width, depth))


_SOLIDS: dict[str, Callable[[Element], WorldGeometry]] = {
    "box": lambda element: Box(_three(element, "size", "edge must be longer")),
    "sphere": lambda element: Sphere(positive(element, "radius")),
    "cylinder": lambda element: Cylinder(positive(element, "radius"), positive(element, "length")),
    "capsule": lambda element: Capsule(positive(element, "radius"), positive(element, "length")),
    "cone": lambda element: Cone(positive(element, "radius"), positive(element, "length")),
    "ellipsoid": lambda element: Ellipsoid(_three(element, "radii", "radius must be greater")),
    "plane": _plane,
}


def _mesh(context: Context, shape: Element, element: Element) -> tuple[WorldGeometry, str] | None:
    from urdfkit.description.sdf.reader.uris import find_file

    uri = element.find("uri")
    if uri is None or not uri.text:
        raise wrong(element, "<mesh> has no <uri>")
    if element.find("submesh") is not None:
        if shape.tag == "collision":
            raise wrong(element, "<submesh> of a collision is not read; save the part as a separate mesh")
        context.note(element, "<submesh> is not read: the whole mesh is shown", "submesh")
    scale = vector(element, "scale", (1.0, 1.0, 1.0))
    if 0 in scale:
        raise wrong(element, "<scale> of <mesh> is zero")
    try:
        file = find_file(context, uri)
    except ResourceError as error:
        if shape.tag == "collision":
            what = f"{error.message}; collision `{shape.get('name')}` is ignored: it has no contacts"
            context.note(uri, what, "collision", error.package)
            return Mesh(uri.text, scale), ""
        what = f"visual `{shape.get('name')}` is not shown: {error.message}"
        context.note(uri, what, "visual", error.package)
        return None
    written = uri.text if "://" in uri.text else f"file://{file}"
    return Mesh(written, scale), str(file)


def _surface(context: Context, element: Element | None) -> Surface:
    if element is None:
        return Surface()
    note_unknown_elements(context, element)
    default = Surface()
    friction, contact, bounce = element.find("friction"), element.find("contact"), element.find("bounce")
    ode = None if friction is None else friction.find("ode")
    if ode is None and friction is not None and (bullet := friction.find("bullet")) is not None:
        first = scalar(bullet, "friction", default.mu)
        slide = first, scalar(bullet, "friction2", default.mu2)
        ode = bullet
    else:
        slide = scalar(ode, "mu", default.mu), scalar(ode, "mu2", default.mu2)
    push = None if contact is None else contact.find("ode")
    if friction is not None and min(slide) < 0:
        raise wrong(friction, f"friction {min(slide):g} is negative")
    return Surface(
        mu=slide[0],
        mu2=slide[1],
        fdir1=vector(ode, "fdir1", default.fdir1),
        slip1=scalar(ode, "slip1", default.slip1),
        slip2=scalar(ode, "slip2", default.slip2),
        kp=scalar(push, "kp", default.kp),
        kd=scalar(push, "kd", default.kd),
        min_depth=scalar(push, "min_depth", default.min_depth),
        max_vel=scalar(push, "max_vel", default.max_vel),
        restitution=scalar(bounce, "restitution_coefficient", default.restitution),
        bounce_threshold=scalar(bounce, "threshold", default.bounce_threshold),
        collide_bitmask=_mask(contact, default.collide_bitmask),
        collide_without_contact=boolean(contact, "collide_without_contact", default.collide_without_contact),
    )


def _mask(contact: Element | None, default: int) -> int:
    child = None if contact is None else contact.find("collide_bitmask")
    if child is None:
        return default
    try:
        return int(child.text, 0) & 0xFFFFFFFF
    except ValueError:
        raise wrong(child, f"<collide_bitmask> is `{child.text}`; it must be a whole number") from None


def _material(context: Context, visual: Element) -> tuple[Rgba | None, str, tuple[Kept, ...]]:
    """Return colour, name of the script, and the material itself if it has further content."""
    element = visual.find("material")
    if element is None:
        return None, "", ()
    ambient = color(element, "ambient", None)
    rgba = color(element, "diffuse", ambient)
    script = element.find("script")
    if (strange := unknown_material(element)) is not None:
        place, name, meant = strange
        hint = Suggestion(meant)
        then = "; the visual keeps its plain colour" if rgba is None else ""
        context.note(place, f"no material `{name}`{then}" + hint, "material")
    plain = ambient in (None, rgba) and all(
        child.tag in ("ambient", "diffuse") or (child.tag == "script" and _is_gazebos(child))
        for child in element.children
    )
    return rgba, text(script, "name"), () if plain else (keep(element),)


def _is_gazebos(script: Element) -> bool:
    return all(child.tag in ("name", "uri") for child in script.children) and text(script, "name").startswith("Gazebo/")
