"""Mistakes between the files of a ROS package: topics, names of nodes, YAML launch files, functions, dependencies."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfkit.lint import lint

ROBOT = """<robot name="cart">
  <link name="base_footprint"/>
  <link name="base_link"/>
  <joint name="base_joint" type="fixed"><parent link="base_footprint"/><child link="base_link"/></joint>
</robot>
"""
MANIFEST = """<package format="3">
  <name>cart</name>
  <version>1.0.0</version>
  <description>A cart.</description>
  <maintainer email="cart@example.com">The maintainers</maintainer>
  <license>MIT</license>
  <buildtool_depend>ament_cmake</buildtool_depend>
  <exec_depend>nav2_amcl</exec_depend>
  <exec_depend>nav2_planner</exec_depend>
  <exec_depend>robot_localization</exec_depend>
  <exec_depend>slam_toolbox</exec_depend>
  <exec_depend>twist_mux</exec_depend>
  <export><build_type>ament_cmake</build_type></export>
</package>
"""
CMAKE = """cmake_minimum_required(VERSION 3.8)
project(cart)
find_package(ament_cmake REQUIRED)
install(DIRECTORY config launch urdf DESTINATION share/${PROJECT_NAME})
ament_package()
"""
SLAM = """slam_toolbox:
  ros__parameters:
    solver_plugin: solver_plugins::CeresSolver
    ceres_linear_solver: SPARSE_NORMAL_CHOLESKY
    odom_frame: odom
    base_frame: base_footprint
    scan_topic: /scan
    mode: mapping
    resolution: 0.05
    map_update_interval: 5.0
    use_scan_matching: true
"""
MUX = """twist_mux:
  ros__parameters:
    topics:
      navigation:
        topic: cmd_vel_nav
        timeout: 0.5
        priority: 10
"""
XML = """<launch>
  <node pkg="slam_toolbox" exec="async_slam_toolbox_node" name="slam_toolbox" output="screen">
    <param from="$(find-pkg-share cart)/config/slam.yaml"/>
    <remap from="scan" to="/scan"/>
  </node>
</launch>
"""
YAML = """launch:
  - arg:
      name: use_sim_time
      default: "true"
  - group:
      scoped: true
      children:
        - node:
            pkg: twist_mux
            exec: twist_mux
            name: twist_mux
            output: screen
            param:
              - from: $(find-pkg-share cart)/config/mux.yaml
              - name: use_sim_time
                value: $(var use_sim_time)
            remap:
              - from: cmd_vel_out
                to: /cmd_vel
"""
PYTHON = """from launch import LaunchDescription
from launch_ros.actions import Node


def server(package, executable):
    return Node(package=package, executable=executable, output="screen")


def generate_launch_description():
    nodes = [Node(package=p, executable=e, name=e) for p, e in [("nav2_amcl", "amcl")]]
    nodes.append(server("nav2_planner", "planner_server"))
    return LaunchDescription(nodes)
