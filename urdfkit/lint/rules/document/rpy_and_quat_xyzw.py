"""E023 rpy-and-quat-xyzw."""

from urdfkit.description.urdf.version import QUATERNION, version_of
from urdfkit.lint.fix_builders import without_attribute
from urdfkit.lint.rule import Findings, Model, RobotRule


class RpyAndQuatXyzw(RobotRule):
    """An ``<origin>`` has both ``rpy`` and ``quat_xyzw``.

    ## What it does
    Checks for ``<origin>`` elements with both attributes in robots of URDF 1.1 or later. URDF 1.0 ignores
    ``quat_xyzw``, which E021 reports.

    ## Why is this bad?
    urdfdom rejects the robot. urdfkit rejects it if the rotations differ, because one of them is wrong.

    ## Example
    ```diff
     <robot name="arm" version="1.1">
       <link name="base">
         <visual>
    -      <origin rpy="0 0 1.57079633" quat_xyzw="0 0 0.70710678 0.70710678"/>
    +      <origin quat_xyzw="0 0 0.70710678 0.70710678"/>
           <geometry><box size="0.1 0.1 0.3"/></geometry>
         </visual>
       </link>
     </robot>
    ```

    ## Fix safety
    Safe if both rotations agree: the fix removes ``rpy``. No fix is offered if they differ.
    """

    code = "E023"
    name = "rpy-and-quat-xyzw"
    fix = "safe"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each origin with both rotations."""
        if version_of(model.robot.element) < QUATERNION:
            return
        different = {problem.element for problem in model.robot.problems if problem.kind == "conflict"}
        defective = {problem.element for problem in model.robot.problems}
        for origin in model.elements:
            if origin.tag != "origin" or not {"rpy", "quat_xyzw"} <= origin.attributes.keys():
                continue
            differ = origin in different
            unclear = origin in defective or any(model.is_unresolved(origin, name) for name in ("rpy", "quat_xyzw"))
            message = f"<origin> has both `rpy` and `quat_xyzw`{', and the rotations differ' if differ else ''}"
            help = "remove the wrong one" if differ else "remove `rpy`"
            fix = None if unclear else without_attribute(model, origin, "rpy", "safe", "Remove `rpy`")
            yield self.at(model, origin, message, attribute="quat_xyzw", help=help, fix=fix)
