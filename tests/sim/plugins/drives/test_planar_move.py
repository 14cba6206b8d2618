"""Planar move and velocity control: the base moves as told, contacts notwithstanding."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from urdfkit.errors import SimulationError
from urdfkit.messages import TF
from urdfkit.sim import Simulator, Spawn

ROBOT = """<robot name="sled">
  <link name="base">
    <collision><origin xyz="0 0 0.1"/><geometry><box size="0.4 0.3 0.2"/></geometry></collision>
    <inertial><origin xyz="0 0 0.1"/><mass value="5"/>
      <inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial>
  </link>
  <gazebo><plugin name="{name}" filename="{filename}">
{parameters}
  </plugin></gazebo>
</robot>
"""
FILES = {
    "ros1": ("mover", "libgazebo_ros_planar_move.so"),
    "ros2": ("mover", "libgazebo_ros_planar_move.so"),
    "gz": ("gz::sim::systems::VelocityControl", "gz-sim-velocity-control-system"),
}
SPELLED = {"ros1": "<odometryFrame>odom</odometryFrame>", "ros2": "<update_rate>20</update_rate>", "gz": ""}
GENERATIONS = ("ros1", "ros2", "gz")
FLOATING = Spawn(z=1.0)

Make = Callable[..., Any]


@pytest.fixture
def make(tmp_path: Path) -> Make:
    """Make a simulator of a box that one of the plugins moves."""

    def build(generation: str, parameters: str = "", **options: Any) -> Simulator:
        name, filename = FILES[generation]
        path = tmp_path / "sled.urdf"
        path.write_text(ROBOT.format(name=name, filename=filename, parameters=parameters or SPELLED[generation]))
        return Simulator(path, **options)

    return build


def yaw(simulator: Simulator) -> float:
    pose = simulator.state.base_pose
    return 2 * math.atan2(pose[5], pose[6])


def holonomic(vx: float, vy: float, w: float, seconds: float) -> tuple[float, float]:
    """Return where a body with a constant twist gets, that of SE(2)'s exponential."""
    angle = w * seconds
    s, c = math.sin(angle) / w, (1 - math.cos(angle)) / w
    return vx * s - vy * c, vx * c + vy * s


@pytest.mark.parametrize("generation", GENERATIONS)
def test_in_the_void_it_moves_as_a_holonomic_body(make: Make, generation: str) -> None:
    vx, vy, w = 0.4, -0.3, 0.5
    parameters = {"ros2": "<update_rate>0</update_rate>"}.get(generation, "")
    simulator = make(generation, parameters, world="void", gravity=(0, 0, 0), spawn=FLOATING)
    simulator.command((vx, vy, 0), (0, 0, w))
    simulator.run(4.0)
    x, y = holonomic(vx, vy, w, 4.0)
    assert simulator.state.base_pose[:2] == pytest.approx((x, y), abs=2e-3)
    assert yaw(simulator) == pytest.approx(w * 4.0, abs=1e-6)
    assert simulator.state.base_velocity[2] == pytest.approx(0, abs=1e-9)


@pytest.mark.parametrize("generation", GENERATIONS)
def test_a_ramp_adds_up(make: Make, generation: str) -> None:
    simulator = make(generation, world="void", gravity=(0, 0, 0), spawn=FLOATING)
    period = simulator.command_period
    assert period == pytest.approx(0.05 if generation == "ros2" else 0.001)
    for part in range(20):
        simulator.command((0.5 * (part + 0.5) / 20, 0, 0), (0, 0, 0))
        simulator.run(0.05)
    assert simulator.state.base_pose[0] == pytest.approx(0.25, abs=1e-9)


@pytest.mark.parametrize("generation", ["ros1", "gz"])
def test_on_the_ground_friction_has_one_step_at_a_time(make: Make, generation: str) -> None:
    simulator = make(generation)
    simulator.command((0.5, 0, 0), (0, 0, 0))
    simulator.run(2.0)
    # Each step begins at 0.5 m/s and ends slower by mu·g·dt; on the way the robot moves with the mean.
    assert simulator.state.base_pose[0] == pytest.approx(2.0 * (0.5 - 9.81e-3 / 2), abs=1e-3)
    assert simulator.state.base_velocity[0] == pytest.approx(0.5 - 9.81e-3, abs=1e-3)


