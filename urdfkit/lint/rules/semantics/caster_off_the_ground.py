"""S908 caster-off-the-ground."""

from __future__ import annotations

import re
from math import degrees, hypot, sqrt

from urdfkit.description.robot import Box, Capsule, Cylinder, Mesh, Sphere
from urdfkit.lint.placement import turned, unit
from urdfkit.lint.rule import NOT_GAZEBO, RobotRule
from urdfkit.lint.wheels import drives

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.description.robot import Joint, Link, Vector
    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model
    from urdfkit.lint.placement import Frame
    from urdfkit.lint.wheels import TwoSided

_SUPPORT = re.compile(r"cast[eo]r|ball", re.IGNORECASE)
_TILT = 0.06
"""[rad]: robots that stand so on purpose are tilted less."""

_DEEP = 0.1
"""Of the radius of a wheel: how far something reaches below the wheels where it cannot be meant."""

_UPRIGHT = 0.99
"""Cosine: what is less off is upright."""

_NEAR = 0.01
"""How far wheels may sink into what they stand on [m]."""


class CasterOffTheGround(RobotRule):
    """A robot with two driven wheels does not stand level: its caster is above or below what the wheels stand on.

    ## What it does
    Compares the lowest points of the wheels that a drive turns with those of the other links, every joint at zero and
    the root level. A caster (by its name, or that of its joint) that would tilt the robot by more than 3.4° is
    reported, and any link that reaches below the wheels by more than a tenth of their radius. Collision shapes count,
    or the visual ones where there are none. Left out are meshes, what a joint lifts or lowers, what hangs on nothing,
    and a floor that the robot stands on.

    ## Why is this bad?
    The robot tips onto its caster when the simulation starts, or its wheels lose the ground and turn in the air: it
    jumps, drifts, or does not move.

    ## Example
    ```xml
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
        <parent link="base"/><child link="caster"/><origin xyz="-0.3 0 0"/>
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

    ## Use instead
    ```xml
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
        <parent link="base"/><child link="caster"/><origin xyz="-0.3 0 -0.05"/>
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

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each link that is too low, or for a caster that is too high."""
        if model.is_incomplete or any(joint.type in ("prismatic", "planar") for joint in model.robot.joints):
            return
        for drive in drives(model):
            wheels = (*drive.left, *drive.right)
            if any(not wheel.radii or max(wheel.radii) <= 0.0 or wheel.radii != wheels[0].radii for wheel in wheels):
                continue
            heights = [wheel.place[2] - max(wheel.radii) for wheel in wheels]
            if max(heights) - min(heights) > 1e-3 * max(wheels[0].radii):
                continue  # That is a finding of drive-wheels-misaligned, or is meant.
            yield from self._off(model, drive, min(heights), max(wheels[0].radii))

    def _off(self, model: Model, drive: TwoSided, ground: float, radius: float) -> Iterator[Finding]:
        driven = {wheel.joint.child for wheel in (*drive.left, *drive.right)}
        mean = [sum(wheel.place[i] for wheel in (*drive.left, *drive.right)) / (2 * len(drive.left)) for i in (0, 1)]
        supports: list[tuple[float, float, Joint]] = []
        above = {joint.child: joint for joint in model.robot.joints}
        tree = _root(above, drive.left[0].joint)
        for link in model.robot.links:
            frame = model.frames.get(link.name)
            low = _lowest(link, frame) if frame is not None and link.name not in driven else None
            joint = above.get(link.name)
            if low is None or frame is None or not _is_rigid(model, above, link):
                continue
            if tree != (link.name if joint is None else _root(above, joint)):
                continue  # Nobody knows where it is: it hangs on nothing, which is a finding of its own.
            if joint is None and _is_floor(link, frame, drive, ground):
                continue
            place = joint.element if joint is not None else link.element
            gap, away = low[2] - ground, hypot(low[0] - mean[0], low[1] - mean[1])
            if gap < -_DEEP * radius:
                message = f"`{link.name}` reaches {-gap:.3g} m below the drive's wheels: they lose the ground"
                yield self.at(model, place, message, attribute="name", link=link.name)
            elif (
                joint is not None
                and len(drive.left) == 1
                and gap < 2.0 * radius
                and _SUPPORT.search(f"{link.name} {joint.name}")
            ):
                supports.append((gap / max(away, 1e-3), gap, joint))
        for tilt, gap, joint in sorted(supports, key=lambda support: support[0])[:1]:
            if tilt > _TILT:
                message = f"`{joint.child}` is {gap:.3g} m above the ground: the robot tips by {degrees(tilt):.3g}°"
                yield self.at(model, joint.element, message, attribute="name", link=joint.child, joint=joint.name)


