"""Z830 topic-with-blank."""

from __future__ import annotations

import re

from urdfkit.lint.edits import new_text
from urdfkit.lint.gazebo import references
from urdfkit.lint.rule import NOT_GAZEBO, RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.description.element import Element
    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model

_TAGS = ("topic", "camera_info_topic")


class TopicWithBlank(RobotRule):
    """The name of a topic has a blank in it.

    ## What it does
    Looks at the topics of sensors and of the plugins it knows, and at remappings. Blanks around a name do not count.

    ## Why is this bad?
    ROS throws "invalid topic name", Gazebo advertises nothing: the sensor is there and nobody hears of it.

    ## Example
    ```xml
    <robot name="cart">
      <link name="mast"/>
      <gazebo reference="mast">
        <sensor name="eye" type="camera"><topic>front camera</topic></sensor>
      </gazebo>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="cart">
      <link name="mast"/>
      <gazebo reference="mast">
        <sensor name="eye" type="camera"><topic>front_camera</topic></sensor>
      </gazebo>
    </robot>
    ```

    ## Fix safety
    Unsafe: other programs may name the topic, too; blanks become underscores, those beside a slash nothing.
    """

    code = "Z830"
    name = "topic-with-blank"
    severity = "warning"
    fix = "unsafe"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each topic with a blank."""
        seen: set[int] = set()
        for text, element in self._topics(model):
            if id(element) in seen or not re.search(r"\s", text) or "$" in text:
                continue
            seen.add(id(element))
            right = re.sub(r"\s+", "_", re.sub(r"\s*(/|:=)\s*", r"\1", text.strip()))
            fix = new_text(model, element, right, "unsafe", f"Write `{right}`")
            yield self.at(model, element, f"the topic `{text}` has a blank in it: no topic can be called that", fix=fix)

    def _topics(self, model: Model) -> Iterator[tuple[str, Element]]:
        for block in model.robot.gazebo:
            for sensor in block.sensors:
                inner = (sensor.element, *(one for one in (sensor.element.find("camera"),) if one is not None))
                yield from ((child.text, child) for part in inner for child in part.children if child.tag in _TAGS)
            for plugin in (*block.plugins, *(one for sensor in block.sensors for one in sensor.plugins)):
                ros = plugin.element.find("ros")
                for rule in ros.children if ros is not None else ():
                    if ":=" in rule.text or rule.tag == "namespace":
                        yield re.sub(r"\s*:=\s*", ":=", rule.text), rule
        for text, element, _, _ in references(model, ("topic",)):
            yield text, element
