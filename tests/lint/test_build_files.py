"""Defects of package.xml, CMakeLists.txt, setup.py and setup.cfg, and correct files next to each of them."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfkit.lint import lint

MANIFEST = """<package format="3">
  <name>cart</name>
  <version>1.0.0</version>
  <description>A cart.</description>
  <maintainer email="cart@example.com">The maintainers</maintainer>
  <license>MIT</license>
  <buildtool_depend>ament_cmake</buildtool_depend>
  <exec_depend>launch_ros</exec_depend>
  <export><build_type>ament_cmake</build_type></export>
</package>
"""
CMAKE = """cmake_minimum_required(VERSION 3.8)
project(cart)
find_package(ament_cmake REQUIRED)
install(DIRECTORY launch urdf
  DESTINATION share/${PROJECT_NAME})
install(PROGRAMS scripts/wait.py DESTINATION lib/${PROJECT_NAME})
if(BUILD_TESTING)
  find_package(ament_cmake_pytest REQUIRED)
endif()
ament_package()
"""
SETUP = """import os
from glob import glob
from setuptools import setup

package_name = "cart"

setup(
    name=package_name,
    packages=[package_name],
    data_files=[
        ("share/ament_index/resource_index/packages", ["resource/" + package_name]),
        ("share/" + package_name, ["package.xml"]),
        (os.path.join("share", package_name, "launch"), glob(os.path.join("launch", "*.launch.*"))),
        (os.path.join("share", package_name, "config"), glob("config/*.yaml") + glob("config/*.rviz")),
        (os.path.join("share", package_name, "urdf"), ["urdf/cart.urdf"]),
    ],
    entry_points={"console_scripts": ["drive = cart.drive:main"]},
)
"""
CFG = "[develop]\nscript_dir=$base/lib/cart\n[install]\ninstall_scripts=$base/lib/cart\n"
LAUNCH = """<launch>
  <let name="settings" value="$(find-pkg-share cart)/config/cart.yaml"/>
