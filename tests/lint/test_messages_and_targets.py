"""Generated messages and the targets of CMakeLists.txt, with correct packages of ROS 1 and ROS 2 as a start."""

from __future__ import annotations

from time import process_time

import pytest

from tests.lint.test_build_files import MANIFEST, found, write

ROBOT = '<robot name="cart"><link name="base"/></robot>\n'
INTERFACES = MANIFEST.replace(
    "  <exec_depend>launch_ros</exec_depend>\n",
    """  <exec_depend>launch_ros</exec_depend>
  <buildtool_depend>rosidl_default_generators</buildtool_depend>
  <depend>std_msgs</depend>
  <depend>rclcpp</depend>
  <exec_depend>rosidl_default_runtime</exec_depend>
  <member_of_group>rosidl_interface_packages</member_of_group>
""",
)
CMAKE = """cmake_minimum_required(VERSION 3.8)
project(cart)
find_package(ament_cmake REQUIRED)
find_package(rosidl_default_generators REQUIRED)
find_package(std_msgs REQUIRED)
find_package(rclcpp REQUIRED)
rosidl_generate_interfaces(${PROJECT_NAME}
  "msg/Load.msg"
  "srv/Tip.srv"
  DEPENDENCIES std_msgs
)
add_executable(drive src/drive.cpp)
ament_target_dependencies(drive rclcpp std_msgs)
install(TARGETS drive DESTINATION lib/${PROJECT_NAME})
install(DIRECTORY launch urdf DESTINATION share/${PROJECT_NAME})
ament_package()
"""
FILES = {
    "urdf/cart.urdf": ROBOT,
    "package.xml": INTERFACES,
    "CMakeLists.txt": CMAKE,
    "msg/Load.msg": "std_msgs/Header header  # time\nfloat64 mass\n",
    "srv/Tip.srv": "bool up\n---\nbool success\n",
    "src/drive.cpp": '#include "rclcpp/rclcpp.hpp"\n#include "std_msgs/msg/bool.hpp"\nint main() {}\n',
    "launch/cart.launch.xml": '<launch>\n  <node pkg="cart" exec="drive"/>\n</launch>\n',
}
NEEDS = "CMakeLists.txt:6: {}() needs find_package({} REQUIRED)"
MADE = ["CMakeLists.txt:9: `msg/Made.msg` does not exist in this package"]
NEEDS_GROUP = "rosidl_generate_interfaces() needs <member_of_group>rosidl_interface_packages</member_of_group>"


@pytest.mark.parametrize(
    ("file", "old", "new", "expected"),
    [
        (
            "CMakeLists.txt",
            '  "srv/Tip.srv"\n',
            "",
            ["CMakeLists.txt:7: `srv/Tip.srv` is not generated; rosidl_generate_interfaces() does not name it"],
        ),
        ("CMakeLists.txt", '  "srv/Tip.srv"\n', '  # "srv/Tip.srv"\n', []),
        (
            "CMakeLists.txt",
            "srv/Tip.srv",
            "srv/Lift.srv",
            ["CMakeLists.txt:9: `srv/Lift.srv` does not exist in this package; did you mean `Tip.srv`?"],
        ),
        ("CMakeLists.txt", '  "srv/Tip.srv"', '  "srv/Tip.srv" "msg/Made.msg" # file(WRITE', MADE),
        ("CMakeLists.txt", '"srv/Tip.srv"', "${services}", []),
        (
            "CMakeLists.txt",
            "  DEPENDENCIES std_msgs\n",
            "",
            ["CMakeLists.txt:7: `Load.msg` uses `std_msgs`, which is missing in DEPENDENCIES"],
        ),
        (
            "CMakeLists.txt",
            "DEPENDENCIES std_msgs",
            "DEPENDENCIES sensor_msgs",
            [NEEDS.format("rosidl_generate_interfaces", "sensor_msgs")],
        ),
        ("CMakeLists.txt", "DEPENDENCIES std_msgs", "DEPENDENCIES shop_msgs", []),
        (
            "package.xml",
            "  <member_of_group>rosidl_interface_packages</member_of_group>\n",
            "",
            [f"package.xml:12: {NEEDS_GROUP} in package.xml"],
        ),
        (
            "package.xml",
            "  <exec_depend>rosidl_default_runtime</exec_depend>\n",
            "",
            ["package.xml:11: missing dependency on `rosidl_default_runtime`, which generated messages need"],
        ),
        (
            "CMakeLists.txt",
            "drive DESTINATION lib/${PROJECT_NAME}",
            "drive\n  RUNTIME DESTINATION bin",
            ["CMakeLists.txt:15: executable `drive` is installed to `bin`, but launch files need it in `lib/cart`"],
        ),
        (
            "CMakeLists.txt",
            "(drive rclcpp std_msgs)",
            "(drive rclcpp)",
            ["CMakeLists.txt:13: target `drive` includes headers of `std_msgs`, but does not depend on it"],
        ),
        (
            "CMakeLists.txt",
            "(drive rclcpp std_msgs)",
            "(drive rclcpp nav_msgs)",
            [NEEDS.format("ament_target_dependencies", "nav_msgs")],
        ),
        ("CMakeLists.txt", "(drive rclcpp std_msgs)", "(drive rclcpp shop_core)", []),
        ("CMakeLists.txt", "(drive rclcpp std_msgs)", "(drive rclcpp ${NEEDED})", []),
    ],
)
def test_messages_and_targets_of_ros2(tmp_path, monkeypatch, file, old, new, expected):
    monkeypatch.chdir(tmp_path)
    write(tmp_path, FILES)
    assert found(tmp_path) == []
    text = FILES[file]
    assert text.count(old) == 1
    write(tmp_path, {file: text.replace(old, new)})
    assert found(tmp_path) == expected


