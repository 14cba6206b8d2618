"""S901 wheel-separation-inconsistent."""

from math import dist

from urdfkit.description.urdf.geometry import unit
from urdfkit.lint.facts.gazebo.drive_wheels import TwoSided, drives, further, mismatch, track, written
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule

TOLERANCE = 0.05
"""Accepted relative deviation with one wheel on each side."""

SKID_STEER_RATIO = 2.0
"""Accepted ratio with several wheels on each side, where the separation is tuned to compensate for slip."""


class WheelSeparation(RobotRule):
    """The configured wheel separation of a drive differs from the distance between its wheels.

    ## What it does
    Compares the wheel separation of the drive with the lateral distance between the wheel joints and between the wheel
    shapes, with every joint at zero. Deviations of up to 5 % are accepted. For skid-steer robots, with several wheels
    on each side, a factor of up to two is accepted, because their separation is tuned to compensate for slip.

    ## Why is this bad?
    The robot turns more or less than commanded, and its odometry is wrong by the same factor.

    ## Example
    ```diff
     <robot name="cart">
       <link name="base"/>
       <link name="left"/>
       <link name="right"/>
       <joint name="left_joint" type="continuous">
         <parent link="base"/>
         <child link="left"/>
         <origin xyz="0 0.15 0"/>
         <axis xyz="0 1 0"/>
       </joint>
       <joint name="right_joint" type="continuous">
         <parent link="base"/>
         <child link="right"/>
         <origin xyz="0 -0.15 0"/>
         <axis xyz="0 1 0"/>
       </joint>
       <gazebo>
         <plugin name="drive" filename="libgazebo_ros_diff_drive.so">
           <leftJoint>left_joint</leftJoint>
           <rightJoint>right_joint</rightJoint>
    -      <wheelSeparation>0.2</wheelSeparation>
    +      <wheelSeparation>0.3</wheelSeparation>
         </plugin>
       </gazebo>
     </robot>
    ```

    ## Fix safety
    Unsafe: the fix writes the distance between the wheels, but the positions of the wheels may be the error.
    """

    code = "S901"
    name = "wheel-separation-inconsistent"
    severity = "warning"
    fix = "unsafe"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each drive with a wrong wheel separation."""
        if not model.robot.gazebo:
            return
        for drive in drives(model):
            value = written(model, drive, "wheel_separation")
            if value is None:
                continue
            separation = value[0]
            left, right = drive.left[0], drive.right[0]
            lateral = unit(left.axis) or (0.0, 1.0, 0.0)
            distances = [
                abs(sum((a - b) * c for a, b, c in zip(left_centre, right_centre, lateral, strict=True)))
                for left_wheel, right_wheel in zip(drive.left, drive.right, strict=True)
                for left_centre, right_centre in zip(left_wheel.middles, right_wheel.middles, strict=False)
            ]
            least, most = (
                (1.0 - TOLERANCE, 1.0 + TOLERANCE)
                if len(drive.left) == 1
                else (1.0 / SKID_STEER_RATIO, SKID_STEER_RATIO)
            )
            yield from self._of_further_pairs(model, drive, separation)
            if distances[0] < 0.01 or any(least * distance <= separation <= most * distance for distance in distances):
                continue
            first_pair = min(len(left.middles), len(right.middles))
            actual, subject = track(left, right, distances[:first_pair])
            yield mismatch(self, model, drive, value, actual=actual, comparison=f"{subject} are {{}} m apart")

    def _of_further_pairs(self, model: Model, drive: TwoSided, separation: float) -> Findings:
        """Yield a finding for each later pair that is as wide as the first one, but has another separation."""
        widths = [dist(left.place, right.place) for left, right in zip(drive.left, drive.right, strict=True)]
        for pair, value in further(model, drive, "wheel_separation"):
            if abs(widths[pair] - widths[0]) < 0.01 * widths[0] and abs(value[0] - separation) > TOLERANCE * separation:
                comparison = f"the first pair of wheels is equally far apart, and its value is {separation:g} m"
                yield mismatch(self, model, drive, value, actual=separation, comparison=comparison)