</launch>
"""


def write(folder: Path, files: dict[str, str]) -> None:
    for name, text in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)


def found(folder: Path) -> list[str]:
    return [f"{finding.file}:{finding.line}: {finding.message}" for finding in lint(folder)]


@pytest.fixture
def cmake(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    start = '<launch>\n  <node pkg="cart" exec="wait.py"/>\n</launch>\n'
    model = '<robot name="cart"><link name="base"/></robot>\n'
    files = {"package.xml": MANIFEST, "CMakeLists.txt": CMAKE, "urdf/cart.urdf": model}
    write(tmp_path, {**files, "launch/cart.launch.xml": start, "scripts/wait.py": ""})
    assert found(tmp_path) == []
    return tmp_path


@pytest.fixture
def python(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    manifest = MANIFEST.replace("  <buildtool_depend>ament_cmake</buildtool_depend>\n", "")
    model = '<robot name="cart"><link name="base"/></robot>\n'
    files = {"package.xml": manifest.replace("ament_cmake", "ament_python"), "setup.py": SETUP, "setup.cfg": CFG}
    modules = {"cart/__init__.py": "", "cart/drive.py": "def main():\n    pass\n", "resource/cart": ""}
    write(tmp_path, {**files, **modules, "urdf/cart.urdf": model, "launch/cart.launch.xml": LAUNCH})
    write(tmp_path, {"config/cart.yaml": "{}\n"})
    assert found(tmp_path) == []
    return tmp_path


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        (
            ' format="3"',
            "",
            '1: <exec_depend> does not exist in format 1 of package.xml; add `format="3"` to <package>',
        ),
        ('format="3"', 'format="4"', "1: unknown format `4` of package.xml; use 1, 2 or 3"),
        ("<name>cart<", "<name>1cart<", "2: package name `1cart` does not begin with a letter"),
        (
            "<name>cart<",
            "<name>my cart<",
            "2: package name `my cart` contains characters other than letters, digits, `_` and `-`",
        ),
        ("<version>1.0.0<", "<version>1.0.0</version><version>2.0.0<", "3: package.xml has a second <version>"),
        ("MIT", "", "6: <license> is empty"),
        ('email="cart@example.com"', "", "5: <maintainer> has no `email`"),
        ("cart@example.com", "cart@example", "5: `cart@example` is not an e-mail address"),
        (">launch_ros<", ">cart<", "8: package `cart` depends on itself"),
        ("<buildtool_depend>ament_cmake</buildtool_depend>", "", "1: package.xml has no <buildtool_depend>ament_cmake"),
    ],
)
def test_a_manifest_that_tools_refuse_is_reported(cmake, old, new, expected):
    assert old in MANIFEST
    (cmake / "package.xml").write_text(MANIFEST.replace(old, new))
    assert any(line.startswith(f"package.xml:{expected}") for line in found(cmake)), found(cmake)


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("<exec_depend>launch_ros</exec_depend>", "<depend>launch_ros</depend><test_depend>launch_ros</test_depend>"),
        ("<buildtool_depend>ament_cmake<", "<buildtool_depend>ament_cmake_auto<"),
        ("</license>", '</license><license file="LICENSE">BSD</license><author>Nobody</author>'),
        ("A cart.", "A <em>small</em> cart."),
        ("launch_ros", "python3-pil"),
    ],
)
def test_a_manifest_that_tools_accept_is_silent(cmake, old, new):
    assert old in MANIFEST
    (cmake / "package.xml").write_text(MANIFEST.replace(old, new))
    assert found(cmake) == []


def test_folders_that_moveit_reads_have_to_be_installed(cmake):
    write(cmake, {"config/cart.srdf": '<robot name="cart"/>\n'})
    assert "CMakeLists.txt:4: folder `config` is not installed, but MoveIt reads it" in found(cmake)
    (cmake / "CMakeLists.txt").write_text(CMAKE.replace("launch urdf", "launch urdf config"))
    assert not any("not installed" in line for line in found(cmake))


def test_folders_that_the_description_of_another_package_reads_have_to_be_installed(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    control = MANIFEST.replace("<name>cart<", "<name>cart_control<")
    cmake = CMAKE.replace("(cart)", "(cart_control)").replace("launch urdf", "launch")
    robot = """<robot name="cart"><link name="base"/>
      <gazebo><plugin name="p" filename="libgz_ros2_control-system.so">
        <!-- $(find cart_control)/other/cart.yaml -->
        <parameters>$(find cart_control)/config/cart.yaml</parameters>
      </plugin></gazebo></robot>"""
    folder = tmp_path / "cart_control"
    files = {"package.xml": control, "CMakeLists.txt": cmake.replace("install(PROGRAMS", "# install(PROGRAMS")}
    write(
        folder, {**files, "config/cart.yaml": "{}\n", "other/cart.yaml": "{}\n", "launch/c.launch.xml": "<launch/>\n"}
    )
    own = MANIFEST.replace("launch_ros", "cart_control")
    write(tmp_path / "cart", {"package.xml": own, "urdf/cart.urdf.xacro": robot})
    lines = [line for line in found(tmp_path) if "not installed" in line]
    use = "cart/urdf/cart.urdf.xacro:4 uses it"
    assert lines == [f"cart_control/CMakeLists.txt:4: folder `config` is not installed, but {use}"]


def test_a_neighbour_that_misspells_its_dependency_belongs_to_the_robot(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    robot = '<robot name="r"><link name="base"/></robot>\n'
    description = MANIFEST.replace("<name>cart<", "<name>cart_description<")
    write(tmp_path / "cart_description", {"package.xml": description, "urdf/r.urdf": robot})
    for written, expected in (("cart_descriptoin", 1), ("cart2_description", 0), ("cart_descriptions_of_others", 0)):
        bringup = MANIFEST.replace("<name>cart<", "<name>bringup<").replace("launch_ros", written)
        write(tmp_path / "bringup", {"package.xml": bringup})
        lines = [line for line in found(tmp_path) if "unknown dependency" in line]
        assert len(lines) == expected, lines


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ("share/${PROJECT_NAME})\n", "share/${PROJECT_NAME}\n", "4: the parenthesis of `install` is not closed"),
        ("project(cart)", "project(cart))", "2: unmatched `)`"),
        ("project(cart)\n", "", "1: CMakeLists.txt does not call project()"),
        ("find_package(ament_cmake REQUIRED)\n", "", "9: ament_package() needs find_package(ament_cmake REQUIRED)"),
        ("(ament_cmake R", "(catkin R", "3: ament_package() needs find_package(ament_cmake REQUIRED)"),
        ("(ament_cmake R", "(ament_cmakes R", "3: unknown package `ament_cmakes`; did you mean `ament_cmake`?"),
        ("urdf\n  DESTINATION", "urdf\n ", "4: install(DIRECTORY) has no DESTINATION"),
        ("share/${PROJECT_NAME}", "share/${PROJECT}", "5: variable `PROJECT` does not exist"),
        ("share/${PROJECT_NAME}", "share/cart_files", "5: folder `launch` is installed to `share/cart_files`, but its"),
        (
            "share/${PROJECT_NAME}",
            "${CATKIN_PACKAGE_SHARE_DESTINATION}",
            "5: variable `CATKIN_PACKAGE_SHARE_DESTINATION` is",
        ),
        (
            "share/${PROJECT_NAME}",
            "share",
            "5: folder `launch` is installed to `share`, but its files are looked up in",
        ),
        (
            "(DIRECTORY launch urdf",
            "(FILES launch urdf",
            "4: install(FILES) does not install folders `launch`, `urdf`; write install(DIRECTORY …)",
        ),
        ("share/${PROJECT_NAME}", "lib/cart", "5: folder `launch` is installed to `lib/cart`, but its files are"),
        ("install(PROGRAMS scripts/wait.py DESTINATION lib/${PROJECT_NAME})\n", "", "4: `scripts/wait.py` is not"),
        ("(DIRECTORY", "(DIRECTROY", "4: unknown argument `DIRECTROY` of install(); did you mean `DIRECTORY`?"),
        (
            "  DESTINATION share",
            "  DESTNATION share",
            "5: unknown argument `DESTNATION` of install(); did you mean `DESTINA",
        ),
    ],
)
def test_a_defect_of_cmake_is_reported(cmake, old, new, expected):
    assert old in CMAKE
    (cmake / "CMakeLists.txt").write_text(CMAKE.replace(old, new, 1))
    assert any(line.startswith(f"CMakeLists.txt:{expected}") for line in found(cmake)), found(cmake)


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("project(cart)", 'project(cart)\nmessage("a ) and a ( in a text") # and ( here\n#[[ ( ]]\nset(A [=[ ( ]=])'),
        ("find_package(ament_cmake REQUIRED)", "find_package(ament_cmake_auto REQUIRED)"),
        ("find_package(ament_cmake REQUIRED)", "find_package(my_cmake REQUIRED)"),
        ("share/${PROJECT_NAME})\n", "share/cart/)\n"),
        ("share/${PROJECT_NAME})\n", "${INSTALL_FOLDER})\n"),
        ("urdf\n  DESTINATION share/${PROJECT_NAME}", "urdf ${WHERE}"),
        ("install(DIRECTORY launch urdf", "install(DIRECTORY launch DESTINATION share)\ninstall(DIRECTORY launch urdf"),
        ("install(PROGRAMS scripts/wait.py", "install(DIRECTORY scripts/"),
        (
            "project(cart)",
            "project(cart)\n#[[ install(FILES old.yaml)\ninstall(DIRECTRY a DESTINATION share/${PROJECT}) ]]",
        ),
        (
            "find_package(ament_cmake R",
            "foreach(dep IN LISTS ALL)\nfind_package(${dep})\nendforeach()\n# find_package(R",
        ),
        ("scripts/wait.py", "scripts/wait.py RENAME wait"),
        ("install(PROGRAMS", "install(DIRECTORY urdf/ TYPE DATA)\ninstall(PROGRAMS"),
        ("wait.py DESTINATION", "wait.py PERMISSIONS OWNER_READ OWNER_EXECUTE DESTINATION"),
        ("share/${PROJECT_NAME})\n", "${CATKIN_DEVEL_PREFIX}/share)\n"),
    ],
)
def test_a_correct_cmake_file_is_silent(cmake, old, new):
    assert old in CMAKE
    (cmake / "CMakeLists.txt").write_text(CMAKE.replace(old, new, 1))
    assert found(cmake) == []


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        (
            '"config/*.yaml"',
            '"confg/*.yaml"',
            "14: folder `confg` does not exist in this package; did you mean `config`",
        ),
        ('"config/*.yaml"', '"config/*.yml"', "14: `config/cart.yaml` is not installed, but launch/cart.launch.xml:2"),
        (
            'glob("config/*.yaml") +',
            'glob("params/*.yaml") +',
            "14: folder `params` does not exist in this package; launch files use `config`",
        ),
        ("*.launch.*", "*.launch.py", "13: launch file `launch/cart.launch.xml` is not installed"),
        ('"resource/" +', '"resources/" +', "11: `resources/cart` does not exist in this package"),
        ("cart.drive:", "crt.drive:", "17: module `crt` does not exist in this package; did you mean `cart`?"),
        ("cart.drive:", "cart.driv:", "17: module `cart.driv` does not exist in this package; did you mean `drive`?"),
        (":main", ":mian", "17: `cart/drive.py` does not define `mian`; did you mean `main`?"),
        ("resource_index/packages", "resource_index/package", "11: data_files does not install the marker"),
        (
            'packages", ["resource/" + package_name]',
            'package", [os.path.join("resource", package_name)]',
            "11: data_files does not install the marker",
        ),
        (
            'name, "config")',
            'name, "configs")',
            "14: `config/cart.yaml` is installed to `share/cart/configs`, but launch",
        ),
        ("packages=[package_name]", "packages=[]", "9: Python package `cart` is not installed, but `drive` imports it"),
        ("console_scripts", "console_script", "17: unknown group `console_script` of entry points; did you mean"),
        (
            "name=package_name,",
            'name=package_name,\n    version="1.0.1",',
            "9: the version in setup.py is 1.0.1, but the version in package.xml is 1.0.0",
        ),
        (":main", ".main", "17: `drive = cart.drive.main` is not of the form `name = module:function`"),
    ],
)
def test_a_defect_of_setup_is_reported(python, old, new, expected):
    assert old in SETUP
    (python / "setup.py").write_text(SETUP.replace(old, new, 1))
    assert any(line.startswith(f"setup.py:{expected}") for line in found(python)), found(python)


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ('"config/*.yaml"', '"config/*"'),
        ('glob("config/*.yaml")', "settings()"),
        ('"config/*.yaml"', '"config/**/*.yaml", recursive=True'),
        ("cart.drive:main", "other_package.drive:main"),
        ("packages=", 'package_dir={"": "src"}, packages='),
    ],
)
def test_a_correct_setup_file_is_silent(python, old, new):
    assert old in SETUP
    (python / "setup.py").write_text(SETUP.replace(old, new, 1))
    assert found(python) == []


def test_a_folder_of_executables_that_ros2_run_does_not_search_is_reported(python):
    (python / "setup.cfg").write_text(CFG.replace("lib/cart", "lib/carts"))
    message = "executables are installed to `lib/carts`, but `ros2 run` searches `lib/cart`"
    assert found(python) == [f"setup.cfg:{line}: {message}" for line in (2, 4)]
    (python / "setup.cfg").unlink()
    assert found(python) == ["setup.py:17: setup.cfg is missing: `ros2 run` finds executables only in `lib/cart`"]
    (python / "pyproject.toml").write_text("")
    assert found(python) == []


def test_a_module_that_imports_its_function_is_accepted(python):
    for text in ("from cart.other import main\n", "from cart.other import *\n", "main = print\n", "def main(:\n"):
        (python / "cart" / "drive.py").write_text(text)
        assert found(python) == []


LOOP = "foreach(folder launch urdf)\n  install(DIRECTORY ${folder} DESTINATION share/${PROJECT_NAME})\nendforeach()\n"
LIST = "set(FOLDERS launch urdf)\nforeach(folder IN LISTS FOLDERS)\n  install(DIRECTORY ${folder}"
LIST += " DESTINATION share/${PROJECT_NAME})\nendforeach()\n"
PLAIN = "install(DIRECTORY launch urdf\n  DESTINATION share/${PROJECT_NAME})\n"


@pytest.mark.parametrize(
    ("install", "expected"),
    [
        (LOOP, []),
        (LIST, []),
        (LOOP.replace("launch urdf", "lanch urdf"), ["CMakeLists.txt:4: `lanch` does not exist in this package"]),
        (LOOP.replace("launch urdf", "urdf"), ["CMakeLists.txt:4: folder `launch` is not installed, but it contains"]),
        (LIST.replace("launch urdf", "urdf"), ["CMakeLists.txt:4: folder `launch` is not installed, but it contains"]),
        (LOOP.replace("launch urdf", "${OTHERS}"), []),
    ],
)
def test_folders_that_a_loop_installs(cmake, install, expected):
    (cmake / "CMakeLists.txt").write_text(CMAKE.replace(PLAIN, install))
    reported = found(cmake)
    assert len(reported) == len(expected)
    assert all(line.startswith(start) for line, start in zip(reported, expected, strict=True)), reported


CODE = """import rclpy
from sensor_msgs.msg import LaserScan
from rcl_interfaces.msg import SetParametersResult
try:
    import cv_bridge
