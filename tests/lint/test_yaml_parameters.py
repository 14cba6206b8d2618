"""Defects of YAML files of controllers, MoveIt and the bridge, and correct files next to each of them."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfkit.lint import lint

JOINT = """  <joint name="{0}" type="{1}">
    <parent link="{2}"/>
    <child link="{3}"/>
    <origin xyz="0 0 0.1"/>
    <axis xyz="0 1 0"/>
    <limit lower="{4}" upper="{5}" effort="10" velocity="2"/>
  </joint>
"""
ROBOT = (
    '<robot name="arm">\n'
    + "".join(f'  <link name="{name}"/>\n' for name in ("base", "upper", "lower", "finger"))
    + JOINT.format("shoulder", "revolute", "base", "upper", -1.5, 1.5)
    + JOINT.format("elbow", "revolute", "upper", "lower", -2.5, 2.5)
    + JOINT.format("grip", "prismatic", "lower", "finger", 0, 0.04)
    + "</robot>\n"
)
MANIFEST = """<package format="3">
  <name>{0}</name>
  <version>1.0.0</version>
  <description>An arm.</description>
  <maintainer email="arm@example.com">The maintainers</maintainer>
  <license>MIT</license>
  <buildtool_depend>{1}</buildtool_depend>
  {2}
  <export><build_type>{1}</build_type></export>
</package>
"""
ROS2 = """controller_manager:
  ros__parameters:
    update_rate: 100
    joint_state_broadcaster:
      type: joint_state_broadcaster/JointStateBroadcaster
    arm_controller:
      type: joint_trajectory_controller/JointTrajectoryController
    grip_controller:
      type: parallel_gripper_action_controller/GripperActionController

arm_controller:
  ros__parameters:
    joints: [shoulder, elbow]
    command_interfaces: [position]
    state_interfaces: [position]
    allow_partial_joints_goal: true
    constraints:
      goal_time: 0.5

grip_controller:
  ros__parameters:
    joint: grip
    goal_tolerance: 0.002
"""
ROS1 = """arm:
  joint_state_controller:
    type: joint_state_controller/JointStateController
    publish_rate: 50
  arm_controller:
    type: velocity_controllers/JointTrajectoryController
    joints: [shoulder, elbow]
    gains:
      shoulder: {p: 20.0, i: 0.0, d: 0.0}
      elbow: {p: 20.0, i: 0.0, d: 0.0}
    velocity_ff:
      shoulder: 1.0
      elbow: 1.0
"""
LAUNCH = """<launch>
  <rosparam file="$(find arm_description)/config/controllers.yaml" command="load"/>
  <node name="spawner" pkg="controller_manager" type="spawner" ns="arm" args="joint_state_controller arm_controller"/>
</launch>
"""
SRDF = """<robot name="arm">
  <group name="arm"><joint name="shoulder"/><joint name="elbow"/></group>
  <group name="hand"><joint name="grip"/></group>
</robot>
"""
MOVEIT = """arm:
  kinematics_solver: kdl_kinematics_plugin/KDLKinematicsPlugin
  kinematics_solver_timeout: 0.05
joint_limits:
  elbow:
    has_position_limits: true
    min_position: -2.5
    max_position: 2.5
    has_velocity_limits: true
    max_velocity: 2.0
request_adapters:
  - default_planning_request_adapters/ValidateWorkspaceBounds
moveit_controller_manager: moveit_simple_controller_manager/MoveItSimpleControllerManager
moveit_simple_controller_manager:
  controller_names: [arm_controller, grip_controller]
  arm_controller:
    type: FollowJointTrajectory
    action_ns: follow_joint_trajectory
    default: true
    joints: [shoulder, elbow]
  grip_controller:
    type: ParallelGripperCommand
    action_ns: gripper_cmd
    joints: [grip]
"""
OMPL = """planner_configs:
  RRTConnect:
    type: geometric::RRTConnect
  PRMstar:
    type: geometric::PRMstar
arm:
  default_planner_config: RRTConnect
  planner_configs:
    - RRTConnect
    - PRMstar
  longest_valid_segment_fraction: 0.005
"""
BRIDGE = """- topic_name: scan
  ros_type_name: sensor_msgs/msg/LaserScan
  gz_type_name: gz.msgs.LaserScan
  direction: GZ_TO_ROS
