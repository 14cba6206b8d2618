"""Packages, headers and libraries that the targets of CMakeLists.txt need, with correct packages as a start."""

from __future__ import annotations

from pathlib import Path
from time import process_time

import pytest

from tests.lint.test_build_files import MANIFEST, found, write
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.packaging.build_files import BuildFiles
from urdfkit.lint.facts.packaging.cmake_commands import commands
from urdfkit.lint.facts.packaging.cmake_defects import cmake_defects
from urdfkit.lint.facts.packaging.targets import targets

CMAKE = """cmake_minimum_required(VERSION 3.8)
project(cart)
find_package(ament_cmake REQUIRED)
find_package(nav_msgs REQUIRED)
find_package(rclcpp REQUIRED)
find_package(rclcpp_components REQUIRED)
find_package(std_srvs REQUIRED)
add_library(core SHARED src/core.cpp)
target_include_directories(core PUBLIC include)
ament_target_dependencies(core rclcpp)
add_library(part SHARED src/part.cpp)
target_link_libraries(part core)
ament_target_dependencies(part rclcpp_components nav_msgs std_srvs)
rclcpp_components_register_node(part PLUGIN "cart::Part" EXECUTABLE part_node)
install(TARGETS core part ARCHIVE DESTINATION lib LIBRARY DESTINATION lib RUNTIME DESTINATION bin)
install(DIRECTORY include/ DESTINATION include)
install(DIRECTORY urdf DESTINATION share/${PROJECT_NAME})
ament_package()
"""
DEPENDS = "".join(f"<depend>{name}</depend>" for name in ("nav_msgs", "rclcpp", "rclcpp_components", "std_srvs"))
FILES = {
    "package.xml": MANIFEST.replace("<exec_depend>launch_ros</exec_depend>", DEPENDS),
    "CMakeLists.txt": CMAKE,
    "urdf/cart.urdf": '<robot name="cart"><link name="base"/></robot>\n',
    "include/cart/core.hpp": "#pragma once\nnamespace cart { double speed(); }\n",
    "src/core.cpp": '#include "cart/core.hpp"\n#include <rclcpp/rclcpp.hpp>\ndouble cart::speed() { return 1.0; }\n',
    "src/part.cpp": """#include "cart/core.hpp"
#include <nav_msgs/msg/odometry.hpp>
#include <rclcpp/rclcpp.hpp>
#include <rclcpp_components/register_node_macro.hpp>
#include <std_srvs/srv/empty.hpp>
namespace cart { class Part : public rclcpp::Node {}; }
RCLCPP_COMPONENTS_REGISTER_NODE(cart::Part)
""",
}


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        (
            "find_package(nav_msgs REQUIRED)\n",
            "",
            ["3: ament_target_dependencies() needs find_package(nav_msgs REQUIRED)"],
        ),
        (
            "find_package(rclcpp_components REQUIRED)\n",
            "",
            ["5: ament_target_dependencies() needs find_package(rclcpp_components REQUIRED)"],
        ),
        (
            "(part rclcpp_components nav_msgs std_srvs)",
            "(part rclcpp_componets nav_msgs std_srvs)",
            ["13: unknown package `rclcpp_componets`; did you mean `rclcpp_components`?"],
        ),
        (
            "(part rclcpp_components nav_msgs std_srvs)",
            "(part rclcpp_components std_srvs)",
            ["12: target `part` includes headers of `nav_msgs`, but does not depend on it"],
        ),
        ("(part rclcpp_components nav_msgs std_srvs)", "(part rclcpp_components shop std_srvs)", []),
        (
            "target_link_libraries(part core)\n",
            "",
            ["11: `cart/core.hpp` is not found: target `part` lacks the folder `include` of headers"],
        ),
        (
            "target_link_libraries(part core)\n",
            "target_include_directories(part PUBLIC include)\n",
            ["13: target `part` uses `cart/core.hpp`, but does not link the library `core`"],
        ),
        (
            "target_link_libraries(part core)",
            "target_link_libraries(part corre)",
            ["12: no command defines the library `corre`; did you mean `core`?"],
        ),
        (
            "target_include_directories(core PUBLIC include)\n",
            "",
            [
                f"{line}: `cart/core.hpp` is not found: target `{name}` lacks the folder `include` of headers"
                for line, name in ((8, "core"), (10, "part"))
            ],
        ),
        (" src/part.cpp)", ")", ["11: target `part` has no source files"]),
        (
            "add_library(part SHARED src/part.cpp)\ntarget_link_libraries(part core)\n",
            "target_link_libraries(part core)\nadd_library(part SHARED src/part.cpp)\n",
            ["11: target_link_libraries() is called before add_library() defines the target `part`"],
        ),
        ("find_package(nav_msgs REQUIRED)\n", "ament_auto_find_build_dependencies()\n", []),
    ],
)
def test_targets_of_ament(tmp_path, monkeypatch, old, new, expected):
    monkeypatch.chdir(tmp_path)
    write(tmp_path, FILES)
    assert found(tmp_path) == []
    assert CMAKE.count(old) == 1
    write(tmp_path, {"CMakeLists.txt": CMAKE.replace(old, new)})
    assert found(tmp_path) == [f"CMakeLists.txt:{each}" for each in expected]


