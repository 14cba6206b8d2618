"""K972 manifest-invalid."""

from __future__ import annotations

import re

from urdfkit.lint.finding import Finding
from urdfkit.lint.rule import Findings, Model, RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from urdfkit.lint.facts.build_files import BuildFiles
    from urdfkit.lint.model.tags import Tag

_DEPENDS = (
    *("depend", "build_depend", "build_export_depend", "buildtool_depend", "buildtool_export_depend", "exec_depend"),
    *("test_depend", "doc_depend", "group_depend"),
)
_REQUIRED = ("name", "version", "description", "maintainer", "license")
_TAGS = (*_REQUIRED, *_DEPENDS, "url", "author", "conflict", "replace", "member_of_group", "export", "run_depend")
_TYPES = ("catkin", "ament_cmake", "ament_python", "cmake")
"""Elements of package.xml in the formats 1 to 3 (REP 127, 140 and 149), and common build types."""

_MAX_MISSING = 2
"""Number of missing elements up to which a package.xml is meant to be built."""


class ManifestInvalid(RobotRule):
    """A package.xml has a misspelt or missing element, or names the wrong build tool.

    ## What it does
    Checks elements, the version and the dependencies of package.xml against REP 149, dependencies for misspelt names of
    released packages and of packages of the workspace, and the build tool against CMakeLists.txt and setup.py.

    ## Why is this bad?
    The package is not built, or rosdep finds no key for the dependency. Without ``<build_type>``, colcon builds a ROS 2
    package as a catkin package.

    ## Example
    ```xml
    <package format="3">
      <name>cart_description</name>
      <version>1.0.0</version>
      <description>A robot for tests.</description>
      <maintainer email="maintainer@example.com">The maintainers</maintainer>
      <license>MIT</license>
      <buildtool_depend>ament_cmake</buildtool_depend>
      <exec_depend>robot_state_publishr</exec_depend>
      <export>
        <build_type>ament_cmake</build_type>
      </export>
    </package>
    ```

    ## Use instead
    ```xml
    <package format="3">
      <name>cart_description</name>
      <version>1.0.0</version>
      <description>A robot for tests.</description>
      <maintainer email="maintainer@example.com">The maintainers</maintainer>
      <license>MIT</license>
      <buildtool_depend>ament_cmake</buildtool_depend>
      <exec_depend>robot_state_publisher</exec_depend>
      <export>
        <build_type>ament_cmake</build_type>
      </export>
    </package>
    ```
    """

    code = "K972"
    name = "manifest-invalid"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each defect of a package.xml."""
        from urdfkit.description.packages.related_files import neighbours
        from urdfkit.lint.facts.build_files import build_files
        from urdfkit.lint.facts.ros_packages import misspelling_of
        from urdfkit.lint.fix_builders import nearest

        folders = neighbours(model.package) if model.package is not None else {}
        near = {*folders, *(folder.name for folder in folders.values())}
        for files in build_files(model):
            root = files.root
            if root is None:
                continue
            for tag in root.children:
                suggestion = nearest(tag.name, _TAGS, cutoff=0.8) if tag.name not in _TAGS else None
                if suggestion is not None:
                    message = f"unknown element <{tag.name}> of package.xml; did you mean <{suggestion}>?"
                    yield self._at(files, tag, message)
                elif tag.name == "run_depend" and "format" in root.attributes:
                    form = root.attributes["format"].value
                    if form != "1":
                        yield self._at(files, tag, f"<run_depend> does not exist in format {form}; write <exec_depend>")
            found = {tag.name for tag in root.children}
            near_required = {nearest(name, _REQUIRED, cutoff=0.8) for name in found}
            missing = [name for name in _REQUIRED if name not in found and name not in near_required]
            if len(missing) <= _MAX_MISSING:  # others are no packages to build, such as parts of tests
                for name in missing:
                    yield self._at(files, root, f"package.xml has no <{name}>")
            for text, tag in files.tags("version"):
                if tag.parent is root and not re.fullmatch(r"\d+\.\d+\.\d+", text):
                    yield self._at(files, tag, f"version `{text}` is not of the form 1.2.3")
            for text, tag in files.tags(*_DEPENDS, "run_depend"):
                suggestion = misspelling_of(text, near)
                if suggestion is not None:
                    message = f"unknown dependency `{text}`; did you mean `{suggestion}`?"
                    yield self._at(files, tag, message, "warning")
            yield from self._build_tool(files, root)

    def _build_tool(self, files: BuildFiles, root: Tag) -> Findings:
        from urdfkit.lint.fix_builders import nearest

        cmake = files.cmake.text if files.cmake is not None else ""
        used = re.findall(r"find_package\s*\(\s*(catkin|ament_cmake)(?:_auto|_ros)?\b", cmake)
        expected = used[0] if len(set(used)) == 1 else ""
        if files.cmake is None and files.setup is not None:
            expected = "ament_python"
        tools, types = files.tags("buildtool_depend"), files.tags("build_type")
        names = {text.removesuffix("_auto").removesuffix("_ros") for text, _ in tools}
        if (
            expected in ("catkin", "ament_cmake")
            and names
            and names & {"catkin", "ament_cmake"}
            and expected not in names
        ):
            message = f"the build tool is `{tools[0][0]}`, but CMakeLists.txt uses `{expected}`"
            yield self._at(files, tools[0][1], message)
        elif expected == "catkin" and not tools:
            yield self._at(files, root, "package.xml has no <buildtool_depend>catkin</buildtool_depend>", "warning")
        if not types:
            if expected.startswith("ament"):
                message = f"package.xml has no <build_type>{expected}</build_type> in <export>"
                yield self._at(files, next((tag for _, tag in files.tags("export")), root), message)
            return
        text, tag = types[0]
        suggestion = nearest(text, _TYPES, cutoff=0.7) if text not in _TYPES else None
        if suggestion is not None:
            yield self._at(files, tag, f"unknown build type `{text}`; did you mean `{suggestion}`?")
        elif expected and text in _TYPES and text != expected:
            source = "CMakeLists.txt" if files.cmake is not None else "setup.py"
            yield self._at(files, tag, f"the build type is `{text}`, but {source} is for `{expected}`")

    def _at(self, files: BuildFiles, tag: Tag, message: str, severity: str = "error") -> Finding:
        end = tag.close_end if "\n" not in files.manifest.text[tag.start : tag.close_end] else tag.end
        span = files.manifest.span(tag.start, end)
        return Finding(self.code, self.name, severity, message, span)  # type: ignore[arg-type]
