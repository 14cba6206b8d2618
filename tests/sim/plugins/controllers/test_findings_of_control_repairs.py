"""Every hardware part and controller that a simulation leaves out has a finding of its code at its place."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfkit import Simulator
from urdfkit.lint import lint

INERTIAL = '<inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>'
TREE = f"""<robot name="arm">
<link name="world"/><link name="upper">{INERTIAL}</link><link name="lower">{INERTIAL}</link>
<link name="hand">{INERTIAL}</link>
<joint name="shoulder" type="continuous"><parent link="world"/><child link="upper"/><axis xyz="0 1 0"/></joint>
<joint name="elbow" type="continuous"><parent link="upper"/><child link="lower"/><axis xyz="0 1 0"/></joint>
<joint name="wrist" type="fixed"><parent link="lower"/><child link="hand"/></joint>
"""
ROS_2 = """<ros2_control name="arm" type="system">
<hardware>
<plugin>gz_ros2_control/GazeboSimSystem</plugin>
</hardware>
<joint name="shoulder">
<command_interface name="position"/>
<state_interface name="position"><param name="initial_value">0</param></state_interface>
</joint>
<joint name="elbow">
<command_interface name="velocity"/>
<state_interface name="position"/>
</joint>
</ros2_control>
<gazebo><plugin filename="gz_ros2_control-system" name="gz_ros2_control::GazeboSimROS2ControlPlugin">
<parameters>$(find arm)/config/arm.yaml</parameters>
</plugin></gazebo></robot>
"""
YAML_2 = """controller_manager:
  ros__parameters:
    update_rate: 100
    a:
      type: joint_trajectory_controller/JointTrajectoryController
a:
  ros__parameters:
    joints: [shoulder]
    command_interfaces: [position]
    state_interfaces: [position]
    state_publish_rate: 50.0
"""
ROS_1 = """<transmission name="t">
<type>transmission_interface/SimpleTransmission</type>
<joint name="shoulder">
<hardwareInterface>hardware_interface/PositionJointInterface</hardwareInterface>
</joint>
<actuator name="m"/>
</transmission>
<gazebo><plugin filename="libgazebo_ros_control.so" name="control">
<robotNamespace>/arm</robotNamespace>
</plugin></gazebo></robot>
"""
YAML_1 = """arm:
  a:
    type: position_controllers/JointPositionController
    joint: shoulder
