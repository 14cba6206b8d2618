"""Links that gravity leaves alone, and links that touch others of their robot."""

from __future__ import annotations

from math import cos, sqrt
from pathlib import Path

import numpy as np
import pytest

from tests.reference_engine import ENGINES, ReferenceEngine
from urdfkit.description import load
from urdfkit.description.loading import load_repaired
from urdfkit.kinematics import Kinematics
from urdfkit.lint import lint
from urdfkit.scene import scene_of
from urdfkit.sim import Simulator, Spawn
from urdfkit.sim.construction.link_options import self_colliding, weightless_links
from urdfkit.sim.engine import Engine, Ground
from urdfkit.sim.world import world_builder

G = 9.81
HINGE = """<joint name="hinge" type="continuous"><parent link="world"/><child link="rod"/><axis xyz="0 1 0"/></joint>"""


def link(name: str, mass: float, *, at: str = "0 0 0", shape: str = "") -> str:
    return (
        f'<link name="{name}"><inertial><origin xyz="{at}"/><mass value="{mass}"/><inertia ixx="0.01" iyy="0.01" '
        f'izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial>{shape}</link>'
    )


def fixed(parent: str, child: str, xyz: str) -> str:
    return (
        f'<joint name="{child}_joint" type="fixed"><origin xyz="{xyz}"/><parent link="{parent}"/>'
        f'<child link="{child}"/></joint>'
    )


def block(inside: str, link: str | None = None) -> str:
    return f"<gazebo{f' reference={chr(34)}{link}{chr(34)}' if link else ''}>{inside}</gazebo>"


def write(folder: Path, *parts: str) -> Path:
    path = folder / "probe.urdf"
    path.write_text(f'<robot name="probe">{"".join(parts)}</robot>')
    return path


def simulate(folder: Path, *parts: str, **options: object) -> Simulator:
    return Simulator(write(folder, *parts), note=lambda text: None, **options)  # type: ignore[arg-type]


@pytest.mark.parametrize("engine", [Engine, pytest.param(ReferenceEngine, marks=pytest.mark.slow)])
@pytest.mark.parametrize("word", ["<gravity>false</gravity>", "<gravity>0</gravity>", '<gravity value="false"/>'])
def test_a_pendulum_without_gravity_keeps_its_speed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, engine: type[Engine], word: str
) -> None:
    monkeypatch.setattr(world_builder, "Engine", engine)
    text = '<link name="world"/>' + link("rod", 1.0, at="0 0 -0.4") + HINGE + block(word, "rod")
    simulator = simulate(
        tmp_path, text, world="void", spawn=Spawn(z=0, joints={"hinge": 0.5}, velocities={"hinge": 2.0})
    )
    simulator.run(0.5)
    assert simulator.state.velocity("hinge") == pytest.approx(2.0, abs=1e-12)
    assert simulator.state.position("hinge") == pytest.approx(1.5, abs=1e-9)
    assert simulator.state.energy == pytest.approx((0.5 * (0.01 + 0.16) * 4.0, 0.0), abs=1e-9)


def test_true_is_as_nothing_written(tmp_path: Path) -> None:
    text = '<link name="world"/>' + link("rod", 1.0, at="0 0 -0.4") + HINGE
    ends = []
    for word in ("", "<gravity>true</gravity>", "<gravity>1</gravity>", "<turnGravityOff>false</turnGravityOff>"):
        simulator = simulate(tmp_path, text, block(word, "rod"), world="void", spawn=Spawn(z=0, joints={"hinge": 1.0}))
        simulator.run(0.2)
        ends.append(simulator.state.velocity("hinge"))
    assert ends[1:] == ends[:1] * 3
    assert ends[0] < -1.0