"""
FILES = {
    "package.xml": MANIFEST,
    "CMakeLists.txt": CMAKE,
    "urdf/cart.urdf": ROBOT,
    "config/slam.yaml": SLAM,
    "config/mux.yaml": MUX,
    "launch/slam.launch.xml": XML,
    "launch/mux.launch.yaml": YAML,
    "launch/nav.launch.py": PYTHON,
}


def findings(folder: Path, files: dict[str, str]) -> list[tuple[str, str, int, str]]:
    for name, text in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)
    return [(each.code, each.span.file.rpartition("/")[2], each.line, each.message) for each in lint(folder)]


def test_the_packages_without_mistakes_have_no_findings(tmp_path: Path) -> None:
    (tmp_path / "ros2").mkdir()
    (tmp_path / "ros1").mkdir()
    assert findings(tmp_path / "ros2", FILES) == []
    assert findings(tmp_path / "ros1", FILES_OF_ROS1) == []


@pytest.mark.parametrize(
    ("file", "old", "new", "code", "hint"),
    [
        ("config/slam.yaml", "/scan", "/scna", "K977", "did you mean `/scan`?"),
        ("launch/slam.launch.xml", 'to="/scan"', 'to="/scann"', "K977", "did you mean `/scan`?"),
        ("launch/mux.launch.yaml", "to: /cmd_vel", "to: /cmd_vell", "K977", "did you mean `/cmd_vel`?"),
        ("config/slam.yaml", "slam_toolbox:", "slam_toolbx:", "L117", "did you mean `slam_toolbox`?"),
        ("config/mux.yaml", "twist_mux:", "mux:", "L117", "did you mean `twist_mux`?"),
        ("launch/slam.launch.xml", '"slam_toolbox" out', '"slam_tolbox" out', "L117", "did you mean `slam_toolbox`?"),
        ("config/slam.yaml", "mode: mapping", "mode: maping", "K971", "did you mean `mapping`?"),
        ("config/slam.yaml", "NORMAL", "NORML", "K971", "did you mean `SPARSE_NORMAL_CHOLESKY`?"),
        ("config/slam.yaml", "resolution: 0.05", "resolution: -0.05", "K971", "must be positive"),
        ("config/slam.yaml", "matching: true", "matching: yess", "K971", "neither true nor false"),
        ("config/slam.yaml", "interval: 5.0", "interval: 5", "K974", "5.0"),
        ("config/slam.yaml", "ceres_linear", "ceres_liner", "L104", "did you mean `ceres_linear_solver`?"),
        ("config/slam.yaml", "ros__parameters", "ros_parameters", "K962", "did you mean `ros__parameters`?"),
        ("config/mux.yaml", "timeout", "timeuot", "K971", "did you mean `timeout`?"),
        ("config/mux.yaml", "priority: 10", "priority: 300", "K971", "0 to 255"),
        ("launch/mux.launch.yaml", "pkg:", "package:", "L109", "did you mean `pkg`?"),
        ("launch/mux.launch.yaml", "exec:", "executable:", "L109", "did you mean `exec`?"),
        ("launch/mux.launch.yaml", "param:", "params:", "L109", "did you mean `param`?"),
        ("launch/mux.launch.yaml", "remap:", "remappings:", "L109", "did you mean `remap`?"),
        ("launch/mux.launch.yaml", "- node:", "- nod:", "L109", "did you mean `node`?"),
        ("launch/mux.launch.yaml", "value:", "vlaue:", "L109", "did you mean `value`?"),
        ("launch/mux.launch.yaml", "find-pkg-share", "find", "L109", "did you mean `find-pkg-share`?"),
        ("launch/mux.launch.yaml", "output: screen", "output: scren", "L109", "did you mean `screen`?"),
        ("launch/slam.launch.xml", "screen", "scren", "L110", "unknown output `scren`; did you mean `screen`?"),
        ("launch/nav.launch.py", '"screen"', '"scren"', "L106", "did you mean `screen`?"),
        (
            "launch/nav.launch.py",
            " executable=e,",
            " node_executable=e,",
            "L106",
            " since ROS 2 Galactic; did you mean `executable`?",
        ),
        ("launch/nav.launch.py", '("nav2_planner", "pl', '("nav2_planer", "pl', "K956", "did you mean `nav2_planner`?"),
        ("launch/nav.launch.py", '"planner_server"', '"planer_server"', "L103", "did you mean `planner_server`?"),
        ("launch/nav.launch.py", '"amcl")', '"amlc")', "L103", "did you mean `amcl`?"),
        ("launch/nav.launch.py", ', "planner_server")', ")", "L106", "needs the argument `executable`"),
    ],
)
def test_each_mistake_is_one_finding_at_its_line(
    file: str, old: str, new: str, code: str, hint: str, tmp_path: Path
) -> None:
    text = FILES[file]
    assert old in text
    found = findings(tmp_path, {**FILES, file: text.replace(old, new, 1)})
    line = text[: text.index(old)].count("\n") + 1
    assert [(each[0], each[1], each[2]) for each in found] == [(code, file.rpartition("/")[2], line)], found
    assert hint in found[0][3]


def test_a_topic_that_two_files_or_the_code_name_is_accepted(tmp_path: Path) -> None:
    files = {**FILES, "config/slam.yaml": SLAM.replace("/scan", "/scna"), "src/driver.cpp": 'advertise("scna");\n'}
    assert findings(tmp_path, files) == []


def test_a_topic_is_accepted_if_there_is_more_code_than_is_read(tmp_path: Path) -> None:
    files = {**FILES, "config/slam.yaml": SLAM.replace("/scan", "/scna")}
    files |= {f"src/part_{number}.cpp": "int x;\n" for number in range(401)}
    assert findings(tmp_path, files) == []


WHEEL = """  <link name="{0}"><inertial><mass value="1"/>
    <inertia ixx="0.0027" ixy="0" ixz="0" iyy="0.005" iyz="0" izz="0.0027"/></inertial></link>
  <joint name="{0}_joint" type="continuous"><parent link="base_link"/><child link="{0}"/>
    <origin xyz="{1} 0"/><axis xyz="0 1 0"/><limit effort="20" velocity="20"/></joint>
  <transmission name="{0}_trans"><type>transmission_interface/SimpleTransmission</type>
    <joint name="{0}_joint"><hardwareInterface>hardware_interface/VelocityJointInterface</hardwareInterface></joint>
    <actuator name="{0}_motor"><mechanicalReduction>1</mechanicalReduction></actuator></transmission>
