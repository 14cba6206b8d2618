"""Z825 plugin-unknown."""

from __future__ import annotations

from urdfkit.lint.edits import new_value
from urdfkit.lint.gazebo import plugins
from urdfkit.lint.rule import NOT_GAZEBO, RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.description.robot import Plugin
    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model


class PluginUnknown(RobotRule):
    """There is no such plugin: its library or its class is misspelt.

    ## What it does
    Looks for file names that are nearly those of a library of gazebo_ros_pkgs, of the new Gazebo or of other packages
    in wide use, and, for libraries of the new Gazebo, for a ``name`` that is none of the library's classes. Names that
    are near none pass: the library may be anybody's.

    ## Why is this bad?
    "Failed to load plugin": the robot stands there without drive or sensor. In the new Gazebo the name of a plugin is
    that of its C++ class.

    ## Example
    ```xml
    <robot name="cart">
      <link name="base_footprint"/>
      <gazebo>
        <plugin name="move" filename="libgazebo_ros_planer_move.so"/>
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
    Unsafe: the library, or the class, with the nearest name is taken.
    """

    code = "Z825"
    name = "plugin-unknown"
    fix = "unsafe"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each misspelt library and each misspelt class."""
        from urdfkit.description.plugins.lookup import stem
        from urdfkit.lint.libraries import classes, meant_class, meant_library

        for plugin, _, _ in plugins(model.robot):
            file = plugin.filename
            if file is None or "$" in file or model.is_unresolved(plugin.element, "filename"):
                continue
            library = stem("".join(file.split()))
            meant = meant_library(library)
            if meant is not None:
                yield self._found(model, plugin, "filename", f"there is no library `{library}`", _dressed(file, meant))
            known = classes().get(meant or library, ())
            name = (plugin.name or "").strip()
            if name in known or not (known or "::" in name) or "$" in name:
                continue
            if known and "::" not in name and not _is_gazebos(known[0]):
                # Versions differ in their classes, but all of them have a name space.
                yield self._found(model, plugin, "name", f"`{meant or library}` has no class `{name}`", known[0])
                continue
            right = meant_class(name, known or _every_class())
            if right is not None and right.lower() == name.lower():
                continue  # Z808's
            if known and _is_gazebos(known[0]):
                right = right or known[0]
                yield self._found(model, plugin, "name", f"`{meant or library}` has no class `{name}`", right)
            elif right is not None and not known:
                yield self._found(model, plugin, "name", f"there is no class `{name}`", right)

    def _found(self, model: Model, plugin: Plugin, attribute: str, message: str, right: str) -> Finding:
        fix = new_value(model, plugin.element, attribute, right, "unsafe", f"Write `{right}`")
        return self.at(model, plugin.element, f"{message}; did you mean `{right}`?", attribute=attribute, fix=fix)


def _every_class() -> list[str]:
    from urdfkit.lint.libraries import classes

    return [name for names in classes().values() for name in names]


def _is_gazebos(name: str) -> bool:
    """Whether a class is the new Gazebo's own: those of gz_ros2_control have other names in other versions."""
    return "::systems::" in name


def _dressed(file: str, library: str) -> str:
    """Return a library's file name as files of its kind are written, or as this one is where both are."""
    if library.startswith(("gz", "ign")):
        return f"lib{library}.so" if file.strip().endswith(".so") else library
    folder = file.strip().rpartition("/")
    return f"{folder[0]}{folder[1]}lib{library}.so"
