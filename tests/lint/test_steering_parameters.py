"""Parameters of steering controllers compared with the axles of the robot, and mimic joints with command interfaces."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from urdfkit.lint import lint

RULE = Path(__file__).parent / "rules" / "turn-too-tight"
EXCHANGED = "`left_knuckle_joint` is on the left; the controller reads the right joint of a pair first"
BAD = [
    ("wheelbase: 0.4", "wheelbase: 0.5", 9, "`wheelbase` is 0.5 m, but the axles are 0.4 m apart"),
    ("traction_track_width: 0.36", "traction_track_width: 0.3", 10, "`traction_track_width` is 0.3 m, but the wheels"),
    ("steering_track_width: 0.36", "steering_track_width: 0.2", 11, "`steering_track_width` is 0.2 m, but the wheels"),
    ("[right_knuckle_joint, left_knuckle_joint]", "[left_knuckle_joint, right_knuckle_joint]", 8, EXCHANGED),
]
GOOD = [("wheelbase: 0.4", "wheelbase: 0.43"), ("steering_track_width: 0.36", "steering_track_width: 0.3")]

HAND = """<robot name="hand">
  <link name="palm"/>
  <link name="left"/>
  <link name="right"/>
  <joint name="left" type="continuous"><parent link="palm"/><child link="left"/><axis xyz="0 0 1"/></joint>
  <joint name="right" type="continuous">
    <parent link="palm"/><child link="right"/><axis xyz="0 0 1"/><mimic joint="left"/>
  </joint>
  <ros2_control name="hand" type="system">
    <hardware><plugin>mock_components/GenericSystem</plugin></hardware>
    <joint name="left"><command_interface name="position"/><state_interface name="position"/></joint>
    <joint name="right"><command_interface name="position"/><state_interface name="position"/></joint>
  </ros2_control>
</robot>
"""


def findings(folder: Path, old: str, new: str) -> list:
    for name in ("cart.urdf", "package.xml", "controllers.yaml"):
        shutil.copy(RULE / name, folder)
    text = (folder / "controllers.yaml").read_text()
    assert old in text
    (folder / "controllers.yaml").write_text(text.replace(old, new))
    return [one for one in lint(folder) if one.file.endswith(".yaml")]


@pytest.mark.parametrize(("old", "new", "line", "message"), BAD)
def test_each_wrong_length_is_one_finding(tmp_path, old, new, line, message):
    [found] = findings(tmp_path, old, new)
    assert (found.code, found.line) == ("K970", line)
    assert message in found.message
    assert found.help is not None
    assert found.help.startswith("exchange the names" if message is EXCHANGED else "write 0.")


@pytest.mark.parametrize(("old", "new"), GOOD)
def test_lengths_in_the_tolerance_are_silent(tmp_path, old, new):
    assert findings(tmp_path, old, new) == []


@pytest.mark.parametrize(("release", "count"), [("ros2-humble", 0), ("ros2-jazzy", 1)])
def test_mimic_joints_have_no_command_interface_since_jazzy(tmp_path, release, count):
    (tmp_path / "hand.urdf").write_text(HAND)
    found = [one for one in lint(tmp_path / "hand.urdf", target=release) if one.code == "C720"]
    message = "joint `right` mimics another joint and has a command interface, which ros2_control rejects"
    assert [one.message for one in found] == [message] * count
    assert [one.help for one in found] == ["remove its command interfaces"] * count
    (tmp_path / "hand.urdf").write_text(
        HAND.replace('<joint name="right"><com', '<joint name="right" mimic="false"><com')
    )
    assert [one.code for one in lint(tmp_path / "hand.urdf", target=release) if one.code == "C720"] == []


def _wheel(name: str, parent: str, place: str) -> str:
    return f"""  <link name="{name}"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>
  <joint name="{name}_joint" type="continuous">
    <origin xyz="{place}"/><parent link="{parent}"/><child link="{name}"/><axis xyz="0 1 0"/>
  </joint>
"""


TRICYCLE = f"""<robot name="trike">
  <link name="base_link"/>
  <link name="fork"/>
  <joint name="steering_joint" type="revolute">
    <origin xyz="0.6 0 0"/><parent link="base_link"/><child link="fork"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/>
  </joint>
{_wheel("traction", "fork", "0 0 0")}{_wheel("left", "base_link", "0 0.2 0")}{_wheel("right", "base_link", "0 -0.2 0")}\
</robot>
"""
CONTROLLERS = """controller_manager:
  ros__parameters:
    update_rate: 50
    trike:
      type: tricycle_controller/TricycleController
