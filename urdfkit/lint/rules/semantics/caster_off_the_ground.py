"""S908 caster-off-the-ground."""

import re
from math import degrees, hypot, sqrt

from urdfkit.description.urdf.geometry import rotate, unit
from urdfkit.description.urdf.robot import (
    Box,
    Capsule,
    Collision,
    Cylinder,
    Geometry,
    Joint,
    Link,
    Mesh,
    Sphere,
    Vector,
    Visual,
)
from urdfkit.description.xml.element import Element
from urdfkit.description.xml.source import Position
from urdfkit.lint.facts.gazebo.rolling_wheels import WheelPairs, is_lifted, pairs_of_wheels, rolling_wheels
from urdfkit.lint.facts.root_cause import is_not_positive, root_cause
from urdfkit.lint.model.placement import Frame
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule

_CASTER_NAME = re.compile(r"cast[eo]r|ball", re.IGNORECASE)
_STEERED_BY = re.compile(r"steering_?wheel|fly_?wheel|spare|water", re.IGNORECASE)
"""Names of wheels that do not touch the ground."""

_MAX_TILT = 0.06
"""Largest accepted tilt [rad]; robots that are tilted by design stay below it."""

_MAX_DEPTH = 0.05
"""Largest accepted depth of a link below the wheels, as a fraction of the wheel radius."""

_MAX_CASTER = 1.5
"""Largest accepted ratio of the radius of a caster to that of the drive wheels."""

_UPRIGHT = 0.99
"""Cosine of the angle up to which an axis counts as vertical."""

_MAX_PENETRATION = 0.01
"""Depth by which wheels may penetrate the floor [m]."""