def test_the_mass_of_a_rod_without_gravity_still_swings(tmp_path: Path) -> None:
    bob = link("bob", 2.0) + fixed("rod", "bob", "0 0 -0.5")
    text = '<link name="world"/>' + link("rod", 1.0, at="0 0 -0.25") + bob + HINGE
    off = block("<gravity>false</gravity>", "rod")
    simulator = simulate(tmp_path, text, off, world="void", spawn=Spawn(z=0, joints={"hinge": 1.0}))
    energy = sum(simulator.state.energy)
    fastest = 0.0
    for _ in range(1000):
        simulator.step()
        fastest = max(fastest, abs(simulator.state.velocity("hinge")))
    inertia = 0.01 + 1.0 * 0.25**2 + 0.01 + 2.0 * 0.5**2
    assert fastest == pytest.approx(sqrt(2 * 2.0 * G * 0.5 * (1 - cos(1.0)) / inertia), rel=1e-5)
    assert sum(simulator.state.energy) == pytest.approx(energy, abs=1e-6)


def test_half_the_weight_falls_half_as_fast(tmp_path: Path) -> None:
    text = link("one", 1.0) + link("other", 1.0) + fixed("one", "other", "0 0 0.2")
    simulator = simulate(tmp_path, text, block("<gravity>false</gravity>", "other"), world="void", spawn=Spawn(z=5.0))
    simulator.run(0.1)
    # Gravity pulls one end, so it tips over too; the centre of mass falls as two masses under the weight of one.
    pose, q = simulator.state.link_poses(), simulator.kinematics.link_names
    height = 0.5 * (pose[q.index("one"), 2] + pose[q.index("other"), 2])
    assert height == pytest.approx(5.1 - 0.5 * (G / 2) * 0.01, abs=1e-9)


@pytest.mark.slow
def test_both_engines_do_the_same_without_gravity(tmp_path: Path) -> None:
    hinge = '<joint name="j" type="continuous"><parent link="a"/><child link="b"/><axis xyz="1 2 3"/></joint>'
    text = link("a", 1.0, at="0.1 0 0") + link("b", 2.0, at="0 0.3 0.1") + link("c", 0.5, at="0.1 0.1 0")
    robot = load(write(tmp_path, text, hinge, fixed("b", "c", "0.1 0.2 0.3")))
    kinematics = Kinematics(robot, floating_base=True)
    ends = []
    for engine_type in ENGINES:
        engine = engine_type(kinematics, (), ground=None, weightless=("a", "c"))
        q, v = kinematics.neutral(), np.linspace(-1.0, 1.0, 7)
        engine.reset(q, v)
        engine.applied[6] = 0.3
        engine.step(50)
        ends.append(np.concatenate([engine.q, engine.v]))
    assert ends[0] == pytest.approx(ends[1], abs=1e-11)


SLIDERS = "".join(
    f'<joint name="{child}_joint" type="prismatic"><origin xyz="{x} 0 0"/><parent link="world"/><child link="{child}"/>'
    '<axis xyz="1 0 0"/><limit lower="-5" upper="5" effort="100" velocity="100"/></joint>'
    for child, x in (("left", 0.0), ("right", 0.5))
)
CUBE = '<collision><geometry><box size="0.2 0.2 0.2"/></geometry></collision>'


SELF_COLLISIONS = (
    ((), False),
    ((("<selfCollide>true</selfCollide>", "left"),), True),
    ((("<self_collide>1</self_collide>", "right"),), True),
    ((("<selfCollide>false</selfCollide>", "left"),), False),
    ((("<self_collide>true</self_collide>", None), ("<selfCollide>false</selfCollide>", "left")), True),
    (
        (
            ("<self_collide>true</self_collide>", None),
            ("<selfCollide>0</selfCollide>", "left"),
            ("<selfCollide>0</selfCollide>", "right"),
        ),
        False,
    ),
)


