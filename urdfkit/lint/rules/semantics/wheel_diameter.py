"""S902 wheel-diameter-inconsistent."""

from urdfkit.lint.facts.gazebo.drive_wheels import drives, further, mismatch, written
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule

TOLERANCE = 0.05
"""Accepted relative deviation."""


class WheelDiameter(RobotRule):
    """The configured wheel diameter or radius of a drive differs from the size of the wheels.

    ## What it does
    Compares the wheel diameter or radius of the drive with the cylinders and spheres of its wheels. Deviations of up to
    5 % are accepted. Wheels that consist only of meshes are not checked.

    ## Why is this bad?
    The robot drives faster or slower than commanded, and its odometry is wrong by the same factor.

    ## Example
    ```diff
     <robot name="cart">
       <link name="base"/>
       <link name="left">
         <visual><geometry><sphere radius="0.05"/></geometry></visual>
       </link>
       <link name="right">
         <visual><geometry><sphere radius="0.05"/></geometry></visual>
       </link>
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
    -      <wheelDiameter>0.2</wheelDiameter>
    +      <wheelDiameter>0.1</wheelDiameter>
         </plugin>
       </gazebo>
     </robot>
    ```

    ## Fix safety
    Unsafe: the fix writes the size of the wheel shapes, but the shapes may be the error.
    """

    code = "S902"
    name = "wheel-diameter-inconsistent"
    severity = "warning"
    fix = "unsafe"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each drive with a wrong wheel size."""
        if not model.robot.gazebo:
            return
        for drive in drives(model):
            radii = [radius for wheel in (*drive.left, *drive.right) for radius in wheel.radii if radius > 0.0]
            for meaning, factor in (("wheel_diameter", 2.0), ("wheel_radius", 1.0)):
                value = written(model, drive, meaning)
                if value is None or not radii:
                    continue
                if any(abs(value[0] - factor * radius) <= TOLERANCE * factor * radius for radius in radii):
                    continue
                actual = f"the {meaning.removeprefix('wheel_')} of the wheels is {{}} m"
                yield mismatch(self, model, drive, value, actual=factor * radii[0], comparison=actual)
            first = written(model, drive, "wheel_diameter")
            for pair, value in further(model, drive, "wheel_diameter"):
                diameters = [2.0 * radius for radius in (*drive.left[pair].radii, *drive.right[pair].radii)]
                if first is None or value[0] == first[0]:
                    continue  # Compared above.
                if diameters and min(abs(value[0] - each) for each in diameters) > TOLERANCE * max(diameters):
                    actual = "the diameter of the wheels is {} m"
                    yield mismatch(self, model, drive, value, actual=diameters[0], comparison=actual)