class CasterOffTheGround(RobotRule):
    """The caster of a robot with two drive wheels is above or below the ground.

    ## What it does
    Compares the lowest points of the drive wheels with the lowest points of the other links, with every joint at zero
    and the root link level. A caster, recognised by its name or the name of its joint, or another wheel is reported if
    it would tilt the robot by more than 3.4°. A caster is also reported if its radius is more than 1.5 times that of
    the drive wheels. Any link is reported if it extends below the drive wheels by more than a twentieth of their
    radius. In robots without a Gazebo drive, each pair of a left and a right wheel counts as drive wheels.

    The rule uses the collision shapes of a link, or its visual shapes if it has no collision shapes. It does not check
    meshes, links that a joint raises or lowers, links that are not connected to the root link, or a floor below the
    robot.

    ## Why is this bad?
    The robot tips onto its caster when the simulation starts, or its wheels lose contact with the ground: the robot
    jumps, drifts, or does not move.

    ## Example
    ```diff
     <robot name="cart">
       <link name="base"/>
       <link name="left"><visual><geometry><sphere radius="0.1"/></geometry></visual></link>
       <link name="right"><visual><geometry><sphere radius="0.1"/></geometry></visual></link>
       <link name="caster"><visual><geometry><sphere radius="0.05"/></geometry></visual></link>
       <joint name="left_joint" type="fixed">
         <parent link="base"/><child link="left"/><origin xyz="0 0.2 0"/>
       </joint>
       <joint name="right_joint" type="fixed">
         <parent link="base"/><child link="right"/><origin xyz="0 -0.2 0"/>
       </joint>
       <joint name="caster_joint" type="fixed">
    -    <parent link="base"/><child link="caster"/><origin xyz="-0.3 0 0"/>
    +    <parent link="base"/><child link="caster"/><origin xyz="-0.3 0 -0.05"/>
       </joint>
       <gazebo>
         <plugin name="gz::sim::systems::DiffDrive" filename="gz-sim-diff-drive-system">
           <left_joint>left_joint</left_joint>
           <right_joint>right_joint</right_joint>
           <wheel_separation>0.4</wheel_separation>
           <wheel_radius>0.1</wheel_radius>
         </plugin>
       </gazebo>
     </robot>
    ```
    """

    code = "S908"
    name = "caster-off-the-ground"
    severity = "warning"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each link below the ground, and for a caster above it."""
        if model.is_incomplete:
            return
        parents = {joint.child: joint for joint in model.robot.joints}
        for drive in pairs_of_wheels(model):
            wheels = (*drive.left, *drive.right)
            if any(is_lifted(wheel.joint, parents, model) for wheel in wheels):
                continue
            if any(not wheel.radii or max(wheel.radii) <= 0.0 or wheel.radii != wheels[0].radii for wheel in wheels):
                continue
            heights = [wheel.place[2] - max(wheel.radii) for wheel in wheels]
            if max(heights) - min(heights) > 1e-3 * max(wheels[0].radii):
                continue  # Intended, or reported by drive-wheels-misaligned.
            yield from self._check_supports(model, drive, min(heights), max(wheels[0].radii))

    def _check_supports(self, model: Model, drive: WheelPairs, ground: float, radius: float) -> Findings:
        driven = {wheel.joint.child for wheel in (*drive.left, *drive.right)}
        centre = [sum(wheel.place[i] for wheel in (*drive.left, *drive.right)) / (2 * len(drive.left)) for i in (0, 1)]
        supports: list[tuple[float, float, Joint]] = []
        parent_joint = {joint.child: joint for joint in model.robot.joints}
        root = _root(parent_joint, drive.left[0].joint)
        rolling = {wheel.joint.child for wheel in rolling_wheels(model) if not _STEERED_BY.search(wheel.joint.name)}
        for link in model.robot.links:
            frame = model.frames.get(link.name)
            found = _lowest(link, frame) if frame is not None and link.name not in driven else None
            lowest, shape = found if found is not None else (None, None)
            joint = parent_joint.get(link.name)
            if lowest is None or frame is None or not _is_rigid(model, parent_joint, link):
                continue
            if root != (link.name if joint is None else _root(parent_joint, joint)):
                continue  # Its position is unknown, because a parent link is missing; other rules report this.
            if joint is None and _is_floor(link, frame, drive, ground):
                continue
            element = joint.element if joint is not None else link.element
            gap, distance = lowest[2] - ground, hypot(lowest[0] - centre[0], lowest[1] - centre[1])
            is_caster = joint is not None and _CASTER_NAME.search(f"{link.name} {joint.name}") is not None
            size = max(_radius(each.geometry) for each in link.collisions or link.visuals)
            if is_caster and size > _MAX_CASTER * radius:
                message = (
                    f"caster `{link.name}` has a radius of {size:.3g} m, but that of the drive wheels is {radius:.3g} m"
                )
                help = "check the decimal point and the unit of the radius"
                yield self.at(model, element, message, attribute="name", link=link.name, help=help)
            elif gap < -_MAX_DEPTH * radius:
                message = f"link `{link.name}` extends {-gap:.3g} m below the drive wheels and lifts them"
                # The wheels are attached to this link, so their own offsets are wrong.
                carried = _offset_between(link.name, drive.left[0].joint, parent_joint)
                what = "lower the wheels" if carried is not None else "raise the link or its shapes"
                help = f"{what} by {-gap:.3g} m"
                wheels = tuple(wheel.joint.child or "" for wheel in (*drive.left, *drive.right))
                # The other shapes of the link are above the ground, so the place of this one is wrong.
                is_only = shape is not None and (len(link.collisions) == len(link.visuals) == 1 and _differ(link))
                origin = (carried or joint.element.find("origin")) if joint is not None else None
                place = shape.element.find("origin") or shape.element if shape is not None and is_only else element
                attribute = None if is_only else "name"
                position: Element | Position = place
                if origin is not None and not is_only:
                    cause = root_cause(model, origin, "xyz", is_not_positive) if carried is not None else None
                    position, attribute = cause or (origin, "xyz")
                yield self.at(model, position, message, attribute=attribute, link=link.name, help=help, names=wheels)
            elif joint is None or len(drive.left) != 1:
                continue
            elif link.name in rolling or (is_caster and gap < 2.0 * radius):
                supports.append((gap / max(distance, 1e-3), gap, joint))
        for tilt, gap, joint in sorted(supports, key=lambda support: support[0])[:1]:
            if tilt > _MAX_TILT:
                message = (
                    f"link `{joint.child}` is {gap:.3g} m above the ground, so the robot tips by {degrees(tilt):.3g}°"
                )
                origin = joint.element.find("origin")
                place = joint.element if origin is None else origin
                attribute = "name" if origin is None else "xyz"
                help = f"lower the link by {gap:.3g} m"
                yield self.at(model, place, message, attribute=attribute, link=joint.child, joint=joint.name, help=help)


def _root(parent_joint: dict[str | None, Joint], joint: Joint) -> str | None:
    """Return the root link of the tree that contains a joint; `parent_joint` maps a child link to its joint."""
    seen: set[str | None] = set()
    while joint.parent in parent_joint and joint.parent not in seen:
        seen.add(joint.parent)
        joint = parent_joint[joint.parent]
    return joint.parent


def _offset_between(link: str, wheel: Joint, parent_joint: dict[str | None, Joint]) -> Element | None:
    """Return the ``<origin>`` with the largest z between a wheel and a link that carries it; None if it does not."""
    path: list[Joint] = []
    joint: Joint | None = wheel
    while joint is not None and joint not in path:
        path.append(joint)
        if joint.parent == link:
            return max(path, key=lambda each: abs(each.origin.xyz[2])).element.find("origin")
        joint = parent_joint.get(joint.parent)
    return None


def _is_rigid(model: Model, parent_joint: dict[str | None, Joint], link: Link) -> bool:
    """Return whether no joint raises or lowers a link; an arm may hang down with its joints at zero."""
    seen: set[str | None] = set()
    name: str | None = link.name
    while name in parent_joint and name not in seen:
        seen.add(name)
        joint = parent_joint[name]
        frame = model.frames.get(name or "")
        axis = unit(rotate(frame.rotation, joint.axis)) if frame is not None else None
        if joint.type in ("prismatic", "planar", "floating"):
            return False
        if joint.is_movable and (axis is None or abs(axis[2]) < _UPRIGHT):
            shapes = [shape.geometry for shape in link.collisions or link.visuals]
            is_wheel = joint.type == "continuous" and name == link.name
            if not (is_wheel and all(isinstance(shape, (Cylinder, Sphere)) for shape in shapes)):
                return False
        name = joint.parent
    return True


def _radius(shape: Geometry | None) -> float:
    return shape.radius if isinstance(shape, (Cylinder, Sphere)) else 0.0


def _is_floor(link: Link, frame: Frame, drive: WheelPairs, ground: float) -> bool:
    """Return whether a link is a box below all wheels of a drive and extends beyond them."""
    boxes = [(shape.geometry, frame.moved(shape.origin)) for shape in link.collisions or link.visuals]
    for shape, pose in boxes:
        x, y, z = pose.translation
        if (
            not isinstance(shape, Box)
            or pose.rotation[2][2] < _UPRIGHT
            or z + shape.size[2] / 2.0 > ground + _MAX_PENETRATION
        ):
            continue
        reach = min(shape.size[:2]) / 2.0
        if all(hypot(wheel.place[0] - x, wheel.place[1] - y) < reach for wheel in (*drive.left, *drive.right)):
            return True
    return False


def _lowest(link: Link, frame: Frame) -> tuple[Vector, Visual | Collision] | None:
    """Return the lowest point of a link in the root frame [m] and its shape; None without shapes or with meshes."""
    points: list[tuple[Vector, Visual | Collision]] = []
    for shape in link.collisions or link.visuals:
        geometry = shape.geometry
        if not link.collisions and any(shape.origin.xyz):
            return None  # A visual shape with an offset does not show where the link touches the ground.
        if geometry is None or isinstance(geometry, Mesh):
            return None
        pose = frame.moved(shape.origin)
        up = pose.rotation[2]
        if isinstance(geometry, Box):
            depth = sum(abs(part * size) / 2.0 for part, size in zip(up, geometry.size, strict=True))
        elif isinstance(geometry, Cylinder):
            depth = abs(up[2]) * geometry.length / 2.0 + geometry.radius * sqrt(max(0.0, 1.0 - up[2] ** 2))
        else:
            assert isinstance(geometry, (Capsule, Sphere))
            length = geometry.length if isinstance(geometry, Capsule) else 0.0
            depth = abs(up[2]) * length / 2.0 + geometry.radius
        x, y, z = pose.translation
        points.append(((x, y, z - depth), shape))
    return min(points, key=lambda point: point[0][2]) if points else None


def _differ(link: Link) -> bool:
    """Return whether the collision shape of a link is at another place than its visual shape."""
    return link.collisions[0].origin.xyz != link.visuals[0].origin.xyz
