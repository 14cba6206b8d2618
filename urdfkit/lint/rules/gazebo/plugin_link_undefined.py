"""Z803 plugin-link-undefined."""

from urdfkit.lint.facts.gazebo.plugins import is_frame, references
from urdfkit.lint.fix_builders import meant, new_text
from urdfkit.lint.model.masked_names import unless_masked
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule


class PluginLinkUndefined(RobotRule):
    """A plugin names an undefined link.

    ## What it does
    Checks the parameters of known plugins that name links: base frames of drives (``robotBaseFrame``,
    ``child_frame_id``) and bodies of sensors.

    ## Why is this bad?
    The plugin stops, or publishes transforms of a frame that does not exist.

    ## Example
    ```diff
     <robot name="cart">
       <link name="base_link"/>
       <gazebo>
         <plugin name="move" filename="libgazebo_ros_planar_move.so">
    -      <robotBaseFrame>baselink</robotBaseFrame>
    +      <robotBaseFrame>base_link</robotBaseFrame>
         </plugin>
       </gazebo>
     </robot>
    ```

    ## Fix safety
    Unsafe: the fix writes the nearest link name, which may not be the intended one.
    """

    code = "Z803"
    name = "plugin-link-undefined"
    fix = "unsafe"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each undefined link."""
        for text, element, parameter, _ in references(model, ("link", "frame")):
            if parameter.names == "frame" and parameter.meaning != "base_frame":
                continue
            if is_frame(text, model.robot):
                continue
            near, hint = meant(text.strip("\"'"), model.robot.link_by_name)
            message = f"<{parameter.tag}> names the undefined link `{text}`" + hint
            finding = self.at(model, element, message, link=text, fix=new_text(model, element, near, "unsafe"))
            yield from unless_masked(model, text, near, finding)
