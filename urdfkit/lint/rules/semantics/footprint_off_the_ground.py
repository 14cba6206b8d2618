"""S911 footprint-off-the-ground."""

from urdfkit.description.urdf.robot import Joint
from urdfkit.lint.facts.gazebo.rolling_wheels import is_lifted, rolling_wheels
from urdfkit.lint.rule import Findings, Model, RobotRule

_PART = 0.3
"""Largest distance of the footprint from the ground, as a part of the radius of the wheels."""

_LEAST = 0.01
"""Largest distance of the footprint from the ground that is accepted for small wheels [m]."""


class FootprintOffTheGround(RobotRule):
    """The link ``base_footprint`` is not at the height of the lowest point of the wheels.

    ## What it does
    Compares the height of ``base_footprint``, or of a link whose name ends in ``footprint``, with the lowest point of
    the wheels while every joint is at zero. Wheels are continuous joints with ``wheel`` in their names and the shape of
    a cylinder or sphere. Distances of up to 30 % of the radius are accepted.

    ## Why is this bad?
    The footprint is the point on the ground below the robot (REP 120). If it is above or below the wheels, the robot
    floats above the map or sinks into it, and its sensors measure at the wrong height.

    ## Example
    ```diff
     <robot name="cart">
       <link name="base_footprint"/>
       <link name="base_link">
         <inertial><mass value="8"/><inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial>
       </link>
       <link name="wheel">
         <inertial><mass value="1"/><inertia ixx="0.004" ixy="0" ixz="0" iyy="0.004" iyz="0" izz="0.004"/></inertial>
         <collision>
           <origin rpy="1.5707963267948966 0 0"/>
           <geometry><cylinder radius="0.1" length="0.04"/></geometry>
         </collision>
       </link>
       <joint name="base_joint" type="fixed">
    -    <parent link="base_footprint"/><child link="base_link"/><origin xyz="0 0 -0.1"/>
    +    <parent link="base_footprint"/><child link="base_link"/><origin xyz="0 0 0.1"/>
       </joint>
       <joint name="wheel_joint" type="continuous">
         <parent link="base_link"/><child link="wheel"/><axis xyz="0 1 0"/>
       </joint>
     </robot>
    ```
    """

    code = "S911"
    name = "footprint-off-the-ground"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding for a footprint that is above or below the ground."""
        footprints = [name for name in model.frames if name.lower().endswith("footprint")]
        if len(footprints) != 1 or model.is_incomplete:
            return
        wheels = rolling_wheels(model)
        if not wheels or len(model.robot.roots()) != 1:
            return
        parents = {joint.child: joint for joint in model.robot.joints}
        children = [joint for joint in model.robot.joints if joint.parent == footprints[0]]
        joint = parents.get(footprints[0]) or (children[0] if len(children) == 1 else None)
        if (
            joint is None
            or joint.type != "fixed"
            or joint.parent not in model.frames
            or is_lifted(joint, parents, model)
        ):
            return
        ground = min(wheel.place[2] - wheel.radii[0] for wheel in wheels)
        radius = max(wheel.radii[0] for wheel in wheels)
        height = model.frames[footprints[0]].translation[2] - ground
        if abs(height) <= max(_PART * radius, _LEAST):
            return
        place, attribute = joint.element.find("origin") or joint.element, "xyz"
        links = [link.name for link in model.robot.links]
        is_first = joint.child == footprints[0] and links.index(joint.child) < links.index(joint.parent)
        # A description begins with its root link, so the parent and the child are swapped.
        if is_first and _is_reversed(joint, height, radius):
            place, attribute = joint.element.find("parent") or joint.element, "link"
        side = "above" if height > 0.0 else "below"
        message = f"link `{footprints[0]}` is {abs(height):.3g} m {side} the lowest point of the wheels"
        help = f"change the z of joint `{joint.name}` by {abs(height):.3g} m, or swap its parent and child"
        names = tuple(wheel.joint.child or "" for wheel in wheels)
        yield self.at(
            model, place, message, attribute=attribute, link=footprints[0], joint=joint.name, help=help, names=names
        )


def _is_reversed(joint: Joint, height: float, radius: float) -> bool:
    """Return whether the footprint is on the ground after a swap of parent and child of its joint."""
    return not any(joint.origin.rpy) and abs(height - 2.0 * joint.origin.xyz[2]) <= max(_PART * radius, _LEAST)
