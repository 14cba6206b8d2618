"""Plugins, components, installed targets and messages of packages in C++, with correct packages as a start."""

from __future__ import annotations

import pytest

from tests.lint.test_build_files import MANIFEST, found, write
from tests.lint.test_code_of_targets import CATKIN, MANIFEST_OF_CATKIN

CMAKE = """cmake_minimum_required(VERSION 3.8)
project(cart)
find_package(ament_cmake REQUIRED)
find_package(pluginlib REQUIRED)
find_package(rclcpp REQUIRED)
find_package(rclcpp_components REQUIRED)
add_library(plans SHARED src/plans.cpp)
target_include_directories(plans PUBLIC include)
ament_target_dependencies(plans pluginlib)
add_library(part SHARED src/part.cpp)
ament_target_dependencies(part rclcpp rclcpp_components)
rclcpp_components_register_node(part PLUGIN "cart::Part" EXECUTABLE part_node)
pluginlib_export_plugin_description_file(cart plans.xml)
install(TARGETS plans
  EXPORT export_cart
  LIBRARY DESTINATION lib
)
install(TARGETS part LIBRARY DESTINATION lib)
install(PROGRAMS scripts/tip.py DESTINATION lib/${PROJECT_NAME})
install(DIRECTORY include/ DESTINATION include)
install(DIRECTORY urdf DESTINATION share/${PROJECT_NAME})
ament_export_targets(export_cart)
ament_package()
"""
DEPENDS = "".join(f"<depend>{name}</depend>" for name in ("pluginlib", "rclcpp", "rclcpp_components"))
FILES = {
    "package.xml": MANIFEST.replace("<exec_depend>launch_ros</exec_depend>", DEPENDS),
    "CMakeLists.txt": CMAKE,
    "urdf/cart.urdf": '<robot name="cart"><link name="base"/></robot>\n',
    "scripts/tip.py": "",
    "include/cart/plan.hpp": "#pragma once\nnamespace cart { class Plan {}; }\n",
    "plans.xml": """<library path="plans">
  <class name="cart/Slow" type="cart::Slow" base_class_type="cart::Plan"/>
</library>
""",
    "src/plans.cpp": """#include "cart/plan.hpp"
#include <pluginlib/class_list_macros.hpp>
namespace cart { class Slow : public Plan {}; }
PLUGINLIB_EXPORT_CLASS(cart::Slow, cart::Plan)
""",
    "src/part.cpp": """#include <rclcpp/rclcpp.hpp>
#include <rclcpp_components/register_node_macro.hpp>
namespace cart { class Part : public rclcpp::Node {}; }
RCLCPP_COMPONENTS_REGISTER_NODE(cart::Part)
""",
}
CLASS = '  <class name="cart/Slow" type="cart::Slow" base_class_type="cart::Plan"/>\n'


