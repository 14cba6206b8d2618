"""The same closed forms with models as others write them: masses, sizes, axes, offsets, meshes, roots, steps."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pinocchio as pin
import pytest
import trimesh

from urdfkit.sim import Simulator, Spawn

G = 9.81
Start = Callable[..., Simulator]
QUARTER = math.pi / 2


@pytest.fixture
def start(tmp_path: Path) -> Start:
    """Return a maker of simulators: the text of a URDF, and the simulator's options."""

    def make(*parts: str, **options: Any) -> Simulator:
        file = tmp_path / "model.urdf"
        file.write_text(f'<robot name="probe">{"".join(parts)}</robot>')
        return Simulator(file, note=lambda text: None, **options)

    return make


def link(name: str, mass: float, inertia: Any, shape: str = "", *, at: str = "0 0 0", rpy: str = "0 0 0") -> str:
    x, y, z = inertia
    return (
        f'<link name="{name}"><inertial><origin xyz="{at}" rpy="{rpy}"/><mass value="{mass}"/>'
        f'<inertia ixx="{x}" iyy="{y}" izz="{z}" ixy="0" ixz="0" iyz="0"/></inertial>{shape}</link>'
    )


def collision(geometry: str, *, xyz: str = "0 0 0", rpy: str = "0 0 0") -> str:
    return f'<collision><origin xyz="{xyz}" rpy="{rpy}"/><geometry>{geometry}</geometry></collision>'


def joint(
    name: str, kind: str, parent: str, child: str, axis: str, *, xyz: str = "0 0 0", rpy: str = "0 0 0", more: str = ""
) -> str:
    return (
        f'<joint name="{name}" type="{kind}"><origin xyz="{xyz}" rpy="{rpy}"/><parent link="{parent}"/>'
        f'<child link="{child}"/><axis xyz="{axis}"/>{more}</joint>'
    )


def rough(name: str, mu: float) -> str:
    return f'<gazebo reference="{name}"><mu1>{mu}</mu1><mu2>{mu}</mu2></gazebo>'


def box(*size: float) -> str:
    return f'<box size="{size[0]} {size[1]} {size[2]}"/>'


def box_inertia(mass: float, x: float, y: float, z: float) -> tuple[float, float, float]:
    return mass / 12 * (y * y + z * z), mass / 12 * (x * x + z * z), mass / 12 * (x * x + y * y)


def limit(low: float, high: float) -> str:
    return f'<limit lower="{low}" upper="{high}" effort="1000" velocity="1000"/>'


def leaning(angle: float, towards: float = 0.0) -> tuple[float, float, float]:
    return G * math.sin(angle) * math.cos(towards), G * math.sin(angle) * math.sin(towards), -G * math.cos(angle)


BOXES = {
    "plain": (link("body", 1.0, box_inertia(1, 0.2, 0.2, 0.1), collision(box(0.2, 0.2, 0.1))), 0.05),
    "light": (link("body", 0.01, box_inertia(0.01, 0.05, 0.05, 0.02), collision(box(0.05, 0.05, 0.02))), 0.01),
    "heavy": (link("body", 1e3, box_inertia(1e3, 1, 2, 0.5), collision(box(1, 2, 0.5))), 0.25),
    "long": (link("body", 2.0, box_inertia(2, 2, 0.05, 0.05), collision(box(2, 0.05, 0.05))), 0.025),
    "thin": (link("body", 1.0, box_inertia(1, 0.01, 0.5, 0.01), collision(box(0.01, 0.5, 0.01))), 0.005),
    "off centre": (
        link("body", 1.0, (0.004, 0.004, 0.007), collision(box(0.3, 0.3, 0.1)), at="0.03 0.02 -0.02", rpy="0.3 0.2 1"),
        0.05,
    ),
    "root at the bottom": (
        link("body", 1.0, box_inertia(1, 0.2, 0.2, 0.1), collision(box(0.2, 0.2, 0.1), xyz="0 0 0.05"), at="0 0 0.05"),
        0.0,
    ),
    "turned shape": (
        link("body", 1.0, box_inertia(1, 0.2, 0.1, 0.2), collision(box(0.2, 0.2, 0.1), rpy=f"{QUARTER} 0 0")),
        0.1,
    ),
    "footprint": (
        '<link name="footprint"/>'
        + link("body", 1.0, box_inertia(1, 0.2, 0.2, 0.1), collision(box(0.2, 0.2, 0.1)), at="0.02 0 0")
        + joint("up", "fixed", "footprint", "body", "1 0 0", xyz="0 0 0.05", rpy="0 0 0.3"),
        0.0,
    ),
    "on its end": (
        link("body", 1.0, (0.01, 0.01, 0.005), collision('<cylinder radius="0.1" length="0.1"/>')),
        0.05,
    ),
}


