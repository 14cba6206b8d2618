"""I501 mass-nonpositive."""

from urdfkit.description.urdf.massless_links import is_free, massless
from urdfkit.lint.facts.gazebo.plugins import is_simulated
from urdfkit.lint.finding import Severity
from urdfkit.lint.rule import Findings, Model, RobotRule

_HELP = "set a mass greater than 0 kg"


class MassNonpositive(RobotRule):
    """A moving link has no mass, or a link has a negative mass.

    ## What it does
    Checks for a negative ``<mass>``. Also reports a mass of zero in two cases: if a joint moves the link and no link
    fixed to it has a mass, and if the link has a shape and an inertia and is not fixed to another link. A mass of zero
    is only a warning for robots that are not simulated.

    ## Why is this bad?
    Simulators divide by the mass. check_urdf accepts a mass of zero, Gazebo drops the link, and MuJoCo rejects the
    model.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base">
         <inertial>
    -      <mass value="-1"/>
    +      <mass value="1"/>
           <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/>
         </inertial>
       </link>
     </robot>
    ```
    """

    code = "I501"
    name = "mass-nonpositive"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each negative mass and each mass of zero of a moving link."""
        moved: dict[str, str | None] | None = None
        fixed = {joint.child for joint in model.robot.joints if joint.type == "fixed"}
        for link in model.robot.links:
            mass = link.inertial.mass if link.inertial is not None else None
            if link.inertial is None or mass is None or mass > 0.0:
                continue
            element = link.inertial.element.find("mass") or link.inertial.element
            if mass < 0.0:
                message = f"mass of link `{link.name}` is negative: {mass:g} kg"
                yield self.at(model, element, message, link=link.name, help=_HELP)
                continue
            tensor = link.inertial.inertia
            has_inertia = tensor is not None and min(tensor.ixx, tensor.iyy, tensor.izz) > 0.0
            if has_inertia and (link.visuals or link.collisions) and link.name not in fixed:
                message = f"link `{link.name}` has an inertia but no mass"
                severity: Severity | None = None if is_simulated(model) else "warning"
                yield self.at(model, element, message, attribute="value", link=link.name, help=_HELP, severity=severity)
                continue
            if moved is None:
                found = massless(model.robot, floating=is_free(model.robot))
                moved = {body.name: None if joint is None else joint.name for body, joint in found}
            if link.name in moved:
                why = f"is moved by joint `{moved[link.name]}`" if moved[link.name] else "is free to move"
                yield self.at(
                    model,
                    element,
                    f"link `{link.name}` {why} but has no mass",
                    attribute="value",
                    link=link.name,
                    help=_HELP,
                    severity=None if is_simulated(model) else "warning",
                )
