"""Mimic joints, limits, soundness, shapes: what a robot's joints and links are taken for."""

from __future__ import annotations

import math

import numpy as np
import pinocchio as pin
import pytest

from tests.sim.engine.conftest import collision, joint, link, robot
from urdfkit.errors import SimulationError
from urdfkit.sim.engine import Surface
from urdfkit.sim.engine.contacts import ground_contacts

BODY = (
    '<link name="{name}"><inertial><origin xyz="0 0 0.1"/><mass value="1"/>'
    '<inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial></link>'
)
GRIPPER = (
    '<robot name="gripper"><link name="base"/>'
    + BODY.format(name="left")
    + BODY.format(name="right")
    + '<joint name="a" type="revolute"><parent link="base"/><child link="left"/><axis xyz="1 0 0"/>'
    '<limit lower="-1" upper="1.5" effort="10" velocity="5"/></joint>'
    '<joint name="b" type="revolute"><parent link="base"/><child link="right"/><axis xyz="0 1 0"/>'
    '<limit lower="-3" upper="3" effort="10" velocity="5"/>'
    '<mimic joint="a" multiplier="-2" offset="0.1"/></joint></robot>'
)


def test_mimic_joint_follows_and_both_carry_the_load(engine_of):
    engine = engine_of(GRIPPER, gravity=(0.0, 0.0, 0.0))
    a, b = (engine.kinematics.velocity_index(name) for name in "ab")
    engine.applied[a] = 0.3
    engine.step(500)
    # The effort moves I + (-2)²·I, I = 0.01 + 1·0.1².
    assert engine.v[a] == pytest.approx(0.5 * 0.3 / (0.02 * 5.0), rel=1e-6)
    assert engine.positions[b] == pytest.approx(-2.0 * engine.positions[a] + 0.1, abs=1e-6)


def test_mimic_joint_of_a_motor(engine_of):
    engine = engine_of(GRIPPER)
    a, b = (engine.kinematics.velocity_index(name) for name in "ab")
    engine.motor_velocity[a], engine.motor_effort[a] = 0.5, 50.0
    engine.step(1000)
    assert engine.positions[a] == pytest.approx(0.5, abs=1e-3)
    assert engine.positions[b] == pytest.approx(-2.0 * engine.positions[a] + 0.1, abs=1e-6)


def test_damping_slows_as_an_exponential(engine_of):
    text = GRIPPER.replace('<mimic joint="a" multiplier="-2" offset="0.1"/>', '<dynamics damping="0.04"/>')
    engine = engine_of(text, gravity=(0.0, 0.0, 0.0))
    b = engine.kinematics.velocity_index("b")
    v = np.zeros(2)
    v[b] = 1.0
    engine.reset(None, v)
    engine.step(500)
    assert engine.v[b] == pytest.approx(math.exp(-0.04 / 0.02 * 0.5), rel=2e-3)
    assert engine.tau[b] == pytest.approx(-0.04 * engine.v[b], rel=1e-9)


@pytest.mark.parametrize(
    ("broken", "lacks"),
    [('<mass value="1"/>', "mass"), ('<inertial><origin xyz="0 0 0.1"/><mass value="1"/>', "mass")],
)
def test_a_joint_with_nothing_to_move_is_refused(engine_of, broken, lacks):
    text = GRIPPER.replace(broken, broken.replace('value="1"', 'value="0"')).replace("0.01", "0")
    with pytest.raises(
        SimulationError, match=rf"probe.urdf:\d+:\d+: joint `a` moves link `left`, which has no {lacks}"
    ):
        engine_of(text)


def test_wrong_states_are_refused(engine_of):
    engine = engine_of(GRIPPER)
    with pytest.raises(SimulationError, match="shape"):
        engine.reset(np.zeros(3))
    with pytest.raises(SimulationError, match="not finite"):
        engine.reset(np.array([0.0, math.nan]))
    with pytest.raises(SimulationError, match="invalid time step"):
        engine_of(GRIPPER, dt=0.0)


def test_a_cylinder_that_turns_about_its_axis_is_a_wheel(engine_of):
    kinds = [touch.kind for touch in engine_of("diff_drive").collision_shapes]
    assert kinds == [ground_contacts.BOX, ground_contacts.SPHERE, ground_contacts.WHEEL, ground_contacts.WHEEL]
    assert [touch.kind for touch in engine_of("can").collision_shapes] == [ground_contacts.CYLINDER]


