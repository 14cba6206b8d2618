"""Messages and help of findings that need a target, several files of a package, or a large file."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path

import pytest

from urdfkit.lint import lint

JOINT = (
    '<joint name="{}" type="{}">{}<parent link="{}"/><child link="{}"/><axis xyz="0 {} 1"/>'
    '<limit lower="-1" upper="1" effort="1" velocity="1"/></joint>\n'
)


def joint(name: str, parent: str, child: str, kind: str = "revolute", origin: str = "", lateral: int = 0) -> str:
    return JOINT.format(name, kind, origin, parent, child, lateral)


def robot(body: str, name: str = "arm", attributes: str = "") -> str:
    return f'<robot name="{name}"{attributes}>\n{body}\n</robot>\n'


def xacro(body: str) -> str:
    return robot(body, attributes=' xmlns:xacro="http://www.ros.org/wiki/xacro"')


BASE = '<link name="base"/>\n'
ARM = robot(f'{BASE}<link name="hand"/>\n{joint("elbow", "base", "hand")}')
GZ_CONTROL = 'filename="gz_ros2_control-system" name="gz_ros2_control::GazeboSimROS2ControlPlugin"'
MESH = robot('<link name="base"><visual><geometry>\n<mesh filename="m.stl"/></geometry></visual></link>')


def controlled(hardware: str = "gz_ros2_control/GazeboSimSystem", interface: str = "", plugin: str = "") -> str:
    """Return an arm with a block of ros2_control."""
    plugin = plugin or f"<plugin {GZ_CONTROL}/>"
    block = f'<hardware>\n<plugin>{hardware}</plugin></hardware>\n<joint name="elbow">\n{interface}</joint>'
    control = f'<ros2_control name="system" type="system">{block}</ros2_control>'
    return ARM.replace("</robot>", f"{control}\n<gazebo>{plugin}</gazebo></robot>")


def manifest(
    name: str = "p", tool: str = "ament_cmake", build_type: str = "ament_cmake", depends: str = ""
) -> dict[str, str]:
    """Return a package.xml; without buildtool_depend or build_type if their text is empty."""
    text = f'<package format="3">\n<name>{name}</name><version>1.0.0</version><description>A package.</description>\n'
    text += '<maintainer email="m@example.org">m</maintainer><license>MIT</license>\n'
    text += f"<buildtool_depend>{tool}</buildtool_depend>\n" if tool else "\n"
    text += f"<exec_depend>{depends}</exec_depend>\n" if depends else "\n"
    export = f"<build_type>{build_type}</build_type>" if build_type else ""
    return {"package.xml": f"{text}<export>{export}</export>\n</package>\n"}


CATKIN = manifest(tool="catkin", build_type="")
PYTHON = manifest(tool="", build_type="ament_python") | {"resource/p": "", "r.urdf": ARM}


def cmake(*commands: str) -> dict[str, str]:
    lines = ("cmake_minimum_required(VERSION 3.16)", "project(p)", "find_package(ament_cmake REQUIRED)", *commands)
    return {"CMakeLists.txt": "\n".join((*lines, "ament_package()\n")), "r.urdf": ARM}


def setup(name: str, place: str, file: str) -> dict[str, str]:
    data = f'data_files=[("{place}", ["{file}"])]'
    return PYTHON | {"setup.py": f'from setuptools import setup\n\nsetup(\n    name="{name}",\n    {data},\n)\n'}


def moveit(srdf: str, **files: str) -> dict[str, str]:
    """Return a package with an arm, its SRDF and further files of its folder config."""
    files = {f"config/{name}.yaml": text for name, text in files.items()}
    return manifest() | {"r.urdf": ARM, "config/arm.srdf": robot(srdf)} | files


def loaded(kind: str, parameters: str = "", joints: str = "elbow") -> dict[str, str]:
    """Return a package whose robot loads a controller of a type."""
    interfaces = '<command_interface name="position"/><state_interface name="position"/>'
    plugin = f"<plugin {GZ_CONTROL}><parameters>$(find p)/c.yaml</parameters></plugin>"
    manager = f"controller_manager:\n  ros__parameters:\n    arm:\n      type: {kind}\n"
    own = f"arm:\n  ros__parameters:\n    joints: [{joints}]\n{parameters}"
    return manifest() | {"r.urdf": controlled(interface=interfaces, plugin=plugin), "c.yaml": manager + own}


GROUP = '<group name="arm"><joint name="elbow"/></group>\n'
SHAPE = '<{0}><geometry><box size="1 1 1"/></geometry></{0}>'
TRAJECTORY = "    type: FollowJointTrajectory\n    joints: [elbow]\n"
FORCED = (
    '<transmission name="t"><type>transmission_interface/SimpleTransmission</type><joint name="one">'
    "<hardwareInterface>hardware_interface/EffortJointInterface</hardwareInterface></joint>"
    '<actuator name="m"/></transmission>\n<gazebo><plugin name="c" filename="libgazebo_ros_control.so"/></gazebo>'
)
LEFT = joint("left", "base", "l", "continuous", '<origin xyz="0 0.2 0"/>')
RIGHT = joint("right", "base", "r", "continuous", '<origin xyz="0 0.2 0"/>')
TWO_SHAPES = '<box size="1 1 1"/>\n<sphere radius="1"/>'
OLD_URDF = (
    "write URDF 1.0: `rpy` instead of `quat_xyzw`, other shapes instead of capsules, and no limits of acceleration,"
    " deceleration and jerk"
)
HARDWARE_ARGUMENT = "pass the xacro argument that selects the hardware of the simulator, if the robot has one"
Content = str | bytes | int
"""Text or bytes of a file, or its size; a name that ends in a blank is the size of the file without it."""
CASES: dict[str, tuple[str, str | None, Mapping[str, Content], list[str]]] = {
    "hardware without any plugin": (
        "C718",
        None,
        {"r.urdf": controlled("mine/Hardware", plugin='<plugin filename="gz-sim-imu-system" name="imu"/>')},
        ["r.urdf:7: note: no Gazebo plugin runs ros2_control `system`: its controllers do not run in Gazebo"],
    ),
    "command interface that no simulator has": (
        "C710",
        None,
        {"r.urdf": controlled(interface='<command_interface name="torque"/>')},
        ["r.urdf:9: note: the simulator has no command interface `torque`"],
    ),
    "initial value": (
        "C710",
        None,
        {
            "r.urdf": controlled(
                interface='<state_interface name="position"><param name="initial_value">zero</param></state_interface>'
            )
        },
        ["r.urdf:9: warning: initial_value `zero` is not a number"],
    ),
    "hardware of Classic in Jazzy": (
        "C709",
        "ros2-jazzy",
        {"r.urdf": controlled("gazebo_ros2_control/GazeboSystem")},
        [
            (
                "r.urdf:7: error: hardware `gazebo_ros2_control/GazeboSystem` does not exist for jazzy"
                " | write `gz_ros2_control/GazeboSimSystem`"
            )
        ],
    ),
    "hardware that is not simulated": (
        "C709",
        None,
        {"r.urdf": controlled("mine/Hardware")},
        [
            (
                "r.urdf:7: note: hardware `mine/Hardware` is not simulated; its joints are not controlled in Gazebo"
                f" | {HARDWARE_ARGUMENT}"
            )
        ],
    ),
    "hardware that urdfkit does not simulate": (
        "C709",
        "urdfkit",
        {"r.urdf": controlled("mine/Hardware")},
        [
            (
                "r.urdf:7: warning: hardware `mine/Hardware` is not simulated; its joints are not controlled in Gazebo"
                f" | {HARDWARE_ARGUMENT}"
            )
        ],
    ),
    "misspelt hardware": (
        "C709",
        None,
        {"r.urdf": controlled("gz_ros2_control/GazeboSimSytem")},
        [
            (
                "r.urdf:7: error: unknown hardware `gz_ros2_control/GazeboSimSytem`"
                " | write `gz_ros2_control/GazeboSimSystem`"
            )
        ],
    ),
    "second shape": (
        "E013",
        None,
        {"r.urdf": robot(f"{BASE[:-3]}><visual><geometry>\n{TWO_SHAPES}</geometry></visual></link>")},
        [
            (
                "r.urdf:4: error: extra <sphere> in <geometry>: some readers use the first, others the last"
                " | remove it or the <box> at r.urdf:3"
            )
        ],
    ),
    "URDF 1.1 in Classic": (
        "E022",
        "classic",
        {"r.urdf": robot(BASE, attributes=' version="1.1"')},
        [f"r.urdf:1: error: Gazebo Classic reads URDF 1.0 only, but the robot is URDF 1.1 | {OLD_URDF}"],
    ),
    "URDF 1.2 in Noetic": (
        "E022",
        "ros1-noetic",
        {"r.urdf": robot(BASE, attributes=' version="1.2"')},
        [f"r.urdf:1: error: ROS 1 Noetic reads URDF 1.0 only, but the robot is URDF 1.2 | {OLD_URDF}"],
    ),
    "URDF 1.1 in any release": (
        "E022",
        "ros2",
        {"r.urdf": robot(BASE, attributes=' version="1.1"')},
        [f"r.urdf:1: note: URDF 1.1 is read by ROS 2 Lyrical and Rolling only | {OLD_URDF}"],
    ),
    "topic of a plugin of ROS 1": (
        "Z806",
        "ros2",
        {
            "r.urdf": robot(
                f'{BASE}<gazebo><plugin name="d" filename="libgazebo_ros_diff_drive.so">\n'
                "<commandTopic>cmd</commandTopic></plugin></gazebo>"
            )
        },
        [
            (
                "r.urdf:4: warning: <commandTopic> is not read in ROS 2"
                " | remap the topic with <ros><remapping>from:=to</remapping></ros>"
            )
        ],
    ),
    "sensor of Gazebo Sim": (
        "Z827",
        "classic",
        {"r.urdf": robot(f'{BASE}<gazebo reference="base"><sensor name="s" type="navsat"/></gazebo>')},
        ["r.urdf:3: error: Gazebo Classic has no sensor type `navsat`; did you mean `gps`?"],
    ),
    "controller that is not simulated": (
        "Z833",
        "urdfkit",
        loaded("gripper_controllers/GripperActionController"),
        ["c.yaml:4: warning: controller `arm`: gripper_controllers/GripperActionController is not simulated"],
    ),
    "controller of another package": (
        "K962",
        "urdfkit",
        loaded("mine/Juggler"),
        ["c.yaml:4: warning: controller `arm`: urdfkit does not simulate the type `mine/Juggler` of another package"],
    ),
    "unknown parameter of a loaded controller": (
        "K962",
        None,
        loaded("joint_trajectory_controller/JointTrajectoryController", "    colour: red\n"),
        ["c.yaml:8: note: controller `arm` ignores the unknown parameters `colour`"],
    ),
    "undefined joint of a loaded controller": (
        "K959",
        "urdfkit",
        loaded("joint_trajectory_controller/JointTrajectoryController", joints="wrist_of_the_other_arm"),
        ["c.yaml:7: note: controller `arm` names the undefined joint `wrist_of_the_other_arm`"],
    ),
    "mesh that is a folder": (
        "G607",
        None,
        {"r.urdf": MESH, "m.stl/file": ""},
        ["r.urdf:3: error: mesh `m.stl` is a folder"],
    ),
    "mesh with too many bytes": (
        "G607",
        None,
        {"r.urdf": MESH, "m.stl": "", "m.stl ": 300 * 2**20},
        ["r.urdf:3: error: mesh `m.stl` has 300 MiB; at most 256 are supported: decimate it"],
    ),
    "mesh with too many triangles": (
        "G607",
        None,
        {"r.urdf": MESH, "m.stl": bytes(80) + (5_000_001).to_bytes(4, "little"), "m.stl ": 84 + 50 * 5_000_001},
        ["r.urdf:3: error: mesh `m.stl` has 5000001 triangles; at most 5000000 are supported: decimate it"],
    ),
    "mesh with an expression": (
        "G601",
        None,
        {"r.urdf": MESH.replace("m.stl", "package://$(arg p)/m.stl")},
        [
            (
                "r.urdf:3: note: mesh `package://$(arg p)/m.stl` contains an expression; a simulation with urdfkit"
                " ignores it"
            )
        ],
    ),
    "free robot without a mass": (
        "I511",
        None,
        {
            "r.urdf": robot(
                f'<link name="base">{SHAPE.format("visual")}{SHAPE.format("collision")}</link>'
                '<gazebo><plugin filename="libgazebo_ros_planar_move.so" name="p"/></gazebo>'
            )
        },
        [
            (
                "r.urdf:2: note: no link of the robot has a mass, but the robot is free to move"
                " | add <inertial> with <mass> and <inertia> to every link that moves"
            )
        ],
    ),
    "unlisted controllers of MoveIt": (
        "M108",
        None,
        moveit(
            GROUP,
            moveit_controllers="moveit_simple_controller_manager:\n  controller_names: [one]\n"
            + "".join(f"  {name}:\n{TRAJECTORY}" for name in ("one", "two", "three")),
        ),
        [
            (
                "config/moveit_controllers.yaml:6: warning: controller `two` is not in `controller_names`; MoveIt does"
                " not use it"
            ),
            (
                "config/moveit_controllers.yaml:9: warning: controller `three` is not in `controller_names`; MoveIt"
                " does not use it"
            ),
        ],
    ),
    "truth in quotes": (
        "M109",
        None,
        moveit(
            GROUP,
            kinematics="arm:\n  kinematics_solver: kdl_kinematics_plugin/KDLKinematicsPlugin\n"
            '  position_only_ik: "true"\n',
        ),
        [
            (
                'config/kinematics.yaml:3: warning: `position_only_ik` of group `arm` is "true", a quoted string;'
                " write true or false"
            )
        ],
    ),
    "one limit of two": (
        "M109",
        None,
        moveit(GROUP, joint_limits="joint_limits:\n  elbow:\n    has_position_limits: true\n    max_position: 1.0\n"),
        [
            (
                "config/joint_limits.yaml:3: warning: `has_position_limits` of joint `elbow` is true, but"
                " `min_position` is missing"
            )
        ],
    ),
    "two SRDF files": (
        "M106",
        None,
        moveit(GROUP) | {"config/other.srdf": robot(GROUP)},
        ["config/other.srdf:1: note: config/arm.srdf describes the same robot `arm`; MoveIt reads one SRDF"],
    ),
    "link that is used twice": (
        "M104",
        None,
        moveit(
            GROUP
            + "".join(
                f'<disable_collisions link1="{link}" link2="tool" reason="Never"/>\n' for link in ("base", "hand")
            )
        ),
        [
            (
                "config/arm.srdf:3: warning: link `tool` of <disable_collisions> does not exist in robot `arm`"
                " (used 2 times)"
            )
        ],
    ),
    "misspelt name of a group that is used twice": (
        "M104",
        None,
        moveit(
            '<group name="manipulators"><joint name="elbow"/></group>\n'
            + "".join(
                f'<group_state name="{name}" group="manipulator"><joint name="elbow" value="0"/></group_state>\n'
                for name in "ab"
            )
        ),
        [
            (
                "config/arm.srdf:2: error: group `manipulators` is not used; did you mean `manipulator`, which is used"
                " but undefined?"
            )
        ],
    ),
    "state with many joints of other groups": (
        "M107",
        None,
        moveit(
            '<group name="arm"><joint name="j1"/></group>\n<group_state name="home" group="arm">'
            + "".join(f'<joint name="j{n}" value="0"/>' for n in range(1, 6))
            + "</group_state>"
        )
        | {
            "r.urdf": robot(
                "".join(f'<link name="l{n}"/>\n' for n in range(7))
                + "".join(joint(f"j{n}", f"l{n - 1}", f"l{n}") for n in range(1, 7))
            )
        },
        ["config/arm.srdf:3: warning: joints `j2`, `j3`, `j4`, … of state `home` are not in group `arm`"],
    ),
    "types of a bridge in the wrong order": (
        "K969",
        None,
        manifest()
        | {
            "r.urdf": ARM,
            "config/bridge.yaml": "- ros_topic_name: /clock\n  gz_topic_name: /clock\n  ros_type_name: gz.msgs.Clock\n"
            "  gz_type_name: rosgraph_msgs/msg/Clock\n  direction: GZ_TO_ROS\n",
        },
        ["config/bridge.yaml:3: warning: expected the ROS type before the Gazebo type, found `gz.msgs.Clock`"],
    ),
    "script that is not installed": (
        "K973",
        None,
        manifest(depends="launch_ros")
        | cmake("install(DIRECTORY launch DESTINATION share/p)")
        | {"scripts/talk.py": "", "launch/a.launch.xml": '<launch><node pkg="p" exec="talk.py"/></launch>\n'},
        ["CMakeLists.txt:4: warning: `scripts/talk.py` is not installed, but launch files start it"],
    ),
    "launch files that are not installed": (
        "K973",
        None,
        manifest()
        | cmake("install(DIRECTORY urdf DESTINATION share/p)")
        | {"urdf/file": "", "launch/a.launch.xml": "<launch/>\n"},
        ["CMakeLists.txt:4: warning: folder `launch` is not installed, but it contains launch files"],
    ),
    "destination of an installation": (
        "K973",
        None,
        manifest() | cmake("install(DIRECTORY launch DESTINATION shar/p)") | {"launch/a.launch.xml": "<launch/>\n"},
        ["CMakeLists.txt:4: error: unknown installation folder `shar`; did you mean `share`?"],
    ),
    "package with another name than its folder": (
        "K973",
        None,
        manifest(name="q") | cmake(),
        ["package.xml:2: error: the package is named `q`, but its folder and its project are named `p`"],
    ),
    "setup.py without package.xml": (
        "K973",
        None,
        setup("p", "share/ament_index/resource_index/packages", "resource/p"),
        ["setup.py:5: error: data_files does not install package.xml"],
    ),
    "setup.py with another name and without a marker": (
        "K973",
        None,
        setup("q", "share/p", "package.xml"),
        [
            "setup.py:4: error: the name in setup.py is `q`, but the package is named `p`",
            (
                "setup.py:5: error: data_files does not install the marker `resource/…` to"
                " share/ament_index/resource_index/packages"
            ),
        ],
    ),
    "joint without a transmission": (
        "K963",
        "ros1",
        CATKIN
        | {
            "r.urdf": robot(
                f'{BASE}<link name="a"/><link name="b"/>\n{joint("one", "base", "a")}{joint("two", "a", "b")}{FORCED}'
            ),
            "config/c.yaml": "two_controller:\n  type: effort_controllers/JointPositionController\n  joint: two\n",
        },
        [
            (
                "config/c.yaml:2: note: `effort_controllers/JointPositionController` requires the EffortJointInterface"
                " of joint `two`, which has no transmission"
            )
        ],
    ),
    "launch file in Python": (
        "K964",
        None,
        manifest() | {"r.urdf": ARM, "launch/a.launch.py": "\nx = = 1\n"},
        ["launch/a.launch.py:2: error: invalid Python: invalid syntax"],
    ),
    "package without a build type": (
        "K972",
        None,
        manifest(build_type="") | cmake(),
        ["package.xml:6: error: package.xml has no <build_type>ament_cmake</build_type> in <export>"],
    ),
    "package without a build tool": (
        "K972",
        None,
        manifest(tool="") | cmake(),
        ["package.xml:1: warning: package.xml has no <buildtool_depend>ament_cmake</buildtool_depend>"],
    ),
    "package with another build type": (
        "K972",
        None,
        manifest(build_type="ament_python") | cmake(),
        ["package.xml:6: error: the build type is `ament_python`, but CMakeLists.txt is for `ament_cmake`"],
    ),
    "spawned controller without a type": (
        "K960",
        None,
        manifest()
        | {
            "r.urdf": ARM,
            "config/c.yaml": "controller_manager:\n  ros__parameters:\n"
            "    state: {type: joint_state_broadcaster/JointStateBroadcaster}\n"
            "arm:\n  ros__parameters: {joints: [elbow]}\n",
            "launch/a.launch.xml": '<launch><node pkg="controller_manager" exec="spawner" args="arm"/></launch>\n',
        },
        [
            (
                "config/c.yaml:3: warning: controller `arm` has no `type`, but launch/a.launch.xml spawns it"
                " | add it here, to the parameters of `controller_manager`"
            )
        ],
    ),
    "controller in another namespace": (
        "K960",
        "ros1",
        CATKIN
        | {
            "r.urdf": ARM,
            "config/c.yaml": "arm:\n  type: position_controllers/JointPositionController\n  joint: elbow\n",
            "launch/a.launch": '<launch>\n<rosparam command="load" file="$(find p)/config/c.yaml" ns="robot"/>\n'
            '<node name="s" pkg="controller_manager" type="spawner" args="arm"/></launch>\n',
        },
        [
            (
                "launch/a.launch:2: warning: `arm` is in namespace `/robot`, but its spawner in launch/a.launch:3 is in"
                " no namespace"
            )
        ],
    ),
    "wheels at one place": (
        "K970",
        None,
        manifest()
        | {
            "r.urdf": robot(f'{BASE}<link name="l"/><link name="r"/>\n{LEFT}{RIGHT}'),
            "config/c.yaml": "controller_manager:\n  ros__parameters:\n"
            "    drive: {type: diff_drive_controller/DiffDriveController}\ndrive:\n  ros__parameters:\n"
            "    left_wheel_names: [left]\n    right_wheel_names: [right]\n",
        },
        [
            (
                "config/c.yaml:6: warning: wheels `left` and `right` are at the same place, 0 0.2 0 m"
                " | check the signs of the joint origins"
            )
        ],
    ),
    "decimal point in an integer": (
        "K974",
        None,
        manifest()
        | {
            "r.urdf": ARM,
            "config/nav2.yaml": "local_costmap:\n  local_costmap:\n    ros__parameters:\n      width: 3.5\n"
            "      height: 3\n      update_frequency: 5.0\n      plugins: []\n",
        },
        ["config/nav2.yaml:4: error: `width` is the number with a decimal point 3.5; write 4"],
    ),
    "second root beside a misspelt child": (
        "T203",
        None,
        {
            "r.urdf": robot(
                f'{BASE}<link name="a"/><link name="gripper_left_finger"/>\n<link name="gripper_light_finger"/>\n'
                f"{joint('j', 'base', 'a')}{joint('k', 'a', 'gripper_lft_finger')}"
            )
        },
        [
            (
                "r.urdf:4: error: link `gripper_light_finger` has no parent, but `base` is already the root"
                " | write `gripper_light_finger` as the child of joint `k` if `gripper_lft_finger` is a misspelling"
            )
        ],
    ),
    "parent in another file": (
        "T201",
        None,
        manifest()
        | {
            "r.xacro": xacro(f'<link name="hand"/>\n{joint("wrist", "forearm", "hand", "fixed")}').replace(
                ' name="arm"', ""
            ),
            "arm.urdf": robot('<link name="forearm"/>'),
        },
        [
            (
                "r.xacro:3: note: undefined parent link `forearm` of joint `wrist`"
                " | a file that includes this one has to define it"
            )
        ],
    ),
    "file that an argument selects": (
        "X125",
        None,
        manifest()
        | {
            "r.urdf.xacro": xacro(
                '<xacro:arg name="model" default="ur5x"/>\n<xacro:property name="c" value="'
                "${xacro.load_yaml('$(find p)/config/$(arg model).yaml')}"
                '"/>\n<link name="${c}"/>'
            ),
            "config/ur5.yaml": "a: 1\n",
        },
        [
            (
                "r.urdf.xacro:3: note: file config/ur5x.yaml does not exist; did you mean `ur5.yaml`?"
                " | pass model:=value: its default selects no existing file"
            )
        ],
    ),
    "include that an argument selects": (
        "X113",
        None,
        manifest()
        | {
            "r.urdf.xacro": xacro(
                '<xacro:arg name="model" default="none"/>\n'
                f'<xacro:include filename="$(find p)/$(arg model).xacro"/>\n{BASE}'
            )
        },
        [
            (
                "r.urdf.xacro:3: note: included file none.xacro does not exist"
                " | pass model:=value: its default selects no existing file"
            )
        ],
    ),
    "include of a package that is not installed": (
        "X113",
        None,
        manifest(depends="other_robot")
        | {"r.urdf.xacro": xacro(f'<xacro:include filename="$(find other_robot)/x.xacro"/>\n{BASE}')},
        [
            (
                "r.urdf.xacro:2: warning: package `other_robot` is not installed on this machine"
                " | install it, because package.xml depends on it, or pass its folder with --package-path"
            )
        ],
    ),
    "decimal comma in a property": (
        "X124",
        None,
        {
            "r.urdf.xacro": xacro(
                '<xacro:property name="width" value="1,5"/>\n<link name="a"><visual><geometry>'
                '<box size="${width / 2} 1 1"/></geometry></visual></link>'
            )
        },
        [
            (
                "r.urdf.xacro:2: error: `1,5` is used in an expression, but is not a number"
                " | write a number; `${width / 2}` uses the value at r.urdf.xacro:3"
            )
        ],
    ),
    "argument that launch files pass": (
        "X106",
        None,
        manifest()
        | {
            "r.urdf.xacro": xacro('<link name="$(arg prefix)hand"/>'),
            "launch/a.launch.xml": '<launch><let name="d" value="$(command \'xacro r.urdf.xacro prefix:=a\')"/>'
            "</launch>\n",
        },
        [
            (
                "r.urdf.xacro:2: note: argument `prefix` has no value, but the robot requires one"
                " | pass prefix:=value to lint the robot with it"
            )
        ],
    ),
}


@pytest.mark.parametrize("case", CASES)
def test_a_defect_has_its_place_message_and_help(case: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    code, target, files, expected = CASES[case]
    folder = tmp_path / "p"
    folder.mkdir()
    monkeypatch.chdir(folder)
    for name, content in files.items():
        Path(name).parent.mkdir(parents=True, exist_ok=True)
        if isinstance(content, int):
            os.truncate(name.strip(), content)
        else:
            Path(name).write_bytes(content if isinstance(content, bytes) else content.encode())
    found = [finding for finding in lint(".", target=target) if finding.code == code]
    texts = [
        f"{os.path.relpath(each.file)}:{each.line}: {each.severity}: {each.message}"
        + (f" | {each.help}" if each.help else "")
        for each in found
    ]
    assert texts == expected