def test_names_of_fields_are_read_in_linear_time(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    name = "a" * 31 + "X"
    write(tmp_path, {**FILES, "msg/Load.msg": f"std_msgs/Header header\nfloat64 {name}\n"})
    start = process_time()
    assert found(tmp_path) == [
        f"msg/Load.msg:2: invalid name `{name}` of a field; ROS 2 needs lower case; did you mean `{'a' * 31}_x`?"
    ]
    assert process_time() - start < 3.0


CATKIN = """cmake_minimum_required(VERSION 3.0.2)
project(cart)
find_package(catkin REQUIRED COMPONENTS message_generation std_msgs)
add_message_files(FILES Load.msg)
add_service_files(FILES Tip.srv)
generate_messages(DEPENDENCIES std_msgs)
catkin_package(CATKIN_DEPENDS message_runtime std_msgs)
"""
CATKIN_MANIFEST = (
    MANIFEST.replace("ament_cmake</buildtool", "catkin</buildtool")
    .replace("  <export><build_type>ament_cmake</build_type></export>\n", "")
    .replace(
        "  <exec_depend>launch_ros</exec_depend>\n",
        "  <build_depend>message_generation</build_depend>\n  <depend>std_msgs</depend>\n"
        "  <exec_depend>message_runtime</exec_depend>\n",
    )
)


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        (
            "add_service_files(FILES Tip.srv)\n",
            "",
            ["CMakeLists.txt:5: `srv/Tip.srv` is not generated; add_service_files() does not name it"],
        ),
        ("add_service_files(FILES Tip.srv)", "add_service_files()", []),
        (
            "Tip.srv",
            "Tap.srv",
            ["CMakeLists.txt:5: `srv/Tap.srv` does not exist in this package; did you mean `Tip.srv`?"],
        ),
        (
            "generate_messages(DEPENDENCIES std_msgs)",
            "generate_messages()",
            ["CMakeLists.txt:6: `Load.msg` uses `std_msgs`, which is missing in DEPENDENCIES"],
        ),
    ],
)
def test_messages_of_ros1(tmp_path, monkeypatch, old, new, expected):
    monkeypatch.chdir(tmp_path)
    files = {"msg/Load.msg": "Header header\nfloat64 mass\n", "srv/Tip.srv": FILES["srv/Tip.srv"]}
    write(tmp_path, {**files, "urdf/cart.urdf": ROBOT, "package.xml": CATKIN_MANIFEST, "CMakeLists.txt": CATKIN})
    assert found(tmp_path) == []
    assert CATKIN.count(old) == 1
    write(tmp_path, {"CMakeLists.txt": CATKIN.replace(old, new)})
    assert found(tmp_path) == expected


@pytest.mark.parametrize("needed", ["", " actionlib_msgs"])
def test_messages_of_an_action_need_those_of_actionlib(tmp_path, monkeypatch, needed):
    monkeypatch.chdir(tmp_path)
    cmake = CATKIN.replace("add_service_files(FILES Tip.srv)", "add_action_files(FILES Lift.action)")
    cmake = cmake.replace("DEPENDENCIES std_msgs", f"DEPENDENCIES std_msgs{needed}")
    cmake = cmake.replace("message_generation std", "message_generation actionlib_msgs std")
    manifest = CATKIN_MANIFEST.replace("</license>", "</license><depend>actionlib_msgs</depend>")
    write(tmp_path, {"urdf/cart.urdf": ROBOT, "package.xml": manifest, "CMakeLists.txt": cmake})
    write(
        tmp_path, {"msg/Load.msg": "float64 mass\n", "action/Lift.action": "bool up\n---\nbool done\n---\nbool now\n"}
    )
    message = "`Lift.action` uses `actionlib_msgs`, which is missing in DEPENDENCIES"
    assert [row for row in found(tmp_path) if "DEPENDENCIES" in row] == (
        [] if needed else [f"CMakeLists.txt:6: {message}"]
    )


@pytest.mark.parametrize(
    ("needed", "expected"),
    [(("move_base", "dwa_local_planner"), 0), (("move_base",), 1), ((), 0)],
)
def test_the_package_of_the_local_planner_is_a_dependency(tmp_path, monkeypatch, needed, expected):
    monkeypatch.chdir(tmp_path)
    entries = "".join(f"  <exec_depend>{name}</exec_depend>\n" for name in needed)
    manifest = CATKIN_MANIFEST.replace("  <depend>std_msgs</depend>\n", entries)
    planners = "base_global_planner: navfn/NavfnROS\nbase_local_planner: dwa_local_planner/DWAPlannerROS\n"
    write(tmp_path, {"urdf/cart.urdf": ROBOT, "package.xml": manifest, "config/planners.yaml": planners})
    named = [one for one in found(tmp_path) if "`dwa_local_planner`" in one]
    assert len(named) == expected