"""
DRIVEN = f"""<robot name="cart">
  <link name="base_footprint"/>
  <joint name="base_joint" type="fixed"><parent link="base_footprint"/><child link="base_link"/></joint>
  <link name="base_link"><inertial><mass value="10"/>
    <inertia ixx="0.15" ixy="0" ixz="0" iyy="0.28" iyz="0" izz="0.4"/></inertial></link>
{"".join(WHEEL.format(*each) for each in [("front_left", "0.2 0.2"), ("rear_left", "-0.2 0.2")])}
{"".join(WHEEL.format(*each) for each in [("front_right", "0.2 -0.2"), ("rear_right", "-0.2 -0.2")])}
  <gazebo><plugin name="control" filename="libgazebo_ros_control.so"/></gazebo>
</robot>
"""
CONTROL = """joint_state_controller:
  type: joint_state_controller/JointStateController
  publish_rate: 50
base_controller:
  type: diff_drive_controller/DiffDriveController
  left_wheel: [front_left_joint, rear_left_joint]
  right_wheel: [front_right_joint, rear_right_joint]
  base_frame_id: base_footprint
  pose_covariance_diagonal: [0.001, 0.001, 0.001, 0.001, 0.001, 0.03]
  twist_covariance_diagonal: [0.001, 0.001, 0.001, 0.001, 0.001, 0.03]
  wheel_separation: 0.4
  wheel_radius: 0.1
"""
FILES_OF_ROS1 = {
    "package.xml": """<package format="2">
  <name>cart</name>
  <version>1.0.0</version>
  <description>A cart.</description>
  <maintainer email="cart@example.com">The maintainers</maintainer>
  <license>MIT</license>
  <buildtool_depend>catkin</buildtool_depend>
  <exec_depend>controller_manager</exec_depend>
  <exec_depend>diff_drive_controller</exec_depend>
  <exec_depend>gazebo_ros</exec_depend>
  <exec_depend>gazebo_ros_control</exec_depend>
  <exec_depend>joint_state_controller</exec_depend>
</package>
""",
    "CMakeLists.txt": """cmake_minimum_required(VERSION 3.0.2)
