"""Plugins that nothing here runs: what is reported of them."""

from __future__ import annotations

import pytest

from urdfkit.description.plugins.unknown_plugins import nearest
from urdfkit.sim import Simulator


@pytest.mark.parametrize(
    ("name", "near"),
    [
        ("gazebo_ros_diff_drve", "gazebo_ros_diff_drive"),
        ("gz-sim-diff-drve-system", "gz-sim-diff-drive-system"),
        ("gazebo_ros_doorr", ""),  # what all of them begin with states nothing about which was meant
        ("my_stuff", ""),
        ("gripper_of_hours", "gripper_of_ours"),
    ],
)
def test_the_nearest_name(name: str, near: str) -> None:
    assert nearest(name, ["gripper_of_ours"]) == near


def test_a_plugin_that_nobody_knows_is_told_from_one_of_gazebo(tmp_path) -> None:
    path = tmp_path / "robot.urdf"
    plugins = "".join(f'<plugin name="p" filename="lib{name}.so"/>\n' for name in ("my_stuff", "gazebo_ros_elevator"))
    path.write_text(f'<robot name="r"><link name="world"/>\n<gazebo>{plugins}</gazebo></robot>')
    notes: list[str] = []
    Simulator(path, note=notes.append)
    assert [note.removeprefix(f"{tmp_path}/") for note in notes if not note.startswith("compiling")] == [
        "robot.urdf:2:26: unknown plugin `libmy_stuff.so`: urdfkit does not simulate it",
        "robot.urdf:3:18: plugin `libgazebo_ros_elevator.so` is not simulated yet",
    ]