def test_between_updates_of_ros_2_friction_slows_it(make: Make) -> None:
    simulator = make("ros2")
    simulator.command((1.0, 0, 0), (0, 0, 0))
    simulator.run(2.0)
    # 50 ms of mu·g take 0.49 m/s off each time.
    assert simulator.state.base_pose[0] == pytest.approx(2.0 * (1.0 - 9.81 * 0.05 / 2), rel=0.02)


@pytest.mark.parametrize(("generation", "period"), [("ros1", 0.001), ("gz", 0.001), ("ros2", 0.05)])
def test_gravity_is_cancelled_at_every_update(make: Make, generation: str, period: float) -> None:
    simulator = make(generation, spawn=Spawn(z=3.0))
    simulator.run(1.0)
    # What is left is the fall of each period from rest, g·T/2 per second.
    assert 3.0 - simulator.state.base_pose[2] == pytest.approx(9.81 * period / 2, rel=0.01)


def test_ros_1_and_2_know_no_height(make: Make) -> None:
    for generation in ("ros1", "ros2"):
        simulator = make(generation, world="void", gravity=(0, 0, 0), spawn=FLOATING)
        simulator.command((0, 0, 1.0), (0.3, 0.3, 0))
        simulator.run(1.0)
        assert simulator.state.base_pose[2] == pytest.approx(1.0, abs=1e-9)
        assert simulator.state.base_velocity == pytest.approx((0,) * 6, abs=1e-9)


def test_gz_sim_moves_in_all_six_directions(make: Make) -> None:
    simulator = make("gz", world="void", gravity=(0, 0, 0), spawn=Spawn(z=1.0, yaw=math.pi / 2))
    simulator.command((0.1, 0.2, 0.3), (0, 0, 0))
    simulator.run(1.0)
    assert simulator.state.base_pose[:3] == pytest.approx((-0.2, 0.1, 1.3), abs=1e-9)
    simulator.command((0, 0, 0), (0.4, 0, 0))
    simulator.run(1.0)
    assert simulator.state.base_velocity[3:] == pytest.approx((0, 0.4, 0), abs=1e-9)


def test_gz_sim_may_move_from_the_start(make: Make) -> None:
    initial = "<initial_linear>0.3 0 0</initial_linear><initial_angular>0 0 -0.1</initial_angular>"
    simulator = make("gz", initial, world="void", gravity=(0, 0, 0), spawn=FLOATING)
    simulator.run(1.0)
    assert yaw(simulator) == pytest.approx(-0.1)
    assert math.hypot(*simulator.state.base_pose[:2]) == pytest.approx(0.3, rel=1e-3)
    simulator.command((0, 0, 0), (0, 0, 0))
    simulator.run(0.5)
    assert simulator.state.base_velocity == pytest.approx((0,) * 6, abs=1e-12)
    simulator.reset()
    simulator.run(1.0)
    assert yaw(simulator) == pytest.approx(-0.1)


@pytest.mark.parametrize("generation", GENERATIONS)
def test_a_command_holds_until_the_next_one(make: Make, generation: str) -> None:
    simulator = make(generation)
    simulator.command((0.3, 0, 0), (0, 0, 0))
    simulator.run(3.0)
    there = simulator.state.base_pose[0]
    simulator.command((0, 0, 0), (0, 0, 0))
    simulator.run(0.1)
    here = simulator.state.base_pose[0]
    simulator.run(1.0)
    assert there > 0.25
    assert simulator.state.base_pose[0] == pytest.approx(here, abs=1e-3)


