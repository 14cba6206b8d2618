"""S903 left-right-swapped."""

from __future__ import annotations

from urdfkit.lint.edits import new_text
from urdfkit.lint.finding import Edit, Fix
from urdfkit.lint.rule import NOT_GAZEBO, RobotRule
from urdfkit.lint.wheels import TwoSided, drives

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model


class LeftRightSwapped(RobotRule):
    """The left wheel of a drive is on the right side.

    ## What it does
    Looks where the joints are that a drive calls left and right: x is forward and y is left (REP 103). It also
    looks for wheels whose axis points to the right, which roll backwards.

    ## Why is this bad?
    The robot turns the other way. The drive of Gazebo classic up to ROS Indigo, and that of Kinetic unless its
    ``legacyMode`` is false, swaps the sides itself: what was right there turns the wrong way from Melodic on.

    ## Example
    ```xml
    <robot name="cart">
      <link name="base"/>
      <link name="left"/>
      <link name="right"/>
      <joint name="left_joint" type="fixed">
        <parent link="base"/>
        <child link="left"/>
        <origin xyz="0 -0.15 0"/>
      </joint>
      <joint name="right_joint" type="fixed">
        <parent link="base"/>
        <child link="right"/>
        <origin xyz="0 0.15 0"/>
      </joint>
      <gazebo>
        <plugin name="drive" filename="libgazebo_ros_diff_drive.so">
          <leftJoint>left_joint</leftJoint>
          <rightJoint>right_joint</rightJoint>
          <wheelSeparation>0.3</wheelSeparation>
          <wheelDiameter>0.1</wheelDiameter>
          <robotBaseFrame>base</robotBaseFrame>
        </plugin>
      </gazebo>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="cart">
      <link name="base"/>
      <link name="left"/>
      <link name="right"/>
      <joint name="left_joint" type="fixed">
        <parent link="base"/>
        <child link="left"/>
        <origin xyz="0 0.15 0"/>
      </joint>
      <joint name="right_joint" type="fixed">
        <parent link="base"/>
        <child link="right"/>
        <origin xyz="0 -0.15 0"/>
      </joint>
      <gazebo>
        <plugin name="drive" filename="libgazebo_ros_diff_drive.so">
          <leftJoint>left_joint</leftJoint>
          <rightJoint>right_joint</rightJoint>
          <wheelSeparation>0.3</wheelSeparation>
          <wheelDiameter>0.1</wheelDiameter>
          <robotBaseFrame>base</robotBaseFrame>
        </plugin>
      </gazebo>
    </robot>
    ```

    ## Fix safety
    Unsafe: the two names are swapped, but it may be the joints that are misplaced.
    """

    code = "S903"
    name = "left-right-swapped"
    severity = "warning"
    fix = "unsafe"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each drive with its sides swapped, and one for each that rolls backwards."""
        if not model.robot.gazebo:
            return
        for drive in drives(model):
            left, right = drive.left[0], drive.right[0]
            aside = left.place[1] - right.place[1]
            along = left.place[0] - right.place[0]
            element = left.element or drive.plugin.element
            if aside < 0.0 and abs(aside) > abs(along):
                swaps = drive.spec.generation == "ros1" and drive.spec.kind == "diff_drive"
                yield self.at(
                    model,
                    element,
                    f"`{left.joint.name}` is the left wheel, but lies at y = {left.place[1]:g} m, on the right side",
                    joint=left.joint.name,
                    help="right for ROS Indigo and Kinetic's legacyMode only, which swap the sides" if swaps else None,
                    fix=_swapped(model, drive),
                )
            wheels = (*drive.left, *drive.right)
            if all(wheel.axis[1] < -0.7 for wheel in wheels) and all(
                wheel.joint.type == "continuous" for wheel in wheels
            ):
                yield self.at(
                    model,
                    element,
                    f"the axes of `{left.joint.name}` and `{right.joint.name}` point right: the wheels roll backwards",
                    joint=left.joint.name,
                    help="turn the axes round: y is left",
                )


def _swapped(model: Model, drive: TwoSided) -> Fix | None:
    """Return the fix that gives each side the joint of the other; None where one is not written out."""
    edits: list[Edit] = []
    for wheel, other in zip((*drive.left, *drive.right), (*drive.right, *drive.left), strict=True):
        fix = new_text(model, wheel.element, other.joint.name, "unsafe", "") if wheel.element is not None else None
        if fix is None:
            return None
        edits += fix.edits
    return Fix("unsafe", "Swap the sides", tuple(edits))