CORE = CMAKE[CMAKE.index("add_library(core") : CMAKE.index("ament_target_dependencies(part")]


@pytest.mark.parametrize(
    ("sources", "code", "expected"),
    [
        ("", {}, ["8: no target compiles `src/core.cpp`, but target `part` uses its header `cart/core.hpp`"]),
        (" src/core.cpp", {}, []),
        (" ${sources}", {}, []),
        (")\nament_auto_add_library(core SHARED src/core.cpp", {}, []),
        ("", {"src/core.cpp": '#include "cart/core.hpp"\nint main() { return 0; }\n'}, []),
        ("", {"src/core.cpp": "double speed() { return 1.0; }\n"}, []),
        ("", {"src/part.cpp": '#include "core.cpp"\n' + FILES["src/part.cpp"]}, []),
        (
            " /nowhere/part.cpp",
            {},
            ["8: no target compiles `src/core.cpp`, but target `part` uses its header `cart/core.hpp`"],
        ),
    ],
)
def test_files_that_no_target_compiles(tmp_path, monkeypatch, sources, code, expected):
    monkeypatch.chdir(tmp_path)
    part = f"add_library(part SHARED src/part.cpp{sources})\ntarget_include_directories(part PUBLIC include)\n"
    text = CMAKE.replace(CORE, part).replace("TARGETS core part", "TARGETS part")
    write(tmp_path, {**FILES, "CMakeLists.txt": text, **code})
    assert found(tmp_path) == [f"CMakeLists.txt:{each}" for each in expected]


BRANCHES = """if(WITH_CORE)
  add_library(part SHARED src/part.cpp)
  target_link_libraries(part core)
else()
  add_library(part SHARED src/part.cpp)
  target_link_libraries(part core)
endif()
"""
IN_TESTS = """  add_library(test_dependencies INTERFACE)
  find_package(ament_lint_auto REQUIRED)
  ament_lint_auto_find_test_dependencies()
  ament_add_gtest(test_core test/test_core.cpp)
"""
PACKAGE = "target_link_libraries(part core)\n"
OBJECTS = "target_include_directories(part PUBLIC include)\n"


@pytest.mark.parametrize(
    ("old", "new"),
    [
        (f"add_library(part SHARED src/part.cpp)\n{PACKAGE}", BRANCHES),
        (PACKAGE, "find_package(Protobuf REQUIRED)\ntarget_link_libraries(part core protobuf::libprotobuf)\n"),
        (PACKAGE, "find_package(Fooo REQUIRED)\ntarget_link_libraries(part core foo::foo)\n"),
        (
            f"add_library(part SHARED src/part.cpp)\n{PACKAGE}",
            f"add_library(part SHARED src/part.cpp $<TARGET_OBJECTS:core>)\n{OBJECTS}",
        ),
        (PACKAGE, f"target_sources(part PRIVATE $<TARGET_OBJECTS:core>)\n{OBJECTS}"),
        ("ament_package()\n", f"if(BUILD_TESTING)\n{IN_TESTS}endif()\nament_package()\n"),
    ],
)
def test_correct_targets_of_ament(tmp_path, monkeypatch, old, new):
    monkeypatch.chdir(tmp_path)
    assert CMAKE.count(old) == 1
    texts = {"CMakeLists.txt": CMAKE.replace(old, new), "test/test_core.cpp": "#include <gtest/gtest.h>\n"}
    names = ("ament_lint_auto", "ament_cmake_gtest") if "gtest" in new else ()
    tests = "".join(f"<test_depend>{name}</test_depend>" for name in names)
    texts["package.xml"] = FILES["package.xml"].replace("</depend><depend>rclcpp<", f"</depend>{tests}<depend>rclcpp<")
    write(tmp_path, {**FILES, **texts})
    assert found(tmp_path) == []


