"""J416 mimic-joint-undefined."""

from __future__ import annotations

from urdfkit.lint.edits import meant, new_value
from urdfkit.lint.hidden import doubted
from urdfkit.lint.rule import RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model


class MimicJointUndefined(RobotRule):
    """A joint mimics a joint that is not there, that never moves, or itself.

    ## What it does
    Looks for ``<mimic joint="…"/>`` that names no joint, a fixed one, or the joint that it stands in.

    ## Why is this bad?
    No reader complains. The joint never moves, or robot_state_publisher leaves its frame out.

    ## Example
    ```xml
    <robot name="hand">
      <link name="palm"/>
      <link name="left"/>
      <link name="right"/>
      <joint name="left_finger" type="prismatic">
        <parent link="palm"/>
        <child link="left"/>
        <axis xyz="0 1 0"/>
        <limit lower="0" upper="0.04" effort="10" velocity="0.1"/>
      </joint>
      <joint name="right_finger" type="prismatic">
        <parent link="palm"/>
        <child link="right"/>
        <axis xyz="0 -1 0"/>
        <limit lower="0" upper="0.04" effort="10" velocity="0.1"/>
        <mimic joint="leftfinger"/>
      </joint>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="hand">
      <link name="palm"/>
      <link name="left"/>
      <link name="right"/>
      <joint name="left_finger" type="prismatic">
        <parent link="palm"/>
        <child link="left"/>
        <axis xyz="0 1 0"/>
        <limit lower="0" upper="0.04" effort="10" velocity="0.1"/>
      </joint>
      <joint name="right_finger" type="prismatic">
        <parent link="palm"/>
        <child link="right"/>
        <axis xyz="0 -1 0"/>
        <limit lower="0" upper="0.04" effort="10" velocity="0.1"/>
        <mimic joint="left_finger"/>
      </joint>
    </robot>
    ```

    ## Fix safety
    Unsafe: the joint with the nearest name is taken.
    """

    code = "J416"
    name = "mimic-joint-undefined"
    fix = "unsafe"

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each joint that mimics nothing."""
        for joint in model.robot.joints:
            mimic = joint.mimic
            if mimic is None:
                continue
            others = [name for name in model.robot.joint_by_name if name != joint.name]
            if mimic.joint in others:
                if model.robot.joint_by_name[mimic.joint].type == "fixed":
                    yield self.at(
                        model,
                        mimic.element,
                        f"joint `{joint.name}` mimics `{mimic.joint}`, which is fixed and never moves",
                        attribute="joint",
                        joint=joint.name,
                        severity="warning",
                    )
                continue
            if mimic.joint == joint.name:
                message = f"joint `{joint.name}` mimics itself"
                yield self.at(model, mimic.element, message, attribute="joint", joint=joint.name)
                continue
            near, hint = meant(mimic.joint, others)
            found = self.at(
                model,
                mimic.element,
                f"joint `{joint.name}` mimics `{mimic.joint}`, which is no joint{hint}",
                attribute="joint",
                joint=joint.name,
                fix=new_value(model, mimic.element, "joint", near, "unsafe", f"Write `{near}`") if near else None,
            )
            yield from doubted(model, mimic.joint, near, found)
