"""Start poses: floating joints below a fixed root link."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfkit import Simulator
from urdfkit.scene import lowest_point
from urdfkit.sim import Spawn

BOX = (
    '<link name="{}"><inertial><mass value="1"/><inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/>'
    '</inertial><collision><origin xyz="{}"/><geometry><box size="0.1 0.1 0.2"/></geometry></collision></link>'
)


def robot(folder: Path, origin: str) -> Path:
    """Write a torso on a floating joint below `world`, with a leg 0.5 m below it, and a pole through the ground."""
    path = folder / "walker.urdf"
    path.write_text(
        '<robot name="walker"><link name="world"/>'
        + BOX.format("torso", "0 0 0")
        + BOX.format("leg", "0 0 -0.4")
        + BOX.format("pole", "0 0 0")
        + f'<joint name="free" type="floating"><parent link="world"/><child link="torso"/><origin {origin}/></joint>'
        '<joint name="hip" type="revolute"><parent link="torso"/><child link="leg"/><axis xyz="0 1 0"/>'
        '<limit lower="-1" upper="1" effort="9" velocity="9"/></joint>'
        '<joint name="post" type="fixed"><parent link="world"/><child link="pole"/></joint></robot>'
    )
    return path


def height(simulator: Simulator, link: str) -> float:
    return float(simulator.link_poses()[simulator.kinematics.link_names.index(link), 2])


@pytest.mark.parametrize("origin", ['xyz="0 0 0"', 'xyz="0 1 -2" rpy="0.5 1.2 -2"', 'xyz="0 0 0.2" rpy="0 0 1"'])
def test_a_floating_joint_starts_on_the_ground_if_its_robot_would_start_below(tmp_path: Path, origin: str) -> None:
    simulator = Simulator(robot(tmp_path, origin), note=lambda _: None)
    for _ in range(2):
        assert lowest_point(simulator.scene, simulator.link_poses(), of={"torso", "leg"}) == pytest.approx(0, abs=1e-12)
        assert height(simulator, "pole") == 0.0
        simulator.run(0.01)
        simulator.reset()


def test_a_floating_joint_above_the_ground_stays_where_it_is(tmp_path: Path) -> None:
    simulator = Simulator(robot(tmp_path, 'xyz="0 0 2"'), note=lambda _: None)
    assert height(simulator, "torso") == 2.0
    assert height(simulator, "pole") == 0.0


def test_a_spawn_keeps_the_pose_of_the_description(tmp_path: Path) -> None:
    simulator = Simulator(robot(tmp_path, 'xyz="0 0 0"'), spawn=Spawn(z=0.0), note=lambda _: None)
    assert height(simulator, "torso") == 0.0