@pytest.mark.parametrize(
    ("dependency", "expected"),
    [
        ("<depend>nav2_util</depend>", []),
        ("<exec_depend>nav2_util</exec_depend>", ["target `part` includes headers of `nav_msgs`"]),
    ],
)
def test_packages_that_a_neighbour_brings_are_unknown_unless_tabulated(tmp_path, monkeypatch, dependency, expected):
    folder = tmp_path / "cart"
    cmake = CMAKE.replace(
        "find_package(std_srvs REQUIRED)\n", "find_package(std_srvs REQUIRED)\nfind_package(shop REQUIRED)\n"
    )
    cmake = cmake.replace("part rclcpp_components nav_msgs std_srvs", "part rclcpp_components shop std_srvs")
    write(
        folder,
        {
            **FILES,
            "CMakeLists.txt": cmake,
            "package.xml": FILES["package.xml"].replace("<depend>rclcpp<", "<depend>shop</depend><depend>rclcpp<"),
        },
    )
    shop = f"<package format='3'><name>shop</name>{dependency}</package>\n"
    write(tmp_path / "shop", {"package.xml": shop})
    monkeypatch.chdir(folder)
    assert [each.partition(": ")[2].partition(",")[0] for each in found(folder)] == expected


def test_the_time_grows_with_the_number_of_targets():
    def time_of(count):
        lines = "add_library(part{0} src/part.cpp)\ntarget_link_libraries(part{0} core)\n"
        lines += "install(TARGETS part{0} DESTINATION lib/${{PROJECT_NAME}})\n"
        text = CMAKE + "".join(lines.format(f"_{at}") for at in range(count))
        files = BuildFiles(Path(), Source("package.xml", FILES["package.xml"]), None, None)
        source = Source("CMakeLists.txt", text)
        start = process_time()
        every = commands(source)
        assert targets(files, every)
        list(cmake_defects(source, every))
        return process_time() - start

    assert time_of(800) < 10.0 * max(time_of(200), 0.02)


def test_find_package_after_its_use(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    line = "find_package(nav_msgs REQUIRED)\n"
    write(
        tmp_path,
        {**FILES, "CMakeLists.txt": CMAKE.replace(line, "").replace("ament_package()", f"{line}ament_package()")},
    )
    assert found(tmp_path) == [
        "CMakeLists.txt:17: find_package(nav_msgs) is called after ament_target_dependencies(), which uses it"
    ]


CATKIN = """cmake_minimum_required(VERSION 3.0.2)
project(cart)
find_package(catkin REQUIRED COMPONENTS
  message_generation
  roscpp
  std_msgs
)
add_message_files(FILES Load.msg)
generate_messages(DEPENDENCIES std_msgs)
catkin_package(CATKIN_DEPENDS message_runtime roscpp std_msgs)
include_directories(${catkin_INCLUDE_DIRS})
add_executable(drive src/drive.cpp)
target_link_libraries(drive ${catkin_LIBRARIES})
install(TARGETS drive DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
install(DIRECTORY urdf DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
"""
MANIFEST_OF_CATKIN = """<package format="2">
  <name>cart</name>
  <version>1.0.0</version>
  <description>A cart.</description>
  <maintainer email="cart@example.com">The maintainers</maintainer>
  <license>MIT</license>
  <buildtool_depend>catkin</buildtool_depend>
  <build_depend>message_generation</build_depend>
  <depend>message_runtime</depend>
  <depend>roscpp</depend>
  <depend>std_msgs</depend>
  <depend>octomap</depend>
</package>
"""


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ("  message_generation\n", "", ["4: add_message_files() needs find_package(message_generation REQUIRED)"]),
        (
            "target_link_libraries(drive ${catkin_LIBRARIES})\n",
            "",
            ["12: target `drive` is not linked with `${catkin_LIBRARIES}`"],
        ),
        (
            "CATKIN_DEPENDS message_runtime roscpp",
            "CATKIN_DEPENDS message_runtime rocspp",
            ["10: unknown package `rocspp`; did you mean `roscpp`?"],
        ),
        (
            "catkin_package(CATKIN_DEPENDS message_runtime roscpp std_msgs)",
            "find_package(octomap REQUIRED)\ncatkin_package(CATKIN_DEPENDS message_runtime roscpp DEPENDS octomap)",
            [],
        ),
        ("  roscpp\n", '  roscpp\n  ""\n', []),
        ("(drive src/drive.cpp)", "(drive src/drive.cpp)\nadd_library(part src/drive.cpp)", []),
        ("CATKIN_DEPENDS", "DEPENDS", ["10: `roscpp` is a catkin package; list it in CATKIN_DEPENDS"]),
    ],
)
def test_targets_of_catkin(tmp_path, monkeypatch, old, new, expected):
    monkeypatch.chdir(tmp_path)
    code = "#include <ros/ros.h>\nint main() {}\n"
    files = {**FILES, "CMakeLists.txt": CATKIN, "package.xml": MANIFEST_OF_CATKIN, "src/drive.cpp": code}
    files["msg/Load.msg"] = "std_msgs/Header header\nfloat64 mass\n"
    write(tmp_path, files)
    assert found(tmp_path) == []
    assert CATKIN.count(old) == 1
    write(tmp_path, {"CMakeLists.txt": CATKIN.replace(old, new)})
    assert found(tmp_path) == [f"CMakeLists.txt:{each}" for each in expected]


