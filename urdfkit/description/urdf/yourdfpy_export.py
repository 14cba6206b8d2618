"""Robot → ``yourdfpy.URDF``, element by element."""

from pathlib import Path
from typing import Any

import numpy as np

from urdfkit.description.urdf.shapes import Box, Capsule, Cylinder, Mesh, Pose, Sphere
from urdfkit.errors import MissingDependencyError, ResourceError

try:
    import yourdfpy
    from trimesh.transformations import euler_matrix, translation_matrix
except ImportError as error:
    raise MissingDependencyError("to_yourdfpy needs yourdfpy: pip install yourdfpy") from error


def yourdfpy_of(robot: Any, **options: Any) -> Any:
    """Return a robot as ``yourdfpy.URDF``; see `Robot.to_yourdfpy`."""

    def resolve(fname: str) -> str:
        try:
            assert robot.packages is not None
            return str(robot.packages.resolve_in_any_case(fname, robot.files[0] if robot.files else Path("robot.urdf")))
        except ResourceError:
            return fname

    exported = yourdfpy.Robot(
        name=robot.name,
        links=[_link(link) for link in robot.link_by_name_in_order()],
        joints=[_joint(joint, robot) for joint in robot.joints if robot.joint_by_name[joint.name] is joint],
        materials=[_material(material) for material in robot.materials],
    )
    handler = {} if robot.packages is None else {"filename_handler": resolve}
    try:
        return yourdfpy.URDF(robot=exported, **{**handler, **options})
    except TypeError:  # an unknown option
        raise
    except Exception as error:  # any error of the reader of a mesh
        reason = next(iter(str(error).strip().splitlines()), "") or type(error).__name__
        without = "`to_yourdfpy(load_meshes=False)` exports the robot without its meshes"
        raise ResourceError(f"robot `{robot.name}`: yourdfpy cannot read a mesh ({reason}); {without}") from error


def _link(link: Any) -> Any:
    return yourdfpy.Link(
        link.name,
        None if link.inertial is None else _inertial(link.inertial),
        [
            yourdfpy.Visual(name, origin, geometry, None if item.material is None else _material(item.material))
            for item in link.visuals
            for name, origin, geometry in _shapes(item)
        ],
        [yourdfpy.Collision(*shape) for item in link.collisions for shape in _shapes(item)],
    )


def _inertial(inertial: Any) -> Any:
    tensor = None if inertial.inertia is None else np.array(inertial.inertia.rows)
    return yourdfpy.Inertial(_matrix(inertial.origin), inertial.mass, tensor)


def _shapes(item: Any) -> list[tuple[str | None, Any, Any]]:
    """Return name, origin and geometry; a capsule is a cylinder and two spheres."""
    shape, origin = item.geometry, _matrix(item.origin)
    if isinstance(shape, Capsule):
        ball = yourdfpy.Geometry(sphere=yourdfpy.Sphere(shape.radius))
        ends = [origin @ translation_matrix([0.0, 0.0, side * shape.length / 2.0]) for side in (-1.0, 1.0)]
        middle = yourdfpy.Geometry(cylinder=yourdfpy.Cylinder(shape.radius, shape.length))
        return [(item.name, origin, middle), *((None, end, ball) for end in ends)]
    geometry = None
    if isinstance(shape, Box):
        geometry = yourdfpy.Geometry(box=yourdfpy.Box(np.array(shape.size)))
    elif isinstance(shape, Cylinder):
        geometry = yourdfpy.Geometry(cylinder=yourdfpy.Cylinder(shape.radius, shape.length))
    elif isinstance(shape, Sphere):
        geometry = yourdfpy.Geometry(sphere=yourdfpy.Sphere(shape.radius))
    elif isinstance(shape, Mesh):
        geometry = yourdfpy.Geometry(mesh=yourdfpy.Mesh(shape.uri, np.array(shape.scale)))
    return [(item.name, origin, geometry)]


def _material(material: Any) -> Any:
    return yourdfpy.Material(
        material.name,
        None if material.rgba is None else yourdfpy.Color(np.array(material.rgba)),
        None if material.texture is None else yourdfpy.Texture(material.texture),
    )


def _joint(joint: Any, robot: Any) -> Any:
    limit, dynamics, safety, calibration = joint.limit, joint.dynamics, joint.safety_controller, joint.calibration
    axis = np.array(joint.axis, dtype=float)
    return yourdfpy.Joint(
        joint.name,
        joint.type,
        joint.parent,
        joint.child,
        _matrix(joint.origin),
        axis / np.linalg.norm(axis) if joint.has_axis else axis,  # yourdfpy slides along the axis as written
        None if dynamics is None else yourdfpy.Dynamics(dynamics.damping, dynamics.friction),
        None if limit is None else yourdfpy.Limit(limit.effort, limit.velocity, limit.lower, limit.upper),
        _mimic(joint, robot),
        None if calibration is None else yourdfpy.Calibration(calibration.rising, calibration.falling),
        None
        if safety is None
        else yourdfpy.SafetyController(
            safety.soft_lower_limit, safety.soft_upper_limit, safety.k_position, safety.k_velocity
        ),
    )


def _mimic(joint: Any, robot: Any) -> Any:
    """Return the law that couples a joint to an independent one: yourdfpy does not follow several in a row."""
    if joint.mimic is None or not joint.is_movable:
        return None
    name, multiplier, offset = joint.mimic.joint, joint.mimic.multiplier, joint.mimic.offset
    seen = {joint.name}
    while (master := robot.joint_by_name.get(name)) is not None and master.mimic is not None and name not in seen:
        seen.add(name)
        name = master.mimic.joint
        multiplier, offset = multiplier * master.mimic.multiplier, multiplier * master.mimic.offset + offset
    return yourdfpy.Mimic(name, multiplier, offset)


def _matrix(pose: Pose) -> Any:
    matrix = euler_matrix(*pose.rpy, axes="sxyz")
    matrix[:3, 3] = pose.xyz
    return matrix
