"""What is turned while a simulation runs shows in how things move, and nothing else changes."""

from __future__ import annotations

import numpy as np
import pytest

from urdfkit.description import load
from urdfkit.errors import SimulationError
from urdfkit.sim import Simulator
from urdfkit.sim.state.pid import Gains
from urdfkit.sim.world.live_tuning import Tuning
from urdfkit.sim.world.slip_velocity import slips

BOX = """<robot name="box"><link name="body">
  <inertial><mass value="2"/><inertia ixx="0.02" iyy="0.02" izz="0.02" ixy="0" ixz="0" iyz="0"/></inertial>
  <collision><geometry><box size="0.2 0.2 0.2"/></geometry></collision></link></robot>"""


@pytest.fixture
def box(tmp_path):
    (tmp_path / "box.urdf").write_text(BOX)
    made = Simulator(load(tmp_path / "box.urdf"), note=lambda _: None)
    made.step(300)  # it settles
    return made


def test_gravity_pulls_as_told_and_wakes_what_sleeps(box) -> None:
    tuning = Tuning(box.world)
    assert tuning.gravity == (0.0, 0.0, -9.81)
    tuning.set_gravity((0.0, 0.0, 1.5))
    z = box.state.base_pose[2]
    box.step(1000)
    assert box.state.base_pose[2] - z == pytest.approx(0.75, rel=1e-3)
    for much in (float("nan"), float("inf"), 2e4):
        with pytest.raises(SimulationError, match="gravity"):
            tuning.set_gravity((0.0, 0.0, much))
    assert tuning.gravity == (0.0, 0.0, 1.5)


def test_a_heavier_link_is_pushed_less_far_and_turns_less(box) -> None:
    tuning = Tuning(box.world)
    tuning.set_gravity((0.0, 0.0, 0.0))

    def pushed() -> tuple[float, float]:
        box.world.place("box", (0.0, 0.0, 5.0))
        box.world.push("body", force=(4.0, 0.0, 0.0), torque=(0.0, 0.0, 0.02), for_seconds=0.5)
        box.step(500)
        return box.state.base_velocity[0], box.state.base_velocity[5]

    assert [each.mass for each in tuning.links("box")] == [2.0]
    speed, rate = pushed()
    assert speed == pytest.approx(1.0, rel=1e-6)
    tuning.set_mass("box", 8.0, "body")
    assert [each.mass for each in tuning.links("box")] == [8.0]
    box.world.place("box", (0.0, 0.0, 5.0))
    assert pushed() == (pytest.approx(speed / 4, rel=1e-6), pytest.approx(rate / 4, rel=1e-6))
    tuning.set_mass("box", 2.0, "body")
    assert pushed()[0] == pytest.approx(speed, rel=1e-9)  # and back


def test_friction_decides_whether_it_slides(box) -> None:
    tuning = Tuning(box.world)
    assert [each.mu for each in tuning.links("box")] == [1.0]
    tuning.set_mu("box", 0.1, "body")
    box.world.push("body", force=(0.5 * 2 * 9.81, 0.0, 0.0), for_seconds=0.2)
    box.step(200)
    sliding = 0.2 * (0.5 - 0.1) * 9.81
    assert box.state.base_velocity[0] == pytest.approx(sliding, rel=1e-3)
    found = slips(box.world, box.state.contacts)
    assert len(found) >= 3
    for slip in found:
        assert slip.link == "body"
        assert slip.velocity[0] == pytest.approx(sliding, rel=0.02)
        assert abs(slip.velocity[2]) < 1e-9
    tuning.set_mu("box", 1.0, "body")
    box.step(300)
    assert abs(box.state.base_velocity[0]) < 1e-6


def test_the_worlds_models_are_turned_too_and_stay_so(box) -> None:
    tuning = Tuning(box.world)
    name = box.world.spawn("crate", (2.0, 0.0, 0.0))
    box.step(200)
    before = {each.name: each for each in tuning.models}[name]
    pose, revision = box.world.pose(name), box.world.revision
    tuning.set_mass(name, 3 * before.mass)
    tuning.set_mu(name, 0.05)
    tuning.set_mu("ground_plane", 0.5)
    assert box.world.revision == revision
    assert np.allclose(box.world.pose(name), pose, atol=1e-9)
    after = {each.name: each for each in tuning.models}
    assert after[name].mass == pytest.approx(3 * before.mass)
    assert (after[name].mu, after["ground_plane"].mu) == (0.05, 0.5)
    box.world.spawn("ball", (4.0, 0.0, 1.0))  # makes the engine anew
    assert {each.name: each for each in tuning.models}[name].mu == 0.05
    box.world.push(name, force=(60.0, 0.0, 0.0), for_seconds=0.1)
    box.step(100)
    weight = 3 * before.mass
    assert box.world.bodies[name].twist[0] == pytest.approx(0.1 * (60.0 / weight - 0.05 * 9.81), abs=2e-3)


