"""Z804 sensor-frame-undefined."""

from collections.abc import Iterator

from urdfkit.description.xml.element import Element
from urdfkit.lint.facts.gazebo.plugins import is_frame, references
from urdfkit.lint.facts.gazebo.sensor_frames import FRAMES, sensors_without_frame
from urdfkit.lint.fix_builders import meant, new_text
from urdfkit.lint.model.masked_names import unless_masked
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule


class SensorFrameUndefined(RobotRule):
    """A sensor names an undefined frame, or no frame.

    ## What it does
    Compares ``frameName``, ``frame_name``, ``gz_frame_id`` and similar elements of sensors with the links. ``world``,
    ``map`` and ``odom`` are accepted as frames outside the robot. Also reports a camera or lidar of Gazebo without any
    of these elements, if its link has an optical frame, or if other cameras and lidars of the robot have such an
    element. Gazebo then composes the frame name from the names of the model, the link and the sensor, and no link has
    this name. Three cases are not checked: sensors with plugins, robots with plugins of Gazebo Classic, and robots
    whose launch files publish or override this frame.

    ## Why is this bad?
    Images and scans are published in a frame that is missing in TF: RViz shows nothing, and localisation waits for the
    transform.

    ## Example
    ```diff
     <robot name="cart">
       <link name="camera"/>
       <gazebo reference="camera">
         <sensor name="eye" type="camera">
           <plugin name="eye" filename="libgazebo_ros_camera.so">
    -        <frameName>camera_link</frameName>
    +        <frameName>camera</frameName>
           </plugin>
         </sensor>
       </gazebo>
     </robot>
    ```

    ## Fix safety
    Unsafe: the fix writes the nearest link name, which may not be the intended one.
    """

    code = "Z804"
    name = "sensor-frame-undefined"
    severity = "warning"
    fix = "unsafe"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each undefined frame of a sensor."""
        for text, element, tag in self._frames(model):
            if is_frame(text.strip().lstrip("/"), model.robot) or is_frame(text, model.robot):
                continue
            near, hint = meant(text.strip("\"'"), model.robot.link_by_name)
            message = f"<{tag}> names the undefined frame `{text}`" + hint
            finding = self.at(model, element, message, fix=new_text(model, element, near, "unsafe"))
            yield from unless_masked(model, text, near, finding)
        for block, sensor, frame in sensors_without_frame(model):
            message = f"sensor `{sensor.name}` has no <gz_frame_id>, so the frame of its data is not a link"
            help = f"write <gz_frame_id>{frame}</gz_frame_id>"
            yield self.at(model, sensor.element, message, link=block.reference, help=help)

    def _frames(self, model: Model) -> Iterator[tuple[str, Element, str]]:
        for text, element, parameter, _ in references(model, ("frame",)):
            if parameter.meaning == "frame":
                yield text, element, parameter.tag
        for block in model.robot.gazebo:
            for sensor in block.sensors:
                for child in sensor.element.walk():
                    if child.tag in FRAMES and child.text and "$" not in child.text:
                        yield child.text, child, child.tag
