"""Every robot in its own world: it stands still, goes straight ahead, and does there what its tutorial does."""

import math

import numpy as np
import pytest

from urdfkit.description import load
from urdfkit.messages import FLOAT, from_fields
from urdfkit.resources import find_model, robots_dir
from urdfkit.sim import Simulator

HOMES = {
    "simpleton": "empty.world",
    "mybot": "mybot.world",
    "diff_wheeled_robot": "cylinders.world",
    "diff_wheeled_robot_with_laser": "cylinders.world",
    "gem_e2": "road.world",
    "heterogeneous": "house.world",
    "artoo": "town.sdf",
    "bot": "rooms.world",
    "rrbot": "rrbot.world",
    "seven_dof_arm": "table.world",
    "seven_dof_arm_with_rgbd": "table.world",
}
"""Robot → the world that comes with it."""

WHEELED = [name for name in HOMES if name != "rrbot" and not name.startswith("seven")]

FOR_GZ = {"gazebo": "gz"}
CASES = [*((name, {}) for name in WHEELED), ("gem_e2", FOR_GZ), ("bot", FOR_GZ)]


def at_home(name, arguments=None, **options):
    path = find_model([name]).path
    (world,) = robots_dir().glob(f"{path.parents[2].name}/*_gazebo/worlds/{HOMES[name]}")
    robot = load(path, arguments=arguments or {})
    return Simulator(robot, world=world, note=lambda _: None, **options)


def pose(simulator):
    """Return x, y, z [m], heading [rad] and the sine of half the tilt of the root link."""
    x, y, z, qx, qy, qz, qw = simulator.link_poses()[0]
    return np.array([x, y, z, 2 * math.atan2(qz, qw), math.hypot(qx, qy)])


@pytest.mark.parametrize(("name", "arguments"), CASES)
def test_it_stays_where_it_is_parked(name, arguments):
    simulator = at_home(name, arguments)
    simulator.run(1.0)
    before = pose(simulator)
    fastest = 0.0
    for _ in range(40):
        simulator.run(0.5)
        fastest = max(fastest, np.abs(simulator.state.v[:6]).max())
    np.testing.assert_allclose(pose(simulator), before, rtol=0, atol=1e-9)
    assert fastest < 1e-9


@pytest.mark.parametrize(("name", "arguments"), CASES)
def test_it_goes_straight_without_a_jolt(name, arguments):
    simulator = at_home(name, arguments)
    simulator.command((0.3, 0, 0), (0, 0, 0))
    simulator.run(2.0)
    before, seen = pose(simulator), []
    for _ in range(100):
        simulator.step(10)
        seen.append(pose(simulator))
    seen = np.array(seen)
    assert seen[-1][0] - before[0] == pytest.approx(0.3, abs=0.01)
    assert np.abs(seen[:, 1]).max() < 1e-3
    assert np.abs(seen[:, 3]).max() < 1e-3
    assert np.ptp(seen[:, 2]) < 1e-9
    assert np.ptp(seen[:, 4]) < 1e-9


def test_parked_it_touches_the_ground_as_often_as_it_has_wheels():
    for name, count in {"simpleton": 3, "mybot": 3, "diff_wheeled_robot": 4, "artoo": 4, "gem_e2": 4, "bot": 3}.items():
        simulator = at_home(name)
        simulator.run(1.0)
        links = simulator.robot.link_by_name
        contacts = [contact for contact in simulator.state.contacts if contact.a in links and contact.force[2] > 0]
        assert len({contact.a for contact in contacts}) == count, name
        mass = sum(link.inertial.mass for link in simulator.robot.links if link.inertial is not None)
        gravity = -simulator.world.description.gravity[2]
        assert sum(contact.force[2] for contact in contacts) == pytest.approx(mass * gravity, rel=1e-6)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["mybot", "bot", "heterogeneous"])
def test_a_wall_stops_it(name):
    """Straight ahead there is one, 3, 4 and 5 m away."""
    simulator = at_home(name)
    simulator.command((0.8, 0, 0), (0, 0, 0))
    simulator.run(10.0)
    wall = {"mybot": 3.0, "bot": 4.0, "heterogeneous": 5.0}[name]
    at = pose(simulator)
    assert wall - 0.7 < at[0] < wall - 0.1
    assert abs(at[1]) < 0.3
    simulator.command((-0.8, 0, 0), (0, 0, 0))
    simulator.run(2.0)
    assert pose(simulator)[0] < at[0] - 0.5


def test_the_laser_robot_goes_round_a_cylinder():
    """It passes the one 1.2 m ahead on the left, by the keys j, i, l, i with k between."""
    simulator = at_home("diff_wheeled_robot_with_laser")
    for v, w, seconds in ((0.0, 1.0, 0.7), (0.5, 0.0, 1.6), (0.0, -1.0, 0.7), (0.5, 0.0, 3.0)):
        simulator.command((v, 0, 0), (0, 0, w))
        simulator.run(seconds)
        simulator.command((0, 0, 0), (0, 0, 0))
        simulator.run(0.5)
        assert {contact.b for contact in simulator.state.contacts} == {"ground_plane"}
    at = pose(simulator)
    assert at[0] > 1.9
    assert 0.45 < at[1] < 0.6
    assert abs(at[3]) < 1e-6


@pytest.mark.parametrize("arguments", [{}, FOR_GZ], ids=["classic", "gz"])
def test_the_car_passes_the_gate_of_barriers(arguments):
    simulator = at_home("gem_e2", arguments)
    simulator.command((4.0, 0, 0), (0, 0, 0))
    simulator.run(5.0)
    assert pose(simulator)[0] > 12.0
    assert abs(pose(simulator)[1]) < 0.05


def test_the_droid_pushes_the_ball_away():
    simulator = at_home("artoo")
    before = simulator.world.bodies["ball"].pose
    for v, w, seconds in ((0.0, -1.0, 1.48), (0.6, 0.0, 6.0)):
        simulator.command((v, 0, 0), (0, 0, w))
        simulator.run(seconds)
    after = simulator.world.bodies["ball"].pose
    assert math.dist(before[:2], after[:2]) > 0.2
    assert after[2] == pytest.approx(0.15, abs=0.01)


def test_the_arm_bends_over_its_shelf_and_the_things_stay_where_they_are():
    simulator = at_home("seven_dof_arm")
    simulator.run(1.0)
    before = {name: body.pose for name, body in simulator.world.bodies.items()}
    topic = "/seven_dof_arm/joint4_position_controller/command"
    simulator.bus.publish(topic, FLOAT, from_fields(FLOAT, {"data": 1.0}))
    simulator.run(4.0)
    assert simulator.state.position("elbow_pitch_joint") == pytest.approx(1.0, abs=0.03)
    for name, body in simulator.world.bodies.items():
        assert body.pose == pytest.approx(before[name], abs=1e-6)


def test_the_pendulum_arm_goes_where_it_is_told_within_its_sag():
    simulator = at_home("rrbot")
    for joint, angle in ((1, 1.5), (2, 1.0)):
        topic = f"/rrbot/joint{joint}_position_controller/command"
        simulator.bus.publish(topic, FLOAT, from_fields(FLOAT, {"data": angle}))
    simulator.run(10.0)
    assert simulator.state.position("joint1") == pytest.approx(1.5, abs=0.2)
    assert simulator.state.position("joint2") == pytest.approx(1.0, abs=0.2)