@pytest.mark.parametrize("dt", [0.001, 0.005, 0.01])
@pytest.mark.parametrize("name", BOXES)
def test_whatever_slides_stops_where_it_should(start: Start, name: str, dt: float) -> None:
    text, height = BOXES[name]
    vx, vy, mu = 1.2, 1.6, 0.5
    spawn = Spawn(x=3.0, y=-2.0, yaw=1.2, twist=(vx, vy, 0, 0, 0, 0))
    simulator = start(text, rough("body", mu), dt=dt, spawn=spawn)
    assert simulator.state.base_pose[2] == pytest.approx(height, abs=1e-12)
    assert simulator.state.base_velocity[:2] == pytest.approx((vx, vy))
    simulator.run(1.5)
    x, y, z = simulator.state.base_pose[:3]
    way = 4.0 / (2 * mu * G)
    assert math.dist((x, y), (3.0 + 0.6 * way, -2.0 + 0.8 * way)) < 1e-6 + dt * dt
    assert z == pytest.approx(height, abs=1e-9)


@pytest.mark.parametrize("name", [name for name in BOXES if name not in ("long", "thin")])
@pytest.mark.parametrize("mu", [0.1, 0.5])
def test_whatever_stands_on_an_incline_sticks_or_slides(start: Start, name: str, mu: float) -> None:
    text, _ = BOXES[name]
    for share in (0.95, 0.998, 1.002, 1.05):
        angle = share * math.atan(mu)
        simulator = start(text, rough("body", mu), gravity=leaning(angle, 0.4))
        simulator.run(1.0)
        expected = max(0.0, G * (math.sin(angle) - mu * math.cos(angle)))
        speed = math.hypot(*simulator.state.base_velocity[:2])
        assert speed == pytest.approx(expected, rel=2e-3, abs=1e-9)
        assert math.hypot(*simulator.state.base_pose[:2]) == pytest.approx(expected / 2, rel=5e-3, abs=1e-7)


@pytest.mark.parametrize("dt", [0.001, 0.01])
@pytest.mark.parametrize("shape", ["cylinder", "capsule", "sphere"])
@pytest.mark.parametrize("turned", [False, True])
def test_whatever_is_round_rolls(start: Start, shape: str, turned: bool, dt: float) -> None:
    geometry = '<sphere radius="0.1"/>' if shape == "sphere" else f'<{shape} radius="0.1" length="0.3"/>'
    inertia = (0.008,) * 3 if shape == "sphere" else (0.02, 0.02, 0.01)
    rpy = f"{QUARTER} 0 0" if turned else "0 0 0"
    spawn = Spawn() if turned or shape == "sphere" else Spawn(roll=QUARTER)
    text = link("body", 2.0, inertia, collision(geometry, rpy=rpy), rpy=rpy)
    simulator = start(text, dt=dt, spawn=spawn, gravity=leaning(0.2))
    simulator.run(1.0)
    factor = 5 / 7 if shape == "sphere" else 2 / 3
    assert simulator.state.base_pose[:2] == pytest.approx((factor * G * math.sin(0.2) / 2, 0.0), abs=1e-9)


@pytest.mark.parametrize("name", ["box", "cylinder"])
def test_a_mesh_slides_as_the_shape_it_is(start: Start, tmp_path: Path, name: str) -> None:
    solid = (
        trimesh.creation.box((0.2, 0.2, 0.1))
        if name == "box"
        else trimesh.creation.cylinder(radius=0.1, height=0.1, sections=32)
    )
    solid.export(tmp_path / "solid.stl")
    shape = collision(f'<mesh filename="file://{tmp_path}/solid.stl"/>')
    text = link("body", 1.0, box_inertia(1, 0.2, 0.2, 0.1), shape) + rough("body", 0.5)
    simulator = start(text, spawn=Spawn(twist=(1.2, 1.6, 0, 0, 0, 0)))
    simulator.run(1.5)
    way = 4.0 / G
    assert math.dist(simulator.state.base_pose[:2], (0.6 * way, 0.8 * way)) < 2e-6
    simulator = start(text, gravity=leaning(0.98 * math.atan(0.5), 0.3))
    simulator.run(1.0)
    assert math.hypot(*simulator.state.base_pose[:2]) < 1e-7


def world_with_ramp(folder: Path, angle: float) -> Path:
    """Write a world with nothing but a static box that leans towards +x, its upper face through the origin."""
    x, z = -0.5 * math.sin(angle), -0.5 * math.cos(angle)
    file = folder / "ramp.world"
    file.write_text(
        f'<sdf version="1.9"><world name="ramp"><gravity>0 0 -9.81</gravity>'
        f'<model name="ramp"><static>true</static><pose>{x} 0 {z} 0 {angle} 0'
        '</pose><link name="link"><collision name="shape"><geometry><box><size>20 4 1</size></box></geometry>'
        "</collision></link></model></world></sdf>"
    )
    return file