@pytest.mark.parametrize(
    ("distro", "timeout", "moved"),
    [(None, "0.5", 0.15), ("noetic", "0.5", 0.15), ("melodic", "0.5", 0.6), (None, "-1", 0.6)],
)
def test_commands_time_out_in_noetic(make: Make, distro: str | None, timeout: str, moved: float) -> None:
    tag = f"<cmdTimeout>{timeout}</cmdTimeout>"
    simulator = make("ros1", tag, world="void", gravity=(0, 0, 0), spawn=FLOATING, ros_distro=distro)
    simulator.run(1.0)
    simulator.command((0.3, 0, 0), (0, 0, 0))
    simulator.run(2.0)
    assert simulator.state.base_pose[0] == pytest.approx(moved, abs=1e-3)
    simulator.command((0.3, 0, 0), (0, 0, 0))
    simulator.run(0.4)
    assert simulator.state.base_pose[0] == pytest.approx(moved + 0.12, abs=1e-3)


def test_ros_1_odometry_is_a_difference_of_poses(make: Make) -> None:
    simulator = make("ros1", spawn=Spawn(x=3.0, yaw=math.pi / 2))
    simulator.run(0.5)
    simulator.command((0.4, 0.2, 0), (0, 0, 0))
    simulator.run(0.5)
    assert simulator.command_topics == ("/cmd_vel",)
    message = simulator.bus.latest("/odom")
    assert message.pose.pose.position.x == simulator.state.base_pose[0]
    assert message.pose.pose.position.z == 0.0
    assert (message.header.frame_id, message.child_frame_id) == ("odom", "base_footprint")
    linear = message.twist.twist.linear
    assert (linear.x, linear.y, linear.z) == pytest.approx((0.4, 0.2, 0), abs=0.01)
    assert message.pose.covariance[::7] == pytest.approx([1e-5, 1e-5, 1e12, 1e12, 1e12, 1e-3])
    assert not message.twist.covariance.any()
    counts = {topic.name: topic.count for topic in simulator.bus.topics}
    assert counts["/odom"] == 20


def test_ros_1_turns_are_differences_too(make: Make) -> None:
    simulator = make("ros1", world="void", gravity=(0, 0, 0), spawn=FLOATING)
    simulator.command((0, 0, 0), (0, 0, -2.0))
    simulator.run(5.0)
    assert simulator.bus.latest("/odom").twist.twist.angular.z == pytest.approx(-2.0, abs=1e-6)


def test_ros_1_without_odometry(make: Make) -> None:
    simulator = make("ros1", "<odometryRate>0</odometryRate><robotNamespace>/r</robotNamespace>")
    assert simulator.command_topics == ("/r/cmd_vel",)
    simulator.run(0.2)
    assert "/r/odom" not in {topic.name for topic in simulator.bus.topics}


def test_ros_2_publishes_the_truth(make: Make) -> None:
    extra = """<ros><namespace>/r</namespace><remapping>odom:=truth</remapping></ros>
    <covariance_x>0.1</covariance_x><covariance_yaw>0.3</covariance_yaw><publish_rate>10</publish_rate>"""
    simulator = make("ros2", extra, spawn=Spawn(yaw=math.pi / 2))
    seen: list[Any] = []
    simulator.subscribe("/tf", TF, seen.append)
    simulator.command((0.2, 0, 0), (0, 0, 0))
    simulator.run(1.0)
    assert simulator.command_topics == ("/r/cmd_vel",)
    message = simulator.bus.latest("/r/truth")
    velocity = simulator.state.base_velocity
    assert message.twist.twist.linear.x == pytest.approx(velocity[1])
    assert message.pose.pose.position.z == simulator.state.base_pose[2]
    for covariance in (message.pose.covariance, message.twist.covariance):
        assert covariance[::7] == pytest.approx([0.1, 1e-5, 1e12, 1e12, 1e12, 0.3])
    counts = {topic.name: topic.count for topic in simulator.bus.topics}
    assert counts["/r/truth"] == 10
    frames = [link.child_frame_id for tf in seen for link in tf.transforms if link.header.frame_id == "odom"]
    assert frames == ["base_footprint"] * 10


def test_ros_2_may_publish_nothing(make: Make) -> None:
    simulator = make("ros2", "<publish_odom>false</publish_odom><publish_odom_tf>false</publish_odom_tf>")
    simulator.run(0.2)
    assert "/odom" not in {topic.name for topic in simulator.bus.topics}


