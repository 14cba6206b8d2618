"""Z823 sensor-range-invalid."""

from collections.abc import Iterator
from math import degrees

from urdfkit.description.xml.element import Element
from urdfkit.description.xml.numbers import numbers
from urdfkit.lint.facts.gazebo.plugins import spec_of
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule


class SensorRangeInvalid(RobotRule):
    """A sensor has an invalid range, resolution, field of view or rate.

    ## What it does
    Checks for:

    - lidars without samples or with a resolution of zero, and cameras without a valid field of view
    - a minimum above its maximum: ``<min>`` and ``<max>``, ``<min_angle>`` and ``<max_angle>``, ``<near>`` and
      ``<far>``, ``<pointCloudCutoff>`` and ``<pointCloudCutoffMax>``, ``<min_range>`` and ``<max_range>``
    - values that are not numbers, negative rates and standard deviations, and angles of more than a full turn
    - lidars with a minimum range of 2 m or more, and unknown types of ``<noise>``

    ## Why is this bad?
    The sensor measures nothing, and ``urdfkit sim`` omits it.

    ## Example
    ```diff
     <robot name="cart">
       <link name="eye"/>
       <gazebo reference="eye">
         <sensor name="eye" type="camera">
           <camera>
             <clip>
    -          <near>10</near>
    -          <far>0.1</far>
    +          <near>0.1</near>
    +          <far>10</far>
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

    def check(self, model: Model) -> Findings:
        """Yield a finding for each invalid value."""
        from urdfkit.description.plugins.invalid_sensor_values import (
            WIDE,
            senseless_camera,
            senseless_numbers,
            senseless_parameters,
            senseless_scan,
        )

        for block in model.robot.gazebo:
            for sensor in block.sensors:
                defects: list[tuple[Element, str]] = [*senseless_numbers(sensor.element)]
                defects += _negative_noise(sensor.element)
                for child in sensor.element.children:
                    if child.tag in ("ray", "lidar"):
                        defects += senseless_scan(child)
                        defects += _blind(child)
                    elif child.tag == "camera":
                        defects += senseless_camera(child, is_wide=sensor.type in WIDE)
                        defects += _narrow(child)
                for plugin in sensor.plugins:
                    if (spec := spec_of(plugin, model.target)) is not None:
                        defects += senseless_parameters(plugin, spec)
                for element, message in defects:
                    if not any(model.is_unresolved(each) for each in element.walk()):
                        yield self.at(model, element, message, link=block.reference)


_BLIND = 2.0
"""Minimum range of a lidar that misses all obstacles near the robot [m]; scanners for robots have up to 1 m."""


def _blind(lidar: Element) -> Iterator[tuple[Element, str]]:
    """Yield the minimum of the range of a lidar that sees nothing near the robot."""
    limits = lidar.find("range")
    low, high = (numbers(each.text) if limits and (each := limits.find(tag)) else None for tag in ("min", "max"))
    if limits is not None and low and high and _BLIND <= low[0] < high[0]:
        element = limits.find("min")
        yield element or limits, f"the lidar detects nothing nearer than {low[0]:g} m"


_NARROW = 0.05
"""Field of view below which a camera sees almost nothing [rad]."""


def _narrow(camera: Element) -> Iterator[tuple[Element, str]]:
    """Yield the field of view of a camera that was converted to radians twice."""
    element = camera.find("horizontal_fov")
    angle = numbers(element.text) if element is not None else None
    if element is not None and angle and 0.0 < angle[0] < _NARROW:
        yield element, f"<horizontal_fov> is {angle[0]:.3g} rad, only {degrees(angle[0]):.3g}°"


_DEVIATIONS = ("stddev", "bias_stddev", "dynamic_bias_stddev", "gaussianNoise", "gaussian_noise")


def _negative_noise(sensor: Element) -> Iterator[tuple[Element, str]]:
    """Yield the negative standard deviations of a sensor and its plugins."""
    for element in sensor.walk():
        value = numbers(element.text) if element.tag in _DEVIATIONS and not element.children else None
        if value is not None and len(value) == 1 and value[0] < 0.0:
            yield element, f"<{element.tag}> is {value[0]:g}; a standard deviation must not be negative"
