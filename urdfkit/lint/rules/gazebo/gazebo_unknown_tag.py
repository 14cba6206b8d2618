"""Z811 gazebo-unknown-link-tag."""

from urdfkit.defect_message import Suggestion
from urdfkit.lint.fix_builders import nearest, new_tag
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule

KEYS = (
    *("material", "turnGravityOff", "dampingFactor", "maxVel", "minDepth", "mu1", "mu2", "fdir1", "kp", "kd"),
    *("selfCollide", "maxContacts", "laserRetro", "stopCfm", "stopErp", "stopKp", "stopKd"),
    *("initial_joint_position", "fudgeFactor", "provideFeedback", "implicitSpringDamper", "cfmDamping"),
    *("springStiffness", "springReference", "preserveFixedJoint", "disableFixedJointLumping"),
)
"""The elements that parser_urdf.cc of sdformat (12.3) reads in ``<gazebo reference>``."""

_OF_JOINTS = ("preserveFixedJoint", "disableFixedJointLumping")
"""The elements that parser_urdf.cc of sdformat searches for in the blocks of joints only."""

_ALIASES = {"mu": "mu1", "mul": "mu1"}
_SDF = frozenset(
    (
        *("sensor", "plugin", "visual", "collision", "projector", "gripper", "gravity", "self_collide", "kinematic"),
        *("velocity_decay", "enable_wind", "must_be_base_link", "audio_sink", "audio_source", "battery", "light"),
        *("particle_emitter", "inertial", "pose", "static", "physics", "axis", "max_contacts", "laser_retro"),
        *("surface", "frame"),
    )
)


class GazeboUnknownTag(RobotRule):
    """An element of ``<gazebo reference="…">`` or of a ``<sensor>`` is unknown.

    ## What it does
    Compares the elements of each ``<gazebo>`` block with the names that sdformat converts to friction, stiffness,
    colour and other properties, and suggests the nearest name. An element that resembles none of these names is
    accepted, because it may be an SDF element. ``preserveFixedJoint`` in the block of a link is reported, because only
    joints have this property. The content of a ``<sensor>`` is SDF, so every element that SDF does not define for
    sensors is reported.

    ## Why is this bad?
    sdformat copies an unknown element unchanged, and Gazebo ignores it: ``<mu>`` sets no friction, ``<selfcollide>``
    has no effect, and a camera with ``<horisontal_fov>`` has the default field of view.

    ## Example
    ```diff
     <robot name="cart">
       <link name="base"/>
       <gazebo reference="base">
    -    <selfcollide>true</selfcollide>
    +    <selfCollide>true</selfCollide>
       </gazebo>
     </robot>
    ```

    ## Fix safety
    Unsafe: the fix renames the element to the nearest known name, which may not be the intended one.
    """

    code = "Z811"
    name = "gazebo-unknown-link-tag"
    severity = "warning"
    fix = "unsafe"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each misspelt element of a block, and each unknown element of a sensor."""
        from urdfkit.description.plugins.sensor_elements import unknown_elements

        for block in model.robot.gazebo:
            for child in block.element.children if block.reference else ():
                if child.tag in _OF_JOINTS and block.reference in model.robot.link_by_name:
                    if block.reference not in model.robot.joint_by_name:
                        message = f"<{child.tag}> has no effect in the block of link `{block.reference}`"
                        help: str | None = "write it in a block of the fixed joint"
                        yield self.at(model, child, message, link=block.reference, help=help)
                    continue
                if child.tag in KEYS or child.tag in _SDF or ":" in child.tag:
                    continue
                suggestion = _ALIASES.get(child.tag) or nearest(child.tag, KEYS, cutoff=0.7)
                if suggestion is not None:
                    message = f"unknown element <{child.tag}> in <gazebo>"
                    help = Suggestion(f"<{suggestion}>", before="")
                    yield self.at(model, child, message, help=help, fix=new_tag(model, child, suggestion, "unsafe"))
            for sensor in block.sensors:
                for unknown in unknown_elements(sensor.element):
                    near, element = unknown.meant, unknown.element
                    message = f"unknown element <{element.tag}> in <{unknown.inside}> of a sensor"
                    help = Suggestion(f"<{near}>", before="") if near else None
                    yield self.at(model, element, message, help=help, fix=new_tag(model, element, near, "unsafe"))
