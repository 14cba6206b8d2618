"""J404 limit-effort-or-velocity-missing."""

from urdfkit.description.urdf.version import RATE_LIMITS, version_of
from urdfkit.lint.rule import Findings, Model, RobotRule

_LINEAR_UNITS = {"effort": "[N]", "velocity": "[m/s]"}
_ANGULAR_UNITS = {"effort": "[N·m]", "velocity": "[rad/s]"}


class LimitEffortOrVelocityMissing(RobotRule):
    """A ``<limit>`` lacks ``effort`` or ``velocity``.

    ## What it does
    Checks for ``<limit>`` elements of ``revolute``, ``prismatic`` and ``continuous`` joints without ``effort`` or
    ``velocity``. Robots of URDF 1.2 are not checked, because URDF 1.2 makes both attributes optional.

    ## Why is this bad?
    Up to URDF 1.1, both attributes are required in every ``<limit>``. Without them, urdfdom rejects the robot.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base"/>
       <link name="arm"/>
       <joint name="elbow" type="revolute">
         <parent link="base"/>
         <child link="arm"/>
    -    <limit lower="-1" upper="1" effort="10"/>
    +    <limit lower="-1" upper="1" effort="10" velocity="2"/>
       </joint>
     </robot>
    ```
    """

    code = "J404"
    name = "limit-effort-or-velocity-missing"
    not_for = frozenset(("mujoco",))

    def check(self, model: Model) -> Findings:
        """Yield a finding for each limit that lacks an attribute."""
        if version_of(model.robot.element) >= RATE_LIMITS:
            return
        for joint in model.robot.joints:
            limit = joint.limit
            if limit is None or joint.type not in ("revolute", "prismatic", "continuous"):
                continue
            missing = [name for name in ("effort", "velocity") if name not in limit.element.attributes]
            if missing:
                units = _LINEAR_UNITS if joint.type == "prismatic" else _ANGULAR_UNITS
                attributes = " and ".join(f"{name} {units[name]}" for name in missing)
                message = f"<limit> of joint `{joint.name}` lacks {' and '.join(missing)}"
                yield self.at(model, limit.element, message, joint=joint.name, help=f"add {attributes}")
