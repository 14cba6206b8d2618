"""L103 executable-unknown."""

from urdfkit.defect_message import Suggestion
from urdfkit.lint.facts.launch.executables import (
    Executables,
    executables_of,
    is_of_other_release,
    package_of,
    released,
    replacement_of,
    wrong_components,
)
from urdfkit.lint.rule import Findings, Model, RobotRule

_RELEASES = {1: "ROS 1", 2: "this ROS 2 release"}

_RENAMED = {
    ("robot_state_publisher", "state_publisher"): "robot_state_publisher",
    ("robot_localization", "ekf_localization_node"): "ekf_node",
    ("robot_localization", "ukf_localization_node"): "ukf_node",
    ("ros_gz_sim", "spawn_entity.py"): "create",
    ("gazebo_ros", "create"): "spawn_entity.py",
}
"""Package and executable of older releases or the other Gazebo → the executable of this package in its place."""


class ExecutableUnknown(RobotRule):
    """A launch file starts an executable that does not exist in its package.

    ## What it does
    Checks the ``exec``, ``type`` or ``executable`` of nodes of the robot's package and its neighbours. These names are
    compared with the executables that CMakeLists.txt, setup.py or setup.cfg define and, for catkin, with the files of
    the package. The rule also checks about fifty common released packages. It reports misspelt executables of all these
    packages and, for some packages, executables of the other ROS version. In commands of launch files for Noetic, it
    reports ``xacro.py``, which only earlier releases have.

    ## Why is this bad?
    The launch fails with "executable not found on the libexec directory" or "Cannot locate node of type".

    ## Example
    ```diff
     <launch>
    -  <node name="state" pkg="robot_state_publisher" type="robot_state_publish"/>
    +  <node name="state" pkg="robot_state_publisher" type="robot_state_publisher"/>
     </launch>
    ```

    ## Fix safety
    Unsafe: the fix replaces a misspelt name with the nearest known name, which may not be the intended one.
    """

    code = "L103"
    name = "executable-unknown"
    fix = "unsafe"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each unknown executable."""
        from urdfkit.description.packages.related_files import neighbours
        from urdfkit.lint.facts.launch.actions import launch_files
        from urdfkit.lint.facts.launch.removed_programs import removed_programs
        from urdfkit.lint.facts.launch.ros_version import reads_version
        from urdfkit.lint.facts.nodes.nodelets import wrong_nodelets
        from urdfkit.lint.facts.ros_packages import misspelling_of
        from urdfkit.lint.fix_builders import nearest

        if model.package is None:
            return
        near = neighbours(model.package)
        texts = [source.text for source in model.related_files.values()]
        by_package: dict[str, Executables | None] = {**released()}
        for package in near:
            by_package.pop(package, None)
        for source, start, program, other in removed_programs(model):
            message = f"package `xacro` has no executable `{program}` in Noetic" + Suggestion(other, program)
            yield self.at_span(source.span(start, start + len(program)), message)
        for source, word, message in wrong_nodelets(model):
            yield self.at_span(source.span(word.start, word.end), message, severity="warning")
        for file in launch_files(model):
            version = reads_version(file.source)
            for plugin, message in wrong_components(file.source) if version == 2 else ():
                yield self.at_span(file.source.span(plugin.start, plugin.end), message, names=(plugin.name,))
            for node in file.nodes:
                if node.package is None or node.program is None:
                    continue
                package, program = node.package.name, node.program.name
                new = replacement_of(package, texts) if package not in near else None
                if new is not None:
                    span = file.source.span(node.package.start, node.package.start + len(package))
                    message = f"since Humble, the package `{new}` replaces `{package}`"
                    yield self.at_span(span, message, help=f"write `{new}`")
                    continue
                if package in near:
                    model.expanded.packages.watch(near[package], ".txt")
                if package not in by_package:
                    by_package[package] = executables_of(near[package], package) if package in near else None
                found = by_package[package]
                if found is None or misspelling_of(package, near, version) is not None:
                    continue  # package-xml-dependency reports a package of the other version
                others = [
                    name
                    for name in (found.names if package not in near else ())
                    if is_of_other_release(package, name, version, texts)
                ]
                if program not in others and (program in found.names or program in found.words):
                    continue
                names = [name for name in found.names if name not in others]
                meant = _RENAMED.get((package, program))
                if meant not in names:
                    meant = nearest(program, names, cutoff=0.6 if program in others else 0.7)
                    meant = names[0] if meant is None and found.is_complete and len(names) == 1 else meant
                    meant = f"{program}_node" if f"{program}_node" in names else meant
                owner = package_of(program, package) if meant is None and package not in near else None
                if owner is not None and owner not in (package, *near):
                    span = file.source.span(node.package.start, node.package.start + len(package))
                    message = f"package `{package}` has no executable `{program}`" + Suggestion(owner, package)
                    yield self.at_span(span, message, names=(program,))
                    continue
                if meant is None and not found.is_complete and program not in others:
                    continue
                release = f" in {_RELEASES[version]}" if program in others else ""
                message = f"package `{package}` has no executable `{program}`{release}" + Suggestion(meant, program)
                span = file.source.span(node.program.start, node.program.start + len(program))
                yield self.at_span(span, message, names=(program,))
