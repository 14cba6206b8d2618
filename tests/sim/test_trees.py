"""Models of a world with joints and plugins: doors, drawers, robots in SDF, and URDF robots that a world includes."""

from __future__ import annotations

import re
from math import cos, pi, sin, sqrt
from pathlib import Path

import pytest

from urdfkit.errors import SimulationError
from urdfkit.sim import Simulator, Spawn

G = 9.81
WORLD = """<sdf version="1.9"><world name="probe"><gravity>0 0 -9.81</gravity>{inside}</world></sdf>"""
GROUND = """<model name="ground_plane"><static>true</static><link name="link"><collision name="c"><geometry><plane>
<normal>0 0 1</normal></plane></geometry></collision></link></model>"""
LINK = """<link name="{name}"><pose>{pose}</pose><inertial><pose>{centre} 0 0 0</pose><mass>{mass}</mass><inertia>
<ixx>{inertia}</ixx><iyy>{inertia}</iyy><izz>{inertia}</izz></inertia></inertial>{more}</link>"""


def link(name: str, *, pose: str = "0 0 0 0 0 0", centre: str = "0 0 0", mass: float = 1.0, more: str = "") -> str:
    return LINK.format(name=name, pose=pose, centre=centre, mass=mass, inertia=0.01, more=more)


def joint(kind: str, parent: str, child: str, axis: str = "", pose: str = "0 0 0 0 0 0") -> str:
    written = f"<axis>{axis}</axis>" if axis else ""
    ends = f"<parent>{parent}</parent><child>{child}</child>"
    return f'<joint name="joint" type="{kind}"><pose>{pose}</pose>{ends}{written}</joint>'


def write(folder: Path, inside: str) -> Path:
    path = folder / "probe.world"
    path.write_text(WORLD.format(inside=inside))
    return path


def simulate(folder: Path, inside: str, *, robot: str | Path = "simpleton", **options: object) -> Simulator:
    return Simulator(robot, world=write(folder, inside), spawn=Spawn(x=-5.0, z=0.0), **options)  # type: ignore[arg-type]


PENDULUM = f"""<model name="gallows"><pose>2 0 3 0 0 0</pose>
{link("arm", pose="0.3 0 0 0 0.4 0", centre="0 0 -0.5")}
{joint("revolute", "world", "arm", "<xyz>0 1 0</xyz>")}</model>"""


def test_a_pendulum_hung_on_the_world_keeps_its_energy(tmp_path: Path) -> None:
    simulator = simulate(tmp_path, PENDULUM)
    arm = simulator.world.robots["gallows"]
    assert simulator.world.body_poses()["gallows::arm"][:3] == pytest.approx((2.3, 0.0, 3.0))
    start = sum(arm.state.energy)
    fastest = 0.0
    for _ in range(100):
        simulator.run(0.01)
        fastest = max(fastest, abs(arm.state.velocity("joint")))
    # It swings through 0.4 rad about its hinge: ω² = 2·m·g·l·(1 − cos 0.4) / (I + m·l²).
    assert fastest == pytest.approx(sqrt(2 * G * 0.5 * (1 - 0.9210609940028851) / 0.26), rel=2e-3)
    assert sum(arm.state.energy) == pytest.approx(start, abs=1e-3)