@pytest.mark.parametrize("dt", [0.001, 0.005])
def test_on_a_ramp_of_the_world_the_same_holds(start: Start, tmp_path: Path, dt: float) -> None:
    angle = 0.3
    world = world_with_ramp(tmp_path, angle)
    along, up = np.array([math.cos(angle), 0, -math.sin(angle)]), np.array([math.sin(angle), 0, math.cos(angle)])
    text = link("body", 1.0, box_inertia(1, 0.2, 0.2, 0.1), collision(box(0.2, 0.2, 0.1)))
    for share in (0.98, 1.05):
        mu = math.tan(angle / share)
        x, _, z = 0.05 * up
        simulator = start(text, rough("body", mu), dt=dt, world=world, spawn=Spawn(x=x, z=z, pitch=angle))
        simulator.run(1.0)
        way = (simulator.state.base_pose[:3] - 0.05 * up) @ along
        expected = max(0.0, G * (math.sin(angle) - mu * math.cos(angle))) / 2
        assert way == pytest.approx(expected, rel=1e-4, abs=1e-7)
    x, _, z = 0.1 * up
    ball = link("body", 2.0, (0.008,) * 3, collision('<sphere radius="0.1"/>'))
    simulator = start(ball, dt=dt, world=world, spawn=Spawn(x=x, z=z))
    simulator.run(1.0)
    way = (simulator.state.base_pose[:3] - 0.1 * up) @ along
    assert way == pytest.approx(5 / 14 * G * math.sin(angle), rel=1e-6)


WHEELS = {
    "turned joint": (f"{-QUARTER} 0 0", "0 0 1", "0 0 0"),
    "turned shape": ("0 0 0", "0 1 0", f"{QUARTER} 0 0"),
    "turned twice": (f"0 {QUARTER} {QUARTER}", "0 0 1", "0 0 0"),
}


@pytest.mark.parametrize("written", WHEELS)
@pytest.mark.parametrize("mu", [0.3, 1.0])
def test_skidding_wheels_turn_a_robot_as_coulomb_has_it(start: Start, written: str, mu: float) -> None:
    rpy, axis, shape = WHEELS[written]
    a, b, radius, speed = 0.2, 0.3, 0.1, 3.0
    text = link("base", 5.0, box_inertia(5, 0.4, 0.6, 0.1), collision(box(0.4, 0.5, 0.1)))
    sides = {}
    for x, y in ((a, b), (a, -b), (-a, b), (-a, -b)):
        name = f"w{len(sides)}"
        sides[f"{name}_joint"] = -1.0 if y > 0 else 1.0
        wheel = collision(f'<cylinder radius="{radius}" length="0.05"/>', rpy=shape)
        text += link(name, 0.4, (0.0011, 0.0011, 0.002), wheel, rpy=shape) + rough(name, mu)
        text += joint(f"{name}_joint", "continuous", "base", name, axis, xyz=f"{x} {y} 0", rpy=rpy)
    simulator = start(text)
    for name, sign in sides.items():
        simulator.motors.drive(name, sign * speed, 100.0)
    simulator.run(2.0)
    assert simulator.state.base_velocity[5] == pytest.approx(speed * radius * b / (a * a + b * b), rel=1e-6)
    assert math.hypot(*simulator.state.base_pose[:2]) < 1e-9


@pytest.mark.parametrize("dt", [0.001, 0.005, 0.01])
@pytest.mark.parametrize("speed", [0.1, 3.0, 30.0, 100.0])
@pytest.mark.parametrize("kind", ["revolute", "prismatic"])
def test_limits_hold_at_any_speed(start: Start, kind: str, speed: float, dt: float) -> None:
    text = '<link name="world"/>' + link("arm", 1.0, (0.01,) * 3, at="0.3 0.1 0")
    text += joint("j", kind, "world", "arm", "1 0 0", more=limit(-0.5, 0.5), rpy="0.3 0.2 0.1")
    simulator = start(text, world="void", dt=dt, gravity=(3, 2, -9), spawn=Spawn(z=0, velocities={"j": speed}))
    for _ in range(200):
        simulator.step()
        assert abs(simulator.state.position("j")) < 0.5 + 1e-8


