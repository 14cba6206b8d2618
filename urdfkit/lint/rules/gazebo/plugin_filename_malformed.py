"""Z809 plugin-filename-malformed."""

from __future__ import annotations

from urdfkit.lint.finding import Edit, Fix
from urdfkit.lint.gazebo import plugins, specs
from urdfkit.lint.rule import NOT_GAZEBO, RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.description.robot import Plugin
    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model


class PluginFilenameMalformed(RobotRule):
    """The file name of a plugin is broken.

    ## What it does
    Looks for white space and line ends in ``filename``, and for libraries of Gazebo classic without ``lib`` or
    ``.so``.

    ## Why is this bad?
    "Failed to load plugin": there is no such file.

    ## Example
    ```xml
    <robot name="cart">
      <link name="base_footprint"/>
      <gazebo>
        <plugin name="move" filename="libgazebo_ros_planar_move .so"/>
      </gazebo>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="cart">
      <link name="base_footprint"/>
      <gazebo>
        <plugin name="move" filename="libgazebo_ros_planar_move.so"/>
      </gazebo>
    </robot>
    ```

    ## Fix safety
    Safe: no library has white space in its name, and those of Gazebo classic are called ``lib….so``.
    """

    code = "Z809"
    name = "plugin-filename-malformed"
    fix = "safe"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each file name that can be none."""
        for plugin, _, _ in plugins(model.robot):
            name = plugin.filename
            if name is None or "$" in name or model.is_unresolved(plugin.element, "filename"):
                continue
            right = "".join(name.split())
            if right != name:
                what = "white space in it"
            elif any(spec.generation != "gz" for spec in specs(plugin)) and "/" not in name:
                right = f"{'' if name.startswith('lib') else 'lib'}{name.removesuffix('.so')}.so"
                what = "no `lib` before it" if not name.startswith("lib") else "no `.so` after it"
            if right == name:
                continue
            yield self.at(
                model,
                plugin.element,
                f"the file name `{' '.join(name.split())}` has {what}",
                attribute="filename",
                help=f"write {right}",
                fix=_rewritten(model, plugin, right),
            )


def _rewritten(model: Model, plugin: Plugin, right: str) -> Fix | None:
    position = plugin.element.origin.position
    tag = model.tag(position)
    written = tag.attributes.get("filename") if tag is not None else None
    if written is None or " ".join(written.value.split()) != " ".join((plugin.filename or "").split()):
        return None
    span = model.document(position.file).source.span(written.value_start, written.value_end)
    return Fix("safe", f"Write `{right}`", (Edit(span, right),))