"""
CASES = {
    "hardware": ("gz_ros2_control/GazeboSimSystem", "acme/Hardware", "C709"),
    "empty hardware": ("gz_ros2_control/GazeboSimSystem", "", "C709"),
    "no plugin": ("<plugin>gz_ros2_control/GazeboSimSystem</plugin>", "", "C717"),
    "no hardware": ("<hardware>\n<plugin>gz_ros2_control/GazeboSimSystem</plugin>\n</hardware>", "", "C717"),
    "interface": ('command_interface name="position"', 'command_interface name="grip"', "C710"),
    "initial value": ('value">0<', 'value">zero<', "C710"),
    "joint": ('joint name="elbow">\n<command', 'joint name="knee">\n<command', "C707"),
    "fixed joint": ('joint name="elbow">\n<command', 'joint name="wrist">\n<command', "C707"),
    "type of a package": ("joint_trajectory_controller/JointTrajectoryController", "acme/Controller", "K962"),
    "type without package": ("joint_trajectory_controller/JointTrajectoryController", "Controller", "K962"),
    "misspelt type": ("/JointTrajectoryController", "/JointTrajectoryControler", "K962"),
    "joint of a controller": ("joints: [shoulder]", "joints: [shouldr]", "K959"),
    "interface of a controller": ("joints: [shoulder]", "joints: [elbow]", "K965"),
    "no joints": ("    joints: [shoulder]\n", "", "K971"),
    "no interfaces": ("    command_interfaces: [position]\n", "", "K971"),
    "number": ("state_publish_rate: 50.0", "state_publish_rate: often", "K971"),
    "list for a number": ("state_publish_rate: 50.0", "state_publish_rate: [1]", "K971"),
    "update rate": ("update_rate: 100", "update_rate: often", "K971"),
    "negative update rate": ("update_rate: 100", "update_rate: -1", "K971"),
}
CASES_1 = {
    "interface": ("hardware_interface/PositionJointInterface", "acme/Interface", "C703"),
    "no interface": ("<hardwareInterface>hardware_interface/PositionJointInterface</hardwareInterface>", "", "C702"),
    "two joints": ("</joint>\n<actuator", '</joint>\n<joint name="elbow"/>\n<actuator', "C703"),
    "joint": ('<joint name="shoulder">\n<hardware', '<joint name="shouldr">\n<hardware', "C701"),
    "fixed joint": ('<joint name="shoulder">\n<hardware', '<joint name="wrist">\n<hardware', "C701"),
    "type of a package": ("position_controllers/JointPositionController", "acme/Controller", "K962"),
    "misspelt type": ("/JointPositionController", "/JointPositionControler", "K962"),
    "joint of a controller": ("joint: shoulder", "joint: shouldr", "K959"),
    "no joint": ("    joint: shoulder\n", "", "K971"),
}


def unreported(folder: Path, robot: str, yaml: str) -> tuple[set[str | None], list[str]]:
    """Return the codes of the repairs, and the repairs without a finding of their code at their place."""
    (folder / "package.xml").write_text('<package format="3"><name>arm</name></package>')
    (folder / "urdf").mkdir()
    (folder / "config").mkdir()
    (folder / "config" / "arm.yaml").write_text(yaml)
    path = folder / "urdf" / "arm.urdf"
    path.write_text(robot.replace("$(find arm)", str(folder)))
    repairs = Simulator(path, note=lambda _: None).repairs
    found = [*lint(path), *lint(path, target="urdfkit")]
    places = {(each.code, each.span.file, each.span.line) for each in found}
    missing = [
        f"{repair.code} {repair}"
        for repair in repairs
        if repair.position is None or (repair.code, repair.position.file, repair.position.line) not in places
    ]
    return {repair.code for repair in repairs}, missing


@pytest.mark.parametrize("case", CASES)
def test_parts_of_ros2_control_that_are_left_out_have_a_finding(tmp_path: Path, case: str) -> None:
    old, new, code = CASES[case]
    assert (old in ROS_2) != (old in YAML_2)
    folder = tmp_path / "arm"
    folder.mkdir()
    codes, missing = unreported(folder, TREE + ROS_2.replace(old, new), YAML_2.replace(old, new))
    assert missing == []
    assert code in codes


@pytest.mark.parametrize("case", CASES_1)
def test_parts_of_gazebo_ros_control_that_are_left_out_have_a_finding(tmp_path: Path, case: str) -> None:
    old, new, code = CASES_1[case]
    assert (old in ROS_1) != (old in YAML_1)
    folder = tmp_path / "arm"
    folder.mkdir()
    codes, missing = unreported(folder, TREE + ROS_1.replace(old, new), YAML_1.replace(old, new))
    assert missing == []
    assert code in codes


@pytest.mark.parametrize(("tail", "yaml"), [(ROS_2, YAML_2), (ROS_1, YAML_1)], ids=["ros2", "ros1"])
def test_a_correct_robot_has_no_repairs(tmp_path: Path, tail: str, yaml: str) -> None:
    folder = tmp_path / "arm"
    folder.mkdir()
    assert unreported(folder, TREE + tail, yaml) == (set(), [])


WHEELED = TREE.replace("</robot>", "") + "".join(
    f'<link name="{name}_link">{INERTIAL}<collision><geometry><sphere radius="0.1"/></geometry></collision></link>\n'
    f'<joint name="{name}" type="continuous"><parent link="hand"/>'
    f'<child link="{name}_link"/><origin xyz="{xyz}"/><axis xyz="0 1 0"/></joint>\n'
    for name, xyz in (("fl", "0.3 0.3 0"), ("fr", "0.3 -0.3 0"), ("rl", "-0.3 0.3 0"), ("rr", "-0.3 -0.3 0"))
)
WHEELS = ("fl", "fr", "rl", "rr")
HARDWARE = "".join(
    f'<joint name="{name}"><command_interface name="velocity"/><command_interface name="position"/></joint>\n'
    for name in WHEELS
)
TRANSMISSIONS = "".join(
    f'<transmission name="{name}"><type>transmission_interface/SimpleTransmission</type><joint name="{name}">'
    "<hardwareInterface>hardware_interface/VelocityJointInterface</hardwareInterface></joint>"
    f'<actuator name="{name}_motor"/></transmission>\n'
    for name in WHEELS
)
VARIANCES = {"pose_covariance_diagonal": "[1, 1, 1, 1, 1, 1]", "twist_covariance_diagonal": "[1, 1, 1, 1, 1, 1]"}
STEERING = {"wheelbase": "0.6", "traction_track_width": "0.6", "traction_wheels_radius": "0.1"}
CONTROLLERS: dict[tuple[str, int], dict[str, str]] = {
    ("diff_drive_controller/DiffDriveController", 2): {
        "left_wheel_names": "[fl, rl]",
        "right_wheel_names": "[fr, rr]",
        "wheel_separation": "0.6",
        "wheel_radius": "0.1",
    },
    ("diff_drive_controller/DiffDriveController", 1): {
        "left_wheel": "[fl]",
        "right_wheel": "[fr]",
        "wheel_separation": "0.6",
        "wheel_radius": "0.1",
        **VARIANCES,
    },
    ("ackermann_steering_controller/AckermannSteeringController", 2): {
        "traction_joints_names": "[rl, rr]",
        "steering_joints_names": "[fl, fr]",
        **STEERING,
    },
    ("bicycle_steering_controller/BicycleSteeringController", 2): {
        "traction_joints_names": "[rl]",
        "steering_joints_names": "[fl]",
        **STEERING,
    },
    ("mecanum_drive_controller/MecanumDriveController", 2): {
        "front_left_wheel_command_joint_name": "fl",
        "front_right_wheel_command_joint_name": "fr",
        "rear_left_wheel_command_joint_name": "rl",
        "rear_right_wheel_command_joint_name": "rr",
        "kinematics": "{wheels_radius: 0.1, sum_of_robot_center_projection_on_X_Y_axis: 0.6}",
    },
    ("forward_command_controller/ForwardCommandController", 2): {"joints": "[fl]", "interface_name": "velocity"},
    ("parallel_gripper_action_controller/GripperActionController", 2): {"joint": "fl"},
}
OTHERS = ("odom_frame_id", "enable_odom_tf", "pose_covariance_diagonal", "use_stamped_vel", "max_effort_interface")


@pytest.mark.slow
@pytest.mark.parametrize(("kind", "ros"), CONTROLLERS)
def test_parameters_that_a_controller_cannot_read_have_a_finding(tmp_path: Path, kind: str, ros: int) -> None:
    parameters = CONTROLLERS[kind, ros]
    cases: list[dict[str, str]] = [parameters]
    cases += [{name: value for name, value in parameters.items() if name != missing} for missing in parameters]
    cases += [{**parameters, name: value} for name in parameters for value in ("often", "[1]", "-1", "{a: often}")]
    cases += [{**parameters, name: "{a: often}"} for name in OTHERS]
    head, total, without = f"type: {kind}", 0, []
    for number, each in enumerate(cases):
        lines = [f"{name}: {value}" for name, value in each.items()]
        if ros == 2:
            indented = "".join(f"    {line}\n" for line in lines)
            yaml = YAML_2.partition("    a:\n")[0] + f"    a:\n      {head}\na:\n  ros__parameters:\n{indented}"
            robot = WHEELED + ROS_2.replace("</ros2_control>", HARDWARE + "</ros2_control>")
        else:
            yaml = "arm:\n  a:\n" + "".join(f"    {line}\n" for line in (head, *lines))
            robot = WHEELED + TRANSMISSIONS + ROS_1
        (tmp_path / str(number)).mkdir()
        codes, missing = unreported(tmp_path / str(number), robot, yaml)
        assert number > 0 or (codes, missing) == (set(), [])
        total += len(codes)
        without += missing
    assert without == []
    assert total > len(parameters)
