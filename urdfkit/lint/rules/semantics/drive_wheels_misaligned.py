"""S907 drive-wheels-misaligned."""

from collections.abc import Sequence
from itertools import pairwise
from math import dist

from urdfkit.lint.facts.gazebo.drive_wheels import Wheel, drives
from urdfkit.lint.facts.twins import side_of
from urdfkit.lint.finding import Finding
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule

_MIN_DISTANCE = 0.01
"""Distance or height difference below which two wheels count as being in the same place or level [m]."""

_OPPOSITE = -0.9
"""Cosine of the angle from which two axes count as opposite."""


class DriveWheelsMisaligned(RobotRule):
    """The left and right wheels of a drive do not match.

    ## What it does
    Compares the position, height and axis direction of each pair of left and right wheels. The rule reports a joint
    that is used for both sides, two wheels in the same place, different heights, and opposite axes. Also checks the
    wheels of a ``diff_drive_controller`` that a Gazebo plugin of the robot runs.

    ## Why is this bad?
    To move straight ahead, a drive commands the same velocity to both wheels. If the axes of the wheels point in
    opposite directions, the robot turns on the spot instead. Wheels at different heights do not both touch the ground.
    Two wheels in the same place usually result from a wrong sign, such as ``reflect="1"`` for both sides.

    ## Example
    ```diff
     <robot name="cart">
       <link name="base"/>
       <link name="left"/>
       <link name="right"/>
       <joint name="left_joint" type="continuous">
         <parent link="base"/>
         <child link="left"/>
         <origin xyz="0 0.15 0" rpy="-1.57079633 0 0"/>
         <axis xyz="0 0 1"/>
       </joint>
       <joint name="right_joint" type="continuous">
         <parent link="base"/>
         <child link="right"/>
    -    <origin xyz="0 -0.15 0" rpy="1.57079633 0 0"/>
    +    <origin xyz="0 -0.15 0" rpy="-1.57079633 0 0"/>
         <axis xyz="0 0 1"/>
       </joint>
       <gazebo>
         <plugin name="gz::sim::systems::DiffDrive" filename="gz-sim-diff-drive-system">
           <left_joint>left_joint</left_joint>
           <right_joint>right_joint</right_joint>
           <wheel_separation>0.3</wheel_separation>
         </plugin>
       </gazebo>
     </robot>
    ```
    """

    code = "S907"
    name = "drive-wheels-misaligned"
    severity = "warning"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for the worst defect of each pair of wheels."""
        if not model.robot.gazebo or model.is_damaged:
            return
        for drive in drives(model):
            for left, right in zip(drive.left, drive.right, strict=True):
                origins = (wheel.joint.element.find("origin") for wheel in (left, right))
                if any(
                    origin is not None and any(model.is_unresolved(origin, a) for a in ("xyz", "rpy"))
                    for origin in origins
                ):
                    continue
                if left.joint is right.joint:
                    if left.named != right.named:
                        continue  # One of the names is misspelt and was resolved to the other wheel.
                    message = f"the drive uses joint `{left.joint.name}` for both the left and the right side"
                    help = "name a different joint for each side"
                    yield self.at(
                        model, right.element or drive.plugin.element, message, joint=right.joint.name, help=help
                    )
                    continue
                defect = _defect(left, right)
                if defect is not None:
                    message, help = defect
                    yield self._at(model, left, right, message, help, (*drive.left, *drive.right))
            for side in (drive.left, drive.right):
                yield from self._same_place(model, side)
        yield from self._of_controllers(model)

    def _of_controllers(self, model: Model) -> Findings:
        """Yield a finding for each pair of wheels of a simulated diff_drive_controller that do not match."""
        from urdfkit.lint.facts.control.controller_wheels import simulated_diff_drives

        for _, left, right in simulated_diff_drives(model):
            if not left or len(left) != len(right):
                continue
            for one, other in zip(left, right, strict=True):
                defect = _defect(one, other) if one.joint is not other.joint else None
                if defect is not None:
                    yield self._at(model, one, other, *defect, (*left, *right))
            for side in (left, right):
                yield from self._same_place(model, side)

    def _same_place(self, model: Model, side: Sequence[Wheel]) -> Findings:
        """Yield a finding for each wheel at the place of the wheel before it on the same side."""
        for first, other in pairwise(side):
            if first.joint is not other.joint and max(_distances(first, other)) < _MIN_DISTANCE:
                message = f"drive wheels `{first.joint.name}` and `{other.joint.name}` are in the same place"
                yield self._at(model, first, other, message, "correct the <origin> of one of the joints")

    def _at(
        self, model: Model, first: Wheel, other: Wheel, message: str, help: str, wheels: Sequence[Wheel] = ()
    ) -> Finding:
        from urdfkit.lint.facts.macro_calls import equal_call, with_calls_of
        from urdfkit.lint.facts.root_cause import argument_of_coordinate, shared_argument

        if (_is_on_wrong_side(first) and not _is_on_wrong_side(other)) or _stands_out(first, other, wheels):
            first, other = other, first
        joint, names = other.joint, (first.joint.name,)
        is_misaligned = max(_distances(first, other)) >= _MIN_DISTANCE
        call = None if is_misaligned else equal_call(model, first.joint.element, joint.element)
        place, attribute = (joint.element, "name") if call is None else (call, None)
        origins = [each.element.find("origin") for each in (joint, first.joint)]
        if call is None and not is_misaligned and origins[0] is not None and origins[1] is not None:
            place, attribute = shared_argument(model, origins[0], origins[1]) or (place, attribute)
        wrong = joint.element.find("axis" if _are_opposite(first, other) else "origin") if is_misaligned else None
        if wrong is not None:
            place, attribute = wrong, "xyz"
            is_low = wrong.tag == "origin" and origins[1] is not None
            height = argument_of_coordinate(model, wrong, origins[1] or wrong, 2) if is_low else None
            place, attribute = height or (place, attribute)
        found = self.at(model, place, message, attribute=attribute, joint=joint.name, help=help, names=names)
        own, twin = joint.element.origin, first.joint.element.origin
        return with_calls_of(found, first.joint.element) if own.position == twin.position else found


def _is_on_wrong_side(wheel: Wheel) -> bool:
    """Return whether the name of a wheel states the other side of the robot."""
    side = side_of(wheel.joint.name)
    return wheel.place[1] < 0.0 if side == "left" else wheel.place[1] > 0.0 if side == "right" else False


def _stands_out(first: Wheel, other: Wheel, wheels: Sequence[Wheel]) -> bool:
    """Return whether the height of the first wheel differs from that of the other one and of all further wheels."""
    heights = [wheel.place[2] for wheel in wheels if wheel.joint not in (first.joint, other.joint)]
    near, far = (all(abs(each - one.place[2]) < _MIN_DISTANCE for each in heights) for one in (other, first))
    return bool(heights) and near and not far


def _are_opposite(one: Wheel, other: Wheel) -> bool:
    return sum(a * b for a, b in zip(one.axis, other.axis, strict=True)) < _OPPOSITE


def _distances(one: Wheel, other: Wheel) -> list[float]:
    return [dist(a, b) for a, b in zip(one.middles, other.middles, strict=False)]


def _defect(left: Wheel, right: Wheel) -> tuple[str, str] | None:
    """Return the message and help for a pair of wheels; None if they match."""
    if not (left.joint.is_movable and right.joint.is_movable):
        return None
    both = f"`{left.joint.name}` and `{right.joint.name}`"
    distances = _distances(left, right)
    if max(distances) < _MIN_DISTANCE:
        return f"drive wheels {both} are in the same place", "correct the <origin> of one of the joints"
    if _are_opposite(left, right):
        message = f"the axes of drive wheels {both} point in opposite directions, so the robot turns on the spot"
        return message, "reverse the axis of one of the joints"
    height_difference = min((a[2] - b[2] for a, b in zip(left.middles, right.middles, strict=False)), key=abs)
    if abs(height_difference) > max(_MIN_DISTANCE, 0.05 * max(distances)) and left.radii == right.radii:
        message = f"drive wheels {both} differ in height by {abs(height_difference):.3g} m"
        return message, "place both joints at the same height"
    return None