@pytest.mark.parametrize(
    ("words", "stopped", "engine"),
    [
        *((*case, Engine) for case in SELF_COLLISIONS),
        *(pytest.param(*case, ReferenceEngine, marks=pytest.mark.slow) for case in SELF_COLLISIONS[:2]),
    ],
)
def test_arms_that_would_pass_through_each_other_stop(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, words, stopped: bool, engine: type[Engine]
) -> None:
    monkeypatch.setattr(world_builder, "Engine", engine)
    text = '<link name="world"/>' + link("left", 1.0, shape=CUBE) + link("right", 3.0, shape=CUBE) + SLIDERS
    blocks = [block(*word) for word in words]
    spawn = Spawn(z=0, velocities={"left_joint": 1.0})
    simulator = simulate(tmp_path, text, *blocks, world="void", gravity=(0, 0, 0), spawn=spawn)
    simulator.run(0.6)
    speeds = [simulator.state.velocity(f"{name}_joint") for name in ("left", "right")]
    # 0.3 m apart, they meet after 0.3 s without rebound: 1 kg at 1 m/s becomes 4 kg at 0.25 m/s.
    assert speeds == pytest.approx([0.25, 0.25] if stopped else [1.0, 0.0], abs=1e-9)
    gap = 0.3 + simulator.state.position("right_joint") - simulator.state.position("left_joint")
    assert gap == pytest.approx(0.0 if stopped else -0.3, abs=1e-6)


def test_links_joined_by_a_joint_never_touch(tmp_path: Path) -> None:
    hinge = '<joint name="j" type="continuous"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/></joint>'
    text = link("a", 1.0, shape=CUBE) + link("b", 1.0, shape=CUBE) + hinge
    simulator = simulate(tmp_path, text, block("<self_collide>true</self_collide>"), world="void", spawn=Spawn(z=1.0))
    simulator.run(0.05)
    assert simulator.state.contacts == ()


def test_a_model_of_the_world_says_it_in_sdf(tmp_path: Path) -> None:
    inertial = "<inertial><mass>{}</mass><inertia><ixx>0.01</ixx><iyy>0.01</iyy><izz>0.01</izz></inertia></inertial>"
    cube = '<collision name="c"><geometry><box><size>0.2 0.2 0.2</size></box></geometry></collision>'
    slide = (
        '<joint name="{0}_joint" type="prismatic"><parent>base</parent><child>{0}</child>'
        "<axis><xyz>1 0 0</xyz></axis></joint>"
    )
    arms = "".join(
        f'<link name="{name}"><pose>{x} 0 0 0 0 0</pose>{inertial.format(mass)}{cube}{more}</link>{slide.format(name)}'
        for name, x, mass, more in (("left", 0.0, 1.0, "<self_collide>true</self_collide>"), ("right", 0.5, 3.0, ""))
    )
    base = f'<link name="base">{inertial.format(1.0)}</link>'
    base += '<joint name="bolt" type="fixed"><parent>world</parent><child>base</child></joint>'
    balloon = f'<link name="l">{inertial.format(1.0)}<gravity>0</gravity></link>'
    world = tmp_path / "probe.world"
    world.write_text(
        '<sdf version="1.9"><world name="probe"><gravity>0 0 -9.81</gravity>'
        f'<model name="arms"><pose>0 0 2 0 0 0</pose>{base}{arms}</model>'
        f'<model name="balloon"><pose>5 0 3 0 0 0</pose>{balloon}</model></world></sdf>'
    )
    simulator = Simulator("simpleton", world=world, spawn=Spawn(x=-5.0, z=0.0), note=lambda text: None)
    robot = simulator.world.robots["arms"]
    robot.motors.drive("left_joint", 0.2, 1e3)
    simulator.run(3.0)
    assert robot.state.velocity("right_joint") == pytest.approx(0.2, abs=1e-6)
    assert simulator.world.body_poses()["balloon"][:3] == pytest.approx((5.0, 0.0, 3.0), abs=1e-12)


