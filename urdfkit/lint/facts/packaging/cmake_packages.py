"""Packages that commands of a CMakeLists.txt use and find_package does not find, or finds too late.

Sources: ament_cmake (ament_target_dependencies.cmake), catkin (catkin_package.cmake), genmsg (pkg-genmsg.cmake.em),
and the files package.xml of the packages in the table.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping
from pathlib import Path

from urdfkit.defect_message import Suggestion
from urdfkit.description.packages.related_files import dependencies_in, manifest, neighbours
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.packaging.build_files import BuildFiles
from urdfkit.lint.facts.packaging.cmake_commands import CMakeCommand
from urdfkit.lint.facts.packaging.cmake_defects import BuildDefect
from urdfkit.lint.facts.ros_packages import is_slip, names

_PROVIDED = {
    "std_msgs": "builtin_interfaces",
    "geometry_msgs": "std_msgs",
    "shape_msgs": "geometry_msgs",
    "sensor_msgs": "geometry_msgs",
    "nav_msgs": "geometry_msgs",
    "stereo_msgs": "sensor_msgs",
    "trajectory_msgs": "geometry_msgs",
    "control_msgs": "action_msgs geometry_msgs sensor_msgs trajectory_msgs actionlib_msgs",
    "diagnostic_msgs": "geometry_msgs",
    "visualization_msgs": "sensor_msgs",
    "actionlib_msgs": "std_msgs",
    "tf2_msgs": "action_msgs actionlib_msgs geometry_msgs",
    "std_srvs": "std_msgs",
    "builtin_interfaces": "",
    "unique_identifier_msgs": "",
    "action_msgs": "builtin_interfaces unique_identifier_msgs",
    "rcl_interfaces": "builtin_interfaces",
    "rosgraph_msgs": "builtin_interfaces",
    "lifecycle_msgs": "",
    "composition_interfaces": "rcl_interfaces",
    "rclcpp": "builtin_interfaces rcl_interfaces rosgraph_msgs ament_index_cpp rcpputils rcutils rcl rmw"
    " statistics_msgs tracetools rcl_yaml_param_parser libstatistics_collector rcl_logging_interface rosidl_runtime_cpp"
    " rosidl_dynamic_typesupport rosidl_typesupport_c rosidl_typesupport_cpp rosidl_runtime_c service_msgs"
    " type_description_interfaces",
    "rclcpp_lifecycle": "rclcpp lifecycle_msgs rcl rcl_lifecycle rmw",
    "rclcpp_components": "rclcpp composition_interfaces class_loader",
    "rclcpp_action": "rclcpp action_msgs rcl rcl_action",
    "ament_index_cpp": "",
    "rcpputils": "rcutils",
    "rcutils": "",
    "class_loader": "rcpputils console_bridge",
    "console_bridge": "",
    "pluginlib": "class_loader ament_index_cpp rcpputils rcutils tinyxml2 roslib rosconsole",
    "tinyxml2": "",
    "message_filters": "rclcpp builtin_interfaces roscpp rosconsole std_msgs",
    "tf2": "builtin_interfaces geometry_msgs rcutils console_bridge tf2_msgs",
    "tf2_ros": "builtin_interfaces geometry_msgs message_filters rcl_interfaces rclcpp rclcpp_action rclcpp_components"
    " tf2 tf2_msgs actionlib actionlib_msgs roscpp std_msgs",
    "tf2_geometry_msgs": "geometry_msgs tf2 tf2_ros orocos_kdl_vendor",
    "image_transport": "message_filters pluginlib rclcpp sensor_msgs roscpp",
    "roscpp": "cpp_common message_runtime rosconsole roscpp_serialization roscpp_traits rosgraph_msgs rostime std_msgs"
    " xmlrpcpp",
    "rospy": "genpy rosgraph rosgraph_msgs roslib std_msgs",
    "nodelet": "bond bondcpp message_runtime pluginlib rosconsole roscpp std_msgs",
    "diagnostic_updater": "diagnostic_msgs roscpp std_msgs rclcpp std_srvs",
    "actionlib": "actionlib_msgs message_runtime roscpp rospy std_msgs",
    "dynamic_reconfigure": "message_runtime roscpp roslib rosservice rospy std_msgs",
    "message_generation": "gencpp genmsg genpy",
    **dict.fromkeys(("message_runtime", "rostest", "roslaunch", "rosconsole", "roslib", "rostime", "genmsg"), ""),
    **dict.fromkeys(("rosidl_default_generators", "rosidl_default_runtime", "catkin"), ""),
    **dict.fromkeys(("ament_cmake", "ament_cmake_python", "ament_cmake_ros"), ""),
    **dict.fromkeys(("ament_cmake_gtest", "ament_cmake_gmock", "ament_cmake_pytest", "ament_lint_auto"), ""),
    **dict.fromkeys(("Eigen3", "Threads", "Boost", "OpenCV", "eigen3_cmake_module", "PkgConfig"), ""),
}
"""Package → packages whose headers, messages and commands a dependency on it can provide too, in any release."""

_NEEDED = {
    "rclcpp_components_register_node": ("rclcpp_components",),
    "rclcpp_components_register_nodes": ("rclcpp_components",),
    "pluginlib_export_plugin_description_file": ("pluginlib",),
    "rosidl_generate_interfaces": ("rosidl_default_generators", "rosidl_cmake"),
    "add_message_files": ("message_generation", "genmsg"),
    "add_service_files": ("message_generation", "genmsg"),
    "generate_messages": ("message_generation", "genmsg"),
    "generate_dynamic_reconfigure_options": ("dynamic_reconfigure",),
    "roslaunch_add_file_check": ("roslaunch",),
    "add_rostest": ("rostest",),
    "add_rostest_gtest": ("rostest",),
    "ament_add_gtest": ("ament_cmake_gtest", "ament_cmake_ros", "ament_cmake_gmock"),
    "ament_add_gmock": ("ament_cmake_gmock", "ament_cmake_ros"),
    "ament_add_pytest_test": ("ament_cmake_pytest", "ament_cmake_ros"),
    "ament_lint_auto_find_test_dependencies": ("ament_lint_auto",),
    "ament_target_dependencies": (
        "ament_cmake",
        "ament_cmake_ros",
        "ament_cmake_auto",
        "ament_cmake_target_dependencies",
    ),
    "add_launch_test": ("launch_testing_ament_cmake",),
}
"""Command → the packages that define it; one of them suffices."""

_PLAIN = frozenset(("orocos_kdl", "octomap", "urdfdom_headers", "urdfdom", "console_bridge", "fcl", "ompl"))
"""Packages of ROS that are packages of CMake without catkin."""

_OPEN = re.compile(r"include|ament_auto_\w+|add_subdirectory|find_\w+_dependencies|fetchcontent_\w+")
"""Matches commands that can find further packages."""


def found_packages(every: list[CMakeCommand]) -> dict[str, int] | None:
    """Return the packages that CMake finds with the number of the command; None if it may find others."""
    found: dict[str, int] = {}
    for at, command in enumerate(every):
        if _OPEN.fullmatch(command.name) and not (command.words and command.words[0][0].startswith(("GNU", "CTest"))):
            return None
        if command.name != "find_package":
            continue
        for word, _ in (*command.words[:1], *_components(command)):
            if "$" in word:
                return None
            found.setdefault(word, at)
    return found


def _components(command: CMakeCommand) -> tuple[tuple[str, int], ...]:
    """Return the packages that ``find_package(catkin …)`` names."""
    words = [word for word, _ in command.words]
    if words[:1] != ["catkin"]:
        return ()
    components = command.words[1:]
    return tuple((word, start) for word, start in components if not word.isupper() and not word[:1].isdigit() and word)


def provided(packages: Collection[str], near: Mapping[str, Path]) -> set[str] | None:
    """Return packages with the packages they can provide; None if they or their neighbours need unknown ones.

    Args:
        packages: names of packages.
        near: name → folder of the packages of the workspace, which can provide all that they depend on.
    """
    found, left = set[str](), [*packages]
    while left:
        name = left.pop()
        if name in found:
            continue
        found.add(name)
        if name in near:
            text = manifest(near[name])
            left += dependencies_in(text)
            of_code = dependencies_in(re.sub(r"<(?:exec|test|doc|buildtool)_depend\b[^<]*", "", text))
            if any(each not in near and each not in _PROVIDED for each in of_code):
                return None
        elif name in _PROVIDED:
            left += _PROVIDED[name].split()
        elif name in packages:
            return None
    return found


def package_defects(files: BuildFiles, source: Source, every: list[CMakeCommand]) -> Iterator[BuildDefect]:
    """Yield packages that commands use and find_package does not find, or finds later."""
    found = found_packages(every)
    if found is None or not found:
        return
    near = neighbours(files.folder)
    covered = provided(found, near)
    if any(each.name == "ament_lint_auto_find_test_dependencies" for each in every):
        found = {**{name: 0 for name, _ in files.tags("test_depend")}, **found}
    folded = {name.lower() for name in found}
    reported = set[str]()
    for at, word, start in _uses(every):
        if word in reported or word == files.name:
            continue
        if word in found:
            if found[word] > at:
                reported.add(word)
                command = every[found[word]]
                message = f"find_package({word}) is called after {every[at].name}(), which uses it"
                yield BuildDefect(source, command.start, command.name, message)
            continue
        is_target = every[at].name == "target_link_libraries"
        if is_target and word.lower() in folded:
            continue  # imported targets can be written in another way than their package
        candidates = [name for name in found if not is_target or name in names() or name in near]
        slip = next((name for name in candidates if is_slip(word, name)), None)
        if slip is not None and word not in names() and word not in near:
            reported.add(word)
            yield BuildDefect(source, start, word, f"unknown package `{word}`" + Suggestion(slip, word))
        elif covered is not None and word not in covered and (word in names() or word in near):
            reported.add(word)
            message = f"{every[at].name}() needs find_package({word} REQUIRED)"
            yield BuildDefect(source, *place_of_package(every, word), message)
    for at, command in enumerate(every):
        providers = _NEEDED.get(command.name, ())
        places = [found[name] for name in providers if name in found]
        if not providers or providers[0] in reported or places:
            if places and min(places) > at and providers[0] not in reported:
                reported.add(providers[0])
                late = every[min(places)]
                message = f"find_package({providers[0]}) is called after {command.name}(), which needs it"
                yield BuildDefect(source, late.start, late.name, message)
            continue
        is_test = providers[0].startswith("ament_") or providers[0] == "launch_testing_ament_cmake"
        others = covered if not is_test else {name for name in found if name not in _PROVIDED and "ament" in name}
        slip = next((name for name in found if any(is_slip(name, each) for each in providers)), None)
        if (is_test and others) or others is None or providers[0] in others or slip is not None:
            continue
        reported.add(providers[0])
        message = f"{command.name}() needs find_package({providers[0]} REQUIRED)"
        place = (
            (command.start, command.name)
            if is_test and "add" in command.name
            else place_of_package(every, providers[0])
        )
        yield BuildDefect(source, *place, message)
    yield from _exported(files, source, every, found)


def _uses(every: list[CMakeCommand]) -> Iterator[tuple[int, str, int]]:
    """Yield the number of a command, a package that it uses, and the offset of the package."""
    for at, command in enumerate(every):
        words = command.words
        texts = [word for word, _ in words]
        if command.name == "ament_target_dependencies":
            words = words[1:]
        elif command.name in ("rosidl_generate_interfaces", "generate_messages") and "DEPENDENCIES" in texts:
            words = words[texts.index("DEPENDENCIES") + 1 :]
            end = next((i for i, (word, _) in enumerate(words) if word.isupper()), len(words))
            words = words[:end]
        elif command.name == "target_link_libraries":
            # Targets of other packages than those of ROS are named in another way.
            matches = ((re.match(r"(\w+)::|\$\{(\w+)_TARGETS\}", word), start) for word, start in words[1:])
            words = tuple((use[1] or use[2], start) for use, start in matches if use is not None)
        else:
            continue
        yield from ((at, word, start) for word, start in words if not word.isupper() and "$" not in word)


def place_of_package(every: list[CMakeCommand], name: str) -> tuple[int, str]:
    """Return offset and text after which find_package should find a package: by the alphabet if that orders them."""
    finds = [each for each in every if each.name == "find_package" and each.words]
    of_catkin = next((each for each in finds if each.words[0][0] == "catkin"), None)
    entries = [*_components(of_catkin)] if of_catkin is not None else []
    if not entries:
        entries = [(each.words[0][0], each.start) for each in finds]
        listed = [each for each in entries if "ament" not in each[0]]
    else:
        listed = entries
    is_sorted = [word for word, _ in listed] == sorted(word for word, _ in listed)
    before = [each for each in listed if each[0] < name] if is_sorted else listed
    word, start = (before or entries)[-1 if before or not listed else 0]
    return start, word if of_catkin is not None and word != "catkin" else "find_package"


def _exported(
    files: BuildFiles, source: Source, every: list[CMakeCommand], found: Mapping[str, int]
) -> Iterator[BuildDefect]:
    """Yield misspelt packages of ament_export_dependencies() and catkin_package(), and catkin packages in DEPENDS."""
    declared = {*files.dependencies(), *found}
    of_catkin = {word for each in every if each.name == "find_package" for word, _ in _components(each)}
    for command in every:
        if command.name not in ("ament_export_dependencies", "catkin_package"):
            continue
        key = "CATKIN_DEPENDS" if command.name == "catkin_package" else ""
        for word, start in command.words:
            if word.isupper():
                key = word
            elif "$" in word or word.isdigit():
                continue
            elif key in ("CATKIN_DEPENDS", "") and word not in declared and word not in names():
                near = next((name for name in sorted(declared) if is_slip(word, name)), None)
                if near is not None:
                    yield BuildDefect(source, start, word, f"unknown package `{word}`" + Suggestion(near, word))
            elif key == "DEPENDS" and word in of_catkin - _PLAIN and word in names():
                message = f"`{word}` is a catkin package; list it in CATKIN_DEPENDS"
                yield BuildDefect(source, start, word, message)
                break
