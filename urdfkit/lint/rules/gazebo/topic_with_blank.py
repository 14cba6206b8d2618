"""Z830 topic-with-blank."""

import re
from collections.abc import Iterator

from urdfkit.description.plugins.parameter_values import TOPIC
from urdfkit.description.xml.element import Element
from urdfkit.lint.facts.gazebo.plugins import references
from urdfkit.lint.fix_builders import new_text
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule

_TAGS = ("topic", "camera_info_topic")


class TopicWithBlank(RobotRule):
    """A topic name contains white space or another invalid character.

    ## What it does
    Checks the topics of sensors and known plugins, remappings and namespaces for characters other than letters, digits,
    ``_``, ``/``, ``.``, ``:``, ``~`` and ``-``. White space around a name is ignored.

    ## Why is this bad?
    ROS throws "invalid topic name" and Gazebo does not advertise the topic, so no program receives the sensor data.

    ## Example
    ```diff
     <robot name="cart">
       <link name="mast"/>
       <gazebo reference="mast">
    -    <sensor name="eye" type="camera"><topic>front camera</topic></sensor>
    +    <sensor name="eye" type="camera"><topic>front_camera</topic></sensor>
       </gazebo>
     </robot>
    ```

    ## Fix safety
    Unsafe: other programs may use the topic name. The fix removes white space at the ends and next to slashes, and
    replaces other white space with an underscore.
    """

    code = "Z830"
    name = "topic-with-blank"
    severity = "warning"
    fix = "unsafe"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each invalid topic."""
        seen: set[int] = set()
        for text, element in self._topics(model):
            if id(element) in seen or "$" in text or model.is_unresolved(element):
                continue
            if not re.search(r"\s", text):
                if invalid := TOPIC.sub("", text.replace(":=", "")):
                    seen.add(id(element))
                    yield self.at(model, element, f"invalid topic name `{text}`: it contains `{invalid[0]}`")
                continue
            seen.add(id(element))
            corrected = re.sub(r"\s+", "_", re.sub(r"\s*(/|:=)\s*", r"\1", text.strip()))
            fix = new_text(model, element, corrected, "unsafe")
            yield self.at(model, element, f"invalid topic name `{text}`: it contains white space", fix=fix)

    def _topics(self, model: Model) -> Iterator[tuple[str, Element]]:
        for block in model.robot.gazebo:
            for sensor in block.sensors:
                inner = (sensor.element, *sensor.element.find_all("camera")[:1])
                yield from ((child.text, child) for part in inner for child in part.children if child.tag in _TAGS)
            for plugin in (*block.plugins, *(plugin for sensor in block.sensors for plugin in sensor.plugins)):
                for tag in ("robotNamespace", "controller_manager_name"):
                    yield from ((child.text, child) for child in plugin.element.find_all(tag))
                ros = plugin.element.find("ros")
                for remapping in ros.children if ros is not None else ():
                    if ":=" in remapping.text or remapping.tag == "namespace":
                        yield re.sub(r"\s*:=\s*", ":=", remapping.text), remapping
        for text, element, _, _ in references(model, ("topic",)):
            yield text, element
