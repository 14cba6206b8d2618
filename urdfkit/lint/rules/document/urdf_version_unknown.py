"""E020 urdf-version-unknown."""

from urdfkit.description.urdf.version import VERSIONS, shown, version_of, written_version
from urdfkit.lint.rule import Findings, Model, RobotRule


class UrdfVersionUnknown(RobotRule):
    """The ``version`` of ``<robot>`` is not a version of URDF.

    ## What it does
    Checks that the attribute ``version`` of ``<robot>`` is 1.0, 1.1 or 1.2. A robot without the attribute is URDF 1.0.

    ## Why is this bad?
    urdfdom, which ROS, Pinocchio and Gazebo use, rejects unknown versions and versions that are not written as two
    numbers with a dot.

    ## Example
    ```diff
    -<robot name="arm" version="1">
    +<robot name="arm" version="1.0">
       <link name="base"/>
     </robot>
    ```
    """

    code = "E020"
    name = "urdf-version-unknown"
    not_for = frozenset(("mujoco",))

    def check(self, model: Model) -> Findings:
        """Yield a finding if the version is unknown."""
        root = model.robot.element
        if written_version(root) in VERSIONS or model.is_unresolved(root, "version"):
            return
        message = (
            f"unknown version `{root.attributes['version']}` of URDF; it is read as version {shown(version_of(root))}"
        )
        help = f"the versions of URDF are {', '.join(map(shown, VERSIONS))}"
        yield self.at(model, root, message, attribute="version", help=help)
