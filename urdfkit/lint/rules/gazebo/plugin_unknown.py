"""Z825 plugin-unknown."""

from urdfkit.defect_message import Suggestion
from urdfkit.description.plugins.gazebo_libraries import classes, meant_class, meant_library
from urdfkit.description.urdf.robot import Plugin
from urdfkit.lint.facts.control.exported_plugins import is_built_library
from urdfkit.lint.facts.gazebo.plugins import plugins
from urdfkit.lint.finding import Finding
from urdfkit.lint.fix_builders import new_value
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule


class PluginUnknown(RobotRule):
    """A plugin library or class is unknown.

    ## What it does
    Checks for file names that nearly match a library of gazebo_ros_pkgs, Gazebo Sim or another widely used package. For
    libraries of Gazebo Sim, also checks that ``name`` is a class of the library. A library is accepted if its name
    resembles no known library, if a package of the workspace builds it, or if an installed Python package lists its
    parameters.

    ## Why is this bad?
    Gazebo reports "Failed to load plugin", and the drive or sensor that the plugin provides is missing. Gazebo Sim
    looks up a plugin by the name of its C++ class.

    ## Example
    ```diff
     <robot name="cart">
       <link name="base_footprint"/>
       <gazebo>
    -    <plugin name="move" filename="libgazebo_ros_planer_move.so"/>
    +    <plugin name="move" filename="libgazebo_ros_planar_move.so"/>
       </gazebo>
     </robot>
    ```

    ## Fix safety
    Unsafe: the fix writes the nearest library or class name, which may not be the intended one.
    """

    code = "Z825"
    name = "plugin-unknown"
    fix = "unsafe"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each misspelt library and each misspelt class."""
        from urdfkit.description.plugins.lookup import stem

        for plugin, _, _ in plugins(model.robot):
            file = plugin.filename
            if file is None or "$" in file or model.is_unresolved(plugin.element, "filename"):
                continue
            library = stem("".join(file.split()))
            suggestion = meant_library(library)
            if suggestion is not None and is_built_library(model, library):
                suggestion = None
            if suggestion is not None:
                yield self._finding(
                    model, plugin, "filename", f"unknown library `{library}`", _file_name(file, suggestion)
                )
            class_names = classes().get(suggestion or library, ())
            name = (plugin.name or "").strip()
            if name in class_names or not (class_names or "::" in name) or "$" in name:
                continue
            if class_names and not _is_system(class_names[0]) and ("::" not in name or name.endswith("System")):
                # The classes differ between versions, but all have a namespace, and `…System` is the hardware.
                own = [each for each in class_names if each.partition("::")[0] == name.partition("::")[0]]
                message = f"library `{suggestion or library}` has no class `{name}`"
                yield self._finding(model, plugin, "name", message, (own or class_names)[0])
                continue
            expected = meant_class(name, class_names or _all_classes())
            if expected is not None and expected.lower() == name.lower():
                continue  # Reported by Z808.
            if class_names and _is_system(class_names[0]):
                expected = expected or class_names[0]
                yield self._finding(
                    model, plugin, "name", f"library `{suggestion or library}` has no class `{name}`", expected
                )
            elif expected is not None and not class_names:
                yield self._finding(model, plugin, "name", f"unknown class `{name}`", expected)

    def _finding(self, model: Model, plugin: Plugin, attribute: str, message: str, expected: str) -> Finding:
        fix = new_value(model, plugin.element, attribute, expected, "unsafe")
        return self.at(model, plugin.element, message + Suggestion(expected), attribute=attribute, fix=fix)


def _all_classes() -> list[str]:
    return [name for names in classes().values() for name in names]


def _is_system(name: str) -> bool:
    """Whether a class is a system of Gazebo Sim; classes of gz_ros2_control differ between versions."""
    return "::systems::" in name


def _file_name(file: str, library: str) -> str:
    """Return the file name of a library in the form of its generation, or of `file` if both forms exist."""
    if library.startswith(("gz", "ign")):
        return f"lib{library}.so" if file.strip().endswith(".so") else library
    folder = file.strip().rpartition("/")
    return f"{folder[0]}{folder[1]}lib{library}.so"
