"""Z836 plugin-in-wrong-sensor."""

import re

from urdfkit.description.plugins.lookup import stem
from urdfkit.description.urdf.robot import SensorTag
from urdfkit.lint.facts.gazebo.plugins import plugins
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule


class PluginInWrongSensor(RobotRule):
    """A plugin is outside a sensor, or in a sensor of a type that it does not accept.

    ## What it does
    Checks the plugins of gazebo_ros_pkgs and velodyne_simulator that publish the data of a sensor.
    `libgazebo_ros_gpu_laser.so`, for example, must be in a sensor of type `gpu_ray`.

    ## Why is this bad?
    Gazebo Classic stops loading the plugin, so the plugin publishes no data.

    ## Example
    ```diff
     <robot name="cart">
       <link name="mast"/>
       <gazebo reference="mast">
         <sensor name="laser" type="ray">
    -      <plugin name="laser" filename="libgazebo_ros_gpu_laser.so"/>
    +      <plugin name="laser" filename="libgazebo_ros_laser.so"/>
         </sensor>
       </gazebo>
     </robot>
    ```
    """

    code = "Z836"
    name = "plugin-in-wrong-sensor"
    not_for = NOT_GAZEBO | {"gz"}

    def check(self, model: Model) -> Findings:
        """Yield a finding for each plugin in a sensor of another type, and outside of a sensor."""
        from urdfkit.description.plugins.sensors.table import SENSOR_TYPES, SENSORS_OF_LIBRARIES

        for plugin, _, sensor in plugins(model.robot):
            library = stem(plugin.filename or "")
            types = SENSORS_OF_LIBRARIES.get(library)
            kind = (sensor.type or "").strip() if sensor is not None else None
            is_sensor_type = kind is None or kind in SENSOR_TYPES
            is_computed = sensor is not None and model.is_unresolved(sensor.element, "type")
            if types is None or not is_sensor_type or kind in types or is_computed:
                continue
            required = f"plugin `{library}` requires a sensor of type `{types[0]}`"
            message = f"{required}, but is outside any <sensor>" if kind is None else f"{required}, not `{kind}`"
            others = [
                name for name, accepted in SENSORS_OF_LIBRARIES.items() if kind in accepted and _alike(name, library)
            ]
            help = f'write type="{types[0]}"' + (f", or use lib{others[0]}.so" if others else "")
            is_type_wrong = sensor is not None and _is_of_other_type(sensor, types)
            yield self.at(
                model,
                sensor.element if sensor is not None and is_type_wrong else plugin.element,
                message,
                attribute="type" if is_type_wrong else "filename",
                help=f'put it into <sensor type="{types[0]}">' if kind is None else help,
            )


def _is_of_other_type(sensor: SensorTag, types: tuple[str, ...]) -> bool:
    """Return whether the name or an element of a sensor is that of an accepted type, and none that of its own."""
    words = {*re.split(r"[^a-z]+", (sensor.name or "").lower()), *(child.tag for child in sensor.element.children)}
    return not words.isdisjoint(types) and (sensor.type or "").strip() not in words


def _alike(first: str, second: str) -> bool:
    """Return whether two libraries differ only in where the rays are computed."""
    return first.replace("_gpu", "") == second.replace("_gpu", "")
