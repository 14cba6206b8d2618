"""Z811 gazebo-unknown-link-tag."""

from __future__ import annotations

from urdfkit.lint.edits import nearest, new_tag
from urdfkit.lint.rule import NOT_GAZEBO, RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model

KEYS = (
    "material",
    "turnGravityOff",
    "dampingFactor",
    "maxVel",
    "minDepth",
    "mu1",
    "mu2",
    "fdir1",
    "kp",
    "kd",
    "selfCollide",
    "maxContacts",
    "laserRetro",
    "stopCfm",
    "stopErp",
    "stopKp",
    "stopKd",
    "initial_joint_position",
    "fudgeFactor",
    "provideFeedback",
    "implicitSpringDamper",
    "cfmDamping",
    "springStiffness",
    "springReference",
    "preserveFixedJoint",
    "disableFixedJointLumping",
)
"""What parser_urdf.cc of sdformat (12.3) reads in ``<gazebo reference>``."""

_MEANT = {"mu": "mu1", "mul": "mu1"}
_SDF = frozenset(
    (
        "sensor",
        "plugin",
        "visual",
        "collision",
        "projector",
        "gripper",
        "gravity",
        "self_collide",
        "kinematic",
        "velocity_decay",
        "enable_wind",
        "must_be_base_link",
        "audio_sink",
        "audio_source",
        "battery",
        "light",
        "particle_emitter",
        "inertial",
        "pose",
        "static",
        "physics",
        "axis",
        "max_contacts",
        "laser_retro",
        "surface",
        "frame",
    )
)


class GazeboUnknownTag(RobotRule):
    """An extension in ``<gazebo reference="…">`` is misspelt, or an element of a ``<sensor>``.

    ## What it does
    Compares what is in the block with the names that sdformat turns into friction, stiffness, colour …, and says
    the nearest one. Names that are near to none pass: they may be SDF. In a ``<sensor>`` everything is SDF, so there
    every name that SDF does not know in that place is told.

    ## Why is this bad?
    What sdformat does not know it copies as it is, and Gazebo skips it: ``<mu>`` is no friction, ``<selfcollide>``
    nothing, and a camera with ``<horisontal_fov>`` has the field of view that cameras have by default.

    ## Example
    ```xml
    <robot name="cart">
      <link name="base"/>
      <gazebo reference="base">
        <selfcollide>true</selfcollide>
      </gazebo>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="cart">
      <link name="base"/>
      <gazebo reference="base">
        <selfCollide>true</selfCollide>
      </gazebo>
    </robot>
    ```

    ## Fix safety
    Unsafe: the nearest name is taken.
    """

    code = "Z811"
    name = "gazebo-unknown-link-tag"
    severity = "warning"
    fix = "unsafe"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each name that is nearly one of sdformat's, and each that no sensor knows."""
        from urdfkit.description.plugins.elements import strangers

        for block in model.robot.gazebo:
            for child in block.element.children if block.reference else ():
                if child.tag in KEYS or child.tag in _SDF or ":" in child.tag:
                    continue
                meant = _MEANT.get(child.tag) or nearest(child.tag, KEYS, likeness=0.7)
                if meant is not None:
                    yield self.at(
                        model,
                        child,
                        f"sdformat knows no <{child.tag}>",
                        help=f"did you mean <{meant}>?",
                        fix=new_tag(model, child, meant, "unsafe", f"Write <{meant}>"),
                    )
            for sensor in block.sensors:
                for stranger in strangers(sensor.element):
                    near, element = stranger.meant, stranger.element
                    yield self.at(
                        model,
                        element,
                        f"<{stranger.inside}> of a sensor knows no <{element.tag}>",
                        help=f"did you mean <{near}>?" if near else None,
                        fix=new_tag(model, element, near, "unsafe", f"Write <{near}>") if near else None,
                    )
