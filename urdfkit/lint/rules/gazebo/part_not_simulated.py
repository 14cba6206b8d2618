"""Z833 part-not-simulated."""

from urdfkit.lint.facts.gazebo.plugins import plugins
from urdfkit.lint.rule import Findings, Model, RobotRule


class PartNotSimulated(RobotRule):
    """A simulation with urdfkit ignores a part of the robot.

    ## What it does
    With ``--target urdfkit``, checks for plugins, sensors and controllers of types that urdfkit does not simulate.

    ## Why is this bad?
    The simulation runs without the part, or rejects the robot with ``--strict``. The part may work in Gazebo or on the
    real robot, so the rule applies only to this target.

    ## Example
    ```diff
     <robot name="rover">
       <link name="base"/>
       <gazebo>
    -    <plugin name="slip" filename="libcompany_wheel_slip.so"/>
    +    <plugin name="move" filename="libgazebo_ros_planar_move.so"/>
       </gazebo>
     </robot>
    ```
    """

    code = "Z833"
    name = "part-not-simulated"
    severity = "warning"
    only_for = ("urdfkit",)

    def check(self, model: Model) -> Findings:
        """Yield a finding for each part that a simulation ignores."""
        yield from self._plugins(model)
        yield from self._sensors(model)
        yield from self._controllers(model)

    def _plugins(self, model: Model) -> Findings:
        from urdfkit.description.plugins.gazebo_libraries import meant_library
        from urdfkit.description.plugins.lookup import match, stem
        from urdfkit.description.plugins.unknown_plugins import unknown
        from urdfkit.description.sdf.reader.world_plugins import NEEDLESS

        for plugin, _, sensor in plugins(model.robot):
            file = (plugin.filename or "").strip()
            if not file or "$" in file or model.is_unresolved(plugin.element, "filename"):
                continue
            if stem(file) in NEEDLESS or match(plugin) is not None or meant_library(stem(file)) is not None:
                continue  # The last ones are reported by Z825.
            name = None if sensor is None else sensor.name or ""
            yield self.at(model, plugin.element, unknown(plugin, name, NEEDLESS), attribute="filename")

    def _sensors(self, model: Model) -> Findings:
        from urdfkit.description.plugins.sensors.table import BARE, INSTEAD, SENSOR_TYPES
        from urdfkit.description.plugins.unknown_plugins import unsupported
        from urdfkit.errors import nearest

        for block in model.robot.gazebo:
            for sensor in block.sensors:
                kind = (sensor.type or "").strip()
                if not kind or "$" in kind or model.is_unresolved(sensor.element, "type"):
                    continue
                if kind not in (*SENSOR_TYPES, *INSTEAD) and nearest(kind, SENSOR_TYPES, cutoff=0.8) is not None:
                    continue  # Reported by Z827.
                if message := unsupported(sensor, simulated=bool(sensor.plugins) or kind in BARE):
                    yield self.at(model, sensor.element, message, attribute="type")

    def _controllers(self, model: Model) -> Findings:
        from urdfkit.description.control.controller_types import NOT_SIMULATED
        from urdfkit.lint.facts.control.loaded_controllers import loaded_controllers

        for name, settings, _ in loaded_controllers(model):
            kind = settings.group("type")
            if kind.value in NOT_SIMULATED:
                yield self.at(model, kind.position, f"controller `{name}`: {kind.value} is not simulated")
