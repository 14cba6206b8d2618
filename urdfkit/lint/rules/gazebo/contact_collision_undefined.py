"""Z837 contact-collision-undefined."""

import re

from urdfkit.lint.fix_builders import meant, new_text
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule

_COUNT = re.compile(r"_\d+$")


class ContactCollisionUndefined(RobotRule):
    """A contact sensor names an undefined collision.

    ## What it does
    Compares the ``<collision>`` of contact sensors with the names that Gazebo gives to the collisions of the links:
    ``LINK_collision``, ``LINK_collision_1``, ..., or ``NAME_collision`` and ``NAME`` for a collision with a name. The
    prefix ``PARENT_fixed_joint_lump__``, which Gazebo adds to the collisions of links on fixed joints, is accepted.

    ## Why is this bad?
    Gazebo reports neither contacts nor an error for an unknown collision, so the bumper never triggers.

    ## Example
    ```diff
     <robot name="cart">
       <link name="bumper">
         <visual><geometry><box size="0.02 0.2 0.05"/></geometry></visual>
         <inertial><mass value="1"/><inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial>
         <collision><geometry><box size="0.02 0.2 0.05"/></geometry></collision>
       </link>
       <gazebo reference="bumper">
         <sensor name="bumper_contact" type="contact">
    -      <contact><collision>bumper_link_collision</collision></contact>
    +      <contact><collision>bumper_collision</collision></contact>
         </sensor>
       </gazebo>
     </robot>
    ```

    ## Fix safety
    Unsafe: the fix writes the most similar name, which may not be the intended one.
    """

    code = "Z837"
    name = "contact-collision-undefined"
    severity = "warning"
    fix = "unsafe"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each undefined collision of a contact sensor."""
        blocks = model.robot.gazebo
        sensors = [(block, sensor) for block in blocks for sensor in block.sensors if sensor.type == "contact"]
        if not sensors or model.is_incomplete:
            return
        names: dict[str, None] = {}
        for link in model.robot.links:
            for k, collision in enumerate(link.collisions):
                own = collision.element.get("name")
                names |= dict.fromkeys([f"{link.name}_collision{f'_{k}' if k else ''}"])
                names |= dict.fromkeys([f"{own}_collision", own] if own else [])
        for block in blocks:  # Gazebo adds these to the links.
            added = (each.get("name") for each in block.element.find_all("collision"))
            names |= dict.fromkeys(name for name in added if name)
        for block, sensor in sensors:
            for element in sensor.element.walk():
                if element.tag != "collision" or not element.text or model.is_unresolved(element):
                    continue
                name = element.text.strip().rpartition("::")[2].rpartition("_fixed_joint_lump__")[2]
                name = name.replace("_collision_collision", "_collision")  # as of old releases
                if name in names or _COUNT.sub("", name) in names or name.startswith("_") or "$" in name:
                    continue
                near, hint = meant(name, names)
                message = f"<collision> names the undefined collision `{name}`" + hint
                fix = new_text(model, element, near, "unsafe")
                yield self.at(model, element, message, link=block.reference or "", fix=fix)