@pytest.mark.parametrize(
    ("components", "header", "is_declared", "is_reported"),
    [
        ("roscpp", "geometry_msgs/Twist.h", True, True),
        ("geometry_msgs\n  roscpp", "geometry_msgs/Twist.h", True, False),
        ("roscpp\n  tf2_ros", "geometry_msgs/Twist.h", True, False),  # provides geometry_msgs
        ("roscpp\n  shop", "geometry_msgs/Twist.h", True, False),  # may provide it
        ("roscpp", "geometry_msgs/Twist.h", False, False),  # package-xml-dependency
        ("roscpp", "std_msgs/Header.h", True, False),
        ("roscpp", "cart/Load.h", True, False),
    ],
)
def test_components_of_catkin(tmp_path, monkeypatch, components, header, is_declared, is_reported):
    monkeypatch.chdir(tmp_path)
    manifest = MANIFEST_OF_CATKIN.replace("octomap", "geometry_msgs" if is_declared else "octomap")
    manifest = manifest.replace("</package>", "  <depend>tf2_ros</depend>\n  <depend>shop</depend>\n</package>")
    code = f"#include <ros/ros.h>\n#include <{header}>\nint main() {{}}\n"
    cmake = CATKIN.replace("  roscpp\n", f"  {components}\n")
    files = {**FILES, "CMakeLists.txt": cmake, "package.xml": manifest, "src/drive.cpp": code}
    write(tmp_path, {**files, "msg/Load.msg": "float64 mass\n"})
    message = "find_package(catkin) lacks `geometry_msgs`, whose headers target `drive` includes"
    rows = [row for row in found(tmp_path) if "find_package" in row]
    assert rows == ([f"CMakeLists.txt:4: {message}"] if is_reported else [])


@pytest.mark.parametrize("package", ["nav_msgs", "shop_msgs"])
@pytest.mark.parametrize("is_given", [False, True])
def test_packages_of_own_headers(tmp_path, monkeypatch, package, is_given):
    """A package of the workspace is missing even if an unknown package is given."""
    header = f"{'/' * 100}\n" * 2 + f'#ifndef CORE_HPP\n#define CORE_HPP\n#include "{package}/msg/load.hpp"\n#endif\n'
    used = ("unknown_lib", *((package,) if is_given else ())) if package == "shop_msgs" else (package,) * is_given
    cmake = CMAKE.replace("(core rclcpp)", f"(core {' '.join((*used, 'rclcpp'))})")
    cmake = cmake.replace(
        "find_package(std_srvs REQUIRED)", f"find_package(std_srvs)\nfind_package({package} REQUIRED)"
    )
    manifest = FILES["package.xml"].replace("</license>", f"</license><depend>{package}</depend>")
    manifest = manifest if package == "shop_msgs" else FILES["package.xml"]
    write(tmp_path / "shop_msgs", {"package.xml": MANIFEST.replace("<name>cart", "<name>shop_msgs")})
    write(tmp_path / "cart", {**FILES, "CMakeLists.txt": cmake, "package.xml": manifest})
    write(tmp_path / "cart", {"include/cart/core.hpp": header, "src/core.cpp": '#include "cart/core.hpp"\n'})
    monkeypatch.chdir(tmp_path / "cart")
    rows = [row for row in found(tmp_path / "cart") if "headers of" in row]
    message = f"target `core` includes headers of `{package}`, but does not depend on it"
    assert rows == ([] if is_given else [f"CMakeLists.txt:11: {message}"])


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ("core PUBLIC include", "core PRIVATE include", ["9: `cart/core.hpp` is not found for target `part`"]),
        ("core PUBLIC include", "core PRIVATE src PUBLIC include", []),
        ("(core PUBLIC include)", "(core PRIVATE include)\ntarget_include_directories(part PRIVATE include)", []),
        ("(core PUBLIC include)", "(core PRIVATE include)\ninclude_directories(include)", []),
        ("core PUBLIC include", "core PUBLIC ${rclcpp_INCLUDE_DIRS} PRIVATE include", []),  # perhaps the same folder
    ],
)
def test_private_folders_of_headers(tmp_path, monkeypatch, old, new, expected):
    monkeypatch.chdir(tmp_path)
    write(tmp_path, FILES | {"CMakeLists.txt": CMAKE.replace(old, new)})
    texts = [text for text in found(tmp_path) if "is not found" in text]
    assert [text.partition(",")[0] for text in texts] == [f"CMakeLists.txt:{each}" for each in expected]