def test_gz_sim_publishes_nothing(make: Make) -> None:
    simulator = make("gz", name="s")
    assert simulator.command_topics == ("/model/s/cmd_vel",)
    assert simulator.odometry() == {}
    simulator.run(0.1)
    assert not [topic.name for topic in simulator.bus.topics if "odom" in topic.name]


def test_single_links_are_refused_aloud(make: Make) -> None:
    notes: list[str] = []
    make("gz", "<link_name>base</link_name>", note=notes.append)
    assert len(notes) == 1
    assert "velocities of single links are not simulated" in notes[0]


@pytest.mark.parametrize("generation", GENERATIONS)
def test_with_a_fixed_base_it_stays_and_notes_it(make: Make, generation: str) -> None:
    notes: list[str] = []
    simulator = make(generation, fixed_base=True, spawn=FLOATING, note=notes.append)
    simulator.command((1, 0, 0), (0, 0, 0))
    simulator.run(0.2)
    assert simulator.state.base_velocity == (0.0,) * 6
    assert len(notes) == 1
    assert "fixed base" in notes[0]


@pytest.mark.parametrize("generation", GENERATIONS)
def test_commands_that_are_not_finite_are_dropped(make: Make, generation: str) -> None:
    notes: list[str] = []
    simulator = make(generation, world="void", gravity=(0, 0, 0), spawn=FLOATING, note=notes.append)
    simulator.command((0.1, 0, 0), (0, 0, 0))
    simulator.run(0.1)
    simulator.command((0.1, math.nan, 0), (0, 0, 0))
    simulator.run(0.9)
    assert simulator.state.base_pose[0] == pytest.approx(0.1)
    assert len(notes) == 1
    assert "is not finite" in notes[0]


@pytest.mark.parametrize(
    ("generation", "wrong", "reported"),
    [
        ("ros1", "<odometryRate>often</odometryRate>", "<odometryRate> is `often`; it must be a finite number"),
        ("ros2", "<publish_odom>maybe</publish_odom>", "<publish_odom> is `maybe`; it must be true or false"),
        ("gz", "<initial_linear>1 2</initial_linear>", "<initial_linear> is `1 2`; it must be 3 finite numbers"),
        ("gz", "<initial_angular>a b c</initial_angular>", "<initial_angular> is `a b c`; it must be 3 finite"),
    ],
)
def test_wrong_parameters_are_named_with_their_place(make: Make, generation: str, wrong: str, reported: str) -> None:
    with pytest.raises(SimulationError) as caught:
        make(generation, wrong, strict=True)
    assert reported in str(caught.value)
    assert "sled.urdf:8:1: " in str(caught.value)


def test_the_base_of_a_bolted_robot_cannot_be_moved(make: Make) -> None:
    simulator = make("gz", fixed_base=True, spawn=FLOATING, note=lambda text: None)
    with pytest.raises(SimulationError, match="robot `sled` has no floating base to move"):
        simulator.motors.move_base((0, 0, 0), (0, 0, 0))


@pytest.mark.parametrize("generation", GENERATIONS)
def test_after_a_reset_all_is_as_at_the_start(make: Make, generation: str) -> None:
    def ride(simulator: Simulator) -> bytes:
        simulator.run(0.1)
        simulator.command((0.3, 0.1, 0), (0, 0, 0.5))
        simulator.run(1.0)
        return bytes(simulator.state.q.tobytes())

    simulator = make(generation)
    first = ride(simulator)
    simulator.reset()
    assert ride(simulator) == first


@pytest.mark.parametrize("generation", GENERATIONS)
def test_how_steps_are_portioned_out_does_not_matter(make: Make, generation: str) -> None:
    at_once, singly = make(generation), make(generation)
    for simulator in (at_once, singly):
        simulator.command((0.3, 0.1, 0), (0, 0, 0.5))
    at_once.step(300)
    for _ in range(300):
        singly.step()
    assert at_once.state.q.tobytes() == singly.state.q.tobytes()
