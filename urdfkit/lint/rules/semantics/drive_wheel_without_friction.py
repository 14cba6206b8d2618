"""S914 drive-wheel-without-friction."""

from collections.abc import Iterator

from urdfkit.description.urdf.robot import Joint
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule


class DriveWheelWithoutFriction(RobotRule):
    """A wheel that drives the robot has no friction in Gazebo.

    ## What it does
    Checks ``mu``, ``mu1`` and ``mu2`` of the wheels of differential and skid-steer drives without ``fdir1``. Also
    reports a wheel without coefficients if all other drive wheels have coefficients, and mecanum wheels whose
    ``fdir1``, ``mu`` and ``mu2`` give friction across their rollers instead of along them. Casters are not checked.

    ## Why is this bad?
    The wheel spins, and the robot does not move.

    ## Example
    ```diff
     <robot name="cart">
       <link name="base"/>
       <link name="left"/>
       <link name="right"/>
       <joint name="left_joint" type="continuous">
         <parent link="base"/><child link="left"/><origin xyz="0 0.2 0"/><axis xyz="0 1 0"/>
       </joint>
       <joint name="right_joint" type="continuous">
         <parent link="base"/><child link="right"/><origin xyz="0 -0.2 0"/><axis xyz="0 1 0"/>
       </joint>
    -  <gazebo reference="left"><mu1>0</mu1></gazebo>
    -  <gazebo reference="right"><mu1>0</mu1></gazebo>
    +  <gazebo reference="left"><mu1>1</mu1></gazebo>
    +  <gazebo reference="right"><mu1>1</mu1></gazebo>
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

    code = "S914"
    name = "drive-wheel-without-friction"
    severity = "warning"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each drive wheel with a coefficient of zero."""
        from urdfkit.lint.facts.gazebo.mecanum_friction import wrong_frictions

        driven = list(_driven(model))
        wheels = {joint.child: joint.name for joint in driven}
        yield from self._of_others_only(model, driven)
        for element, call, message, help, link in wrong_frictions(model):
            if call is not None:
                yield self.at_span(model.span(call), message, help=help)
            else:
                yield self.at(model, element, message, link=link, help=help)
        for block in model.robot.gazebo:
            elements = list(block.element.walk()) if block.reference in wheels else []
            if any(element.tag == "fdir1" for element in elements):
                continue
            for element in (each for each in elements if each.tag in ("mu", "mu1", "mu2")):
                text = (element.text or element.get("value") or "").strip()
                if text and not text.strip("0.+-"):
                    name = block.reference
                    message = f"<{element.tag}> of wheel `{name}` is 0, but its joint `{wheels[name]}` drives the robot"
                    yield self.at(model, element, message, link=name, help="write a coefficient near 1")

    def _of_others_only(self, model: Model, driven: list[Joint]) -> Findings:
        """Yield a finding for the only drive wheel without the coefficients that all others have."""
        written = {
            block.reference
            for block in model.robot.gazebo
            if block.reference and any(each.tag in ("mu", "mu1") for each in block.element.walk())
        }
        lacking = [joint for joint in driven if joint.child not in written]
        if len(lacking) == 1 and len({joint.child for joint in driven}) > 1 and not model.is_incomplete:
            joint = lacking[0]
            message = f"wheel `{joint.child}` has no <mu1>, unlike the other wheels that drive the robot"
            help = f'write it in <gazebo reference="{joint.child}">'
            yield self.at(model, joint.element, message, link=joint.child, joint=joint.name, help=help)


def _driven(model: Model) -> Iterator[Joint]:
    """Yield the joints of wheels that a Gazebo drive or a controller for differential drives names."""
    from urdfkit.lint.facts.control.controller_wheels import diff_drives, wheels_of
    from urdfkit.lint.facts.gazebo.drive_wheels import drives

    for drive in drives(model):
        if drive.spec.kind != "mecanum_drive":
            yield from (wheel.joint for wheel in (*drive.left, *drive.right))
    for _, controller in diff_drives(model):
        for side in ("left", "right"):
            yield from (wheel.joint for _, wheel in wheels_of(controller, model, side))