"""


def write(folder: Path, files: dict[str, str]) -> Path:
    for name, text in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)
    return folder


def found(folder: Path) -> list[str]:
    codes = ("K959", "K960", "K962", "K969", "K971", "M108", "M109")
    return [f"{one.file.rpartition('/')[2]}:{one.line}: {one.message}" for one in lint(folder) if one.code in codes]


@pytest.fixture
def ros2(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    manifest = MANIFEST.format("arm_description", "ament_cmake", "")
    files = {"package.xml": manifest, "urdf/arm.urdf": ROBOT, "config/arm.yaml": ROS2, "config/bridge.yaml": BRIDGE}
    settings = {"config/moveit.yaml": MOVEIT, "config/ompl.yaml": OMPL, "config/arm.srdf": SRDF}
    write(tmp_path, {**files, **settings})
    assert found(tmp_path) == []
    return tmp_path


@pytest.fixture
def ros1(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    manifest = MANIFEST.format("arm_description", "catkin", "<exec_depend>controller_manager</exec_depend>")
    files = {"package.xml": manifest, "urdf/arm.urdf": ROBOT, "launch/arm.launch": LAUNCH}
    write(tmp_path, {**files, "config/controllers.yaml": ROS1})
    assert found(tmp_path) == []
    return tmp_path


def change(folder: Path, file: str, old: str, new: str) -> list[str]:
    text = (folder / file).read_text()
    assert old in text
    (folder / file).write_text(text.replace(old, new, 1))
    return found(folder)


@pytest.mark.parametrize(
    ("file", "old", "new", "expected"),
    [
        ("arm", "update_rate: 100", 'update_rate: "100"', '3: `update_rate` is "100", a quoted string'),
        (
            "arm",
            "    joint: grip",
            "    jont: grip",
            "22: unknown parameter `jont` of controller `grip_controller`; did",
        ),
        (
            "arm",
            "  constraints:\n      goal",
            "  goal",
            "17: `goal_time` of controller `arm_controller` belongs below `const",
        ),
        ("arm", "goal_time: 0.5", "linear.x.min_velocity: fast", "18: `linear.x.min_velocity` is `fast`, which is not"),
        (
            "arm",
            "goal_time: 0.5",
            "linear.x.max_deceleration: 1.5",
            "18: `linear.x.max_deceleration` is 1.5; it must not be positive",
        ),
        (
            "arm",
            "goal_time: 0.5",
            "angular: {z: {max_deceleration_reverse: -4.0}}",
            "18: `angular.z.max_deceleration_reverse` is -4; it must not be negative",
        ),
        (
            "arm",
            "goal_time: 0.5",
            "linear: {x: {max_acceleration_reverse: 0.5}}",
            "18: `linear.x.max_acceleration_reverse` is 0.5; it must not be positive",
        ),
        (
            "arm",
            "goal_time: 0.5",
            "linear.x: {min_velocity: 0.1, max_deceleration: -1.0}",
            "18: `linear.x.min_velocity` is 0.1; it must not be positive",
        ),
        ("arm", "  ros__parameters:\n", "", "1: section `controller_manager` has no `ros__parameters`"),
        ("moveit", "joint_limits:", "joint_limmits:", "4: unknown parameter `joint_limmits` of MoveIt; did you mean"),
        (
            "moveit",
            "    min_position: -2.5\n",
            "",
            "6: `has_position_limits` of joint `elbow` is true, but `min_position`",
        ),
        (
            "moveit",
            "timeout: 0.05",
            'timeout: 0.05\n  position_only_ik: "true"',
            "4: `position_only_ik` of group `arm` is",
        ),
        ("arm", "update_rate: 100", "update_rate: [100]", "3: `update_rate` is a list, not a number"),
        ("arm", "goal_time: 0.5", "goal_time: 0.5 s", "18: `goal_time` is `0.5 s`, which is not a number"),
        (
            "arm",
            "goal: true",
            'goal: "true"',
            '16: `allow_partial_joints_goal` is "true", a quoted string; write true',
        ),
        ("arm", "goal: true", "goal: 1", "16: `allow_partial_joints_goal` is 1; write true"),
        ("arm", "[shoulder, elbow]", "shoulder, elbow", "13: `joints` is a string; write a list"),
        ("arm", "    joints: [shoulder, elbow]\n", "", "11: controller `arm_controller` has no `joints`"),
        ("arm", "    state_interfaces: [position]\n", "", "11: controller `arm_controller` has no `state_interfaces`"),
        ("arm", "    joint: grip\n", "", "20: controller `grip_controller` has no `joint`"),
        (
            "arm",
            "      type: joint_trajectory_controller/JointTrajectoryController\n",
            "",
            "6: controller `arm_controller` has no `type`",
        ),
        (
            "arm",
            "goal_tolerance: 0.002",
            "goal_tolerance: 2.0",
            "23: `goal_tolerance` is 2 m, but joint `grip` moves only",
        ),
        (
            "arm",
            "    constraints:",
            "constraints:",
            "17: `constraints` is at the level of the controllers, not in a controller; indent it",
        ),
        ("arm", "joint_trajectory_controller/", "joint-trajectory_controller/", "7: unknown controller type"),
        (
            "moveit",
            "2.0",
            "114.6",
            "10: `max_velocity` of joint `elbow` is 114.6: the limit 2 rad/s in degrees; write 2",
        ),
        ("moveit", "-2.5", "-143.2", "7: `min_position` of joint `elbow` is -143.2: the limit -2.5 rad in degrees"),
        (
            "moveit",
            "max_velocity: 2.0",
            "max_velocity: 4.5",
            "10: `max_velocity` of joint `elbow` is 4.5 rad/s, but its",
        ),
        ("moveit", "-2.5", '"-2.5"', '7: `min_position` of joint `elbow` is "-2.5", a quoted string'),
        (
            "moveit",
            "limits: true",
            'limits: "true"',
            '6: `has_position_limits` is "true", a quoted string; write true',
        ),
        (
            "moveit",
            "WorkspaceBounds",
            "WorkspaceBouds",
            "12: unknown plugin `default_planning_request_adapters/Validate",
        ),
        (
            "moveit",
            "  kinematics_solver: kdl_kinematics_plugin/KDLKinematicsPlugin\n",
            "",
            "1: group `arm` has no `kinem",
        ),
        (
            "moveit",
            "    action_ns: follow_joint_trajectory\n",
            "",
            "16: controller `arm_controller` has no `action_ns`",
        ),
        (
            "moveit",
            "follow_joint_t",
            "folow_joint_t",
            "18: unknown action `folow_joint_trajectory` of controller `arm_con",
        ),
        ("moveit", "    joints: [shoulder, elbow]\n", "", "16: controller `arm_controller` has no `joints`"),
        (
            "moveit",
            "[shoulder, elbow]",
            "[shoulder]",
            "20: no controller moves joint `elbow` of group `arm`; add it to",
        ),
        ("moveit", "[shoulder, elbow]", "[elbow, elbow]", "20: `elbow` occurs twice in `joints` of controller"),
        (
            "moveit",
            "joints: [grip]",
            "joints: grip",
            "24: `joints` of controller `grip_controller` is a string; write a list",
        ),
        (
            "moveit",
            "  controller_names: [arm_controller, grip_controller]\n",
            "",
            "14: `moveit_simple_controller_manager`",
        ),
        (
            "moveit",
            "moveit_controller_manager: moveit_simple_controller_manager/MoveItSimpleControllerManager\n",
            "",
            "13: no file sets `moveit_controller_manager`; MoveIt uses no controller",
        ),
        ("ompl", "geometric::RRTC", "geometric::RTC", "3: unknown planner `geometric::RTConnect`; did you mean"),
        ("ompl", "- PRMstar", "- PRMstr", "10: `planner_configs` does not define planner `PRMstr`; did you mean"),
        ("ompl", "config: RRTConnect", "config: RRT", "7: `planner_configs` does not define planner `RRT`"),
        ("ompl", "arm:", "amr:", "6: group `amr` does not exist in the SRDF"),
        ("ompl", "0.005", "0.005 m", "11: `longest_valid_segment_fraction` of group `arm` is `0.005 m`, which is not"),
        ("bridge", "  ros_type_name: sensor_msgs/msg/LaserScan\n", "", "1: bridge has no `ros_type_name`"),
    ],
)
def test_a_defect_of_ros2_is_reported(ros2, file, old, new, expected):
    lines = change(ros2, f"config/{file}.yaml", old, new)
    assert any(line.startswith(f"{file}.yaml:{expected}") for line in lines), lines


@pytest.mark.parametrize(
    ("file", "old", "new"),
    [
        ("arm", "update_rate: 100", "update_rate: $(var rate)"),
        ("arm", "goal_time: 0.5", "goal_time: .inf"),
        ("arm", "goal_time: 0.5", "goal_time: .NAN"),
        ("arm", "goal_tolerance: 0.002", "goal_tolerance: 1e-3"),
        ("arm", "goal_time: 0.5", "goal_time: 0.5\n    linear.x.min_velocity: -1.0"),
        ("arm", "goal_time: 0.5", "linear.x.max_deceleration: -1.5\n      angular.z.max_acceleration_reverse: .NAN"),
        ("arm", "goal_time: 0.5", "linear: {x: {max_deceleration: -1.5, max_acceleration_reverse: -0.5}}"),
        ("arm", "goal_time: 0.5", "angular.z.max_deceleration_reverse: 4.0"),
        ("arm", "goal_time: 0.5", "linear.x.min_velocity: 0.1"),
        ("ompl", "planner_configs:", "planning_plugin: ompl_interface/OMPLPlanner\nplanner_configs:"),
        ("arm", "    command_interfaces: [position]\n    state_interfaces: [position]\n", ""),
        ("arm", "joint_state_broadcaster:\n", "other:\n      ros_parameter: 1\n    joint_state_broadcaster:\n"),
        ("moveit", "max_velocity: 2.0", "max_velocity: 3.0"),
        ("moveit", "kdl_kinematics_plugin/KDLKinematicsPlugin", "my_kinematics/Plugin"),
        ("moveit", "[shoulder, elbow]", "[shoulder, elbow, grip]"),
        ("moveit", "    type: FollowJointTrajectory\n    action_ns: follow_joint_trajectory\n", "    type: fake\n"),
        ("moveit", "action_ns: gripper_cmd", "action_ns: grasp"),
        (
            "ompl",
            "planner_configs:\n  RRTConnect:\n    type: geometric::RRTConnect\n  PRMstar:\n",
            "other:\n  PRMstar:\n",
        ),
        ("ompl", "geometric::PRMstar", "geometric::MyPlanner"),
    ],
)
def test_a_correct_file_of_ros2_is_silent(ros2, file, old, new):
    assert change(ros2, f"config/{file}.yaml", old, new) == []


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        (
            "    type: joint_state_controller/JointStateController\n",
            "",
            "2: controller `joint_state_controller` has no `type`",
        ),
        ("    joints: [shoulder, elbow]\n", "", "6: controller `arm_controller` has no `joints`"),
        (
            "    type: velocity_controllers/JointTrajectoryController\n    joints: [shoulder, elbow]\n",
            "    type: effort_controllers/JointPositionController\n    joints: elbow\n",
            "7: `effort_controllers/JointPositionController` reads `joint`, not `joints`",
        ),
        (
            "    publish_rate: 50",
            "  publish_rate: 50",
            "4: `publish_rate` is at the level of the controllers, not in a controller",
        ),
        ("  elbow: 1.0", '  elbow: "1.0"', '13: `elbow` in `velocity_ff` is "1.0", a quoted string'),
        ("  elbow: 1.0", "  elbwo: 1.0", "13: unknown name `elbwo` in `velocity_ff` of controller `arm_controller`"),
        ("p: 20.0", 'p: "20.0"', '9: gain `p` is "20.0", a quoted string'),
        (
            "      elbow: 1.0\n",
            "      elbow: 1.0\n      constraints: {}\n",
            "14: `constraints` of controller `arm_controller`",
        ),
        (
            "arm:",
            "robot:",
            "1: `joint_state_controller` is in namespace `/robot`, but its spawner in launch/arm.launch",
        ),
    ],
)
def test_a_defect_of_ros1_is_reported(ros1, old, new, expected):
    lines = change(ros1, "config/controllers.yaml", old, new)
    assert any(line.startswith(f"controllers.yaml:{expected}") for line in lines), lines


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ('command="load"/>', 'command="load" ns="/"/>'),
        ('ns="arm" args', 'ns="$(arg robot)" args'),
        ('ns="arm" args="', 'args="--namespace=/arm '),
        ("$(find arm_description)/config/", "$(arg folder)/"),
    ],
)
def test_controllers_in_the_namespace_of_their_spawner_are_silent(ros1, old, new):
    assert change(ros1, "launch/arm.launch", old, new) == []


def test_a_namespace_of_a_group_applies_to_the_parameters_and_to_the_spawner(ros1):
    grouped = LAUNCH.replace("<launch>", '<launch>\n<group ns="cell">').replace("</launch>", "</group>\n</launch>")
    (ros1 / "launch" / "arm.launch").write_text(grouped)
    assert found(ros1) == []
    (message,) = change(ros1, "launch/arm.launch", 'ns="arm"', 'ns="/arm"')
    assert "in namespace `/cell/arm`, but its spawner in launch/arm.launch:4 is in namespace `/arm`" in message


def test_a_controller_of_moveit_in_ros1_is_named_with_its_namespace(ros1):
    controllers = """controller_list:
  - name: arm/arm_controller
    action_ns: follow_joint_trajectory
    type: FollowJointTrajectory
    joints: [shoulder, elbow]
