"""S916 caster-with-friction."""

from urdfkit.description.urdf.robot import Sphere
from urdfkit.description.xml.numbers import number
from urdfkit.lint.model.placement import shapes_of
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule

_GRIP = 0.5
"""Coefficient of friction from which a ball that does not roll brakes the robot."""


class CasterWithFriction(RobotRule):
    """A sliding caster has as much friction as a tyre in Gazebo.

    ## What it does
    Checks ``mu1`` and ``mu`` of casters that are spheres on a fixed joint, in robots that also have the wheels of a
    drive, or a left and a right wheel. Coefficients of 0.5 or more are reported.

    ## Why is this bad?
    The ball slides instead of rolling. Its friction brakes the robot and hinders turns, so the odometry is wrong.

    ## Example
    ```diff
     <robot name="cart">
       <link name="base"/>
       <link name="left"/>
       <link name="right"/>
       <link name="caster"><visual><geometry><sphere radius="0.05"/></geometry></visual></link>
       <joint name="left_joint" type="continuous">
         <parent link="base"/><child link="left"/><origin xyz="0 0.2 0"/><axis xyz="0 1 0"/>
       </joint>
       <joint name="right_joint" type="continuous">
         <parent link="base"/><child link="right"/><origin xyz="0 -0.2 0"/><axis xyz="0 1 0"/>
       </joint>
       <joint name="caster_joint" type="fixed">
         <parent link="base"/><child link="caster"/><origin xyz="-0.3 0 -0.05"/>
       </joint>
    -  <gazebo reference="caster"><mu1>1</mu1></gazebo>
    +  <gazebo reference="caster"><mu1>0.01</mu1></gazebo>
       <gazebo>
         <plugin name="drive" filename="libgazebo_ros_diff_drive.so">
           <left_joint>left_joint</left_joint>
           <right_joint>right_joint</right_joint>
           <wheel_separation>0.4</wheel_separation>
         </plugin>
       </gazebo>
     </robot>
    ```
    """

    code = "S916"
    name = "caster-with-friction"
    severity = "warning"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each sliding caster with a large coefficient."""
        from urdfkit.lint.facts.gazebo.rolling_wheels import CASTER, pairs_of_wheels

        fixed = {joint.child for joint in model.robot.joints if joint.type == "fixed"}
        balls = {
            link.name
            for link in model.robot.links
            if link.name in fixed
            and CASTER.search(link.name)
            and shapes_of(link)
            and all(isinstance(shape.geometry, Sphere) for shape in link.collisions or link.visuals)
        }
        if not balls or not pairs_of_wheels(model):
            return
        for block in model.robot.gazebo:
            for element in block.element.walk() if block.reference in balls else ():
                value = number(element.text or element.get("value") or "") if element.tag in ("mu", "mu1") else None
                if value is not None and value >= _GRIP:
                    message = f"<{element.tag}> of caster `{block.reference}` is {value:g}, but the ball cannot roll"
                    yield self.at(model, element, message, link=block.reference, help="write a coefficient near 0")
                    break