def test_a_joint_moves_about_the_axis_at_the_place_that_the_file_says(tmp_path: Path) -> None:
    frame = link("frame", mass=5.0)
    panel = link("panel", pose="1 0 0 0 0 1.5707963267948966", more="<self_collide>false</self_collide>")
    axis = '<xyz expressed_in="__model__">0 0 1</xyz><limit><lower>-1</lower><upper>0.5</upper></limit>'
    hinge = joint("revolute", "frame", "panel", axis, pose="0 0.5 0 0.3 0.2 0.1")
    wall = joint("fixed", "world", "frame").replace('name="joint"', 'name="bolt"')
    simulator = simulate(tmp_path, f'<model name="door"><pose>0 3 1 0 0 0</pose>{frame}{panel}{wall}{hinge}</model>')
    door = simulator.world.robots["door"]
    assert door.kinematics.limits("joint") == (-1.0, 0.5)
    assert simulator.world.body_poses()["door::panel"][:3] == pytest.approx((1.0, 3.0, 1.0), abs=1e-12)
    simulator.world.push("door::panel", (0.0, 50.0, 0.0), for_seconds=0.5)
    simulator.run(0.5)
    assert door.state.position("joint") == pytest.approx(0.5, abs=1e-4)
    x, y, z = simulator.world.body_poses()["door::panel"][:3]
    # The hinge is at (0.5, 3): the panel's origin stays half a metre from it, turned by 0.5 rad, level with it.
    assert (x - 0.5, y - 3.0, z - 1.0) == pytest.approx((0.5 * cos(0.5), 0.5 * sin(0.5), 0.0), abs=1e-4)


def test_a_drawer_slides_with_damping_and_stops(tmp_path: Path) -> None:
    axis = "<xyz>1 0 0</xyz><limit><lower>0</lower><upper>0.3</upper></limit><dynamics><damping>2</damping></dynamics>"
    desk = link("desk", mass=30.0) + link("drawer") + joint("prismatic", "desk", "drawer", axis)
    bolt = joint("fixed", "world", "desk").replace('name="joint"', 'name="bolt"')
    simulator = simulate(tmp_path, f'<model name="desk">{desk}{bolt}</model>')
    simulator.world.push("desk::drawer", (1.0, 0.0, 0.0))
    simulator.run(0.4)
    # v = F/d·(1 − exp(−d·t/m))
    assert simulator.world.robots["desk"].state.velocity("joint") == pytest.approx(
        0.5 * (1 - 2.718281828 ** (-0.8)), rel=2e-3
    )
    simulator.run(2.0)
    assert simulator.world.robots["desk"].state.position("joint") == pytest.approx(0.3, abs=1e-4)


def test_joints_may_point_to_the_root(tmp_path: Path) -> None:
    # Both arms say that the hub is their child: the tree is walked against its arrows.
    parts = link("hub", mass=9.0) + link("a", pose="1 0 0 0 0 0") + link("b", pose="-1 0 0 0 0 0")
    hinges = "".join(
        joint("revolute", arm, "hub", "<xyz>0 0 1</xyz>").replace('name="joint"', f'name="{arm}_joint"') for arm in "ab"
    )
    simulator = simulate(tmp_path, f'<model name="fan"><pose>0 2 1 0 0 0</pose>{parts}{hinges}</model>')
    fan = simulator.world.robots["fan"]
    poses = simulator.world.body_poses()
    assert [poses[f"fan::{name}"][0] for name in ("hub", "a", "b")] == pytest.approx([0.0, 1.0, -1.0])
    simulator.world.push("fan::a", (0.0, 0.5, 0.0), for_seconds=0.1)
    simulator.run(0.1)
    # Arm a turns about +z; its joint counts how the hub, its child, turns in it.
    assert fan.state.velocity("a_joint") < -0.01


@pytest.mark.parametrize(
    ("inside", "reported"),
    [
        (link("a") + link("b") + joint("ball", "a", "b"), "joint `joint` of model `thing` is ball, which cannot"),
        (
            link("a") + link("b") + joint("revolute", "a", "b", "<xyz>0 0 1</xyz><dynamics><spring_stiffness>3"
            "</spring_stiffness></dynamics>"),
            "has a spring of 3, which cannot be simulated: remove <spring_stiffness>",
        ),
        (
            link("a") + link("b") + "".join(
                joint("revolute", "a", "b", "<xyz>0 0 1</xyz>").replace('"joint"', f'"{name}"') for name in "xy"
            ),
            "joint `y` of model `thing` closes a loop",
        ),
    ],
)  # fmt: skip
def test_what_cannot_be_simulated_is_refused_with_its_place(tmp_path: Path, inside: str, reported: str) -> None:
    with pytest.raises(SimulationError, match=reported) as caught:
        simulate(tmp_path, f'<model name="thing">{inside}</model>')
    assert re.search(r"probe\.world:\d+:\d+: joint", str(caught.value))