@pytest.mark.parametrize(
    ("file", "old", "new", "expected"),
    [
        (
            "plans.xml",
            'type="cart::Slow"',
            'type="cart::Slwo"',
            "plans.xml:2: no code exports the class `cart::Slwo`; did you mean `cart::Slow`?",
        ),
        (
            "plans.xml",
            'type="cart::Slow"',
            'tpye="cart::Slow"',
            "plans.xml:2: unknown attribute `tpye`; did you mean `type`?",
        ),
        (
            "plans.xml",
            'name="cart/Slow"',
            'nmae="cart/Slow"',
            "plans.xml:2: unknown attribute `nmae`; did you mean `name`?",
        ),
        (
            "plans.xml",
            'name="cart/Slow"',
            'name="cart/Solw"',
            "plans.xml:2: the name `cart/Solw` misspells the class `Slow`",
        ),
        (
            "plans.xml",
            'base_class_type="cart::Plan"',
            'base_class_type="cart::Plna"',
            "plans.xml:2: `cart::Plna` is not the base class `cart::Plan` in PLUGINLIB_EXPORT_CLASS",
        ),
        ("plans.xml", ' base_class_type="cart::Plan"', "", "plans.xml:2: <class> has no `base_class_type`"),
        (
            "plans.xml",
            'path="plans"',
            'path="planes"',
            "plans.xml:1: no command builds the library `planes`; did you mean `plans`?",
        ),
        ("plans.xml", 'path="plans"', 'pth="plans"', "plans.xml:1: unknown attribute `pth`; did you mean `path`?"),
        ("plans.xml", 'library path="plans"', "library", "plans.xml:1: <library> has no `path`"),
        (
            "plans.xml",
            CLASS,
            CLASS + CLASS.replace("Slow", "Fast"),
            "plans.xml:3: no code exports the class `cart::Fast`; did you mean `cart::Slow`?",
        ),
        (
            "src/plans.cpp",
            "PLUGINLIB_EXPORT_CLASS(cart::Slow, cart::Plan)\n",
            "",
            "src/plans.cpp:3: PLUGINLIB_EXPORT_CLASS is missing for `cart::Slow`, which `plans.xml` describes",
        ),
        (
            "src/plans.cpp",
            "(cart::Slow,",
            "(cart::Solw,",
            "src/plans.cpp:4: no class `cart::Solw` is defined; did you mean `cart::Slow`?",
        ),
        (
            "src/plans.cpp",
            ", cart::Plan)",
            ", cart::Plna)",
            "src/plans.cpp:4: `cart::Plna` is not the base class `cart::Plan` in `plans.xml`",
        ),
        (
            "src/plans.cpp",
            "{ class Slow : public Plan {}; }\n",
            (
                "{ class Slow : public Plan {}; class Fast : public Plan {}; }\n"
                "PLUGINLIB_EXPORT_CLASS(cart::Fast, cart::Plan)\n"
            ),
            "src/plans.cpp:4: no description of plugins names the class `cart::Fast`",
        ),
        (
            "CMakeLists.txt",
            "pluginlib_export_plugin_description_file(cart plans.xml)\n",
            "",
            "CMakeLists.txt:22: pluginlib_export_plugin_description_file() is missing for the plugins in `plans.xml`",
        ),
        (
            "CMakeLists.txt",
            "(cart plans.xml)",
            "(cart plan.xml)",
            "CMakeLists.txt:13: `plan.xml` does not exist in this package; did you mean `plans.xml`?",
        ),
        (
            "CMakeLists.txt",
            'PLUGIN "cart::Part"',
            'PLUGIN "cart::Prat"',
            "CMakeLists.txt:12: no code registers the component `cart::Prat`; did you mean `cart::Part`?",
        ),
        (
            "CMakeLists.txt",
            'PLUGIN "cart::Part"',
            'PLUGN "cart::Part"',
            "CMakeLists.txt:12: unknown argument `PLUGN` of rclcpp_components_register_node(); did you mean `PLUGIN`?",
        ),
        (
            "CMakeLists.txt",
            'PLUGIN "cart::Part" ',
            "",
            "CMakeLists.txt:12: rclcpp_components_register_node() has no PLUGIN",
        ),
        (
            "CMakeLists.txt",
            'rclcpp_components_register_node(part PLUGIN "cart::Part" EXECUTABLE part_node)\n',
            "",
            "CMakeLists.txt:10: rclcpp_components_register_node() is missing for the component `cart::Part`",
        ),
        (
            "src/part.cpp",
            "(cart::Part)",
            "(cart::Prat)",
            "src/part.cpp:4: no class `cart::Prat` is defined; did you mean `cart::Part`?",
        ),
        (
            "src/part.cpp",
            "RCLCPP_COMPONENTS_REGISTER_NODE(cart::Part)\n",
            "",
            "CMakeLists.txt:12: RCLCPP_COMPONENTS_REGISTER_NODE is missing in the code of `cart::Part`",
        ),
        (
            "CMakeLists.txt",
            "(export_cart)",
            "(export_crat)",
            "CMakeLists.txt:22: no install() creates the export `export_crat`; did you mean `export_cart`?",
        ),
        (
            "CMakeLists.txt",
            "ament_export_targets(export_cart)\n",
            "",
            "CMakeLists.txt:15: ament_export_targets() is missing for the export `export_cart`",
        ),
        (
            "CMakeLists.txt",
            "install(TARGETS part LIBRARY DESTINATION lib)\n",
            "",
            "CMakeLists.txt:14: target `part` is not installed, but it has plugins",
        ),
        (
            "CMakeLists.txt",
            "part LIBRARY DESTINATION lib)",
            "part LIBRARY DESTINATION lib/${PROJECT_NAME})",
            "CMakeLists.txt:18: library `part` is installed to `lib/cart`, but programs search for it in `lib`",
        ),
        (
            "CMakeLists.txt",
            "TARGETS part LIBRARY",
            "part LIBRARY",
            (
                "CMakeLists.txt:18: install() does not begin with one of CODE, DIRECTORY, EXPORT, FILES,"
                " IMPORTED_RUNTIME_ARTIFACTS, PROGRAMS, SCRIPT, TARGETS"
            ),
        ),
        (
            "CMakeLists.txt",
            "part LIBRARY DESTINATION lib)",
            "part LIBRARY lib)",
            "CMakeLists.txt:18: `LIBRARY` of install() has no DESTINATION",
        ),
        (
            "CMakeLists.txt",
            "part LIBRARY DESTINATION lib)",
            "part LIBRARY DESTINATION)",
            "CMakeLists.txt:18: DESTINATION has no folder",
        ),
        (
            "CMakeLists.txt",
            "part LIBRARY DESTINATION",
            "part LIBARRY DESTINATION",
            "CMakeLists.txt:18: unknown argument `LIBARRY` of install(); did you mean `LIBRARY`?",
        ),
        (
            "CMakeLists.txt",
            "TARGETS part LIBRARY",
            "TARGETS LIBRARY",
            "CMakeLists.txt:18: install(TARGETS) does not name anything to install",
        ),
        (
            "CMakeLists.txt",
            "install(PROGRAMS",
            "install(FILES",
            "CMakeLists.txt:19: `scripts/tip.py` is not executable after install(FILES); write install(PROGRAMS …)",
        ),
        (
            "CMakeLists.txt",
            "install(DIRECTORY include/ DESTINATION include)\n",
            "",
            "CMakeLists.txt:20: folder `include` is not installed, but the package exports its headers",
        ),
    ],
)
def test_plugins_and_installation(tmp_path, monkeypatch, file, old, new, expected):
    monkeypatch.chdir(tmp_path)
    write(tmp_path, FILES)
    assert found(tmp_path) == []
    assert FILES[file].count(old) == 1
    write(tmp_path, {file: FILES[file].replace(old, new)})
    assert found(tmp_path) == ([expected] if expected else [])