MESH = """<robot name="m"><link name="base"><inertial><mass value="1"/><inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0"
ixz="0" iyz="0"/></inertial><collision><geometry><mesh filename="{file}"/></geometry></collision></link></robot>"""


@pytest.mark.parametrize("kind", ["box", "cylinder"])
def test_a_mesh_stands_on_its_convex_hull(engine_of, tmp_path, kind):
    import trimesh

    if kind == "box":
        mesh = trimesh.creation.box((0.2, 0.3, 0.1))
    else:
        mesh = trimesh.creation.cylinder(radius=0.1, height=0.1, sections=64)
    mesh.export(tmp_path / "part.stl")
    engine = engine_of(MESH.format(file=str(tmp_path / "part.stl")), floating=True)
    q = engine.kinematics.neutral()
    q[2] = 0.06
    engine.reset(q)
    engine.step(1000)
    assert engine.q[2] == pytest.approx(0.05, abs=1e-6)
    assert np.abs(engine.v).max() < 1e-9
    assert 3 <= len(engine.contacts()) <= 8
    assert sum(contact.force[2] for contact in engine.contacts()) == pytest.approx(9.81, rel=1e-6)


def test_a_wheel_of_a_bolted_robot_turns_though_it_touches_the_ground(engine_of):
    for effort in (2.0, np.inf):
        engine = engine_of("diff_drive", floating=False, base=[0.0, 0.0, 0.06, 0.0, 0.0, 0.0, 1.0])
        engine.motor_velocity[:], engine.motor_effort[:] = (5.0, -3.0), effort
        engine.step(200)
        assert engine.v == pytest.approx([5.0, -3.0], rel=1e-6)
        assert engine.iterated == 0
        assert engine.contacts() == ()


def test_a_hinged_link_that_meets_the_ground_lies_on_it(engine_of):
    engine = engine_of("flap")
    engine.step(1500)
    blows = engine.iterated
    engine.step(500)
    # Its ball touches when it hangs 0.25 m below the hinge.
    assert math.sin(engine.positions[0]) == pytest.approx(0.25, abs=1e-4)
    assert abs(engine.v[0]) < 1e-9
    assert engine.iterated == blows


@pytest.mark.parametrize("dt", [0.001, 0.005])
@pytest.mark.parametrize("sides", [16, 96])
def test_a_wheel_given_as_a_mesh_rolls(engine_of, texts, tmp_path, sides, dt):
    import trimesh

    wheel = trimesh.creation.cylinder(radius=0.06, height=0.03, sections=sides)
    # Anywhere in its own file: what counts is where it is on the joint's axis.
    wheel.apply_translation((0.2, 0.1, 0.3))
    wheel.export(tmp_path / "wheel.stl")
    placed = f'<origin xyz="-0.2 -0.1 -0.3"/><geometry><mesh filename="{tmp_path / "wheel.stl"}"/></geometry>'
    text = texts["diff_drive"].replace(
        '<origin xyz="0 0 0" rpy="0 0 0"/><geometry><cylinder radius="0.06" length="0.03"/></geometry>', placed
    )
    assert text.count("wheel.stl") == 2
    engine = engine_of(text, dt=dt, surfaces={"base": Surface(0.0, 0.0)})
    q = engine.kinematics.neutral()
    q[2] = 0.06
    engine.reset(q)
    engine.motor_effort[6:], engine.motor_velocity[6:] = 1.0, 5.0
    engine.step(round(1.0 / dt))
    start = float(engine.q[0])
    engine.step(round(2.0 / dt))
    assert engine.q[0] - start == pytest.approx(2.0 * 5.0 * 0.06, rel=1e-3)
    assert engine.iterated == 0


def test_a_round_body_stands_on_its_lowest_corner(engine_of, tmp_path):
    import trimesh

    ball = trimesh.creation.icosphere(subdivisions=3)
    ball.apply_scale((0.3, 0.2, 0.1))
    ball.export(tmp_path / "part.stl")
    engine = engine_of(MESH.format(file=str(tmp_path / "part.stl")), floating=True)
    q = engine.kinematics.neutral()
    q[2] = 0.11
    engine.reset(q)
    for _ in range(20):
        engine.step(100)
        lowest = (ball.vertices @ pin.Quaternion(engine.q[3:7].copy()).matrix().T)[:, 2].min() + engine.q[2]
        assert lowest > -1e-4


