"""N301 link-joint-same-name."""

from __future__ import annotations

from urdfkit.lint.rule import RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model


class LinkJointSameName(RobotRule):
    """A joint has the name of a link.

    ## What it does
    Looks for joints that are called as a link is.

    ## Why is this bad?
    URDF allows it, but SDF has one name space for both: Gazebo refuses the model ("non-unique name"), or renames
    the joint, and then plugins that name it do not find it.

    ## Example
    ```xml
    <robot name="cart">
      <link name="base"/>
      <link name="wheel"/>
      <joint name="wheel" type="fixed">
        <parent link="base"/>
        <child link="wheel"/>
      </joint>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="cart">
      <link name="base"/>
      <link name="wheel"/>
      <joint name="wheel_joint" type="fixed">
        <parent link="base"/>
        <child link="wheel"/>
      </joint>
    </robot>
    ```
    """

    code = "N301"
    name = "link-joint-same-name"
    severity = "warning"
    not_for = frozenset(
        (
            "mujoco",
            "isaac",
            "moveit",
            "ros1",
            "ros2",
        )
    )

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each joint with the name of a link."""
        for joint in model.robot.joints:
            link = model.robot.link_by_name.get(joint.name)
            if link is not None and joint.name:
                yield self.at(
                    model,
                    joint.element,
                    f"joint `{joint.name}` has the name of a link: in SDF they share one name space",
                    attribute="name",
                    joint=joint.name,
                    help=f"the link: {model.shown(link.element.origin.position)}; call the joint `{joint.name}_joint`",
                )
