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
