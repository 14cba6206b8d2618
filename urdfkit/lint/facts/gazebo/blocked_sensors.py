"""Cameras and lidars whose view is blocked by the robot: the sensor is inside of a body, or faces one."""

from __future__ import annotations

from collections.abc import Iterator
from math import cos, dist, inf, isfinite, pi, sin

from urdfkit.description.urdf.attached_bodies import AttachedBodies
from urdfkit.description.urdf.geometry import rotate
from urdfkit.description.urdf.robot import Box, Cylinder, GazeboBlock, Geometry, Mesh, Pose, SensorTag, Sphere, Vector
from urdfkit.description.xml.element import Element
from urdfkit.description.xml.numbers import number, numbers
from urdfkit.lint.facts.placement.solids import depth, diagonal, half_sizes, local, turned_back
from urdfkit.lint.model.model import Model
from urdfkit.lint.model.placement import Frame

_LIDARS = ("ray", "gpu_ray", "lidar", "gpu_lidar")
_CAMERAS = ("camera", "depth", "depth_camera", "rgbd_camera", "wideanglecamera", "wide_angle_camera", "multicamera")

_HOUSING = 0.25
"""Largest diagonal of a shape around a sensor that is its housing [m]."""

_INSIDE = 0.01
"""Smallest depth below the surface of a body at which a sensor is inside of it [m]."""

_PLACED = 1e-6
"""Smallest distance of a sensor from the centre of a shape [m]; parts at one place have no origins yet."""

_RAYS = 37
_BLOCKED = 0.95
"""Number of directions of a lidar that are checked, and the part of them that a blocked lidar does not see beyond."""

_THIN = 0.15
"""Smallest ratio of the sizes of a box around a mesh that is not a plate, whose mesh may have an opening."""

_FACING = 0.25
"""Part of the directions of a lidar that a robot behind it hides, if the lidar faces the robot."""

_TILT = 0.15
"""Angle between the axis of a camera and the further directions that are checked [rad]."""

_NEAR = 1.0
"""Largest distance of a body that blocks a sensor [m]."""

Solid = tuple[str, Geometry, Frame, bool]
"""Link, shape, the pose of the shape in the root link, and whether it is not only around a mesh."""


def blocked_sensors(model: Model) -> Iterator[tuple[GazeboBlock, SensorTag, str, str | None]]:
    """Yield the sensors that see nothing but the robot, or face it: message, and the attribute of the wrong origin."""
    attached = AttachedBodies(model.robot)
    bodies: list[Solid] = []
    for block in model.robot.gazebo:
        for sensor in block.sensors:
            frame = model.frames.get(block.reference or "")
            kind = sensor.type or ""
            if frame is None or kind not in (*_LIDARS, *_CAMERAS):
                continue
            bodies = bodies or list(_solids(model))
            pose = _pose(sensor.element)
            if pose is None or model.is_unresolved(sensor.element):
                continue
            eye = frame.moved(pose)
            solids = [
                solid
                for solid in bodies
                if solid[0] != block.reference
                and attached.body_of(solid[0]) == attached.body_of(block.reference or "")
                and dist(solid[2].translation, eye.translation) > _PLACED
            ]
            shown = [solid for solid in solids if solid[3]]
            around = next(
                (name for name, shape, at, _ in shown if depth(shape, local(at, eye.translation)) > _INSIDE), None
            )
            if around is not None:
                yield block, sensor, f"sensor `{sensor.name}` is inside the shape of link `{around}`", "xyz"
                continue
            rays = _fan(sensor.element) if kind in _LIDARS else [(0.0, 0.0), *_AROUND]
            hit = [_first(shown, eye, *angles) for angles in rays]
            seen = [name for name in hit if name is not None]
            if len(seen) >= _BLOCKED * len(rays):
                yield block, sensor, f"sensor `{sensor.name}` faces only the shape of link `{seen[0]}`", None
                continue
            hit = [_first(solids, eye, *angles) for angles in rays] if kind in _LIDARS else []
            seen = [name for name in hit if name is not None]
            if kind in _LIDARS and len(seen) >= _FACING * len(rays) and not _sees_any(solids, eye, rays):
                part = f"{100.0 * len(seen) / len(rays):.0f} % of its view"
                message = f"sensor `{sensor.name}` faces link `{seen[0]}` in {part}; rotated by 180°, it faces no link"
                yield block, sensor, message, "rpy"


