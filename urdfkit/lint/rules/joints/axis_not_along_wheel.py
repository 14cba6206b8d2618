"""J414 axis-not-along-wheel."""

from __future__ import annotations

from urdfkit.description.numbers import numbers
from urdfkit.description.robot import Cylinder
from urdfkit.lint.placement import rotation, shapes_of, turned, unit
from urdfkit.lint.rule import RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.description.robot import Joint, Vector
    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model

PARALLEL = 0.985
"""Cosine of 10 degrees: cambered wheels are let be."""


class AxisNotAlongWheel(RobotRule):
    """A wheel does not turn about its own axis.

    ## What it does
    Compares the axis of continuous joints with the axis of the disc (a cylinder wider than long) that the child
    link is, both turned as the origins say.

    ## Why is this bad?
    The wheel spins like a coin or a turntable, and the robot does not drive.

    ## Example
    ```xml
    <robot name="cart">
      <link name="base"/>
      <link name="wheel">
        <visual>
          <origin rpy="1.5707963267948966 0 0"/>
          <geometry><cylinder radius="0.1" length="0.04"/></geometry>
        </visual>
      </link>
      <joint name="axle" type="continuous">
        <parent link="base"/>
        <child link="wheel"/>
        <axis xyz="0 0 1"/>
      </joint>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="cart">
      <link name="base"/>
      <link name="wheel">
        <visual>
          <origin rpy="1.5707963267948966 0 0"/>
          <geometry><cylinder radius="0.1" length="0.04"/></geometry>
        </visual>
      </link>
      <joint name="axle" type="continuous">
        <parent link="base"/>
        <child link="wheel"/>
        <axis xyz="0 1 0"/>
      </joint>
    </robot>
    ```
    """

    code = "J414"
    name = "axis-not-along-wheel"
    severity = "warning"

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each wheel whose axis is off by more than 10 degrees."""
        for joint in model.robot.joints:
            axis = unit(joint.axis)
            wheel = model.robot.link_by_name.get(joint.child or "")
            if joint.type != "continuous" or wheel is None or axis is None:
                continue
            written = joint.element.find("axis")
            if written is not None and len(numbers(written.get("xyz") or "1 0 0") or ()) != 3:
                continue  # It could not be read.
            discs = [
                tuple(row[2] for row in rotation(shape.origin.rpy))
                for shape in shapes_of(wheel)
                if isinstance(shape.geometry, Cylinder) and shape.geometry.length < 2.0 * shape.geometry.radius
            ]
            if len(discs) != len(wheel.visuals) + len(wheel.collisions) or not discs:
                continue  # Something else than a disc: the wheel may be any part of it.
            cosines = [abs(sum(a * b for a, b in zip(axis, disc, strict=True))) for disc in discs]
            if max(cosines) < PARALLEL:
                own = _rolling_ahead(model, joint, discs[0])
                yield self.at(
                    model,
                    joint.element.find("axis") or joint.element,
                    f"joint `{joint.name}` does not turn the wheel `{wheel.name}` about its own axis: that is "
                    f"{' '.join(f'{round(part, 3) + 0.0:g}' for part in own)} in the joint's frame",
                    attribute="xyz",
                    joint=joint.name,
                    help="a cylinder lies along its z",
                )


def _rolling_ahead(model: Model, joint: Joint, axis: tuple[float, ...]) -> Vector:
    """Return an axis, turned round where a wheel that turns about it would roll backwards: y is left (REP 103)."""
    x, y, z = axis
    parent = model.frames.get(joint.parent or "")
    frame = parent.moved(joint.origin) if parent is not None else None
    ahead = turned(frame.rotation, (x, y, z)) if frame is not None else (x, y, z)
    largest = max(ahead, key=abs)
    return (x, y, z) if largest > 0.0 else (-x, -y, -z)
