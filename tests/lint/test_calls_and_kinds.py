"""Calls in CMakeLists.txt, kinds of dependencies and modules, with correct packages as a start."""

from __future__ import annotations

import pytest

from tests.lint.test_build_files import MANIFEST, found, write
from tests.lint.test_code_of_targets import CATKIN, MANIFEST_OF_CATKIN
from tests.lint.test_messages_and_targets import FILES as MESSAGES_OF_ROS2
from tests.lint.test_plugins_and_installation import FILES

MODULES = """from distutils.core import setup
from catkin_pkg.python_setup import generate_distutils_setup
setup(**generate_distutils_setup(packages=['cart'], package_dir={'': 'src'}))
"""
OF_CATKIN = {
    "CMakeLists.txt": CATKIN.replace("(CATKIN", "(INCLUDE_DIRS include CATKIN")
    .replace("add_message", "catkin_python_setup()\nadd_message")
    .replace("install(DIRECTORY", "install(DIRECTORY include"),
    "package.xml": MANIFEST_OF_CATKIN,
    "setup.py": MODULES,
    "urdf/cart.urdf": FILES["urdf/cart.urdf"],
    "src/cart/__init__.py": "",
    "src/drive.cpp": "#include <ros/ros.h>\nint main() {}\n",
    "include/cart/load.h": "",
    "msg/Load.msg": "std_msgs/Header header\n",
}
NEEDS_TWO = " needs the package of the base class and a file"
PACKAGE = "catkin_package(INCLUDE_DIRS include CATKIN_DEPENDS message_runtime roscpp std_msgs)\n"
MESSAGES = "add_message_files(FILES Load.msg)\n"
GENERATE = "generate_messages(DEPENDENCIES std_msgs)\n"


@pytest.mark.parametrize(
    ("file", "old", "new", "expected"),
    [
        (
            "CMakeLists.txt",
            MESSAGES + GENERATE,
            GENERATE + MESSAGES,
            "CMakeLists.txt:10: add_message_files() is called after generate_messages(), which needs its files",
        ),
        ("CMakeLists.txt", GENERATE, "", "CMakeLists.txt:9: generate_messages() is missing after add_message_files()"),
        (
            "CMakeLists.txt",
            GENERATE + PACKAGE,
            PACKAGE + GENERATE,
            "CMakeLists.txt:11: generate_messages() is called after catkin_package(), which exports its messages",
        ),
        (
            "CMakeLists.txt",
            "(FILES Load.msg)",
            "(Load.msg)",
            "CMakeLists.txt:9: add_message_files() does not begin with FILES or DIRECTORY",
        ),
        (
            "CMakeLists.txt",
            "INCLUDE_DIRS include",
            "INCLUDE_DIRS incldue",
            "CMakeLists.txt:11: folder `incldue` does not exist in this package; did you mean `include`?",
        ),
        (
            "CMakeLists.txt",
            "(INCLUDE_DIRS include",
            "(include",
            "CMakeLists.txt:11: `include` does not follow a keyword of catkin_package()",
        ),
        (
            "CMakeLists.txt",
            "CATKIN_DEPENDS",
            "LIBRARIES",
            "CMakeLists.txt:11: `message_runtime` is a catkin package; list it in CATKIN_DEPENDS",
        ),
        (
            "CMakeLists.txt",
            "catkin_python_setup()\n",
            "",
            "CMakeLists.txt:10: catkin_python_setup() is missing, which installs the modules in setup.py",
        ),
        (
            "setup.py",
            "'src'",
            "'source'",
            "setup.py:3: folder `source` does not exist in this package; did you mean `src`?",
        ),
        (
            "setup.py",
            "['cart']",
            "['crat']",
            "setup.py:3: `src/crat` does not exist in this package; did you mean `cart`?",
        ),
        (
            "CMakeLists.txt",
            "install(TARGETS drive DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})\n",
            "",
            None,
        ),
        (
            "package.xml",
            "<depend>roscpp<",
            "<exec_depend>roscpp<",
            "package.xml:10: CMakeLists.txt finds `roscpp`, but <exec_depend> does not install it for builds",
        ),
        (
            "package.xml",
            "<depend>roscpp<",
            "<build_depend>roscpp<",
            "package.xml:10: the targets use `roscpp`, but <build_depend> does not install it at run time",
        ),
        (
            "package.xml",
            "<buildtool_depend>",
            "<exec_depend>",
            "package.xml:1: package.xml has no <buildtool_depend>catkin</buildtool_depend>",
        ),
    ],
)
def test_calls_of_catkin(tmp_path, monkeypatch, file, old, new, expected):
    monkeypatch.chdir(tmp_path)
    write(tmp_path, OF_CATKIN)
    assert found(tmp_path) == []
    text = OF_CATKIN[file]
    assert text.count(old) == 1
    text = text.replace(old, new)
    kind = old.partition(">")[0][1:]
    if file == "package.xml":  # the end tag too
        name = old[1:].partition(">")[2].removesuffix("<") or "catkin"
        text = text.replace(f"{name}</{kind}>", f"{name}</{new.partition('>')[0][1:]}>")
    write(tmp_path, {file: text})
    assert found(tmp_path) == ([expected] if expected else [])