def _root(above: dict[str | None, Joint], joint: Joint) -> str | None:
    """Return the link at the root of the tree that a joint is in, by child → joint."""
    seen: set[str | None] = set()
    while joint.parent in above and joint.parent not in seen:
        seen.add(joint.parent)
        joint = above[joint.parent]
    return joint.parent


def _is_rigid(model: Model, above: dict[str | None, Joint], link: Link) -> bool:
    """Whether no joint lifts or lowers a link: arms hang down at zero, where no robot starts."""
    seen: set[str | None] = set()
    name: str | None = link.name
    while name in above and name not in seen:
        seen.add(name)
        joint = above[name]
        frame = model.frames.get(name or "")
        axis = unit(turned(frame.rotation, joint.axis)) if frame is not None else None
        if joint.is_movable and (axis is None or abs(axis[2]) < _UPRIGHT):
            shapes = [shape.geometry for shape in link.collisions or link.visuals]
            is_wheel = joint.type == "continuous" and name == link.name
            if not (is_wheel and all(isinstance(shape, (Cylinder, Sphere)) for shape in shapes)):
                return False
        name = joint.parent
    return True


def _is_floor(link: Link, frame: Frame, drive: TwoSided, ground: float) -> bool:
    """Whether a link lies below all wheels of a drive and reaches out farther than they: they stand on it."""
    boxes = [(shape.geometry, frame.moved(shape.origin)) for shape in link.collisions or link.visuals]
    for shape, placed in boxes:
        x, y, z = placed.translation
        if not isinstance(shape, Box) or placed.rotation[2][2] < _UPRIGHT or z + shape.size[2] / 2.0 > ground + _NEAR:
            continue
        reach = min(shape.size[:2]) / 2.0
        if all(hypot(wheel.place[0] - x, wheel.place[1] - y) < reach for wheel in (*drive.left, *drive.right)):
            return True
    return False


def _lowest(link: Link, frame: Frame) -> Vector | None:
    """Return the lowest point of a link's shapes in the root link [m]; None where it has none, or has meshes."""
    points: list[Vector] = []
    for shape in link.collisions or link.visuals:
        geometry = shape.geometry
        if not link.collisions and any(shape.origin.xyz):
            return None  # Nothing touches the ground there: wheel-off-its-axis tells where a picture is elsewhere.
        if geometry is None or isinstance(geometry, Mesh):
            return None
        placed = frame.moved(shape.origin)
        up = placed.rotation[2]
        if isinstance(geometry, Box):
            down = sum(abs(part * size) / 2.0 for part, size in zip(up, geometry.size, strict=True))
        elif isinstance(geometry, Cylinder):
            down = abs(up[2]) * geometry.length / 2.0 + geometry.radius * sqrt(max(0.0, 1.0 - up[2] ** 2))
        else:
            assert isinstance(geometry, (Capsule, Sphere))
            length = geometry.length if isinstance(geometry, Capsule) else 0.0
            down = abs(up[2]) * length / 2.0 + geometry.radius
        x, y, z = placed.translation
        points.append((x, y, z - down))
    return min(points, key=lambda point: point[2]) if points else None