_AROUND = ((_TILT, 0.0), (-_TILT, 0.0), (0.0, _TILT), (0.0, -_TILT))
"""Yaw and pitch of further directions of a camera."""


def _solids(model: Model) -> Iterator[Solid]:
    """Yield the boxes, cylinders and spheres that are large enough to block a sensor.

    The collision shapes of a link with meshes stand for these, but may be larger.
    """
    for link in model.robot.links:
        frame = model.frames.get(link.name)
        has_mesh = any(isinstance(shape.geometry, Mesh) for shape in link.visuals)
        for shape in (link.collisions if has_mesh else link.visuals or link.collisions) if frame is not None else ():
            geometry = shape.geometry
            if frame is None or not isinstance(geometry, (Box, Cylinder, Sphere)) or diagonal(geometry) <= _HOUSING:
                continue
            sizes = half_sizes(geometry)
            if not has_mesh or min(sizes) >= _THIN * max(sizes):
                yield link.name, geometry, frame.moved(shape.origin), not has_mesh


def _pose(sensor: Element) -> Pose | None:
    """Return the pose of a sensor in its link; None if it is malformed, infinite or relative to another frame."""
    element = sensor.find("pose")
    if element is None:
        return Pose()
    values = numbers(element.text or "0 0 0 0 0 0")
    if values is None or len(values) != 6 or element.attributes or not all(map(isfinite, values)):
        return None
    return Pose((values[0], values[1], values[2]), (values[3], values[4], values[5]))


def _fan(sensor: Element) -> list[tuple[float, float]]:
    """Return the directions of a lidar: yaw, and zero pitch."""
    horizontal = next((each for each in sensor.walk() if each.tag == "horizontal"), None)
    limits = [horizontal.find(tag) if horizontal is not None else None for tag in ("min_angle", "max_angle")]
    low, high = ((number(each.text or "") if each is not None else None) for each in limits)
    first, last = (low, high) if low is not None and high is not None and isfinite(high - low) else (-pi, pi)
    return [(first + (last - first) * step / (_RAYS - 1), 0.0) for step in range(_RAYS)]


def _sees_any(solids: list[Solid], eye: Frame, rays: list[tuple[float, float]]) -> bool:
    """Return whether a lidar sees the robot if it is rotated by 180°."""
    return any(_first(solids, eye, yaw + pi, pitch) is not None for yaw, pitch in rays)


def _first(solids: list[Solid], eye: Frame, yaw: float, pitch: float) -> str | None:
    """Return the link that the ray in a direction of the sensor meets first; None if it meets none nearby."""
    direction = rotate(eye.rotation, (cos(pitch) * cos(yaw), cos(pitch) * sin(yaw), -sin(pitch)))
    found = [(_distance(shape, at, eye.translation, direction), name) for name, shape, at, _ in solids]
    distance, name = min(found, default=(inf, ""))
    return name if distance < _NEAR else None


def _distance(shape: Geometry, at: Frame, start: Vector, direction: Vector) -> float:
    """Return the distance along a ray to the box around a shape [m]; infinite if the ray misses it or starts inside."""
    point, heading = local(at, start), turned_back(at, direction)
    enter, leave = 0.0, inf
    for place, part, half in zip(point, heading, half_sizes(shape), strict=True):
        if abs(part) < 1e-12:
            if abs(place) > half:
                return inf
            continue
        near, far = sorted(((-half - place) / part, (half - place) / part))
        enter, leave = max(enter, near), min(leave, far)
    return enter if 0.0 < enter < leave else inf