def test_catkin_package_after_the_targets(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    cmake = OF_CATKIN["CMakeLists.txt"]
    write(
        tmp_path,
        {**OF_CATKIN, "CMakeLists.txt": cmake.replace(PACKAGE, "").replace("install(T", f"{PACKAGE}install(T")},
    )
    message = "catkin_package() is called after add_executable(), which needs the folders that it sets"
    assert found(tmp_path) == [f"CMakeLists.txt:14: {message}"]


@pytest.mark.parametrize(
    ("file", "old", "new", "expected"),
    [
        (
            "CMakeLists.txt",
            "_node(part PLUGIN",
            "_node(plans PLUGIN",
            "CMakeLists.txt:12: the code of the component `cart::Part` is in the target `part`; did you mean `part`?",
        ),
        ("CMakeLists.txt", "EXECUTABLE part_node", "EXECUTABLE", "CMakeLists.txt:12: EXECUTABLE has no name"),
        (
            "CMakeLists.txt",
            "_file(cart plans.xml)",
            "_file(plans.xml)",
            "CMakeLists.txt:13: pluginlib_export_plugin_description_file()" + NEEDS_TWO,
        ),
        (
            "CMakeLists.txt",
            "_file(cart plans.xml)",
            "_file(crat plans.xml)",
            "CMakeLists.txt:13: no dependency has the base class of the package `crat`; did you mean `cart`?",
        ),
        (
            "CMakeLists.txt",
            "find_package(ament_cmake REQUIRED)\n",
            "find_package(ament_cmake_python REQUIRED)\n",
            "CMakeLists.txt:3: ament_target_dependencies() needs find_package(ament_cmake REQUIRED)",
        ),
        (
            "CMakeLists.txt",
            "ament_package()",
            "ament_python_install_package(carts)\nament_package()",
            "CMakeLists.txt:23: folder `carts` does not exist in this package; did you mean `cart`?",
        ),
        (
            "scripts/tip.py",
            "import os\n",
            "import os\nfrom cart.plan import Plan\n",
            "CMakeLists.txt:23: ament_python_install_package() is missing for the modules that `tip.py` imports",
        ),
    ],
)
def test_calls_of_ament(tmp_path, monkeypatch, file, old, new, expected):
    monkeypatch.chdir(tmp_path)
    texts = {**FILES, "scripts/tip.py": "import os\n", "cart/__init__.py": ""}
    write(tmp_path, texts)
    assert found(tmp_path) == []
    assert texts[file].count(old) == 1
    write(tmp_path, {file: texts[file].replace(old, new)})
    assert found(tmp_path) == [expected]


def test_install_before_its_target(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    line = "install(TARGETS part LIBRARY DESTINATION lib)\n"
    cmake = FILES["CMakeLists.txt"].replace(line, "").replace("add_library(part", f"{line}add_library(part")
    write(tmp_path, {**FILES, "CMakeLists.txt": cmake})
    assert found(tmp_path) == ["CMakeLists.txt:10: install() is called before the target `part` is defined"]


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ("[develop]", "[deveolp]", "1: unknown section `deveolp`; did you mean `develop`?"),
        ("script_dir", "script_idr", "2: unknown key `script_idr`; did you mean `script_dir`?"),
        ("script_dir=$base/lib/cart\n", "", "1: setup.cfg does not set `script_dir=$base/lib/cart` in [develop]"),
        (
            "install_scripts=$base/lib/cart\n",
            "",
            "3: setup.cfg does not set `install_scripts=$base/lib/cart` in [install]",
        ),
        (
            "[install]\ninstall_scripts=$base",
            "[install]\ninstall_scripts=$bsae",
            "4: unknown variable `$bsae`; did you mean `$base`?",
        ),
        ("[develop]\nscript_dir=$base/lib/cart\n", "", None),
        ("script_dir", "script-dir", None),
    ],
)
def test_keys_of_setup_cfg(tmp_path, monkeypatch, old, new, expected):
    monkeypatch.chdir(tmp_path)
    config = "[develop]\nscript_dir=$base/lib/cart\n[install]\ninstall_scripts=$base/lib/cart\n"
    setup = """from setuptools import setup
setup(
    name="cart",
    packages=["cart"],
    data_files=[
        ("share/ament_index/resource_index/packages", ["resource/cart"]),
        ("share/cart", ["package.xml"]),
        ("share/cart/urdf", ["urdf/cart.urdf"]),
    ],
    entry_points={"console_scripts": ["drive = cart.drive:main"]},
)
"""
    manifest = MANIFEST.replace("  <buildtool_depend>ament_cmake</buildtool_depend>\n", "")
    manifest = manifest.replace("<build_type>ament_cmake", "<build_type>ament_python")
    modules = {"resource/cart": "", "cart/__init__.py": "", "cart/drive.py": "def main(): pass\n"}
    robot = {"urdf/cart.urdf": FILES["urdf/cart.urdf"]}
    write(tmp_path, {**modules, **robot, "setup.py": setup, "package.xml": manifest, "setup.cfg": config})
    assert found(tmp_path) == []
    assert config.count(old) == 1
    write(tmp_path, {"setup.cfg": config.replace(old, new)})
    assert found(tmp_path) == ([f"setup.cfg:{expected}"] if expected else [])


