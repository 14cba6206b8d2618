"""J413 axis-missing-on-movable."""

from urdfkit.lint.finding import Severity
from urdfkit.lint.fix_builders import more_children
from urdfkit.lint.rule import Findings, Model, RobotRule

_MIN_OTHERS = 3
"""Number of joints with an axis from which the only joint without one is a warning."""


class AxisMissing(RobotRule):
    """A movable joint has no ``<axis>``.

    ## What it does
    Checks for ``revolute``, ``continuous``, ``prismatic`` and ``planar`` joints without an ``<axis>``, if their child
    link has a shape or a mass. The finding is a warning if four or more joints move and only one of them has no axis.

    ## Why is this bad?
    The default axis is x (``1 0 0``), although z is often expected. Write the axis explicitly, even if it is the
    default.

    ## Example
    ```diff
     <robot name="arm">
       <link name="world"/>
       <link name="arm">
         <inertial><mass value="1"/><inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial>
       </link>
       <joint name="elbow" type="continuous">
         <parent link="world"/>
         <child link="arm"/>
    +    <axis xyz="1 0 0"/>
       </joint>
     </robot>
    ```

    ## Fix safety
    Safe: the fix writes the default value explicitly.
    """

    code = "J413"
    name = "axis-missing-on-movable"
    severity = "note"
    fix = "safe"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each joint that relies on the default axis."""
        movable = [joint for joint in model.robot.joints if joint.type in ("revolute", "continuous", "prismatic")]
        without = [joint for joint in movable if joint.element.find("axis") is None]
        is_forgotten = len(without) == 1 and len(movable) > _MIN_OTHERS
        for joint in model.robot.joints:
            if (
                joint.type not in ("revolute", "continuous", "prismatic", "planar")
                or joint.element.find("axis") is not None
            ):
                continue
            child = model.robot.link_by_name.get(joint.child or "")
            if child is not None and (child.visuals or child.collisions or child.inertial is not None):
                message = f"{joint.type} joint `{joint.name}` has no <axis> and uses the default, x (1 0 0)"
                severity: Severity | None = "warning" if is_forgotten and not joint.mimic else None
                fix = more_children(model, joint.element, '<axis xyz="1 0 0"/>', "safe", "Write the default axis")
                yield self.at(
                    model, joint.element, message, attribute="name", joint=joint.name, severity=severity, fix=fix
                )
