"""I511 moving-link-without-inertial."""

from urdfkit.description.urdf.massless_links import first_massless, is_free, massless
from urdfkit.lint.facts.gazebo.plugins import is_simulated, is_simulator
from urdfkit.lint.finding import Severity
from urdfkit.lint.rule import Findings, Model, RobotRule


class MovingLinkWithoutInertial(RobotRule):
    """A link that moves has no mass or no inertia.

    ## What it does
    Checks for links that can move although neither the link nor any link fixed to it has a mass and a tensor. A link
    can move if a joint moves it, or if the robot has no root link ``world``. The finding is an error for simulators:
    with ``--target gz``, ``classic``, ``mujoco``, ``isaac`` or ``drake``, or if the robot contains Gazebo plugins. For
    other robots it is a warning. The finding for a root link is a note if there is no target and the robot has no
    ``<gazebo>``, ``<transmission>`` or ``<ros2_control>``: MuJoCo, PyBullet and Newton treat it as fixed.

    A robot without any ``<inertial>`` has a single finding. This finding is a note in two cases:

    - At most one of these conditions holds: joints move links, these links have shapes, the target is a simulator. In
      this case, a robot without collision shapes is not reported.
    - The target is not a simulator, and the robot has no ``<gazebo>``, ``<transmission>`` or ``<ros2_control>``.

    ## Why is this bad?
    Gazebo silently drops the link and all links attached to it; MuJoCo rejects the model. `urdfkit sim` estimates the
    mass and warns.

    ## Example
    ```diff
     <robot name="cart">
       <link name="base">
         <inertial>
           <mass value="1"/>
           <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/>
         </inertial>
       </link>
       <link name="wheel">
    +    <inertial>
    +      <mass value="0.2"/>
    +      <inertia ixx="0.0008" ixy="0" ixz="0" iyy="0.0008" iyz="0" izz="0.0008"/>
    +    </inertial>
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
    severity = "warning"
    not_for = frozenset(("moveit",))

    def check(self, model: Model) -> Findings:
        """Yield a finding for each moving body without a mass or inertia; one for a robot without any mass."""
        robot = model.robot
        if model.is_incomplete:
            return
        severity: Severity = "error" if is_simulated(model) else "warning"
        found = massless(robot, floating=is_free(robot))
        if not found:
            return
        is_of_control = bool(robot.gazebo or robot.ros2_control or robot.transmissions)
        if all(link.inertial is None for link in robot.links):
            link, joint = first_massless(found)
            if joint is None:  # A joint without a type moves its child if it has an axis.
                typeless = [
                    each for each in robot.joints if each.type is None and each.element.find("axis") is not None
                ]
                moved = {each.child: each for each in typeless}
                shaped = [each for each in robot.links if each.name in moved and (each.visuals or each.collisions)]
                link, joint = (shaped[0], moved[shaped[0].name]) if shaped else (link, joint)
            is_shaped = bool(link.visuals or link.collisions)
            if sum((is_shaped, joint is not None, is_simulator(model))) < 2:
                if not any(each.collisions for each in robot.links):
                    return  # It describes kinematics only.
                severity = "note"
            if not is_simulator(model) and not is_of_control:
                severity = "note"  # It describes kinematics only.
            effect = f"joints move `{link.name}` and other links" if joint is not None else "the robot is free to move"
            message = f"no link of the robot has a mass, but {effect}"
            help = "add <inertial> with <mass> and <inertia> to every link that moves"
            yield self.at(model, link.element, message, attribute="name", link=link.name, help=help, severity=severity)
            return
        for link, joint in found:
            if link.inertial is not None:
                continue  # Reported by E014, I501 or I504.
            is_static = joint is None and model.target is None and not is_of_control  # in most programs
            effect = f"is moved by joint `{joint.name}`" if joint is not None else "is free to move"
            yield self.at(
                model,
                link.element,
                f"link `{link.name}` {effect} but has no mass or no inertia",
                attribute="name",
                link=link.name,
                joint=None if joint is None else joint.name,
                help="add <inertial> with <mass> and <inertia>",
                severity="note" if is_static else severity,
                kind="free" if joint is None else "moved",
            )