def test_imports_need_packages_at_run_time(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    texts = {**FILES, "scripts/tip.py": "import rclpy\n"}
    texts["package.xml"] = texts["package.xml"].replace("<export>", "<exec_depend>rclpy</exec_depend>\n  <export>")
    write(tmp_path, texts)
    assert found(tmp_path) == []
    write(tmp_path, {"package.xml": texts["package.xml"].replace("exec_depend", "build_depend")})
    message = "Python code imports `rclpy`, but <build_depend> does not install it at run time"
    assert found(tmp_path) == [f"package.xml:9: {message}"]


def test_plugins_that_class_loader_registers(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    code = FILES["src/plans.cpp"].replace("PLUGINLIB_EXPORT_CLASS", "CLASS_LOADER_REGISTER_CLASS")
    write(tmp_path, FILES | {"src/plans.cpp": code})
    assert found(tmp_path) == []


def test_generated_messages_that_are_not_installed(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    group = "  <member_of_group>rosidl_interface_packages</member_of_group>\n"
    cmake = MESSAGES_OF_ROS2["CMakeLists.txt"].replace(
        "DEPENDENCIES std_msgs\n", "DEPENDENCIES std_msgs\n  SKIP_INSTALL\n"
    )
    files = {"CMakeLists.txt": cmake, "package.xml": MESSAGES_OF_ROS2["package.xml"].replace(group, "")}
    write(tmp_path, MESSAGES_OF_ROS2 | files)
    assert found(tmp_path) == []


def test_nodes_of_packages_of_tests_need_test_dependencies_only(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    manifest = OF_CATKIN["package.xml"].replace("<depend>roscpp</depend>", "<build_depend>roscpp</build_depend>")
    assert manifest != OF_CATKIN["package.xml"]
    write(tmp_path, OF_CATKIN | {"package.xml": manifest})
    assert len(found(tmp_path)) == 1
    for name in ("package.xml", "CMakeLists.txt"):
        text = (tmp_path / name).read_text()
        (tmp_path / name).write_text(
            text.replace("<name>cart<", "<name>test_cart<").replace("project(cart)", "project(test_cart)")
        )
    assert [each for each in found(tmp_path) if "roscpp" in each] == []


def test_a_package_of_the_system_covers_the_package_that_cmake_finds(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    cmake = FILES["CMakeLists.txt"].replace(
        "find_package(rclcpp R", "find_package(urdfdom_headers REQUIRED)\nfind_package(rclcpp R"
    )
    write(tmp_path, FILES | {"CMakeLists.txt": cmake})
    assert ["missing dependency on `urdfdom_headers`" in each for each in found(tmp_path)] == [True]
    manifest = FILES["package.xml"].replace(
        "<depend>rclcpp<", "<build_depend>liburdfdom-headers-dev</build_depend><depend>rclcpp<"
    )
    write(tmp_path, {"package.xml": manifest})
    assert found(tmp_path) == []
