"""S906 double-offset."""

from __future__ import annotations

from urdfkit.lint.rule import RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model


class DoubleOffset(RobotRule):
    """Two fixed joints in a row have the same offset.

    ## What it does
    Looks for a fixed joint and a fixed joint above it with the same ``xyz``, at least two parts of which are not
    zero. Equal segments of legs and arms, whose joints move, are normal.

    ## Why is this bad?
    The offset is applied twice: the frame is twice as far away as the part it belongs to. Mostly one of them was
    copied.

    ## Example
    ```xml
    <robot name="cart">
      <link name="base"/>
      <link name="camera_link"/>
      <link name="camera_rgb_frame"/>
      <joint name="camera_joint" type="fixed">
        <parent link="base"/>
        <child link="camera_link"/>
        <origin xyz="0.38 0 0.2"/>
      </joint>
      <joint name="camera_rgb_joint" type="fixed">
        <parent link="camera_link"/>
        <child link="camera_rgb_frame"/>
        <origin xyz="0.38 0 0.2"/>
      </joint>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="cart">
      <link name="base"/>
      <link name="camera_link"/>
      <link name="camera_rgb_frame"/>
      <joint name="camera_joint" type="fixed">
        <parent link="base"/>
        <child link="camera_link"/>
        <origin xyz="0.38 0 0.2"/>
      </joint>
      <joint name="camera_rgb_joint" type="fixed">
        <parent link="camera_link"/>
        <child link="camera_rgb_frame"/>
        <origin xyz="0 0.02 0"/>
      </joint>
    </robot>
    ```
    """

    code = "S906"
    name = "double-offset"
    severity = "warning"

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each offset that is repeated."""
        for joint in model.robot.joints:
            xyz = joint.origin.xyz
            if joint.type != "fixed" or sum(part != 0.0 for part in xyz) < 2:
                continue
            above = model.robot.parents_of.get(joint.parent or "", [])
            if len(above) == 1 and above[0] is not joint and above[0].type == "fixed" and above[0].origin.xyz == xyz:
                shown = " ".join(f"{part:g}" for part in xyz)
                yield self.at(
                    model,
                    joint.element.find("origin") or joint.element,
                    f"joint `{joint.name}` has the offset {shown} of joint `{above[0].name}` above it",
                    attribute="xyz",
                    joint=joint.name,
                    help="is it meant twice?",
                )
