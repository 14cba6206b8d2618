"""E021 urdf-version-too-low."""

from urdfkit.description.urdf.version import CAPSULE, QUATERNION, RATE_LIMITS, RATES, Version, shown, written_version
from urdfkit.description.xml.element import Element
from urdfkit.lint.fix_builders import more_attributes, new_value
from urdfkit.lint.rule import Findings, Model, RobotRule

_ADDED: tuple[tuple[str, str, Version], ...] = (
    ("origin", "quat_xyzw", QUATERNION),
    *(("limit", rate, RATE_LIMITS) for rate in RATES),
)
"""Element, attribute, and the version that added it."""


class UrdfVersionTooLow(RobotRule):
    """The robot uses a later version of URDF than it declares.

    ## What it does
    Checks for ``quat_xyzw`` and ``<capsule>``, which need ``version="1.1"`` in ``<robot>``, and for limits of
    ``acceleration``, ``deceleration`` and ``jerk``, which need ``version="1.2"``. A robot without the attribute is URDF
    1.0. The first use of each is reported. The limits are notes, because readers only ignore them, and so are capsules
    in a robot without target outside of a package, which urdfdom may never read.

    ## Why is this bad?
    Readers ignore attributes of a later version: without ``quat_xyzw`` the part has no rotation. urdfdom drops the
    collision or visual with the capsule; MuJoCo, PyBullet and urdfkit read capsules in every version.

    ## Example
    ```xml
    <robot name="arm">
      <link name="base">
        <visual>
          <origin xyz="0 0 0.1" quat_xyzw="0 0.70710678 0 0.70710678"/>
          <geometry><box size="0.1 0.1 0.3"/></geometry>
        </visual>
      </link>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm" version="1.1">
      <link name="base">
        <visual>
          <origin xyz="0 0 0.1" quat_xyzw="0 0.70710678 0 0.70710678"/>
          <geometry><box size="0.1 0.1 0.3"/></geometry>
        </visual>
      </link>
    </robot>
    ```

    ## Fix safety
    Unsafe: the fix declares the version. ROS releases before Lyrical refuse a robot of version 1.1 or later, and its
    attributes have an effect from then on.
    """

    code = "E021"
    name = "urdf-version-too-low"
    severity = "warning"
    fix = "unsafe"

    def check(self, model: Model) -> Findings:
        """Yield a finding at the first use of each attribute and element of a later version."""
        root = model.robot.element
        declared = written_version(root)
        if declared is None or declared >= RATE_LIMITS:
            return
        uses: dict[str, list[Element]] = {}
        is_for_ros = model.target is not None or model.package is not None
        needs: dict[str, Version] = {}
        for element in model.elements:
            if element.tag == "capsule" and declared < CAPSULE and model.target != "mujoco":
                uses.setdefault("<capsule>", []).append(element)
                needs["<capsule>"] = CAPSULE
            for tag, attribute, version in _ADDED:
                if element.tag == tag and attribute in element.attributes and declared < version:
                    uses.setdefault(attribute, []).append(element)
                    needs[attribute] = version
        title = f"Declare version {shown(max(needs.values()))}" if needs else ""
        for name, elements in uses.items():
            is_capsule = name == "<capsule>"
            if "version" in root.attributes:
                fix = new_value(model, root, "version", shown(max(needs.values())), "unsafe", title)
            else:
                fix = more_attributes(model, root, f'version="{shown(max(needs.values()))}"', "unsafe", title)
            more = f" ({len(elements) - 1} more)" if len(elements) > 1 else ""
            effect = "urdfdom drops the shape" if is_capsule else "it is ignored"
            yield self.at(
                model,
                elements[0],
                f"{name if is_capsule else f'`{name}`'} needs URDF {shown(needs[name])}, but the robot is URDF"
                f" {shown(declared)}: {effect}{more}",
                attribute=None if is_capsule else name,
                help=f'write version="{shown(max(needs.values()))}" in <robot>, if all readers of the robot support it',
                fix=fix,
                severity="error" if name == "quat_xyzw" else None if is_capsule and is_for_ros else "note",
            )
