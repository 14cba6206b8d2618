"""Dependencies of package.xml whose element installs them at another time than the package needs them (REP 149)."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator

from urdfkit.lint.facts.packaging.build_files import BuildFiles
from urdfkit.lint.model.tags import Tag

_NOT_BUILT = frozenset(("exec_depend", "run_depend", "test_depend", "doc_depend"))
_NOT_RUN = frozenset(("build_depend", "buildtool_depend", "test_depend", "doc_depend"))
_LIBRARIES = frozenset(
    (
        *("cv_bridge", "image_transport", "laser_geometry", "nodelet", "rclcpp", "rclcpp_action", "rclcpp_components"),
        *("rclcpp_lifecycle", "roscpp", "tf", "tf2_ros"),
    )
)
"""Packages with shared libraries that targets need at run time; others can consist of headers."""


def wrong_kinds(
    files: BuildFiles, built: Collection[str], imported: Collection[str]
) -> Iterator[tuple[Tag, str, str, str]]:
    """Yield the element, the package, the message and the advice for each dependency of the wrong kind.

    Args:
        files: the build files of the package.
        built: the packages that CMakeLists.txt finds.
        imported: the packages that Python code imports.
    """
    if re.search(r"(?:^|_)tests?(?:_|$)", files.name):  # It is not installed: its nodes run in tests only.
        return
    root, cmake = files.root, files.cmake.text if files.cmake is not None else ""
    kinds: dict[str, list[Tag]] = {}
    for text, tag in files.tags(*{tag.name for tag in root.children if tag.name.endswith("depend")}) if root else ():
        kinds.setdefault(text, []).append(tag)
    for name, tags in kinds.items():
        names = {tag.name for tag in tags}
        if any(tag.attributes for tag in tags):
            continue
        is_called = files.build_tool == "catkin" or len(re.findall(rf"\b{re.escape(name)}\b", cmake)) > 1
        if name in built and names <= _NOT_BUILT and is_called:
            message = f"CMakeLists.txt finds `{name}`, but <{tags[0].name}> does not install it for builds"
            yield tags[0], name, message, "write <depend>, or <build_depend> if only the build needs the package"
        elif name in imported and names <= _NOT_RUN:
            message = f"Python code imports `{name}`, but <{tags[0].name}> does not install it at run time"
            yield tags[0], name, message, "write <exec_depend>, or <depend> if the build needs the package too"
        elif name in built and names <= _NOT_RUN and name in _LIBRARIES:
            message = f"the targets use `{name}`, but <{tags[0].name}> does not install it at run time"
            yield tags[0], name, message, "write <depend>, which installs the package for builds and at run time"