trike:
  ros__parameters:
    traction_joint_name: traction_joint
    steering_joint_name: steering_joint
    wheelbase: 0.6
    wheel_radius: 0.1
planner_server:
  ros__parameters:
    planner_plugins: [GridBased]
    GridBased:
      plugin: nav2_smac_planner/SmacPlannerHybrid
      minimum_turning_radius: 0.5
"""


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ("wheelbase: 0.6", "wheelbase: 0.62", []),
        ("wheelbase: 0.6", "wheelbase: 0.9", [("K970", 10, "`wheelbase` is 0.9 m, but the axles are 0.6 m apart")]),
        (
            "wheel_radius: 0.1",
            "wheel_radius: 0.2",
            [("K970", 11, "`wheel_radius` is 0.2 m, but the radius of the wheels is 0.1 m")],
        ),
        (
            "radius: 0.5",
            "radius: 0.2",
            [("K986", 17, "`minimum_turning_radius` is 0.2 m, but the steering joints allow at least 0.385 m")],
        ),
        *(
            (
                f"name: {joint}_joint",
                f"name: {joint}_joinnt",
                [
                    (
                        "K959",
                        line,
                        (
                            f"controller joint `{joint}_joinnt` does not exist in robot `trike`;"
                            f" did you mean `{joint}_joint`?"
                        ),
                    )
                ],
            )
            for joint, line in (("traction", 8), ("steering", 9))
        ),
    ],
)
def test_the_controller_of_a_steered_and_driven_wheel_is_compared_with_the_robot(tmp_path, old, new, expected):
    shutil.copy(RULE / "package.xml", tmp_path)
    (tmp_path / "cart.urdf").write_text(TRICYCLE)
    assert old in CONTROLLERS
    (tmp_path / "controllers.yaml").write_text(CONTROLLERS.replace(old, new))
    found = [(one.code, one.line, one.message) for one in lint(tmp_path) if one.file.endswith(".yaml")]
    assert found == expected


def test_wheels_on_two_axles_leave_the_wheelbase_of_a_steered_wheel_unknown(tmp_path):
    shutil.copy(RULE / "package.xml", tmp_path)
    (tmp_path / "cart.urdf").write_text(TRICYCLE.replace("0 -0.2 0", "0.1 -0.2 0"))
    (tmp_path / "controllers.yaml").write_text(CONTROLLERS.replace("wheelbase: 0.6", "wheelbase: 0.9"))
    assert [one for one in lint(tmp_path) if one.code == "K970" and "wheelbase" in one.message] == []


COMMANDS = """<launch>
  <node pkg="nav2_controller" exec="controller_server" name="controller_server">
    <remap from="cmd_vel" to="{}"/>
  </node>
</launch>
"""


@pytest.mark.parametrize(
    ("topic", "flag", "expected"),
    [
        ("trike/cmd_vel", "false", []),
        (
            "trike/cmd_vel_unstamped",
            "false",
            [
                (
                    "K980",
                    (
                        "no node subscribes to the velocity commands on `trike/cmd_vel_unstamped`;"
                        " did you mean `trike/cmd_vel`?"
                    ),
                )
            ],
        ),
        (
            "trike/cmd_vel",
            "true",
            [("K985", "this flag of `trike` is true, but `controller_server` publishes Twist on `trike/cmd_vel`")],
        ),
    ],
)
def test_navigation_commands_the_controller_of_a_steered_wheel_on_its_only_topic(tmp_path, topic, flag, expected):
    shutil.copy(RULE / "package.xml", tmp_path)
    (tmp_path / "cart.urdf").write_text(TRICYCLE)
    (tmp_path / "controllers.yaml").write_text(
        CONTROLLERS.replace("    wheelbase:", f"    use_stamped_vel: {flag}\n    wheelbase:")
    )
    (tmp_path / "drive.launch.xml").write_text(COMMANDS.format(topic))
    found = [(one.code, one.message) for one in lint(tmp_path) if one.code in ("K980", "K985")]
    assert found == expected


def test_navigation_with_stamps_commands_a_controller_with_stamps(tmp_path):
    shutil.copy(RULE / "package.xml", tmp_path)
    (tmp_path / "cart.urdf").write_text(TRICYCLE)
    stamped = CONTROLLERS.replace("    wheelbase:", "    use_stamped_vel: true\n    wheelbase:")
    stamped += "controller_server:\n  ros__parameters: {enable_stamped_cmd_vel: true}\n"
    (tmp_path / "controllers.yaml").write_text(stamped)
    (tmp_path / "drive.launch.xml").write_text(COMMANDS.format("trike/cmd_vel"))
    assert [one.message for one in lint(tmp_path) if one.code in ("K980", "K985")] == []