def test_what_is_written_is_read(tmp_path: Path) -> None:
    text = link("a", 1.0) + link("b", 1.0) + fixed("a", "b", "0 0 1")
    robot = load(write(tmp_path, text, block("<gravity>False</gravity><selfCollide>TRUE</selfCollide>", "a")))
    assert (weightless_links(robot), self_colliding(robot)) == ({"a"}, {"a"})
    robot = load(write(tmp_path, text, block("<turnGravityOff>true</turnGravityOff>", "b")))
    assert (weightless_links(robot), self_colliding(robot)) == ({"b"}, frozenset())


@pytest.mark.parametrize("tag", ["gravity", "turnGravityOff", "selfCollide", "self_collide"])
def test_a_value_that_is_neither_true_nor_false_is_ignored_and_reported(tmp_path: Path, tag: str) -> None:
    path = write(tmp_path, link("a", 1.0), "\n", block(f"<{tag}>maybe</{tag}>", "a"))
    robot = load_repaired(path)
    assert (weightless_links(robot), self_colliding(robot)) == (frozenset(), frozenset())
    (repair,) = robot.repairs
    (finding,) = [each for each in lint(path) if each.code == "E010"]
    assert repair.position is not None
    assert (repair.code, repair.position.line) == ("E010", finding.line)
    assert finding.message == f"<{tag}>: `maybe` is not true or false"


def test_the_engine_takes_names_or_all(tmp_path: Path) -> None:
    text = '<link name="world"/>' + link("left", 1.0, shape=CUBE) + link("right", 3.0, shape=CUBE) + SLIDERS
    robot = load(write(tmp_path, text))
    kinematics, shapes = Kinematics(robot), scene_of(robot).with_role("collision")
    for asked, expected in ((True, 0.25), (("right",), 0.25), ((), 1.0), (False, 1.0)):
        engine = Engine(kinematics, shapes, gravity=(0, 0, 0), ground=Ground(-9.0), self_collide=asked)
        engine.reset(kinematics.neutral(), np.array([1.0, 0.0]))
        engine.step(500)
        assert engine.v[0] == pytest.approx(expected, abs=1e-9)


def test_energy_of_a_robot_of_the_world_leaves_out_what_gravity_does_not_pull(tmp_path: Path) -> None:
    inertial = "<inertial><pose>{} 0 0 0 0 0</pose><mass>2</mass><inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz>"
    inertial += "</inertia></inertial>"
    links = "".join(
        f'<link name="{name}"><pose>{x} 0 0 0 0 0</pose>{inertial.format(at)}<gravity>{pulled}</gravity></link>'
        for name, x, at, pulled in (("rod", 0.0, 0.5, 0), ("bob", 1.0, 0.0, 1))
    )
    joints = (
        '<joint name="hinge" type="revolute"><parent>world</parent><child>rod</child><axis><xyz>0 1 0</xyz></axis>'
        '</joint><joint name="weld" type="fixed"><parent>rod</parent><child>bob</child></joint>'
    )
    world = tmp_path / "probe.world"
    world.write_text(
        '<sdf version="1.9"><world name="probe"><gravity>0 0 -9.81</gravity>'
        f'<model name="arm"><pose>0 0 3 0 0 0</pose>{links}{joints}</model></world></sdf>'
    )
    simulator = Simulator("simpleton", world=world, spawn=Spawn(x=-5.0, z=0.0), note=lambda text: None)
    arm = simulator.world.robots["arm"]
    assert arm.state.energy == pytest.approx((0.0, 2.0 * G * 3.0), abs=1e-9)
    simulator.run(0.3)
    assert sum(arm.state.energy) == pytest.approx(2.0 * G * 3.0, abs=1e-4)
    # It turns about its hinge as all its mass does under the weight of the bob: 2·g·1 / (0.2 + 2·0.25 + 2·1).
    assert arm.state.velocity("hinge") == pytest.approx(0.3 * 2.0 * G / 2.7, rel=0.1)
