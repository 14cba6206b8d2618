"""Z823 sensor-range-invalid."""

from __future__ import annotations

from urdfkit.lint.gazebo import spec_of
from urdfkit.lint.rule import NOT_GAZEBO, RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.description.element import Element
    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model


class SensorRangeInvalid(RobotRule):
    """A sensor is told to look where nothing is.

    ## What it does
    Looks for lidars without samples or with a resolution of zero, for a smaller number above the larger one in
    ``<min>`` and ``<max>``, ``<min_angle>`` and ``<max_angle>``, ``<near>`` and ``<far>``, ``<pointCloudCutoff>`` and
    ``<pointCloudCutoffMax>``, ``<min_range>`` and ``<max_range>``, and for cameras whose field of view is none. Also
    for numbers that are none, rates below zero and angles of more than a full turn.

    ## Why is this bad?
    Such a sensor sees nothing; the simulator of this package leaves it out.

    ## Example
    ```xml
    <robot name="cart">
      <link name="eye"/>
      <gazebo reference="eye">
        <sensor name="eye" type="camera">
          <camera>
            <clip>
              <near>10</near>
              <far>0.1</far>
            </clip>
          </camera>
        </sensor>
      </gazebo>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="cart">
      <link name="eye"/>
      <gazebo reference="eye">
        <sensor name="eye" type="camera">
          <camera>
            <clip>
              <near>0.1</near>
              <far>10</far>
            </clip>
          </camera>
        </sensor>
      </gazebo>
    </robot>
    ```
    """

    code = "Z823"
    name = "sensor-range-invalid"
    severity = "error"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each number that leaves nothing to see."""
        from urdfkit.description.plugins.sense import (
            WIDE,
            senseless_camera,
            senseless_numbers,
            senseless_parameters,
            senseless_scan,
        )

        for block in model.robot.gazebo:
            for sensor in block.sensors:
                found: list[tuple[Element, str]] = [*senseless_numbers(sensor.element)]
                for child in sensor.element.children:
                    if child.tag in ("ray", "lidar"):
                        found += senseless_scan(child)
                    elif child.tag == "camera":
                        found += senseless_camera(child, is_wide=sensor.type in WIDE)
                for plugin in sensor.plugins:
                    if (spec := spec_of(plugin, model.target)) is not None:
                        found += senseless_parameters(plugin, spec)
                for element, message in found:
                    if not any(model.is_unresolved(each) for each in element.walk()):
                        yield self.at(model, element, message, link=block.reference)
