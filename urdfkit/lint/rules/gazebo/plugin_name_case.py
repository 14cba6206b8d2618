"""Z808 plugin-name-case."""

from __future__ import annotations

from urdfkit.lint.edits import new_value
from urdfkit.lint.gazebo import plugins
from urdfkit.lint.rule import NOT_GAZEBO, RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model


class PluginNameCase(RobotRule):
    """A system of the new Gazebo is called in the wrong case.

    ## What it does
    Compares the ``name`` of plugins that begins with ``gz::`` or ``ignition::`` with the classes it knows, without
    regard to case.

    ## Why is this bad?
    In the new Gazebo the name is that of the C++ class: ``gz::sim::Systems::DiffDrive`` is found nowhere and the
    plugin is not loaded.

    ## Example
    ```xml
    <robot name="cart">
      <link name="base"/>
      <gazebo>
        <plugin name="gz::sim::Systems::OdometryPublisher" filename="gz-sim-odometry-publisher-system"/>
      </gazebo>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="cart">
      <link name="base"/>
      <gazebo>
        <plugin name="gz::sim::systems::OdometryPublisher" filename="gz-sim-odometry-publisher-system"/>
      </gazebo>
    </robot>
    ```

    ## Fix safety
    Safe: there is one class of that name.
    """

    code = "Z808"
    name = "plugin-name-case"
    fix = "safe"
    not_for = NOT_GAZEBO | {"classic", "ros1"}

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each class in the wrong case."""
        from urdfkit.description.plugins import ALL_SPECS

        classes = {name.lower(): name for spec in ALL_SPECS for name in spec.class_names}
        for plugin, _, _ in plugins(model.robot):
            name = (plugin.name or "").strip()
            if not name.lower().startswith(("gz::", "ignition::", "gz_ros2_control::", "ign_ros2_control::")):
                continue
            right = classes.get(name.lower())
            if right is None and "::systems::" in name.lower() and "::systems::" not in name:
                at = name.lower().index("::systems::")
                right = f"{name[:at]}::systems::{name[at + 11 :]}"
            if right is not None and right != name:
                yield self.at(
                    model,
                    plugin.element,
                    f"there is no class `{name}`; it is `{right}`",
                    attribute="name",
                    fix=new_value(model, plugin.element, "name", right, "safe", f"Write `{right}`"),
                )