@pytest.mark.parametrize(
    ("file", "old", "new", "expected"),
    [
        ("msg/Load.msg", "float64 mass", "flaot64 mass", "2: unknown type `flaot64`; did you mean `float64`?"),
        (
            "msg/Load.msg",
            "std_msgs/Header",
            "sdt_msgs/Header",
            "1: unknown package `sdt_msgs`; did you mean `std_msgs`?",
        ),
        (
            "msg/Load.msg",
            "std_msgs/Header",
            "std_msgs/Haeder",
            "1: package `std_msgs` has no message `Haeder`; did you mean `Header`?",
        ),
        ("msg/Load.msg", "std_msgs/Header", "Header", None),
        ("msg/Load.msg", "float64 mass", "float64 mass\nint8 mass", "3: second field `mass`"),
        (
            "msg/Load.msg",
            "float64 mass",
            "Point place",
            "2: type `Point` has no package; did you mean `geometry_msgs/Point`?",
        ),
        ("msg/Load.msg", "float64 mass", "uint8 MASS=3\nfloat64 mass # Point place", None),
        ("srv/Tip.srv", "---\n", "", "1: .srv files have 1 lines `---`, but this file has 0"),
        ("srv/Tip.srv", "Load load", "Laod load", "1: unknown type `Laod`; did you mean `Load`?"),
        ("srv/Tip.srv", "Load load", "Load[2] Loads", None),
        ("srv/Tip.srv", "Load load", "string<=9 name\n---", "3: .srv files have 1 lines `---`, but this file has 2"),
    ],
)
def test_lines_of_messages(tmp_path, monkeypatch, file, old, new, expected):
    monkeypatch.chdir(tmp_path)
    texts = {"msg/Load.msg": "std_msgs/Header header\nfloat64 mass\n", "srv/Tip.srv": "Load load\n---\nbool success\n"}
    cmake = CATKIN.replace("add_message_files(", "add_service_files(FILES Tip.srv)\nadd_message_files(")
    code = {"src/drive.cpp": "#include <ros/ros.h>\nint main() {}\n", "urdf/cart.urdf": FILES["urdf/cart.urdf"]}
    write(tmp_path, {**code, **texts, "CMakeLists.txt": cmake, "package.xml": MANIFEST_OF_CATKIN})
    assert found(tmp_path) == []
    assert texts[file].count(old) == 1
    write(tmp_path, {file: texts[file].replace(old, new)})
    assert found(tmp_path) == ([f"{file}:{expected}"] if expected else [])


def test_descriptions_of_plugins_in_packages_without_a_robot(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    write(tmp_path / "cart", {name: text for name, text in FILES.items() if name != "urdf/cart.urdf"})
    cmake = CMAKE.replace("install(DIRECTORY urdf DESTINATION share/${PROJECT_NAME})\n", "")
    description = FILES["plans.xml"].replace("cart::Slow", "cart::Slwo")
    write(tmp_path / "cart", {"CMakeLists.txt": cmake, "plans.xml": description})
    message = "no code exports the class `cart::Slwo`; did you mean `cart::Slow`?"
    assert found(tmp_path) == [f"cart/plans.xml:2: {message}"]
