"""Things come, go, are placed and pushed while a simulation runs, by call and on the bus."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from urdfkit.errors import ResourceError, SimulationError
from urdfkit.messages import TWIST, from_fields, twist
from urdfkit.sim import Simulator, Spawn

G = 9.81
FAR = (30.0, 30.0, 0.5)
BALL = """<sdf version="1.9"><model name="ball"><link name="link"><inertial><mass>2</mass><inertia><ixx>0.02</ixx>
<iyy>0.02</iyy><izz>0.02</izz></inertia></inertial><collision name="c"><geometry><sphere><radius>0.1</radius></sphere>
</geometry></collision></link></model></sdf>"""


@pytest.fixture
def ball(tmp_path: Path) -> Path:
    path = tmp_path / "ball.sdf"
    path.write_text(BALL)
    return path


def drive(simulator: Simulator, seconds: float = 0.5) -> None:
    simulator.command((0.3, 0.0, 0.0), (0.0, 0.0, 0.4))
    simulator.run(seconds)


def bits(simulator: Simulator) -> bytes:
    box = np.array([simulator.world.bodies["box"].pose, (*simulator.world.bodies["box"].twist, 0.0)])
    return simulator.state.q.tobytes() + simulator.state.v.tobytes() + box.tobytes()


def furnished(**options: Any) -> Simulator:
    """Return a robot that soon pushes a box, and a crate that lies still."""
    simulator = Simulator("simpleton", world="empty", **options)
    simulator.world.spawn("box", (0.55, 0.0, 0.0))
    simulator.world.spawn("crate", (2.0, 1.0, 0.0))
    return simulator


def test_what_comes_and_goes_far_away_is_not_felt() -> None:
    quiet, lively = furnished(), furnished()
    for simulator in (quiet, lively):
        drive(simulator, 1.0)
    ball = lively.world.spawn("ball", FAR)
    other = lively.world.spawn("simpleton", (-30.0, 0.0, 0.0), name="other")
    for simulator in (quiet, lively):
        drive(simulator)
    assert bits(lively) == bits(quiet)
    lively.world.remove(ball)
    lively.world.remove(other)
    for simulator in (quiet, lively):
        simulator.run(0.5)
    assert bits(lively) == bits(quiet)
    # What slept woke with the impulses it rested on.
    assert lively.world.bodies["crate"].pose == pytest.approx(quiet.world.bodies["crate"].pose, abs=1e-9)
    assert lively.state.t == quiet.state.t == pytest.approx(2.0)


def test_a_robot_alone_does_not_feel_it_either() -> None:
    alone, joined = Simulator("simpleton"), Simulator("simpleton")
    for simulator in (alone, joined):
        drive(simulator)
    joined.world.spawn("ball", FAR)
    for simulator in (alone, joined):
        simulator.run(0.5)
    # With and without bodies, kernels of their own step a robot.
    assert np.abs(joined.state.q - alone.state.q).max() < 1e-12
    assert np.abs(joined.state.v - alone.state.v).max() < 1e-10


def test_a_second_robot_drives_by_its_own_plugins() -> None:
    simulator = Simulator("simpleton")
    name = simulator.world.spawn("simpleton", (0.0, 2.0, 0.0))
    assert name == "simpleton_1"
    states: list[Any] = []
    simulator.subscribe(f"/{name}/joint_states", "sensor_msgs/msg/JointState", states.append)
    for topic in (f"/{name}/cmd_vel", "/simpleton/cmd_vel"):
        simulator.bus.publish(topic, TWIST, twist((0.3, 0.0, 0.0), (0.0, 0.0, 0.4)))
    simulator.run(1.0)
    first, second = (robot.state.base_pose for robot in simulator.world.robots.values())
    assert first[0] > 0.2
    assert (second[0], second[1] - 2.0) == pytest.approx(first[:2], abs=1e-9)
    simulator.world.remove(name)
    count = len(states)
    simulator.run(0.2)
    assert list(simulator.world.robots) == ["simpleton"]
    assert len(states) == count


def test_what_is_spawned_falls_is_placed_and_stays_after_a_reset(ball: Path) -> None:
    simulator = Simulator("simpleton", spawn=Spawn(x=-3.0))
    assert simulator.world.spawn(ball, (1.0, 0.0, 1.0), name="egg") == "egg"
    egg = simulator.world.bodies["egg"]
    simulator.run(0.2)
    assert egg.pose[2] == pytest.approx(1.0 - G * 0.02, abs=1e-9)
    simulator.world.spawn(ball, (2.0, 0.0, 1.0))
    egg.place((1.0, 1.0, 2.0), (1.0, 0.0, 0.0, 0.0, 0.0, 0.0))
    simulator.run(0.1)
    assert egg.pose[:3] == pytest.approx((1.1, 1.0, 2.0 - G * 0.005), abs=1e-9)
    simulator.reset()
    assert simulator.t == 0.0
    assert egg.pose[:3] == (1.0, 0.0, 1.0)
    simulator.world.remove("egg")
    with pytest.raises(SimulationError, match="no body `egg` in the world"):
        _ = egg.pose


def test_pushes_are_along_the_worlds_axes_and_end_in_time(ball: Path) -> None:
    simulator = Simulator("simpleton", world="void", gravity=(0.0, 0.0, 0.0), spawn=Spawn(x=-3.0))
    for name, rate in (("still", 0.0), ("spinning", 20.0)):
        simulator.world.spawn(ball, (0.0, len(name), 0.0), name=name)
        simulator.world.bodies[name].place((0.0, float(len(name)), 0.0), (0.0, 0.0, 0.0, 0.0, 0.0, rate))
        simulator.world.bodies[name].push((4.0, 0.0, 0.0), for_seconds=0.5)
        simulator.world.bodies[name].push((0.0, 1.0, 0.0), for_seconds=0.25)
    simulator.run(1.0)
    for name in ("still", "spinning"):  # v = F·t / m
        assert simulator.world.bodies[name].twist[:3] == pytest.approx((1.0, 0.125, 0.0), abs=1e-5)


def test_a_force_off_the_centre_turns_and_torques_add_up(ball: Path) -> None:
    simulator = Simulator("simpleton", world="void", gravity=(0.0, 0.0, 0.0), spawn=Spawn(x=-3.0))
    simulator.world.spawn(ball, (0.0, 0.0, 0.0))
    simulator.world.push("ball", (0.0, 0.2, 0.0), (0.0, 0.0, 0.01), at=(0.1, 0.0, 0.0), for_seconds=0.1)
    simulator.run(0.2)
    # ω = (0.1·0.2 + 0.01)·0.1 / 0.02
    assert simulator.world.bodies["ball"].twist[3:] == pytest.approx((0.0, 0.0, 0.15), rel=1e-4)
    assert simulator.world.bodies["ball"].twist[1] == pytest.approx(0.01, rel=1e-4)


def test_a_link_of_a_robot_is_pushed_as_hard() -> None:
    simulator = Simulator("simpleton", world="void", gravity=(0.0, 0.0, 0.0))
    simulator.world.push(simulator.kinematics.root, (0.0, 3.0, 0.0), for_seconds=0.2)
    simulator.run(0.3)
    model, data = simulator.kinematics.model, simulator.kinematics.data
    import pinocchio as pin

    momentum = pin.computeCentroidalMomentum(model, data, simulator.state.q, simulator.state.v)
    assert momentum.linear == pytest.approx((0.0, 0.6, 0.0), abs=1e-4)
    assert not simulator.world.robots["simpleton"].articulation.applied.any()


def test_a_robot_is_placed_with_a_velocity_along_the_axes_of_the_world() -> None:
    simulator = Simulator("simpleton", world="void", gravity=(0.0, 0.0, 0.0))
    simulator.world.place("simpleton", (1.0, 2.0, 3.0, 0.0, 0.0, 1.5707963267948966), (0.5, 0.2, -0.1, 0.0, 0.0, 0.0))
    joints = simulator.state.v[6:].copy()
    assert simulator.state.v[:6] == pytest.approx([0.2, -0.5, -0.1, 0.0, 0.0, 0.0])  # in the frame of the robot
    assert not joints.any()
    simulator.world.place("simpleton", (1.0, 2.0, 3.0, 0.0, 0.0, 1.5707963267948966), (0.0, 0.0, 0.0, 0.3, 0.0, 0.4))
    assert simulator.state.v[:6] == pytest.approx([0.0, 0.0, 0.0, 0.0, -0.3, 0.4])


def test_a_wall_is_put_elsewhere() -> None:
    simulator = Simulator("simpleton")
    simulator.world.spawn("wall", (5.0, 0.0, 0.0))
    simulator.world.place("wall", (0.8, 0.0, 0.0, 1.5707963267948966))
    simulator.command((0.3, 0.0, 0.0), (0.0, 0.0, 0.0))
    simulator.run(3.0)
    assert 0.1 < simulator.state.base_pose[0] < 0.7
    with pytest.raises(SimulationError, match="`wall` is static"):
        simulator.world.place("wall", (1.0, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0, 0.0, 0.0))


def publish(simulator: Simulator, topic: str, type: str, fields: dict[str, Any]) -> None:
    simulator.bus.publish(topic, type, from_fields(type, fields))


def test_gazebos_services_are_topics() -> None:
    remarks: list[str] = []
    simulator = Simulator("simpleton", note=remarks.append, spawn=Spawn(x=-3.0))
    simulator.subscribe("/gazebo/model_states", "gazebo_msgs/msg/ModelStates", lambda _: None)
    pose = {"position": {"x": 1.0, "z": 1.0}}
    request = {"model_name": "egg", "model_xml": BALL, "initial_pose": pose}
    publish(simulator, "/gazebo/spawn_sdf_model", "gazebo_msgs/srv/SpawnModel_Request", request)
    assert simulator.world.bodies["egg"].pose[:3] == (1.0, 0.0, 1.0)
    wrench = {"body_name": "egg", "wrench": {"force": {"y": 2.0, "z": 2 * G}}, "duration": {"sec": -1}}
    publish(simulator, "/gazebo/apply_body_wrench", "gazebo_msgs/srv/ApplyBodyWrench_Request", wrench)
    simulator.run(0.1)
    assert simulator.world.bodies["egg"].twist[:3] == pytest.approx((0.0, 0.1, 0.0), abs=1e-9)
    publish(simulator, "/gazebo/clear_body_wrenches", "gazebo_msgs/srv/BodyRequest_Request", {"body_name": "egg"})
    state = {"model_name": "egg", "pose": {"position": {"x": 4.0, "z": 3.0}}, "twist": {"linear": {"x": 1.0}}}
    publish(simulator, "/gazebo/set_model_state", "gazebo_msgs/msg/ModelState", state)
    simulator.run(0.1)
    assert simulator.world.bodies["egg"].pose[:3] == pytest.approx((4.1, 0.0, 3.0 - G * 0.005), abs=1e-9)
    states = simulator.bus.latest("/gazebo/model_states")
    assert states.name == ["simpleton", "ground_plane", "egg"]
    assert states.twist[2].linear.x == pytest.approx(1.0)
    publish(simulator, "/gazebo/delete_model", "gazebo_msgs/srv/DeleteModel_Request", {"model_name": "egg"})
    assert "egg" not in simulator.world.bodies
    publish(simulator, "/gazebo/delete_model", "gazebo_msgs/srv/DeleteModel_Request", {"model_name": "eg"})
    assert any("/gazebo/delete_model: no model or robot `eg`" in remark for remark in remarks)


def test_a_wrench_is_given_in_the_frame_that_is_named() -> None:
    simulator = Simulator("simpleton", world="void", gravity=(0.0, 0.0, 0.0), spawn=Spawn(yaw=1.5707963267948966))
    request = {
        "body_name": simulator.kinematics.root,
        "reference_frame": "simpleton::chassis",
        "wrench": {"force": {"x": 3.0}},
        "duration": {"nanosec": 100_000_000},
    }
    publish(simulator, "/gazebo/apply_body_wrench", "gazebo_msgs/srv/ApplyBodyWrench_Request", request)
    simulator.run(0.01)
    x, y, _ = simulator.state.base_velocity[:3]
    assert y > 100 * abs(x)


def test_gzs_services_are_topics() -> None:
    simulator = Simulator("simpleton", spawn=Spawn(x=-3.0))
    model = BALL[BALL.index("<model") : BALL.index("</sdf>")]
    for _ in range(2):
        request = {"sdf": model, "allow_renaming": True, "pose": {"position": {"z": 1.0}}}
        publish(simulator, "/world/empty/create", "ros_gz_interfaces/msg/EntityFactory", request)
    assert {"ball", "ball_1"} <= set(simulator.world.bodies)
    request = {"entity": {"name": "ball_1"}, "pose": {"position": {"x": 2.0, "z": 2.0}}}
    publish(simulator, "/world/empty/set_pose", "ros_gz_interfaces/srv/SetEntityPose_Request", request)
    wrench = {"entity": {"name": "ball_1"}, "wrench": {"force": {"x": 20.0}}}
    publish(simulator, "/world/empty/wrench", "ros_gz_interfaces/msg/EntityWrench", wrench)
    simulator.run(0.1)
    assert simulator.world.bodies["ball_1"].twist[0] == pytest.approx(20.0 * 0.001 / 2.0)
    publish(simulator, "/world/empty/remove", "ros_gz_interfaces/msg/Entity", {"name": "ball_1"})
    assert "ball_1" not in simulator.world.bodies


def test_what_is_not_there_is_reported_with_what_is_near() -> None:
    simulator = Simulator("simpleton")
    with pytest.raises(ResourceError, match="no model or robot `coke_cn`; did you mean `coke_can`"):
        simulator.world.spawn("coke_cn")
    with pytest.raises(SimulationError, match="no body or link `chasis`"):
        simulator.world.push("chasis", (1.0, 0.0, 0.0))
    with pytest.raises(SimulationError, match="is the simulation's own robot"):
        simulator.world.remove("simpleton")
    with pytest.raises(SimulationError, match="it must be x y z, x y z yaw"):
        simulator.world.spawn("ball", (1.0, 2.0))
    simulator.world.spawn("ball", FAR, name="egg")
    with pytest.raises(SimulationError, match="has a `egg`; use `egg_1`"):
        simulator.world.spawn("ball", FAR, name="egg")


def test_poses_and_velocities_that_would_overflow_are_refused() -> None:
    simulator = Simulator("simpleton")
    before = simulator.world.pose("simpleton")
    with pytest.raises(SimulationError, match=r"the position contains 1e\+300; at most 1e\+09 can be simulated \[m\]"):
        simulator.world.place("simpleton", (0.0, 1e300, 0.0))
    with pytest.raises(SimulationError, match=r"the velocity contains -1e\+10; at most 1e\+09 can be simulated"):
        simulator.world.place("simpleton", (0.0, 0.0, 1.0), (0.0, -1e10, 0.0, 0.0, 0.0, 0.0))
    assert simulator.world.pose("simpleton") == before


def test_what_comes_where_a_robot_is_does_not_blow_it_away() -> None:
    simulator = Simulator("simpleton", note=lambda _: None)
    simulator.world.spawn("crate", (0.0, 0.0, 0.0))
    fastest = 0.0
    for _ in range(60):
        simulator.run(0.02)
        fastest = max(
            fastest, *map(abs, simulator.state.base_velocity), *map(abs, simulator.world.bodies["crate"].twist[:3])
        )
    assert fastest < 5.0
    assert max(map(abs, simulator.state.base_pose[:3])) < 1.0


@pytest.mark.parametrize("steps", [1.5, -1])
def test_a_step_is_a_whole_number(steps: float) -> None:
    with pytest.raises(SimulationError, match="invalid number of steps"):
        Simulator("simpleton", note=lambda _: None).step(steps)  # type: ignore[arg-type]