"""
    write(ros1, {"config/arm.srdf": SRDF, "config/moveit.yaml": controllers})
    assert found(ros1) == []
    assert change(ros1, "config/moveit.yaml", "arm/arm_", "amr/arm_") == [
        "moveit.yaml:2: unknown controller `amr/arm_controller`; did you mean `arm/arm_controller`?"
    ]
    assert change(ros1, "config/moveit.yaml", "amr/arm_", "arm_") == []  # a launch file names this namespace
    (ros1 / "launch" / "arm.launch").unlink()
    assert found(ros1) == [
        "moveit.yaml:2: controller `arm_controller` is in a namespace: its name is `arm/arm_controller`"
    ]


def test_one_finding_for_joints_instead_of_joint(ros1):
    one = """grip_controller:
  type: position_controllers/JointPositionController
  joints: [grip]
"""
    write(ros1, {"config/grip.yaml": one})
    assert found(ros1) == [
        "grip.yaml:3: unknown parameter `joints` of controller `grip_controller`; did you mean `joint`?"
    ]


@pytest.mark.parametrize(("tool", "severity"), [("ament_cmake", "error"), ("catkin", "warning")])
def test_a_value_that_is_no_boolean_stops_moveit_2(ros2, tool, severity):
    write(ros2, {"package.xml": MANIFEST.format("arm_description", tool, "")})
    change(ros2, "config/moveit.yaml", "has_position_limits: true", "has_velocity_limits: maybe")
    assert [one.severity for one in lint(ros2) if "`has_velocity_limits` of" in one.message] == [severity]


@pytest.mark.parametrize(("options", "is_reported"), [("", True), (' "--param-file", "other.yaml",', False)])
def test_a_spawned_controller_without_a_type_is_reported_where_the_type_belongs(ros2, options, is_reported):
    node = f'Node(package="controller_manager", executable="spawner", arguments=[{options} "arm_controller"])'
    launch = f"def generate_launch_description():\n    return LaunchDescription([{node}])\n"
    write(
        ros2,
        {
            "launch/arm.launch.py": "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n"
            + launch
        },
    )
    entry = "    arm_controller:\n      type: joint_trajectory_controller/JointTrajectoryController\n"
    lines = change(ros2, "config/arm.yaml", entry, "")
    expected = ["arm.yaml:7: controller `arm_controller` has no `type`, but launch/arm.launch.py spawns it"]
    assert lines == (expected if is_reported else [])


@pytest.mark.parametrize(
    ("text", "line", "why"),
    [
        (
            "a: &a [1, 1]\n"
            + "".join(f"{n}: &{n} [{', '.join([f'*{p}'] * 9)}]\n" for p, n in zip("abcdefg", "bcdefgh", strict=True)),
            5,
            "nested too deeply, or too many aliases",
        ),
        ("x: 1\ny: " + "[" * 50_000, 2, "nested too deeply"),
    ],
    ids=["aliases", "brackets"],
)
def test_a_yaml_file_that_expands_without_end_is_one_finding(ros2, text, line, why):
    write(ros2, {"config/other.yaml": text})
    (finding,) = lint(ros2)
    assert (finding.code, finding.line, finding.message) == ("K966", line, f"invalid YAML: {why}")


def test_a_controller_without_a_type_whose_name_a_function_spawns_is_reported(ros2):
    launch = """import os

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    params = os.path.join(get_package_share_directory('arm_description'), 'config', 'arm.yaml')

    def spawn(*names):
        arguments = list(names) + ['--param-file', params]
        return Node(package='controller_manager', executable='spawner', arguments=arguments)

    return LaunchDescription([spawn('OTHER', 'arm_controller')])
"""
    entry = "    arm_controller:\n      type: joint_trajectory_controller/JointTrajectoryController\n"
    lines = change(ros2, "config/arm.yaml", entry, "")
    assert lines == []
    write(ros2, {"launch/arm.launch.py": launch.replace("OTHER", "grip_controller")})
    expected = ["arm.yaml:7: controller `arm_controller` has no `type`, but launch/arm.launch.py spawns it"]
    assert found(ros2) == expected
