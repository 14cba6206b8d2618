"""Z826 sensors-share-topic."""

from __future__ import annotations

from urdfkit.lint.rule import NOT_GAZEBO, RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model
    from urdfkit.lint.topics import Published


class SensorsShareTopic(RobotRule):
    """Two sensors publish on the same topic.

    ## What it does
    Compares the topics of lasers, cameras, IMUs, GPS and the like: as they are written, with namespace, name of the
    camera and remappings, else as the plugin takes them. Rangefinders and bumpers are left out: of theirs several often
    share a topic on purpose.

    ## Why is this bad?
    The images of two cameras, or the scans of two lasers, come one after the other on one topic, each from elsewhere:
    RViz flickers and maps are torn. It happens where a macro of a sensor has its topic written out.

    ## Example
    ```xml
    <robot name="cart">
      <link name="mast"/>
      <gazebo reference="mast">
        <sensor name="left_eye" type="camera"><topic>image</topic></sensor>
        <sensor name="right_eye" type="camera"><topic>image</topic></sensor>
      </gazebo>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="cart">
      <link name="mast"/>
      <gazebo reference="mast">
        <sensor name="left_eye" type="camera"><topic>left/image</topic></sensor>
        <sensor name="right_eye" type="camera"><topic>right/image</topic></sensor>
      </gazebo>
    </robot>
    ```
    """

    code = "Z826"
    name = "sensors-share-topic"
    severity = "warning"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each second sensor on a topic, once for each of them."""
        from urdfkit.lint.topics import published

        first: dict[str, Published] = {}
        said: set[tuple[str, str]] = set()
        for one in published(model):
            other = first.setdefault(one.topic, one)
            if other.key == one.key or one.key in said:
                continue
            said.add(one.key)
            yield self.at(
                model,
                one.element,
                f"`{one.name}` publishes on `{one.topic}`, as `{other.name}` does",
                help=f"give each a topic of its own; the other is at {model.shown(other.element.origin.position)}",
            )
