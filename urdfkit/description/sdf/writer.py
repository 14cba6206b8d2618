"""to_sdf: write a world as SDF that sdformat accepts and that loads as an equal world."""

from collections.abc import Sequence
from math import isfinite
from pathlib import Path

from urdfkit.description.sdf.model import WorldAxis, WorldInertial, WorldJoint, WorldLink, WorldModel
from urdfkit.description.sdf.sdf_text import Markup, figure
from urdfkit.description.sdf.shapes import Cone, Ellipsoid, Light, Surface, WorldGeometry, WorldShape
from urdfkit.description.sdf.world import Physics, World
from urdfkit.description.urdf.robot import Box, Capsule, Cylinder, Mesh, Sphere
from urdfkit.errors import DescriptionError

VERSION = "1.9"
"""The SDF version written, unless the world has newer features."""


def to_sdf(world: World) -> str:
    """Return a world as SDF. `load_world` reads an equal world from it, unless its meshes have been moved.

    Raises:
        DescriptionError: a name, or a character in it, cannot be written in SDF.
    """
    out = Markup()
    with out.inside("sdf", version=_version(world.models, world.joints)), out.inside("world", name=world.name):
        default = World("")
        out.numbers("gravity", world.gravity)
        out.numbers("magnetic_field", world.magnetic_field, default.magnetic_field)
        _physics(out, world.physics)
        for light in world.lights:
            _light(out, light)
        for model in world.models:
            _model(out, model)
        for robot in world.robots:
            with out.inside("include"):
                out.put("uri", robot.uri)
                out.put("name", _name(robot.name))
                out.truth("static", robot.static, False)
                out.pose(robot.pose)
                out.keep(robot.kept)
        for joint in world.joints:
            _joint(out, joint)
        out.keep(world.kept)
    return out.text()


def model_to_sdf(model: WorldModel) -> str:
    """Return a model as a separate SDF file.

    Raises:
        DescriptionError: a name, or a character in it, cannot be written in SDF.
    """
    out = Markup()
    with out.inside("sdf", version=_version((model,), ())):
        _model(out, model)
    return out.text()


def save_world(world: World, path: str | Path) -> None:
    """Write a world to a file, atomically.

    Raises:
        DescriptionError: the world cannot be written in SDF.
        OSError: the file cannot be written.
    """
    from urdfkit.atomic import write_text

    write_text(Path(path), to_sdf(world))


def _version(models: Sequence[WorldModel], joints: Sequence[WorldJoint]) -> str:
    """Return the oldest version from 1.9 on that supports all elements: world joints 1.10, cones and mimic 1.11."""
    shapes = (s for model in models for _, _, link in model.all_links() for s in (*link.collisions, *link.visuals))
    axes = (axis for model in models for _, joint in model.all_joints() for axis in joint.axes)
    if any(isinstance(shape.geometry, Cone) for shape in shapes) or any(axis.mimic is not None for axis in axes):
        return "1.11"
    return "1.10" if joints else VERSION


def _name(name: str) -> str:
    if " ".join(name.split()) != name:  # sdformat collapses white space in texts, so joints would not find their links
        raise DescriptionError(f"the name {name!r} cannot be written in SDF: use single spaces")
    if not name or "::" in name or name == "world" or (name.startswith("__") and name.endswith("__")):
        why = "it is empty" if not name else "`::` separates models" if "::" in name else "it is reserved"
        raise DescriptionError(f"the name `{name}` cannot be written in SDF: {why}")
    return name


def _physics(out: Markup, physics: Physics) -> None:
    if physics == Physics():
        return
    with out.inside("physics", name=physics.name, type=physics.engine):
        out.number("max_step_size", physics.max_step_size)
        out.number("real_time_factor", physics.real_time_factor)
        out.number("real_time_update_rate", physics.real_time_update_rate)
        out.keep(physics.kept)


def _light(out: Markup, light: Light) -> None:
    default = Light("")
    with out.inside("light", name=_name(light.name), type=light.type):
        out.pose(light.pose)
        out.truth("cast_shadows", light.cast_shadows, default.cast_shadows)
        out.number("intensity", light.intensity, default.intensity)
        out.numbers("diffuse", light.diffuse, default.diffuse)
        out.numbers("specular", light.specular, default.specular)
        if light.attenuation != default.attenuation:
            with out.inside("attenuation"):
                for tag, value in zip(("range", "constant", "linear", "quadratic"), light.attenuation, strict=True):
                    out.number(tag, value)
        out.numbers("direction", light.direction)
        if light.spot != default.spot:
            with out.inside("spot"):
                for tag, value in zip(("inner_angle", "outer_angle", "falloff"), light.spot, strict=True):
                    out.number(tag, value)
        out.keep(light.kept)


def _model(out: Markup, model: WorldModel) -> None:
    if not (model.static or model.links or model.models):
        raise DescriptionError(f"model `{model.name}` cannot be written in SDF: it has no link and is not static")
    with out.inside("model", name=_name(model.name), canonical_link=model.canonical_link):
        out.pose(model.pose)
        out.truth("static", model.static, False)
        out.truth("self_collide", model.self_collide, False)
        for link in model.links:
            _link(out, link)
        for nested in model.models:
            _model(out, nested)
        for joint in model.joints:
            _joint(out, joint)
        out.keep(model.kept)


