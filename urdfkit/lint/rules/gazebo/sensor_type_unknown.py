"""Z827 sensor-type-unknown."""

from __future__ import annotations

from urdfkit.lint.edits import nearest, new_value
from urdfkit.lint.rule import NOT_GAZEBO, RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model

_CLASSIC = {
    "lidar": "ray",
    "gpu_lidar": "gpu_ray",
    "depth_camera": "depth",
    "rgbd_camera": "depth",
    "rgbd": "depth",
    "navsat": "gps",
}
"""Types of the new Gazebo → what Gazebo classic has instead (gazebo11, `SensorFactory::RegisterAll`)."""

_OFTEN = {
    "laser": "ray",
    "hokuyo": "ray",
    "kinect": "depth",
    "openni": "depth",
    "rgb_camera": "camera",
    "webcam": "camera",
}
"""What people call a sensor → its type."""


class SensorTypeUnknown(RobotRule):
    """There is no sensor of that type.

    ## What it does
    Looks for a ``type`` of a ``<sensor>`` that is nearly one of SDF's, or that is often taken for one, and, for Gazebo
    classic, for types that only the new Gazebo has. Other names pass: plugins may bring sensors of their own.

    ## Why is this bad?
    "Unable to create sensor": nothing is published.

    ## Example
    ```xml
    <robot name="cart">
      <link name="mast"/>
      <gazebo reference="mast">
        <sensor name="eye" type="camra"/>
      </gazebo>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="cart">
      <link name="mast"/>
      <gazebo reference="mast">
        <sensor name="eye" type="camera"/>
      </gazebo>
    </robot>
    ```

    ## Fix safety
    Unsafe: the type with the nearest name is taken.
    """

    code = "Z827"
    name = "sensor-type-unknown"
    fix = "unsafe"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each sensor of a type that is not there."""
        from urdfkit.description.plugins.sensors import SENSOR_TYPES

        is_classic = model.target in ("classic", "ros1")
        for block in model.robot.gazebo:
            for sensor in block.sensors:
                kind = sensor.type or ""
                if not kind or "$" in kind or model.is_unresolved(sensor.element, "type"):
                    continue
                right = None
                if kind in SENSOR_TYPES or kind in ("openni_kinect", "gpu_ray"):
                    right = _CLASSIC.get(kind) if is_classic else None
                else:
                    right = _OFTEN.get(kind.lower()) or nearest(kind.strip(), SENSOR_TYPES, likeness=0.8)
                    right = {"ray": "gpu_lidar"}.get(right or "", right) if model.target == "gz" else right
                if right is None:
                    continue
                which = "Gazebo classic has no sensor" if kind in SENSOR_TYPES else "there is no sensor"
                yield self.at(
                    model,
                    sensor.element,
                    f"{which} of type `{kind}`; did you mean `{right}`?",
                    attribute="type",
                    fix=new_value(model, sensor.element, "type", right, "unsafe", f"Write `{right}`"),
                )
