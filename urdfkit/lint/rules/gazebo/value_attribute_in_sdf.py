"""Z812 value-attr-in-sdf-context."""

from urdfkit.description.xml.element import Element
from urdfkit.lint.finding import Edit, Fix
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule


class ValueAttributeInSdf(RobotRule):
    """A value is written as an attribute where SDF expects text.

    ## What it does
    Checks inside ``<sensor>``, ``<visual>``, ``<collision>`` and ``<surface>`` of ``<gazebo>`` for elements that have
    only the attribute ``value``. Direct children of ``<gazebo reference="…">``, such as ``<mu1 value="1"/>``, accept
    both forms.

    ## Why is this bad?
    SDF reads the text of an element, which is empty here, and uses the default value.

    ## Example
    ```diff
     <robot name="cart">
       <link name="laser"/>
       <gazebo reference="laser">
    +    <mu1 value="1"/>
         <sensor name="laser" type="ray">
    -      <update_rate value="20"/>
    +      <update_rate>20</update_rate>
         </sensor>
       </gazebo>
     </robot>
    ```

    ## Fix safety
    Safe: the fix writes the value as text.
    """

    code = "Z812"
    name = "value-attr-in-sdf-context"
    severity = "warning"
    fix = "safe"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each value that SDF does not read."""
        for block in model.robot.gazebo:
            for child in block.element.children:
                if child.tag in ("sensor", "visual", "collision", "surface"):
                    yield from self._check_children(model, child)

    def _check_children(self, model: Model, element: Element) -> Findings:
        for child in element.children:
            if child.tag == "plugin":
                continue
            if list(child.attributes) == ["value"] and not child.text and not child.children:
                message = f"<{child.tag}> has a value attribute but no text: SDF reads only the text"
                help = f"write <{child.tag}>{child.get('value')}</{child.tag}>"
                yield self.at(model, child, message, attribute="value", help=help, fix=_as_text(model, child))
            yield from self._check_children(model, child)


def _as_text(model: Model, element: Element) -> Fix | None:
    position = element.origin.position
    tag = model.tag(position)
    written = tag.attributes.get("value") if tag is not None else None
    if tag is None or written is None:
        return None
    text = f"<{tag.name}>{written.value}</{tag.name}>"
    source = model.document(position.file).source
    return Fix("safe", "Write the value as text", (Edit(source.span(tag.start, tag.close_end), text),))