@pytest.mark.parametrize(("dt", "most"), [(0.001, 50.0), (0.005, 1.0)])
@pytest.mark.parametrize("mode", ["servo", "motor", "effort"])
def test_no_joint_passes_its_limit_however_hard_it_is_driven(engine_of, mode, dt, most):
    engine = engine_of("arm", dt=dt)
    lower, upper = engine.kinematics.model.lowerPositionLimit, engine.kinematics.model.upperPositionLimit
    random = np.random.default_rng(2)
    furthest, reached = -math.inf, 0
    for _ in range(round(4.0 / dt)):
        if engine.steps % round(0.1 / dt) == 0:
            if mode == "servo":
                engine.kp[:], engine.kd[:], engine.servo_effort[:] = 10.0 * most, 0.1 * most, most
                engine.position_target[:] = random.uniform(-4.0, 4.0, 7)
            elif mode == "motor":
                engine.motor_effort[:], engine.motor_velocity[:] = most, random.uniform(-20.0, 20.0, 7)
            else:
                engine.applied[:] = random.uniform(-most, most, 7)
        engine.step()
        beyond = float(max((engine.q - upper).max(), (lower - engine.q).max()))
        furthest, reached = max(furthest, beyond), reached + (beyond > -1e-6)
    assert reached > 20
    assert furthest < 1e-8


def test_what_starts_in_the_ground_rises_from_it_and_does_not_jump(engine_of):
    engine = engine_of("box")
    engine.reset(engine.kinematics.neutral())  # 5 cm deep
    heights = []
    for _ in range(100):
        engine.step(20)
        heights.append(float(engine.q[2]))
    assert max(heights) < 0.051
    assert heights[-1] == pytest.approx(0.05, abs=1e-6)


def test_divergence_of_a_free_robot_names_its_root_link(engine_of):
    engine = engine_of("box")
    engine.reset(engine.kinematics.neutral(), np.array([1e300, 0.0, 0.0, 0.0, 0.0, 0.0]))
    with pytest.raises(SimulationError, match="root link `body`"):
        engine.step(10)


def test_a_joint_that_starts_far_beyond_its_limit_comes_back_slowly(engine_of):
    engine = engine_of("arm")
    q = engine.kinematics.neutral()
    q[1] = 3.5  # the limit is 2.5
    engine.reset(q)
    speeds = []
    for _ in range(1500):
        engine.step()
        speeds.append(abs(engine.v).max())
    assert engine.positions[1] < 2.6
    assert max(speeds) < 60.0


def test_joints_beyond_their_limits_return_under_the_weight_of_a_robot(engine_of):
    """Four legs with box feet: more rows than dofs, whose corrections contradict each other."""
    shin = collision('<box size="0.03 0.03 0.2"/>', xyz="0 0 -0.1")
    parts = [link("base", 10.0, (0.05, 0.15, 0.2), collision('<box size="0.4 0.2 0.1"/>'))]
    for k, (x, y) in enumerate(((0.18, 0.12), (0.18, -0.12), (-0.18, 0.12), (-0.18, -0.12))):
        parts += [
            link(f"hip{k}", 0.5, (0.001, 0.001, 0.001)),
            link(f"thigh{k}", 1.0, (0.004, 0.004, 0.001), at="0 0 -0.1"),
            link(f"shin{k}", 0.3, (0.001, 0.001, 0.0001), shin, at="0 0 -0.1"),
            joint(f"roll{k}", "revolute", "base", f"hip{k}", xyz=f"{x} {y} 0", axis="1 0 0", more=limit(-1, 1)),
            joint(f"pitch{k}", "revolute", f"hip{k}", f"thigh{k}", axis="0 1 0", more=limit(-1.5, 3.4)),
            joint(
                f"knee{k}", "revolute", f"thigh{k}", f"shin{k}", xyz="0 0 -0.2", axis="0 1 0", more=limit(-2.7, -0.9)
            ),
        ]
    engine = engine_of(robot(*parts), floating=True)
    q = engine.kinematics.neutral()
    q[2] = 0.4
    engine.reset(q)
    engine.kd[6:] = 100.0
    engine.servo_effort[6:] = 1000.0
    engine.step(300)
    knees = engine.q[9::3]
    assert knees == pytest.approx(-0.3, abs=0.03)
    engine.step(1200)
    assert engine.q[9::3].max() < -0.9 + 1e-3


def limit(lower, upper):
    return f'<limit lower="{lower}" upper="{upper}" effort="30" velocity="20"/>'
