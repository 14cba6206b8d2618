"""S905 optical-frame-convention."""

from math import pi

from urdfkit.lint.facts.gazebo.drive_wheels import same_turn
from urdfkit.lint.rule import Findings, Model, RobotRule

TOLERANCE = 2e-3
"""Accepted difference of the rotation matrices, so that 1.57 passes for π/2."""


class OpticalFrame(RobotRule):
    """An optical frame does not have the standard orientation.

    ## What it does
    Checks fixed joints whose child link has ``optical`` in its name. The rotation from the camera body (x forward, z
    up) to its optical frame (z forward, x right) must be rpy = -π/2 0 -π/2 (REP 103).

    ## Why is this bad?
    Point clouds and detections are rotated by 90 degrees.

    ## Example
    ```diff
    -<robot name="camera">
    +<robot name="camera" xmlns:xacro="http://www.ros.org/wiki/xacro">
       <link name="camera_link"/>
       <link name="camera_optical_frame"/>
       <joint name="camera_optical_joint" type="fixed">
         <parent link="camera_link"/>
         <child link="camera_optical_frame"/>
    -    <origin rpy="0 0 0"/>
    +    <origin rpy="${-pi/2} 0 ${-pi/2}"/>
       </joint>
     </robot>
    ```
    """

    code = "S905"
    name = "optical-frame-convention"
    severity = "note"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each optical frame with a different rotation."""
        for joint in model.robot.joints:
            child, parent = (joint.child or "").lower(), (joint.parent or "").lower()
            if joint.type != "fixed" or "optical" not in child or "optical" in parent:
                continue
            origin = joint.element.find("origin")
            if origin is not None and model.is_unresolved(origin, "rpy"):
                continue
            if same_turn(joint.origin.rpy, (-pi / 2, 0.0, -pi / 2)) > TOLERANCE:
                rpy = " ".join(f"{angle:.4g}" for angle in joint.origin.rpy)
                place = origin or joint.element
                message = f"optical frame `{joint.child}` has rpy {rpy} rad instead of -π/2 0 -π/2"
                help = 'write rpy="${-pi/2} 0 ${-pi/2}": z points forward, x right and y down'
                yield self.at(model, place, message, attribute="rpy", link=joint.child, joint=joint.name, help=help)