@pytest.mark.parametrize(
    ("change", "line"),
    [
        (lambda t: t.set_mass("box", 0.0, "body"), "at least 1e-06 kg"),
        (lambda t: t.set_mass("box", 1.0, "bodi"), "did you mean `body`"),
        (lambda t: t.set_mass("ground_plane", 1.0), "has no effect"),
        (lambda t: t.set_mu("box", -1.0, "body"), "not negative"),
        (lambda t: t.set_mu("crate", 1.0), "no model `crate`"),
        (lambda t: t.set_gains("box/a/b", Gains(1.0)), "no gains `box/a/b`"),
    ],
)
def test_what_makes_no_sense_is_refused_in_a_line(box, change, line: str) -> None:
    with pytest.raises(SimulationError, match=line) as caught:
        change(Tuning(box.world))
    assert "\n" not in str(caught.value)


def test_gains_of_a_running_controller_change_what_it_does() -> None:
    simulator = Simulator("rrbot", note=lambda _: None)
    tuning = Tuning(simulator.world)
    path = next(path for path in tuning.gains if path.endswith("joint1"))
    simulator.step(200)
    topic = next(t.name for t in simulator.bus.topics if "joint1" in t.name and t.name.endswith("/command"))
    from urdfkit.messages import FLOAT, from_fields

    simulator.bus.publish(topic, FLOAT, from_fields(FLOAT, {"data": 0.6}))
    tuning.set_gains(path, Gains(0.0))
    simulator.step(300)
    limp = simulator.state.position("joint1")
    assert tuning.gains[path] == Gains(0.0)
    tuning.set_gains(path, Gains(2000.0, 0.0, 100.0))
    simulator.step(2000)
    assert abs(simulator.state.position("joint1") - 0.6) < abs(limp - 0.6)
    assert simulator.state.position("joint1") == pytest.approx(0.6, abs=0.02)
    with pytest.raises(SimulationError, match="gain `p`"):
        tuning.set_gains(path, Gains(-1.0))


GZ_ARM = """<robot name="bar"><link name="base">
  <inertial><mass value="5"/><inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="world"/><joint name="held" type="fixed"><parent link="world"/><child link="base"/></joint>
  <link name="arm"><inertial><origin xyz="0.2 0 0"/><mass value="1"/>
  <inertia ixx="0.001" iyy="0.02" izz="0.02" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="lift" type="revolute"><origin xyz="0 0 1"/><parent link="base"/><child link="arm"/><axis xyz="0 -1 0"/>
  <limit lower="-2" upper="2" effort="50" velocity="5"/></joint>
  <gazebo><plugin filename="gz-sim-joint-position-controller-system"
    name="gz::sim::systems::JointPositionController"><joint_name>lift</joint_name><p_gain>20</p_gain>
    <i_gain>0</i_gain><d_gain>4</d_gain>{}</plugin></gazebo></robot>"""


def test_gains_of_a_plugin_that_commands_by_itself_are_turned_too(tmp_path) -> None:
    (tmp_path / "bar.urdf").write_text(GZ_ARM.format(""))
    simulator = Simulator(load(tmp_path / "bar.urdf"), note=lambda _: None)
    tuning = Tuning(simulator.world)
    (path,) = tuning.gains
    assert path == "bar/joint_position_controller/lift"
    simulator.step(5000)
    assert simulator.state.position("lift") == pytest.approx(-1.962 / 20, rel=0.01)  # m g l / p
    tuning.set_gains(path, Gains(200.0, 0.0, 20.0))
    simulator.step(5000)
    assert simulator.state.position("lift") == pytest.approx(-1.962 / 200, rel=0.01)


def test_a_plugin_whose_gains_do_nothing_offers_none(tmp_path) -> None:
    (tmp_path / "bar.urdf").write_text(GZ_ARM.format("<use_velocity_commands>true</use_velocity_commands>"))
    assert Tuning(Simulator(load(tmp_path / "bar.urdf"), note=lambda _: None).world).gains == {}
