"""Z804 sensor-frame-undefined."""

from __future__ import annotations

from urdfkit.lint.edits import meant, new_text
from urdfkit.lint.gazebo import is_frame, references
from urdfkit.lint.hidden import doubted
from urdfkit.lint.rule import NOT_GAZEBO, RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.description.element import Element
    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model


class SensorFrameUndefined(RobotRule):
    """A sensor speaks of a frame that the robot does not have.

    ## What it does
    Compares ``frameName``, ``frame_name``, ``gz_frame_id`` … of sensors with the links. ``world``, ``map`` and
    ``odom`` are frames outside of the robot.

    ## Why is this bad?
    Its pictures and scans come with a frame that TF does not know: RViz shows nothing, localisation waits.

    ## Example
    ```xml
    <robot name="cart">
      <link name="camera"/>
      <gazebo reference="camera">
        <sensor name="eye" type="camera">
          <plugin name="eye" filename="libgazebo_ros_camera.so">
            <cameraName>eye</cameraName>
            <frameName>camera_link</frameName>
          </plugin>
        </sensor>
      </gazebo>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="cart">
      <link name="camera"/>
      <gazebo reference="camera">
        <sensor name="eye" type="camera">
          <plugin name="eye" filename="libgazebo_ros_camera.so">
            <cameraName>eye</cameraName>
            <frameName>camera</frameName>
          </plugin>
        </sensor>
      </gazebo>
    </robot>
    ```

    ## Fix safety
    Unsafe: the link with the nearest name is taken.
    """

    code = "Z804"
    name = "sensor-frame-undefined"
    severity = "warning"
    fix = "unsafe"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each frame of a sensor that is no link."""
        for text, element, tag in self._frames(model):
            if is_frame(text.strip().lstrip("/"), model.robot) or is_frame(text, model.robot):
                continue
            near, hint = meant(text.strip("\"'"), model.robot.link_by_name)
            found = self.at(
                model,
                element,
                f"<{tag}> names `{text}`, which is no link{hint}",
                fix=new_text(model, element, near, "unsafe", f"Write `{near}`") if near else None,
            )
            yield from doubted(model, text, near, found)

    def _frames(self, model: Model) -> Iterator[tuple[str, Element, str]]:
        for text, element, parameter, _ in references(model, ("frame",)):
            if parameter.meaning == "frame":
                yield text, element, parameter.tag
        for block in model.robot.gazebo:
            for sensor in block.sensors:
                for child in sensor.element.children:
                    if child.tag in ("gz_frame_id", "ignition_frame_id") and child.text and "$" not in child.text:
                        yield child.text, child, child.tag
