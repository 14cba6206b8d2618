"""E021 urdf-version-too-low."""

from urdfkit.description.urdf.version import FIRST_VERSIONS, RATES, shown, version_of
from urdfkit.description.value_defects import later_feature, later_features, other_uses
from urdfkit.lint.finding import Severity
from urdfkit.lint.fix_builders import more_attributes, new_value
from urdfkit.lint.rule import Findings, Model, RobotRule


class UrdfVersionTooLow(RobotRule):
    """The robot uses a later version of URDF than it declares.

    ## What it does
    Checks for ``quat_xyzw`` and ``<capsule>``, which need ``version="1.1"`` in ``<robot>``, and for limits of
    ``acceleration``, ``deceleration`` and ``jerk``, which need ``version="1.2"``. A robot without the attribute is URDF
    1.0. The first use of each feature is reported. The limits are reported as notes, because readers merely ignore
    them.

    ## Why is this bad?
    Readers ignore attributes of a later version: without ``quat_xyzw`` the part has no rotation. urdfdom drops the
    ``<collision>`` or ``<visual>`` element that contains a capsule. MuJoCo, PyBullet and urdfkit read capsules in every
    version.

    ## Example
    ```diff
    -<robot name="arm">
    +<robot name="arm" version="1.1">
       <link name="base">
         <visual>
           <origin xyz="0 0 0.1" quat_xyzw="0 0.70710678 0 0.70710678"/>
           <geometry><box size="0.1 0.1 0.3"/></geometry>
         </visual>
       </link>
     </robot>
    ```

    ## Fix safety
    Unsafe: the fix declares the version. ROS releases before Lyrical reject a robot of version 1.1 or later. In other
    releases, the attributes then take effect.
    """

    code = "E021"
    name = "urdf-version-too-low"
    severity = "warning"
    fix = "unsafe"

    def check(self, model: Model) -> Findings:
        """Yield a finding at the first use of each attribute and element of a later version."""
        root = model.robot.element
        declared = version_of(root)
        uses = later_features(model.robot)
        if model.target == "mujoco":
            uses.pop("capsule", None)
        if not uses or model.is_unresolved(root, "version"):
            return
        latest = max(uses, key=FIRST_VERSIONS.__getitem__)
        needed = shown(FIRST_VERSIONS[latest])
        title = f"Declare version {needed}"
        if "version" in root.attributes:
            fix = new_value(model, root, "version", needed, "unsafe", title)
        else:
            fix = more_attributes(model, root, f'version="{needed}"', "unsafe", title)
        for name, elements in uses.items():
            effect = "urdfdom drops the shape" if name == "capsule" else "readers ignore the attribute"
            message = f"{later_feature(name, declared)}: {effect}{other_uses(elements)}"
            reason = "" if shown(FIRST_VERSIONS[name]) == needed else f", which `{latest}` needs"
            help = f'write version="{needed}" in <robot>{reason}, if all readers of the robot support it'
            severity: Severity | None = "error" if name == "quat_xyzw" else "note" if name in RATES else None
            yield self.at(model, elements[0], message, attribute=name, help=help, fix=fix, severity=severity)
