"""J403 limit-missing."""

from urdfkit.lint.rule import Findings, Model, RobotRule


class LimitMissing(RobotRule):
    """A revolute or prismatic joint has no ``<limit>``.

    ## What it does
    Checks for ``revolute`` and ``prismatic`` joints without ``<limit>``.

    ## Why is this bad?
    These types require a limit: without it, urdfdom rejects the robot. Use the type ``continuous`` for a joint that
    turns without limits.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base"/>
       <link name="arm"/>
       <joint name="elbow" type="revolute">
         <parent link="base"/>
         <child link="arm"/>
         <axis xyz="0 1 0"/>
    +    <limit lower="-1.5" upper="1.5" effort="10" velocity="2"/>
       </joint>
     </robot>
    ```
    """

    code = "J403"
    name = "limit-missing"
    not_for = frozenset(("mujoco",))

    def check(self, model: Model) -> Findings:
        """Yield a finding for each joint that lacks a required limit."""
        for joint in model.robot.joints:
            if joint.type in ("revolute", "prismatic") and joint.limit is None:
                units = "[rad], [N·m] and [rad/s]" if joint.type == "revolute" else "[m], [N] and [m/s]"
                alternative = (
                    ", or use the type `continuous` if it turns without limits" if joint.type == "revolute" else ""
                )
                message = f"{joint.type} joint `{joint.name}` has no <limit>"
                help = f'add <limit lower="…" upper="…" effort="…" velocity="…"/> in {units}{alternative}'
                yield self.at(model, joint.element, message, joint=joint.name, help=help)
