"""K972 manifest-invalid."""

from __future__ import annotations

import re

from urdfkit.defect_message import Suggestion
from urdfkit.lint.facts.packaging.build_files import BuildFiles, build_files
from urdfkit.lint.finding import Finding, Severity
from urdfkit.lint.model.tags import Tag
from urdfkit.lint.rule import Findings, Model, RobotRule

_TYPES = ("catkin", "ament_cmake", "ament_python", "cmake")
"""Common build types."""

_ROS1 = ("catkin", "message_generation", "message_runtime", "roscpp", "roslaunch", "rospy", "rviz")
_ROS2 = ("launch_ros", "rclcpp", "rclpy", "ros2launch", "ros2run", "rosidl_default_generators", "rviz2")
"""Packages that only one version of ROS has."""


class ManifestInvalid(RobotRule):
    """A package.xml has a misspelt or missing element, or names the wrong build tool.

    ## What it does
    Checks the elements, name, version, addresses and dependencies of package.xml against its format (REP 127, 140 and
    149), and the build tool against CMakeLists.txt and setup.py. Also reports dependencies that misspell a released
    package or a package of the workspace, and dependencies on packages of the other ROS version.

    ## Why is this bad?
    The package is not built, or rosdep finds no key for the dependency. Without ``<build_type>``, colcon builds a ROS 2
    package as a catkin package.

    ## Example
    ```diff
     <package format="3">
       <name>cart_description</name>
       <version>1.0.0</version>
       <description>A robot for tests.</description>
       <maintainer email="maintainer@example.com">The maintainers</maintainer>
       <license>MIT</license>
       <buildtool_depend>ament_cmake</buildtool_depend>
    -  <exec_depend>robot_state_publishr</exec_depend>
    +  <exec_depend>robot_state_publisher</exec_depend>
       <export>
         <build_type>ament_cmake</build_type>
       </export>
     </package>
    ```

    ## Fix safety
    Unsafe: the fix replaces a misspelt name with the nearest known name, which may not be the intended one.
    """

    code = "K972"
    name = "manifest-invalid"
    fix = "unsafe"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each defect of a package.xml."""
        from urdfkit.description.packages.related_files import neighbours
        from urdfkit.lint.facts.dependency_cycles import cycle_over
        from urdfkit.lint.facts.package_format import format_defects
        from urdfkit.lint.facts.ros_packages import misspelling_of

        folders = neighbours(model.package) if model.package is not None else {}
        near = {*folders, *(folder.name for folder in folders.values())}
        for files in build_files(model):
            root = files.root
            if root is None:
                continue
            for defect in format_defects(files):
                yield self._at(files, defect.tag, defect.message, defect.severity, defect.is_in_start_tag)
            depends = {tag.name for tag in root.children if tag.name.endswith("depend")}
            for text, tag in files.tags(*depends):
                is_ros2 = files.build_tool.startswith("ament") and "condition" not in tag.attributes
                suggestion = misspelling_of(text, near, 2 if is_ros2 else 0)
                if suggestion is not None:
                    message = f"unknown dependency `{text}`" + Suggestion(suggestion, text)
                    is_slip = misspelling_of(text, near) is not None
                    yield self._at(files, tag, message, "warning", kind="" if is_slip else "dependency")
                elif tag.name != "buildtool_depend" and not tag.attributes and (other := _other_ros(text, files)):
                    message = f"`{text}` is a package of {other}, but `{files.build_tool}` builds this package"
                    yield self._at(files, tag, message, "warning", kind="dependency")
            for text, tag in files.tags(*depends - {"test_depend"}):
                is_own = text in folders and text != files.name and not tag.attributes
                cycle = cycle_over(files.name, text, folders) if is_own else []
                if cycle and files.name == min(cycle):  # each cycle in one package
                    names = " → ".join(f"`{name}`" for name in cycle)
                    # catkin orders packages by what they need to be built.
                    severity: Severity = "error" if files.build_tool.startswith("ament") else "note"
                    message = f"the packages depend on each other: {names}; colcon fails"
                    yield self._at(files, tag, message, severity, kind="cycle")
            yield from self._build_tool(files, root)

    def _build_tool(self, files: BuildFiles, root: Tag) -> Findings:
        from urdfkit.lint.fix_builders import nearest

        cmake = files.cmake.text if files.cmake is not None else ""
        used = re.findall(r"find_package\s*\(\s*(catkin|ament_cmake)(?:_auto|_ros)?\b", cmake)
        expected = used[0] if len(set(used)) == 1 else ""
        if files.cmake is None and files.setup is not None:
            expected = "ament_python"
        depends = {tag.name for tag in root.children if tag.name.endswith("depend")}
        tools, types = files.tags("buildtool_depend"), files.tags("build_type")
        names = {text.removesuffix("_auto").removesuffix("_ros") for text, _ in tools}
        if (
            expected in ("catkin", "ament_cmake")
            and names
            and names & {"catkin", "ament_cmake"}
            and expected not in names
        ):
            message = f"the build tool is `{tools[0][0]}`, but CMakeLists.txt uses `{expected}`"
            yield self._at(files, tools[0][1], message, kind="build tool")
        elif expected in ("catkin", "ament_cmake") and not any(
            text in (expected, f"{expected}_auto", f"{expected}_ros", f"{expected}_simple")
            and tag.name not in ("exec_depend", "run_depend", "test_depend", "doc_depend")
            for text, tag in files.tags(*depends)
        ):
            message = f"package.xml has no <buildtool_depend>{expected}</buildtool_depend>"
            yield self._at(files, root, message, "warning", True)
        if not types:
            if expected.startswith("ament"):
                message = f"package.xml has no <build_type>{expected}</build_type> in <export>"
                yield self._at(files, next((tag for _, tag in files.tags("export")), root), message)
            return
        text, tag = types[0]
        suggestion = nearest(text, _TYPES, cutoff=0.7) if text not in _TYPES else None
        if suggestion is not None:
            yield self._at(files, tag, f"unknown build type `{text}`" + Suggestion(suggestion, text))
        elif expected and text in _TYPES and text != expected:
            source, kind = ("CMakeLists.txt", "build type") if files.cmake is not None else ("setup.py", "")
            yield self._at(files, tag, f"the build type is `{text}`, but {source} is for `{expected}`", kind=kind)

    def _at(
        self,
        files: BuildFiles,
        tag: Tag,
        message: str,
        severity: Severity = "error",
        in_start: bool = False,
        kind: str = "",
    ) -> Finding:
        text = files.manifest.text[tag.start : tag.close_end]
        span = files.manifest.span(tag.start, tag.end if in_start or "\n" in text else tag.close_end)
        return self.at_span(span, message, severity=severity, kind=kind)


def _other_ros(package: str, files: BuildFiles) -> str:
    """Return the version of ROS of a package, if the package is built for the other version; else empty."""
    tool = files.build_tool.partition("_")[0]
    if files.cmake is not None and tool not in files.cmake.text:
        return ""  # the build tool is reported
    if tool == "catkin" and package in _ROS2:
        return "ROS 2"
    return "ROS 1" if tool == "ament" and package in _ROS1 else ""
