"""Z826 sensors-share-topic."""

from urdfkit.lint.facts.gazebo.sensor_topics import Published, published
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule


class SensorsShareTopic(RobotRule):
    """Two sensors publish on the same topic.

    ## What it does
    Compares the topics of lasers, cameras, IMUs, GPS receivers and similar sensors, including namespaces, camera names,
    remappings and the defaults of the plugins. Rangefinders and bumpers are not checked, because several of them often
    share a topic on purpose.

    ## Why is this bad?
    The images of two cameras, or the scans of two lasers, alternate on one topic: RViz flickers and maps are distorted.
    The usual cause is a sensor macro with a fixed topic.

    ## Example
    ```diff
     <robot name="cart">
       <link name="mast"/>
       <gazebo reference="mast">
    -    <sensor name="left_eye" type="camera"><topic>image</topic></sensor>
    -    <sensor name="right_eye" type="camera"><topic>image</topic></sensor>
    +    <sensor name="left_eye" type="camera"><topic>left/image</topic></sensor>
    +    <sensor name="right_eye" type="camera"><topic>right/image</topic></sensor>
       </gazebo>
     </robot>
    ```
    """

    code = "Z826"
    name = "sensors-share-topic"
    severity = "warning"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each sensor on the topic of another sensor, once per sensor."""
        first: dict[str, Published] = {}
        reported: set[tuple[str, str]] = set()
        for sensor in published(model):
            other = first.setdefault(sensor.topic, sensor)
            if other.key == sensor.key or sensor.key in reported:
                continue
            reported.add(sensor.key)
            message = f"`{sensor.name}` publishes on `{sensor.topic}`, which `{other.name}` also uses"
            help = f"choose another topic; the other sensor is at {model.shown(other.element.origin.position)}"
            yield self.at(model, sensor.element, message, help=help, names=(sensor.topic.strip("/"),))
