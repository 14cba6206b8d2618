"""S903 left-right-swapped."""

from collections.abc import Sequence

from urdfkit.lint.facts.gazebo.drive_wheels import TwoSided, Wheel, drives
from urdfkit.lint.finding import Edit, Finding, Fix
from urdfkit.lint.fix_builders import new_text
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule


class LeftRightSwapped(RobotRule):
    """The left wheel of a drive is on the right side.

    ## What it does
    Checks the positions of the joints that a drive names as left and right: x points forward and y left (REP 103). Also
    checks for wheels whose axes point right, so that they roll backwards. This check includes the wheels of a
    ``diff_drive_controller`` without negative multipliers that a Gazebo plugin of the robot runs.

    ## Why is this bad?
    The robot turns in the wrong direction. Up to ROS Indigo, the drive plugin of Gazebo Classic itself swaps the sides.
    The plugin of ROS Kinetic does the same unless ``legacyMode`` is false. A robot written for these versions turns in
    the wrong direction from ROS Melodic on.

    ## Example
    ```diff
     <robot name="cart">
       <link name="base"/>
       <link name="left"/>
       <link name="right"/>
       <joint name="left_joint" type="fixed">
         <parent link="base"/>
         <child link="left"/>
    -    <origin xyz="0 -0.15 0"/>
    +    <origin xyz="0 0.15 0"/>
       </joint>
       <joint name="right_joint" type="fixed">
         <parent link="base"/>
         <child link="right"/>
    -    <origin xyz="0 0.15 0"/>
    +    <origin xyz="0 -0.15 0"/>
       </joint>
       <gazebo>
         <plugin name="drive" filename="libgazebo_ros_diff_drive.so">
           <leftJoint>left_joint</leftJoint>
           <rightJoint>right_joint</rightJoint>
           <wheelSeparation>0.3</wheelSeparation>
         </plugin>
       </gazebo>
     </robot>
    ```

    ## Fix safety
    Unsafe: the fix swaps the two names, but the positions of the joints may be the error.
    """

    code = "S903"
    name = "left-right-swapped"
    severity = "warning"
    fix = "unsafe"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each drive with swapped sides, and for each that rolls backwards."""
        if not model.robot.gazebo:
            return
        for drive in drives(model):
            left, right = drive.left[0], drive.right[0]
            lateral = left.place[1] - right.place[1]
            longitudinal = left.place[0] - right.place[0]
            element = left.element or drive.plugin.element
            if lateral < 0.0 and abs(lateral) > abs(longitudinal):
                is_legacy = drive.spec.generation == "ros1" and drive.spec.kind == "diff_drive"
                message = f"left wheel `{left.joint.name}` is on the right side, at y = {left.place[1]:g} m"
                help = "swap the two joint names" + (
                    "; not for ROS Indigo, or Kinetic with legacyMode, which swap the sides themselves"
                    if is_legacy
                    else ""
                )
                yield self.at(model, element, message, joint=left.joint.name, help=help, fix=_swap_sides(model, drive))
            if _roll_backwards(drive.left, drive.right):
                yield self._backwards(model, left, right)
        yield from self._of_controllers(model)

    def _of_controllers(self, model: Model) -> Findings:
        """Yield a finding for each simulated diff_drive_controller whose wheels, on the right sides, roll backwards."""
        from urdfkit.lint.facts.control.controller_wheels import simulated_diff_drives
        from urdfkit.lint.facts.control.yaml_tree import number_of

        for controller, left, right in simulated_diff_drives(model):
            is_on_side = bool(left and right) and left[0].place[1] > right[0].place[1]
            radii = [value for key, value in controller.group.entries if "radius" in key.text]
            is_reversed = any((number_of(value) or 0.0) < 0.0 for value in radii)
            if is_on_side and not is_reversed and _roll_backwards(left, right):
                yield self._backwards(model, left[0], right[0])

    def _backwards(self, model: Model, left: Wheel, right: Wheel) -> Finding:
        is_turned = min(left.joint.axis) >= 0.0
        place = left.joint.element.find("origin" if is_turned else "axis") or left.joint.element
        message = f"the axes of wheels `{left.joint.name}` and `{right.joint.name}` point right, so they roll backwards"
        attribute, names = "rpy" if is_turned else "xyz", (left.joint.name, right.joint.name)
        help = "reverse the axes: y points left"
        return self.at(model, place, message, attribute=attribute, joint=left.joint.name, help=help, names=names)


def _roll_backwards(left: Sequence[Wheel], right: Sequence[Wheel]) -> bool:
    return all(wheel.axis[1] < -0.7 and wheel.joint.type == "continuous" for wheel in (*left, *right))


def _swap_sides(model: Model, drive: TwoSided) -> Fix | None:
    """Return the fix that swaps the joint names of the two sides; None if one of them is not literal text."""
    edits: list[Edit] = []
    for wheel, opposite in zip((*drive.left, *drive.right), (*drive.right, *drive.left), strict=True):
        fix = new_text(model, wheel.element, opposite.joint.name, "unsafe") if wheel.element is not None else None
        if fix is None:
            return None
        edits += fix.edits
    return Fix("unsafe", "Swap the sides", tuple(edits))