MESSAGES = {
    "catkin": """cmake_minimum_required(VERSION 3.0.2)
project(cart)
find_package(catkin REQUIRED COMPONENTS message_generation roscpp)
add_message_files(FILES Row.msg)
generate_messages()
catkin_package(CATKIN_DEPENDS message_runtime roscpp)
include_directories(${catkin_INCLUDE_DIRS})
add_executable(part src/part.cpp)
{}target_link_libraries(part ${catkin_LIBRARIES})
install(TARGETS part RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
""",
    "ament_cmake": """cmake_minimum_required(VERSION 3.8)
project(cart)
find_package(ament_cmake REQUIRED)
find_package(rosidl_default_generators REQUIRED)
rosidl_generate_interfaces(cart_msgs msg/Row.msg LIBRARY_NAME cart)
add_executable(part src/part.cpp)
{}install(TARGETS part DESTINATION lib/cart)
ament_package()
""",
}
TYPESUPPORT = 'rosidl_get_typesupport_target(support cart_msgs "rosidl_typesupport_cpp")\n'


@pytest.mark.parametrize(
    ("tool", "header", "command", "expected"),
    [
        ("catkin", "cart/Row.h", "", ["9: target `part` includes `cart/Row.h`, but may be built before it"]),
        ("catkin", "cart/Row.h", "add_dependencies(part ${catkin_EXPORTED_TARGETS})\n", ["10: target `part`"]),
        ("catkin", "cart/Row.h", "add_dependencies(part ${${PROJECT_NAME}_EXPORTED_TARGETS})\n", []),
        ("catkin", "cart/Row.h", "add_dependencies(part cart_generate_messages_cpp)\n", []),
        ("catkin", "cart/Row.h", "add_dependencies(${target} cart_generate_messages_cpp)\n", []),  # in a loop
        ("catkin", "ros/ros.h", "", []),
        ("ament_cmake", "cart/msg/row.hpp", "", ["6: target `part` includes `cart/msg/row.hpp`, but may be built"]),
        ("ament_cmake", "cart/msg/row.hpp", TYPESUPPORT + "target_link_libraries(part ${support})\n", []),
        ("ament_cmake", "cart/msg/row.hpp", "rosidl_target_interfaces(part cart_msgs rosidl_typesupport_cpp)\n", []),
        ("ament_cmake", "cart/msg/row.hpp", "target_link_libraries(part cart_msgs__rosidl_typesupport_cpp)\n", []),
    ],
)
def test_targets_with_messages_of_their_package(tmp_path, monkeypatch, tool, header, command, expected):
    monkeypatch.chdir(tmp_path)
    files = {"CMakeLists.txt": MESSAGES[tool].replace("{}", command), "msg/Row.msg": "float64 offset\n"}
    code = f"#include <{header}>\n\nint main() {{\n  return 0;\n}}\n"
    manifest = FILES["package.xml"].replace("ament_cmake", tool)
    write(tmp_path, {"urdf/cart.urdf": FILES["urdf/cart.urdf"], "package.xml": manifest, "src/part.cpp": code, **files})
    texts = [text for text in found(tmp_path) if "may be built" in text]
    assert len(texts) == len(expected)
    assert all(text.startswith(f"CMakeLists.txt:{start}") for text, start in zip(texts, expected, strict=True))
