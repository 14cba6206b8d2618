"""Z827 sensor-type-unknown."""

from urdfkit.defect_message import Suggestion
from urdfkit.lint.fix_builders import nearest, new_value
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule

_CLASSIC = {
    "lidar": "ray",
    "gpu_lidar": "gpu_ray",
    "depth_camera": "depth",
    "rgbd_camera": "depth",
    "rgbd": "depth",
    "navsat": "gps",
}
"""Types of Gazebo Sim → equivalent types of Gazebo Classic (gazebo11, `SensorFactory::RegisterAll`)."""

_MISNOMERS = {
    "laser": "ray",
    "hokuyo": "ray",
    "kinect": "depth",
    "openni": "depth",
    "rgb_camera": "camera",
    "webcam": "camera",
}
"""Common misnomers → SDF types."""


class SensorTypeUnknown(RobotRule):
    """A sensor has an unknown type, or no type.

    ## What it does
    Checks for a ``<sensor>`` whose ``type`` nearly matches an SDF type or is a common wrong name. For Gazebo Classic,
    also checks for types that only Gazebo Sim supports. Other types are accepted, because plugins may define their own.

    ## Why is this bad?
    Gazebo reports "Unable to create sensor" and publishes nothing.

    ## Example
    ```diff
     <robot name="cart">
       <link name="mast"/>
       <gazebo reference="mast">
    -    <sensor name="eye" type="camra"/>
    +    <sensor name="eye" type="camera"/>
       </gazebo>
     </robot>
    ```

    ## Fix safety
    Unsafe: the fix writes the nearest type, which may not be the intended one.
    """

    code = "Z827"
    name = "sensor-type-unknown"
    fix = "unsafe"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each sensor of an unknown type or without a type."""
        from urdfkit.description.plugins.sensors.table import SENSOR_TYPES

        is_classic = model.target in ("classic", "ros1")
        for block in model.robot.gazebo:
            for sensor in block.sensors:
                kind = sensor.type or ""
                if not kind.strip():
                    message = f"sensor `{sensor.name or 'sensor'}` has no type"
                    yield self.at(model, sensor.element, message, help="add a type, such as camera, imu or gpu_lidar")
                    continue
                if "$" in kind or model.is_unresolved(sensor.element, "type"):
                    continue
                expected = None
                if kind in SENSOR_TYPES or kind in ("openni_kinect", "gpu_ray"):
                    expected = _CLASSIC.get(kind) if is_classic else None
                else:
                    misnomer = nearest(kind.strip().lower(), _MISNOMERS, cutoff=0.75)
                    expected = nearest(kind.strip(), SENSOR_TYPES, cutoff=0.8) or _MISNOMERS.get(misnomer or "")
                    expected = {"ray": "gpu_lidar"}.get(expected or "", expected) if model.target == "gz" else expected
                if expected is None:
                    continue
                defect = "Gazebo Classic has no sensor type" if kind in SENSOR_TYPES else "unknown sensor type"
                message = f"{defect} `{kind}`" + Suggestion(expected, kind)
                fix = new_value(model, sensor.element, "type", expected, "unsafe")
                yield self.at(model, sensor.element, message, attribute="type", fix=fix)