project(cart)
find_package(catkin REQUIRED)
catkin_package()
install(DIRECTORY config urdf DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
""",
    "urdf/cart.urdf": DRIVEN,
    "config/control.yaml": CONTROL,
}


@pytest.mark.parametrize(
    ("name", "kind"),
    [("diff_drive_controller", "DiffDriveController"), ("joint_state_controller", "JointStateController")],
)
def test_packages_of_controllers_of_ros1_are_dependencies(name: str, kind: str, tmp_path: Path) -> None:
    manifest = FILES_OF_ROS1["package.xml"].replace(f"  <exec_depend>{name}</exec_depend>\n", "")
    ((code, _, _, message),) = findings(tmp_path, {**FILES_OF_ROS1, "package.xml": manifest})
    assert code == "K956"
    assert message == f"missing dependency on `{name}`, which has the controller type `{name}/{kind}`"


def test_parameters_of_costmaps_of_ros1_are_compared(tmp_path: Path) -> None:
    costmap = """local_costmap:
  global_frame: odom
  robot_base_frame: base_link
  update_freqency: 5.0
  rolling_window: true
  width: 4.0
"""
    found = findings(tmp_path, {**FILES_OF_ROS1, "config/costmap.yaml": costmap})
    message = "unknown parameter `update_freqency` in the parameters of costmap_2d; did you mean `update_frequency`?"
    assert found == [("L104", "costmap.yaml", 4, message)]


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('"0.2 -0.2 0"/><axis xyz="0 1 0"', '"0.2 -0.2 0"/><axis xyz="0 -1 0"', "point in opposite directions"),
        ('"-0.2 0.2 0"', '"0.2 0.2 0"', "`front_left_joint` and `rear_left_joint` are in the same place"),
    ],
)
def test_wheels_of_a_controller_that_do_not_match_are_found(old: str, new: str, message: str, tmp_path: Path) -> None:
    assert old in DRIVEN
    found = findings(tmp_path, {**FILES_OF_ROS1, "urdf/cart.urdf": DRIVEN.replace(old, new, 1)})
    assert [each[0] for each in found] == ["S907"]
    assert message in found[0][3]


def test_wheels_of_a_controller_that_all_roll_backwards_are_found(tmp_path: Path) -> None:
    robot = DRIVEN.replace('<axis xyz="0 1 0"', '<axis xyz="0 -1 0"')
    found = findings(tmp_path, {**FILES_OF_ROS1, "urdf/cart.urdf": robot})
    assert [each[0] for each in found] == ["S903"]
    assert "point right, so they roll backwards" in found[0][3]
    reversed_radii = "".join(f"  {side}_wheel_radius_multiplier: -1.0\n" for side in ("left", "right"))
    files = {
        **FILES_OF_ROS1,
        "urdf/cart.urdf": robot,
        "config/control.yaml": CONTROL.rstrip("\n") + f"\n{reversed_radii}",
    }
    assert "S903" not in [each[0] for each in findings(tmp_path / "reversed", files)]


CONTROLLED = """<robot name="cart">
  <link name="base"/><link name="wheel"/>
  <joint name="wheel_joint" type="continuous"><parent link="base"/><child link="wheel"/><axis xyz="0 1 0"/></joint>
  <ros2_control name="cart" type="system">
    <hardware><plugin>gz_ros2_control/GazeboSimSystem</plugin></hardware>
    <joint name="wheel_joint"><command_interface name="velocity"/></joint>
  </ros2_control>
  <gazebo><plugin filename="libgazebo_ros2_control.so" name="gazebo_ros2_control"/></gazebo>
</robot>
"""


def test_a_plugin_of_another_gazebo_than_the_hardware_and_the_packages_is_one_finding(tmp_path: Path) -> None:
    manifest = "<package format='3'><name>cart</name><version>1.0.0</version><depend>gz_ros2_control</depend></package>"
    (tmp_path / "package.xml").write_text(manifest)
    (tmp_path / "cart.urdf").write_text(CONTROLLED)
    [found] = lint(tmp_path, select=("K956", "C709"))
    assert (found.code, found.line) == ("K956", 8)
    assert found.help == "load the plugin of `gz_ros2_control`, like the hardware of the robot"