CART = f"""<model name="cart"><pose>0 0 0.1 0 0 {pi / 2}</pose>
{
    link(
        "chassis",
        mass=3.0,
        more='<collision name="ball"><pose>-0.2 0 -0.05 0 0 0</pose><geometry><sphere><radius>0.05</radius>'
        "</sphere></geometry><surface><friction><ode><mu>0</mu><mu2>0</mu2></ode></friction></surface></collision>",
    )
}
{
    "".join(
        link(
            f"{side}_wheel",
            pose=f"0 {y} 0 -1.5707963267948966 0 0",
            mass=0.5,
            more='<collision name="c"><geometry>'
            "<cylinder><radius>0.1</radius><length>0.04</length></cylinder></geometry></collision>",
        )
        + joint("revolute", "chassis", f"{side}_wheel", "<xyz>0 0 1</xyz>").replace('"joint"', f'"{side}_joint"')
        for side, y in (("left", 0.15), ("right", -0.15))
    )
}
<plugin filename="gz-sim-diff-drive-system" name="gz::sim::systems::DiffDrive"><left_joint>left_joint</left_joint>
<right_joint>right_joint</right_joint><wheel_separation>0.3</wheel_separation><wheel_radius>0.1</wheel_radius>
<topic>/cart/cmd_vel</topic></plugin></model>"""


@pytest.mark.parametrize("nested", [False, True])
def test_a_robot_written_in_sdf_drives(tmp_path: Path, nested: bool) -> None:
    inside = f'<model name="garage"><pose>1 0 0 0 0 0</pose>{CART}</model>' if nested else CART
    simulator = simulate(tmp_path, GROUND + inside)
    name = "garage" if nested else "cart"
    from urdfkit.messages import TWIST, twist

    simulator.run(0.3)
    before = simulator.world.robots[name].state.base_pose
    assert before[0] == pytest.approx(1.0 if nested else 0.0, abs=1e-3)
    simulator.bus.publish("/cart/cmd_vel", TWIST, twist((0.2, 0, 0), (0, 0, 0)))
    simulator.run(2.0)
    after = simulator.world.robots[name].state.base_pose
    assert after[1] - before[1] == pytest.approx(0.4, abs=5e-3)  # it looks along y
    assert after[0] == pytest.approx(before[0], abs=1e-3)


def test_a_urdf_in_a_world_runs_as_if_it_were_the_one(tmp_path: Path) -> None:
    text = """<robot name="cart"><link name="base"><collision><geometry><box size="0.2 0.2 0.2"/></geometry></collision>
    <inertial><mass value="1"/><inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial></link>
    <gazebo><plugin name="m" filename="libgazebo_ros_planar_move.so"><commandTopic>/cart/cmd</commandTopic>
    <odometryTopic>/cart/odom</odometryTopic></plugin></gazebo></robot>"""
    (tmp_path / "cart.urdf").write_text(text)
    include = "<include><uri>cart.urdf</uri><name>{}</name><pose>{} 0 0.1 0 0 0</pose>{}</include>"
    inside = GROUND + include.format("cart", 0, "") + include.format("post", 3, "<static>true</static>")
    simulator = simulate(tmp_path, inside)
    from urdfkit.messages import TWIST, twist

    simulator.bus.publish("/cart/cmd", TWIST, twist((0.5, 0, 0), (0, 0, 0)))
    simulator.run(1.0)
    # Of what the plugin sets in each step, friction takes mu·g·dt halfway through it.
    assert simulator.world.robots["cart"].state.base_pose[0] == pytest.approx(0.5 - 0.5 * 9.81 * 0.001, abs=1e-5)
    assert simulator.world.body_poses()["post::base"][0] == 3.0
    assert "post" not in simulator.world.robots
