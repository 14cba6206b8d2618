"""Labels: of a robot as a whole, of its links, and what is none."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from urdfkit.description.urdf.robot import Robot
from urdfkit.scene import scene_of

LINKS = """<link name="a"><visual><geometry><sphere radius="1"/></geometry></visual></link><link name="b"><visual>
<geometry><sphere radius="1"/></geometry></visual></link>
<joint name="j" type="fixed"><parent link="a"/><child link="b"/>
</joint>"""


def plugin(label: str, file: str = "gz-sim-label-system") -> str:
    return f'<plugin filename="{file}" name="gz::sim::systems::Label"><label>{label}</label></plugin>'


@pytest.mark.parametrize(
    ("blocks", "labels"),
    [
        ("", [0, 0]),
        (f"<gazebo>{plugin('7')}</gazebo>", [7, 7]),
        (f"<gazebo>{plugin('7')}</gazebo><gazebo reference='b'><visual>{plugin('9')}</visual></gazebo>", [7, 9]),
        (f"<gazebo reference='a'>{plugin('3', 'libignition-gazebo-label-system.so')}</gazebo>", [3, 0]),
        (f"<gazebo>{plugin('red')}</gazebo>", [0, 0]),
        (f"<gazebo>{plugin('256')}</gazebo>", [0, 0]),
        (f"<gazebo>{plugin('7', 'gz-sim-other-system')}</gazebo>", [0, 0]),
    ],
)
def test_labels_of_a_robot(robot_of: Callable[[str], Robot], blocks: str, labels: list[int]) -> None:
    assert [shape.label for shape in scene_of(robot_of(LINKS + blocks)).with_role("visual")] == labels
