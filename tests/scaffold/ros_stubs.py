"""What Debian has not of ROS, as far as a build and its tests look: launch modules, packages that are depended on."""

import sys

LAUNCH_MODULES = (
    "launch",
    "launch.actions",
    "launch.conditions",
    "launch.event_handlers",
    "launch.launch_description_sources",
    "launch.substitutions",
    "launch_ros",
    "launch_ros.actions",
    "launch_ros.parameter_descriptions",
    "launch_ros.substitutions",
)
_MODULE = """
class Recorded:
    def __init__(self, *args, **kwargs):
        self.args, self.kwargs = args, kwargs
        self.entities = args[0] if args else []


def __getattr__(name):
    if name.startswith("__"):
        raise AttributeError(name)
    return type(name, (Recorded,), {})


def get_launch_description_from_python_launch_file(path):
    scope = {}
    with open(path) as file:
        exec(compile(file.read(), path, "exec"), scope)
    return scope["generate_launch_description"]()
"""
PACKAGES_OF_ROS_1 = {
    "controller_manager": ["spawner"],
    "gazebo_plugins": [],
    "gazebo_ros": ["spawn_model"],
    "gazebo_ros_control": [],
    "hector_gazebo_plugins": [],
    "joint_state_controller": [],
    "joint_state_publisher": ["joint_state_publisher"],
    "joint_state_publisher_gui": ["joint_state_publisher_gui"],
    "joint_trajectory_controller": [],
    "joy": ["joy_node"],
    "robot_state_publisher": ["robot_state_publisher"],
    "rviz": ["rviz"],
    "teleop_twist_joy": ["teleop_node"],
    "teleop_twist_keyboard": ["teleop_twist_keyboard.py"],
    "velocity_controllers": [],
    "velodyne_gazebo_plugins": [],
    "xacro": ["xacro"],
}
"""Package → its programs."""


def write_launch_modules(folder):
    """Write the modules that launch files import: calls are kept, nothing is started."""
    for name in LAUNCH_MODULES:
        module = folder / name.replace(".", "/")
        module.mkdir(parents=True, exist_ok=True)
        (module / "__init__.py").write_text(_MODULE)


def write_tools(folder):
    """Write `xacro` and `urdfkit`, which Debian has not."""
    folder.mkdir(parents=True)
    for name, command in (("xacro", "expand"), ("urdfkit", "")):
        tool = folder / name
        tool.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m urdfkit {command} "$@"\n')
        tool.chmod(0o755)


def write_packages(folder):
    """Write the packages of ROS 1 that a robot's packages and launch files name."""
    for name, programs in PACKAGES_OF_ROS_1.items():
        package = folder / name
        package.mkdir(parents=True)
        (package / "package.xml").write_text(
            f'<package format="2"><name>{name}</name><version>0.0.0</version><description>stub</description>'
            '<maintainer email="a@example.com">a</maintainer><license>none</license>'
            "<buildtool_depend>catkin</buildtool_depend></package>"
        )
        (package / "CMakeLists.txt").write_text(
            f"cmake_minimum_required(VERSION 3.0.2)\nproject({name})\nfind_package(catkin REQUIRED)\ncatkin_package()\n"
        )
        for program in programs:
            (package / program).write_text("#!/bin/sh\n")
            (package / program).chmod(0o755)
    arguments = "".join(f'<arg name="{name}"/>' for name in ("world_name", "gui", "paused", "use_sim_time"))
    (folder / "gazebo_ros/launch").mkdir()
    (folder / "gazebo_ros/launch/empty_world.launch").write_text(f"<launch>{arguments}</launch>")