def _link(out: Markup, link: WorldLink) -> None:
    with out.inside("link", name=_name(link.name)):
        out.pose(link.pose)
        _inertial(out, link.inertial)
        out.truth("gravity", link.gravity, True)
        if link.self_collide is not None:
            out.truth("self_collide", link.self_collide)
        out.truth("kinematic", link.kinematic, False)
        if any(link.damping):
            with out.inside("velocity_decay"):
                out.number("linear", link.damping[0])
                out.number("angular", link.damping[1])
        for shape in link.collisions:
            with out.inside("collision", name=_name(shape.name)):
                _shape(out, shape)
                _surface(out, shape.surface)
                out.keep(shape.kept)
        for shape in link.visuals:
            with out.inside("visual", name=_name(shape.name)):
                _shape(out, shape)
                _look(out, shape)
                out.keep(shape.kept)
        for light in link.lights:
            _light(out, light)
        out.keep(link.kept)


def _inertial(out: Markup, body: WorldInertial) -> None:
    if body == WorldInertial():
        return
    with out.inside("inertial"):
        out.pose(body.pose)
        out.number("mass", body.mass)
        with out.inside("inertia"):
            for tag in ("ixx", "ixy", "ixz", "iyy", "iyz", "izz"):
                out.number(tag, getattr(body, tag))


def _shape(out: Markup, shape: WorldShape) -> None:
    out.pose(shape.pose)
    out.number("laser_retro", shape.laser_retro, 0.0)
    with out.inside("geometry"):
        _geometry(out, shape.geometry)


def _geometry(out: Markup, geometry: WorldGeometry) -> None:
    with out.inside(type(geometry).__name__.lower()):
        if isinstance(geometry, Box):
            out.numbers("size", geometry.size)
        elif isinstance(geometry, Sphere):
            out.number("radius", geometry.radius)
        elif isinstance(geometry, Cylinder | Capsule | Cone):
            out.number("radius", geometry.radius)
            out.number("length", geometry.length)
        elif isinstance(geometry, Ellipsoid):
            out.numbers("radii", geometry.radii)
        elif isinstance(geometry, Mesh):
            out.put("uri", geometry.uri)
            out.numbers("scale", geometry.scale, (1.0, 1.0, 1.0))
        else:
            out.numbers("normal", geometry.normal)
            out.numbers("size", geometry.size)


def _look(out: Markup, shape: WorldShape) -> None:
    out.number("transparency", shape.transparency, 0.0)
    if any(each.element.tag == "material" for each in shape.kept) or not (shape.rgba or shape.material):
        return
    with out.inside("material"):
        if shape.material:
            with out.inside("script"):
                out.put("uri", "file://media/materials/scripts/gazebo.material")
                out.put("name", shape.material)
        if shape.rgba is not None:
            out.numbers("ambient", shape.rgba)
            out.numbers("diffuse", shape.rgba)


def _surface(out: Markup, surface: Surface) -> None:
    if surface == (default := Surface()):
        return
    with out.inside("surface"):
        if (surface.restitution, surface.bounce_threshold) != (default.restitution, default.bounce_threshold):
            with out.inside("bounce"):
                out.number("restitution_coefficient", surface.restitution)
                out.number("threshold", surface.bounce_threshold)
        with out.inside("friction"), out.inside("ode"):
            out.number("mu", surface.mu)
            out.number("mu2", surface.mu2)
            out.numbers("fdir1", surface.fdir1, default.fdir1)
            out.number("slip1", surface.slip1, default.slip1)
            out.number("slip2", surface.slip2, default.slip2)
        with out.some("contact"):
            out.truth("collide_without_contact", surface.collide_without_contact, False)
            if surface.collide_bitmask != default.collide_bitmask:
                out.put("collide_bitmask", str(surface.collide_bitmask))
            with out.some("ode"):
                for tag in ("kp", "kd", "max_vel", "min_depth"):
                    out.number(tag, getattr(surface, tag), getattr(default, tag))


def _joint(out: Markup, joint: WorldJoint) -> None:
    with out.inside("joint", name=_name(joint.name), type=joint.type):
        out.put("parent", joint.parent)
        out.put("child", joint.child)
        out.pose(joint.pose)
        for tag, axis in zip(("axis", "axis2"), joint.axes, strict=False):
            with out.inside(tag):
                _axis(out, axis)
        out.keep(joint.kept)


def _axis(out: Markup, axis: WorldAxis) -> None:
    out.numbers("xyz", axis.xyz)
    limits = [(tag, getattr(axis, tag)) for tag in ("lower", "upper", "effort", "velocity")]
    with out.some("limit"):
        for tag, value in limits:
            if isfinite(value):
                out.put(tag, figure(value))
    with out.some("dynamics"):
        for tag in ("damping", "friction", "spring_reference", "spring_stiffness"):
            out.number(tag, getattr(axis, tag), 0.0)
    if axis.mimic is not None:
        with out.inside("mimic", joint=axis.mimic.joint):
            for tag in ("multiplier", "offset", "reference"):
                out.put(tag, figure(getattr(axis.mimic, tag)))
