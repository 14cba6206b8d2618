"""I511 moving-link-without-inertial."""

from urdfkit.description.urdf.massless_links import massless
from urdfkit.description.urdf.robot import Joint
from urdfkit.description.xml.numbers import number
from urdfkit.lint.facts.gazebo.plugins import is_simulated
from urdfkit.lint.rule import Findings, Model, RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from urdfkit.lint.finding import Severity


class MovingLinkWithoutInertial(RobotRule):
    """A link that moves has no mass or no inertia.

    ## What it does
    Checks for links with a shape that a joint moves, where neither the link nor any link fixed to it has a mass and a
    tensor. The finding is an error for simulators: with ``--target gz``, ``classic``, ``mujoco``, ``isaac`` or
    ``drake``, or if the robot contains Gazebo plugins. For other robots it is a note. A robot without any mass is
    reported once, and only if it is simulated.

    ## Why is this bad?
    Gazebo silently drops the link and all links attached to it; MuJoCo rejects the model.

    ## Example
    ```xml
    <robot name="cart">
      <link name="base">
        <inertial>
          <mass value="1"/>
          <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/>
        </inertial>
      </link>
      <link name="wheel">
        <visual><geometry><sphere radius="0.1"/></geometry></visual>
      </link>
      <joint name="axle" type="continuous">
        <parent link="base"/>
        <child link="wheel"/>
        <axis xyz="0 1 0"/>
      </joint>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="cart">
      <link name="base">
        <inertial>
          <mass value="1"/>
          <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/>
        </inertial>
      </link>
      <link name="wheel">
        <inertial>
          <mass value="0.2"/>
          <inertia ixx="0.0008" ixy="0" ixz="0" iyy="0.0008" iyz="0" izz="0.0008"/>
        </inertial>
        <visual><geometry><sphere radius="0.1"/></geometry></visual>
      </link>
      <joint name="axle" type="continuous">
        <parent link="base"/>
        <child link="wheel"/>
        <axis xyz="0 1 0"/>
      </joint>
    </robot>
    ```
    """

    code = "I511"
    name = "moving-link-without-inertial"
    severity = "note"
    not_for = frozenset(("moveit",))

    def check(self, model: Model) -> Findings:
        """Yield a finding for each moving body without a mass or inertia; one for a robot without any mass."""
        robot = model.robot
        if model.is_incomplete:
            return
        shaped = [link.name for link in robot.links if link.visuals or link.collisions]
        severity: Severity = "error" if is_simulated(model) else "note"
        if all(link.inertial is None for link in robot.links):
            moved = {joint.child for joint in robot.joints if _is_moving(joint)}
            first = next((link for link in robot.links if link.name in moved and link.name in shaped), None)
            if first is not None and severity == "error":
                yield self.at(
                    model,
                    first.element,
                    f"no link of the robot has a mass, but joints move `{first.name}` and other links",
                    attribute="name",
                    link=first.name,
                    help="add <inertial> with <mass> and <inertia> to every link that moves",
                    severity=severity,
                )
            return
        for link, joint in massless(robot, floating=False):
            if joint is None or link.name not in shaped:
                continue
            inertial = link.inertial
            if inertial is not None and inertial.mass is not None and inertial.inertia is not None:
                continue  # Both exist but are zero: reported by I501 and I504.
            if inertial is not None and any(
                model.is_unresolved(child, name) or (child.tag in ("mass", "inertia") and number(value) is None)
                for child in inertial.element.children
                for name, value in child.attributes.items()
            ):
                continue  # They exist, but could not be computed or read.
            yield self.at(
                model,
                link.element,
                f"link `{link.name}` is moved by joint `{joint.name}` but has no mass or no inertia",
                attribute="name",
                link=link.name,
                joint=joint.name,
                help="add <inertial> with <mass> and <inertia>",
                severity=severity,
            )


def _is_moving(joint: Joint) -> bool:
    return joint.is_movable or (joint.type is None and joint.element.find("axis") is not None)
