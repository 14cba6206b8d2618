"""E022 urdf-version-unsupported."""

from urdfkit.description.urdf.version import VERSIONS, shown, written_version
from urdfkit.lint.rule import Findings, Model, RobotRule

_READERS = ("lyrical", "rolling")
"""ROS 2 releases with urdfdom 5.1 or later, which reads URDF 1.1 and 1.2."""


class UrdfVersionUnsupported(RobotRule):
    """The targeted ROS release does not support the URDF version of the robot.

    ## What it does
    With ``--target ros1``, ``ros2`` or ``classic``, checks that the release supports the ``version`` of ``<robot>``.
    ROS 2 Lyrical and Rolling read URDF 1.1 and 1.2. All other releases read URDF 1.0 only. For ``ros2`` without a
    release the finding is a note.

    ## Why is this bad?
    urdfdom 3 and 4, the readers of Humble and Jazzy, reject the robot: "only version 1.0 is currently supported".
    Older readers ignore ``quat_xyzw`` and drop capsules.

    ## Example
    ```diff
    -<robot name="arm" version="1.1">
    +<robot name="arm">
       <link name="base">
         <visual>
    -      <origin xyz="0 0 0.1" quat_xyzw="0 0.70710678 0 0.70710678"/>
    +      <origin xyz="0 0 0.1" rpy="0 1.57079633 0"/>
           <geometry><box size="0.1 0.1 0.3"/></geometry>
         </visual>
       </link>
     </robot>
    ```
    """

    code = "E022"
    name = "urdf-version-unsupported"
    only_for = ("ros1", "ros2", "classic")

    def check(self, model: Model) -> Findings:
        """Yield a finding if the target does not read the version of the robot."""
        root = model.robot.element
        version = written_version(root)
        if version is None or version == VERSIONS[0] or version not in VERSIONS or model.release in _READERS:
            return
        names = {"ros1": "ROS 1", "ros2": "ROS 2", "classic": "Gazebo Classic"}
        reader = f"{names[model.target or '']} {model.release.capitalize()}".strip()
        is_any = model.target == "ros2" and not model.release
        message = (
            f"URDF {shown(version)} is read by ROS 2 Lyrical and Rolling only"
            if is_any
            else f"{reader} reads URDF 1.0 only, but the robot is URDF {shown(version)}"
        )
        help = "write URDF 1.0: `rpy` instead of `quat_xyzw`, other shapes instead of capsules, and no limits of"
        help += " acceleration, deceleration and jerk"
        yield self.at(model, root, message, attribute="version", help=help, severity="note" if is_any else None)
