"""J421 joint-origin-too-far."""

from math import dist

from urdfkit.lint.rule import Findings, Model, RobotRule

_MIN_DISTANCE = 10.0
"""Distance of a joint from its parent frame that only large robots have [m]."""

_TIMES = 20.0
"""Ratio of the distance to the largest link above which the parts of the robot cannot be connected."""


class OriginTooFar(RobotRule):
    """A joint is far from its parent link, compared with the size of all links.

    ## What it does
    Checks for joints that are at least 10 m from the frame of their parent link, and 20 times as far as the largest
    link extends. Joints of a root link without shapes are not checked, because they place the robot in the world.

    ## Why is this bad?
    The child link floats far from the robot. The usual cause is an offset in millimetres, copied from a CAD program.

    ## Example
    ```xml
    <robot name="arm">
      <link name="base">
        <visual><geometry><box size="0.2 0.2 0.1"/></geometry></visual>
      </link>
      <link name="arm">
        <visual><geometry><box size="0.05 0.05 0.3"/></geometry></visual>
      </link>
      <joint name="mount" type="fixed">
        <parent link="base"/>
        <child link="arm"/>
        <origin xyz="0 0 200"/>
      </joint>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm">
      <link name="base">
        <visual><geometry><box size="0.2 0.2 0.1"/></geometry></visual>
      </link>
      <link name="arm">
        <visual><geometry><box size="0.05 0.05 0.3"/></geometry></visual>
      </link>
      <joint name="mount" type="fixed">
        <parent link="base"/>
        <child link="arm"/>
        <origin xyz="0 0 0.2"/>
      </joint>
    </robot>
    ```
    """

    code = "J421"
    name = "joint-origin-too-far"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each joint that is too far from its parent link."""
        zero = (0.0, 0.0, 0.0)
        far = [joint for joint in model.robot.joints if dist(joint.origin.xyz, zero) >= _MIN_DISTANCE]
        if not far or not model.extents:
            return
        size = max(extent.diagonal for extent in model.extents.values())
        children = {joint.child for joint in model.robot.joints}
        for joint in far:
            distance = dist(joint.origin.xyz, zero)
            origin = joint.element.find("origin")
            is_placed_in_world = joint.parent not in children and joint.parent not in model.extents
            if origin is None or is_placed_in_world or distance < _TIMES * size:
                continue
            yield self.at(
                model,
                origin,
                f"joint `{joint.name}` is {distance:.4g} m from `{joint.parent}`; "
                f"the largest link extends {size:.3g} m",
                attribute="xyz",
                joint=joint.name,
                help="write offsets in metres",
            )