@pytest.mark.parametrize("dt", [0.001, 0.005])
def test_a_mimic_joint_carries_its_part_of_the_load(start: Start, dt: float) -> None:
    slide = limit(-3, 3)
    text = '<link name="world"/>' + link("a", 1.0, (0.01,) * 3) + link("b", 2.0, (0.01,) * 3)
    text += joint("j", "prismatic", "world", "a", "0 0 1", more=slide)
    text += joint(
        "k", "prismatic", "world", "b", "0 0 1", xyz="1 0 0", more=slide + '<mimic joint="j" multiplier="2"/>'
    )
    simulator = start(text, world="void", dt=dt, spawn=Spawn(z=0))
    simulator.motors.servo("j", stiffness=1000.0, damping=100.0, position=0.5)
    simulator.run(5.0)
    assert simulator.state.position("j") == pytest.approx(0.5 - (1.0 + 2.0 * 2.0) * G / 1000.0, abs=1e-7)
    assert simulator.state.position("k") == pytest.approx(2.0 * simulator.state.position("j"), abs=1e-12)


@pytest.mark.parametrize("kind", ["continuous", "planar", "floating"])
def test_a_tree_in_free_fall_keeps_its_momentum(start: Start, kind: str) -> None:
    text = link("root", 2.0, (0.1, 0.2, 0.25), at="0.1 0 0.05", rpy="0.1 0.2 0.3")
    text += link("middle", 1.0, (0.1, 0.2, 0.25), at="0.1 0 0.1", rpy="0.3 0 0") + link("end", 0.4, (0.01, 0.02, 0.025))
    text += joint("j", kind, "root", "middle", "0 1 0", xyz="0 0 1", rpy="0.3 0.2 0.1")
    text += joint("k", "continuous", "middle", "end", "0 1 1", xyz="0 0.2 0")
    spawn = Spawn(z=0.0, yaw=1.0, pitch=0.4, twist=(0, 1, 2, 0.3, 0.4, 0.5), velocities={"k": 2.0})
    simulator = start(text, world="void", gravity=(1, 2, -9), spawn=spawn)
    model = simulator.kinematics.model
    terms = model.createData()

    def momentum() -> Any:
        pin.computeCentroidalMomentum(model, terms, np.array(simulator.state.q), np.array(simulator.state.v))
        return terms.hg.vector.copy(), terms.com[0].copy()

    before, centre = momentum()
    energy = sum(simulator.state.energy)
    simulator.run(2.0)
    after, moved = momentum()
    mass, gravity = 3.4, np.array([1.0, 2.0, -9.0])
    assert after[:3] == pytest.approx(before[:3] + 2.0 * mass * gravity, abs=1e-4)
    assert after[3:] == pytest.approx(before[3:], abs=1e-5)
    assert moved == pytest.approx(centre + 2.0 * before[:3] / mass + 2.0 * gravity, abs=1e-5)
    assert sum(simulator.state.energy) == pytest.approx(energy, abs=1e-4)


def half_period(angle: float, length: float) -> float:
    """Return half the period of a mathematical pendulum, 2·√(l/g)·K(sin² α/2)."""
    a, b = 1.0, math.cos(angle / 2)
    for _ in range(8):
        a, b = (a + b) / 2, math.sqrt(a * b)
    return math.pi * math.sqrt(length / G) / a


@pytest.mark.parametrize("angle", [0.1, 1.0, 2.8])
@pytest.mark.parametrize(
    ("at", "rpy", "axis", "turned"),
    [("0 0 -0.3", "0 0 0", "0 1 0", "0 0 0"), ("0 0 -0.3", "0 0 0.9", "-1 0 0", "0 0 0.7"),
     ("0.3 0 0", "0 0.4 0", "0 -1 0", f"0 {QUARTER} 0")],
)  # fmt: skip
def test_a_pendulum_swings_right_however_it_is_written(
    start: Start, angle: float, at: str, rpy: str, axis: str, turned: str
) -> None:
    x, y, _ = inertia = (0.03, 0.01, 0.02)
    text = '<link name="world"/>' + link("bob", 0.5, inertia, at=at, rpy=rpy)
    text += joint("hinge", "continuous", "world", "bob", axis, rpy=turned)
    about = {"0 1 0": y, "0 -1 0": y, "-1 0 0": x * math.cos(0.9) ** 2 + y * math.sin(0.9) ** 2}[axis]
    length = (about + 0.5 * 0.09) / (0.5 * 0.3)
    simulator = start(text, world="void", spawn=Spawn(z=0, joints={"hinge": angle}))
    crossings: list[float] = []
    before = angle
    while len(crossings) < 3:
        simulator.step()
        now = simulator.state.position("hinge")
        if before * now < 0.0:
            crossings.append(simulator.t - simulator.dt * now / (now - before))
        before = now
        assert simulator.t < 10.0
    assert np.diff(crossings).mean() == pytest.approx(half_period(angle, length), rel=1e-5)
