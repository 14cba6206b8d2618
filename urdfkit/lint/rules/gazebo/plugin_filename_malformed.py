"""Z809 plugin-filename-malformed."""

from urdfkit.description.urdf.robot import Plugin
from urdfkit.lint.facts.gazebo.plugins import plugins, specs
from urdfkit.lint.finding import Edit, Fix
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule


class PluginFilenameMalformed(RobotRule):
    """The file name of a plugin is missing or malformed.

    ## What it does
    Checks for plugins without ``filename``, and for a ``filename`` that contains white space or line breaks, is a class
    such as ``gz::sim::systems::Imu``, or names a library of Gazebo Classic without the prefix ``lib`` or the suffix
    ``.so``.

    ## Why is this bad?
    Gazebo reports "Failed to load plugin", because the file does not exist.

    ## Example
    ```diff
     <robot name="cart">
       <link name="base_footprint"/>
       <gazebo>
    -    <plugin name="move" filename="libgazebo_ros_planar_move .so"/>
    +    <plugin name="move" filename="libgazebo_ros_planar_move.so"/>
       </gazebo>
     </robot>
    ```

    ## Fix safety
    Safe: library names contain no white space, and libraries of Gazebo Classic are named ``lib….so``.
    """

    code = "Z809"
    name = "plugin-filename-malformed"
    fix = "safe"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each malformed file name."""
        for plugin, _, _ in plugins(model.robot):
            name = plugin.filename or ""
            if not name.strip():
                label = f" `{plugin.name.strip()}`" if plugin.name and plugin.name.strip() else ""
                message, help = f"plugin{label} has no filename", 'add filename="…", the library of the plugin'
                yield self.at(model, plugin.element, message, attribute="filename", help=help)
                continue
            if "$" in name or model.is_unresolved(plugin.element, "filename"):
                continue
            if "::" in name:
                message = f"plugin file name `{name}` is the name of a class"
                help = "write the file name of the library; the class belongs in the attribute `name`"
                yield self.at(model, plugin.element, message, attribute="filename", help=help)
                continue
            corrected = "".join(name.split())
            if corrected != name:
                defect = "contains white space"
            elif any(spec.generation != "gz" for spec in specs(plugin)) and "/" not in name:
                corrected = f"{'' if name.startswith('lib') else 'lib'}{name.removesuffix('.so')}.so"
                defect = "lacks the prefix `lib`" if not name.startswith("lib") else "lacks the suffix `.so`"
            if corrected == name:
                continue
            message = f"plugin file name `{' '.join(name.split())}` {defect}"
            fix = _rewritten(model, plugin, corrected)
            yield self.at(model, plugin.element, message, attribute="filename", help=f"write {corrected}", fix=fix)


def _rewritten(model: Model, plugin: Plugin, corrected: str) -> Fix | None:
    position = plugin.element.origin.position
    tag = model.tag(position)
    written = tag.attributes.get("filename") if tag is not None else None
    if written is None or " ".join(written.value.split()) != " ".join((plugin.filename or "").split()):
        return None
    span = model.document(position.file).source.span(written.value_start, written.value_end)
    return Fix("safe", f"Replace with `{corrected}`", (Edit(span, corrected),))