except ImportError:
    import tf2_ros
import some_module
TEXT = '''
import nav_msgs
from message_filters import Subscriber
'''
"""


@pytest.mark.parametrize(
    ("needed", "expected"),
    [
        (["rclpy", "sensor_msgs"], []),
        (["rclpy", "common_interfaces"], []),
        (["rclpy"], ["missing dependency on `sensor_msgs`"]),
        (["sensor_msgs"], ["missing dependency on `rclpy`"]),
    ],
)
def test_packages_that_python_code_imports_are_dependencies(cmake, needed, expected):
    lines = "".join(f"<exec_depend>{name}</exec_depend>\n  " for name in needed)
    (cmake / "package.xml").write_text(MANIFEST.replace("<exec_depend>launch_ros", f"{lines}<exec_depend>launch_ros"))
    (cmake / "scripts").mkdir(exist_ok=True)
    (cmake / "scripts/scan.py").write_text(CODE)
    (cmake / "test").mkdir(exist_ok=True)
    (cmake / "test/test_scan.py").write_text("import cv_bridge\n")
    assert [one.message for one in lint(cmake, target="ros2") if one.code == "K956"] == expected


@pytest.mark.parametrize(
    ("call", "expected"),
    [
        ("find_package(rclcpp REQUIRED)", ["missing dependency on `rclcpp`"]),
        (
            "foreach(name rclcpp launch_ros)\n  find_package(${name} REQUIRED)\nendforeach()",
            ["missing dependency on `rc"],
        ),
        ("find_package(launch_ros REQUIRED)\nfind_package(Eigen3 REQUIRED)\nfind_package(octomap REQUIRED)", []),
        ("find_package(rclcpp QUIET)", []),
        ("if(WITH_NODE)\n  find_package(rclcpp REQUIRED)\nendif()", []),
        ("if(DEFINED ENV{ROS1})\n  find_package(catkin REQUIRED COMPONENTS roscpp)\nendif()", []),
        ("find_package(catkin OPTIONAL_COMPONENTS roscpp)", []),
        ("find_package(catkin COMPONENTS roscpp OPTIONAL_COMPONENTS rospy)", ["missing dependency on `roscpp`"]),
        ("if(A)\nendif()\nfind_package(rclcpp QUIET REQUIRED)", ["missing dependency on `rclcpp`"]),
    ],
)
def test_packages_that_cmake_finds_are_dependencies(cmake, call, expected):
    tool = "find_package(ament_cmake REQUIRED)"
    (cmake / "CMakeLists.txt").write_text(CMAKE.replace(tool, f"{tool}\n{call}"))
    reported = [one.message for one in lint(cmake, target="ros2") if one.code == "K956"]
    assert len(reported) == len(expected)
    assert all(map(str.startswith, reported, expected)), reported


PROGRAM = """add_executable(drive src/drive.cpp)
target_link_libraries(drive stdc++)
install(TARGETS drive DESTINATION lib/${PROJECT_NAME})
"""


_TEST_OF_AMENT = """find_package(ament_cmake_gtest REQUIRED)
ament_add_gtest(core_test test.cpp)
target_link_libraries(core_test stdc++)
"""


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ("", "", []),
        ("(drive src", "(${PROJECT_NAME}_drive src", ["4: the other commands call this target `drive`"]),
        ("(drive src", "(driver src", ["4: the other commands call this target `drive`"]),
        ("libraries(drive", "libraries(driver", ["5: no command defines the target `driver`; did you mean `drive`?"]),
        (
            "drive DESTINATION",
            "drive RUNTIM DESTINATION",
            ["6: unknown argument `RUNTIM` of install(); did you mean `RUNTIME`?"],
        ),
        ("TARGETS drive", "TARGETS driver", ["6: no command defines the target `driver`; did you mean `drive`?"]),
        ("src/drive.cpp", "src/driver.cpp", ["4: `src/driver.cpp` does not exist in this package"]),
        ("src/drive.cpp", "source/drive.cpp", []),
        ("add_executable", "include(targets.cmake)\nadd_executable", []),
        ("install(TARGETS drive", "add_python_module(extra x.cpp)\ninstall(TARGETS drive extra", []),
        ("install", _TEST_OF_AMENT.replace("gtest", "gtest") + "install", []),
        ("install", _TEST_OF_AMENT.replace("gtest", "gmock") + "install", []),
        ("install", "catkin_add_gtest(${PROJECT_NAME}-test a.cpp)\ntarget_link_libraries(cart-test m)\ninstall", []),
        (
            "install",
            _TEST_OF_AMENT.replace("ament_cmake_gtest", "rostest")
            .replace("ament_add", "add_rostest")
            .replace("test.cpp", "${CASE} test.cpp")
            + "install",
            [],
        ),
        ("install", "if(TARGET core)\n  target_link_libraries(core m)\nendif()\ninstall", []),
        ("install", "find_package(fmt REQUIRED)\ntarget_compile_definitions(fmt PUBLIC A)\ninstall", []),
        ("install", "FetchContent_MakeAvailable(json)\ntarget_compile_options(json PUBLIC -w)\ninstall", []),
        ("install", "pkg_check_modules(yaml yaml-cpp)\ntarget_compile_options(yaml PUBLIC -w)\ninstall", []),
        ("install", "add_subdirectory(core)\ntarget_compile_options(core PUBLIC -w)\ninstall", []),
        ("src/drive.cpp)", "src/drive.cpp src/made.cpp)\nexecute_process(COMMAND make_it)", []),
        ("src/drive.cpp)", "src/drive.cpp src/made.cpp)\nfile(GENERATE OUTPUT src/made.cpp CONTENT x)", []),
        ("src/drive.cpp)", "src/drive.cpp src/made.cpp)\nfile(WRITE src/made.cpp x)", []),
        ("src/drive.cpp)", "src/drive.cpp src/made.cpp)\ninclude(cmake/made.cmake)", []),
        (
            "src/drive.cpp)",
            "src/drive.cpp src/made.cpp)\ninclude(GNUInstallDirs)",
            ["4: `src/made.cpp` does not exist in this package"],
        ),
    ],
)
def test_targets_and_their_sources(cmake, old, new, expected):
    write(cmake, {"src/drive.cpp": "int main() {}\n"})
    tool = "find_package(ament_cmake REQUIRED)\n"
    text = CMAKE.replace(tool, tool + PROGRAM.replace(old, new, 1) if old else tool + PROGRAM)
    (cmake / "CMakeLists.txt").write_text(text)
    reported = found(cmake)
    assert len(reported) == len(expected)
    assert all(line.startswith(f"CMakeLists.txt:{start}") for line, start in zip(reported, expected, strict=True))


@pytest.mark.parametrize("folder", ["meshes", "urdf"])
def test_a_folder_of_meshes_that_a_property_names(cmake, folder):
    (cmake / "meshes").mkdir()
    model = f"""<robot name="cart" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:property name="shapes" value="package://cart/{folder}"/>
  <link name="base"><visual><geometry><mesh filename="${{shapes}}/base.stl"/></geometry></visual></link>
</robot>
"""
    write(cmake, {"urdf/cart.urdf.xacro": model, f"{folder}/base.stl": "solid base\nendsolid base\n"})
    (cmake / "urdf/cart.urdf").unlink()
    message = "CMakeLists.txt:4: folder `meshes` of this package is not installed"
    assert [each for each in found(cmake) if "not installed" in each] == [message] * (folder == "meshes")
