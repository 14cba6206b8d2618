"""Bodies of a world in the simulator: at rest, in the way, pushed, placed and refused."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfkit.description.sdf import load_world
from urdfkit.errors import SimulationError
from urdfkit.sim import Simulator, Spawn
from urdfkit.sim.construction.rigid_bodies import visuals_of

WORLD = """<sdf version="1.7"><world name="probe"><gravity>0 0 -9.81</gravity>
<model name="ground_plane"><static>true</static><link name="link"><collision name="c"><geometry><plane>
<normal>0 0 1</normal></plane></geometry></collision></link></model>{models}</world></sdf>"""

BOX = """<model name="{name}"><pose>{pose}</pose><static>{static}</static><link name="link"><inertial><mass>1</mass>
<inertia><ixx>0.01</ixx><iyy>0.01</iyy><izz>0.01</izz></inertia></inertial><collision name="c"><geometry><box>
<size>0.2 0.4 0.2</size></box></geometry></collision></link>{more}</model>"""


def box(name: str, pose: str, *, static: bool = False, more: str = "") -> str:
    return BOX.format(name=name, pose=pose, static=str(static).lower(), more=more)


@pytest.fixture
def world(tmp_path: Path):
    def make(*models: str) -> Path:
        path = tmp_path / "probe.world"
        path.write_text(WORLD.format(models="".join(models)))
        return path

    return make


def test_bodies_fall_are_placed_pushed_and_put_back(world) -> None:
    simulator = Simulator("simpleton", world=world(box("box", "2 0 1 0 0 0")), spawn=Spawn(x=-2.0))
    simulator.run(0.3)
    assert simulator.world.bodies["box"].pose[2] == pytest.approx(1.0 - 0.5 * 9.81 * 0.09, abs=1e-9)
    simulator.run(1.0)
    assert simulator.world.bodies["box"].pose[2] == pytest.approx(0.1, abs=1e-6)
    simulator.world.bodies["box"].push((9.81 + 2.0, 0.0, 0.0))
    simulator.run(0.5)
    assert simulator.world.bodies["box"].twist[0] == pytest.approx(1.0, rel=1e-2)
    simulator.world.bodies["box"].place((3.0, 1.0, 0.1, 0.0, 0.0, 0.0, 1.0))
    simulator.world.bodies["box"].release()
    simulator.run(0.5)
    assert simulator.world.bodies["box"].pose[:3] == pytest.approx((3.0, 1.0, 0.1), abs=1e-6)
    simulator.reset()
    assert simulator.world.bodies["box"].pose[:3] == (2.0, 0.0, 1.0)


def test_the_only_link_of_a_model_is_pushed_by_its_scoped_name(world) -> None:
    simulator = Simulator("simpleton", world=world(box("box", "2 0 0.1 0 0 0")), spawn=Spawn(x=-2.0))
    (link,) = [link.name for model in simulator.world.description.models for link in model.links if model.name == "box"]
    simulator.world.push(f"box::{link}", force=(0.0, 0.0, 30.0))
    simulator.run(0.1)
    assert simulator.world.bodies["box"].twist[2] > 0.5
    with pytest.raises(SimulationError, match="no body or link `box::lnk`"):
        simulator.world.push("box::lnk", force=(0.0, 0.0, 30.0))


def test_furniture_stays_where_it_stands() -> None:
    simulator = Simulator("simpleton", world="house")
    before = simulator.world.body_poses()
    simulator.run(0.5)
    for name, pose in simulator.world.body_poses().items():
        assert pose == pytest.approx(before[name], abs=1e-4), name


def test_links_held_by_fixed_joints_are_one_body(world) -> None:
    more = (
        '<link name="top"><pose>0 0 0.5 0 0 0</pose><inertial><mass>3</mass></inertial></link>'
        '<joint name="glue" type="fixed"><parent>link</parent><child>top</child></joint>'
    )
    simulator = Simulator("simpleton", world=world(box("post", "3 0 0.1 0 0 0", more=more)))
    body = simulator.world.bodies["post"].body
    assert body.mass == 4.0
    assert body.centre == pytest.approx((0.0, 0.0, 0.375))


def test_what_cannot_be_simulated_is_refused_with_its_place(world) -> None:
    more = '<link name="door"/><joint name="hinge" type="ball"><parent>link</parent><child>door</child></joint>'
    with pytest.raises(SimulationError, match=r"joint `hinge` of model `cupboard` is ball, which cannot be") as caught:
        Simulator("simpleton", world=world(box("cupboard", "3 0 0.1 0 0 0", more=more)))
    assert "probe.world" in str(caught.value)


def test_an_inertia_that_nothing_has_is_refused_with_its_place(world) -> None:
    crate = box("crate", "3 0 0.1 0 0 0").replace("<izz>0.01</izz>", "<izz>0.5</izz>")
    message = r"inertia of link `link` of `crate` is impossible: of its principal moments 0\.01, 0\.01 and 0\.5 kg·m²"
    with pytest.raises(SimulationError, match=message) as caught:
        Simulator("simpleton", world=world(crate))
    assert "probe.world" in str(caught.value)
    Simulator("simpleton", world=world(crate.replace("<static>false", "<static>true")))


def test_a_mimic_joint_of_sdf_follows_also_when_it_was_saved(world, tmp_path: Path) -> None:
    inertia = "<inertial><mass>1</mass></inertial>"
    axis = "<axis><xyz>0 0 1</xyz>{}</axis><parent>link</parent><child>{}</child></joint>"
    more = f'<link name="a">{inertia}</link><link name="b">{inertia}</link><joint name="j" type="revolute">'
    more += axis.format("", "a") + '<joint name="k" type="revolute">'
    more += axis.format('<mimic joint="j"><multiplier>2</multiplier><reference>0.1</reference></mimic>', "b")
    notes: list[str] = []
    simulator = Simulator("simpleton", world=world(box("door", "3 0 0.1 0 0 0", more=more)), note=notes.append)
    assert not [each for each in notes if "mimic" in each]
    simulator.world.robots["door"].motors.drive("j", 0.5, 10.0)
    simulator.run(2.0)
    state = simulator.world.robots["door"].state
    j, k = state.position("j"), state.position("k")
    assert 0.8 < j < 1.0
    assert k == pytest.approx(2.0 * (j - 0.1), abs=1e-6)
    simulator.world.save(tmp_path / "after.sdf")
    again = Simulator("simpleton", world=tmp_path / "after.sdf", note=notes.append)
    again.world.robots["door"].motors.drive("j", -0.5, 10.0)
    again.run(1.0)
    state = again.world.robots["door"].state
    # Both are zero where they were saved.
    assert state.position("k") == pytest.approx(2.0 * state.position("j"), abs=1e-6)


def test_a_wall_stops_a_robot_with_all_the_force_its_wheels_have(world) -> None:
    simulator = Simulator("simpleton", world=world(box("wall", "0.8 0 0.1 0 0 0", static=True)))
    simulator.command((0.3, 0, 0), (0, 0, 0))
    simulator.run(3.0)
    stopped = simulator.link_poses()[0].copy()
    simulator.run(1.0)
    assert simulator.link_poses()[0] == pytest.approx(stopped, abs=1e-6)
    on_the_wall = [contact.force for contact in simulator.state.contacts if "wall" in (contact.a, contact.b)]
    # Two wheels of radius 0.1 m with motors of 0.3 N·m.
    assert abs(sum(force[0] for force in on_the_wall)) == pytest.approx(6.0, rel=1e-6)


def test_a_robot_pushes_what_slides(world) -> None:
    smooth = "<surface><friction><ode><mu>0.1</mu><mu2>0.1</mu2></ode></friction></surface>"
    crate = box("crate", "0.8 0 0.1 0 0 0").replace("</geometry></collision>", f"</geometry>{smooth}</collision>")
    simulator = Simulator("simpleton", world=world(crate))
    simulator.command((0.3, 0, 0), (0, 0, 0))
    simulator.run(3.0)
    before = simulator.link_poses()[0][0]
    gap = simulator.world.bodies["crate"].pose[0] - before
    simulator.run(1.0)
    robot = simulator.link_poses()[0]
    assert robot[0] - before == pytest.approx(0.3, abs=1e-4)
    assert simulator.world.bodies["crate"].pose[0] - robot[0] == pytest.approx(gap, abs=1e-4)
    assert abs(robot[1]) < 1e-4


def test_what_a_world_looks_like_hangs_on_its_bodies() -> None:
    world = load_world("house")
    looks = visuals_of(world)
    builder = Simulator("simpleton", world="house").world.builder
    bodies = {*builder.static_poses, *builder.free_bodies}
    assert {shape.body for shape in looks} <= bodies
    assert len({shape.body for shape in looks}) > 5
    assert len({shape.name for shape in looks}) == len(looks)
    assert all(shape.has_color for shape in looks)
