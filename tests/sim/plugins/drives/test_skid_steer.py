"""The skid steer drive, and that robots skid as Coulomb friction states."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from urdfkit.errors import SimulationError
from urdfkit.messages import TF
from urdfkit.sim import Simulator

RADIUS, HALF_TRACK, MASS = 0.1, 0.25, 8.0

WHEEL = """
  <link name="{name}_wheel">
    <collision><origin rpy="1.5707963267948966 0 0"/>
      <geometry><cylinder radius="0.1" length="0.04"/></geometry></collision>
    <inertial><mass value="0.5"/><inertia ixx="0.0015" ixy="0" ixz="0" iyy="0.0025" iyz="0" izz="0.0015"/></inertial>
  </link>
  <joint name="{name}_joint" type="continuous">
    <parent link="base"/><child link="{name}_wheel"/><origin xyz="{x} {y} 0.1"/><axis xyz="0 1 0"/>
  </joint>
"""
ROBOT = """<robot name="quad">
  <link name="base">
    <inertial><origin xyz="{centre} 0 0.1"/><mass value="6"/>
      <inertia ixx="0.1" ixy="0" ixz="0" iyy="0.2" iyz="0" izz="0.25"/></inertial>
  </link>
  {wheels}
  <gazebo><plugin name="drive" filename="{filename}">
{parameters}
  </plugin></gazebo>
</robot>
"""
SIZES = "<wheelSeparation>0.5</wheelSeparation><wheelDiameter>0.2</wheelDiameter>"
PAIRS = """<num_wheel_pairs>2</num_wheel_pairs>
<left_joint>left_front_joint</left_joint><left_joint>left_rear_joint</left_joint>
<right_joint>right_front_joint</right_joint><right_joint>right_rear_joint</right_joint>
<wheel_separation>0.5</wheel_separation><wheel_separation>0.5</wheel_separation>
<wheel_diameter>0.2</wheel_diameter><wheel_diameter>0.2</wheel_diameter>
<odometry_source>0</odometry_source><max_wheel_torque>50</max_wheel_torque>"""

Make = Callable[..., Any]


@pytest.fixture
def make(tmp_path: Path) -> Make:
    """Make a simulator of a robot on four wheels, two of them `half_base` ahead and two behind."""

    def build(
        parameters: str = SIZES + "<torque>50</torque>",
        filename: str = "libgazebo_ros_skid_steer_drive.so",
        *,
        half_base: float = 0.2,
        centre: float = 0.0,
        **options: Any,
    ) -> Simulator:
        wheels = "".join(
            WHEEL.format(name=f"{side}_{end}", x=along * half_base, y=across * HALF_TRACK)
            for side, across in (("left", 1), ("right", -1))
            for end, along in (("front", 1), ("rear", -1))
        )
        path = tmp_path / "quad.urdf"
        path.write_text(ROBOT.format(wheels=wheels, filename=filename, parameters=parameters, centre=centre))
        return Simulator(path, **options)

    return build


def yaw(simulator: Simulator) -> float:
    pose = simulator.state.base_pose
    return 2 * math.atan2(pose[5], pose[6])


def settled_turn(simulator: Simulator, rate: float) -> float:
    """Return the yaw rate once it is steady."""
    for part in range(1, 11):
        simulator.command((0, 0, 0), (0, 0, rate * part / 10))
        simulator.run(0.05)
    simulator.run(2.0)
    before = yaw(simulator)
    simulator.run(1.0)
    return math.remainder(yaw(simulator) - before, 2 * math.pi)


@pytest.mark.parametrize("half_base", [0.1, 0.2, 0.25])
def test_on_the_spot_it_turns_at_the_rate_that_friction_gives(make: Make, half_base: float) -> None:
    # Wheel surfaces run at ±W·b, where the robot needs w·b, and are dragged sideways at w·a. Friction is opposite to
    # the slip (b·(W - w), a·w), the same at all wheels, and has no moment when b·b·(W - w) = a·a·w.
    wanted = 1.0
    expected = wanted * HALF_TRACK**2 / (HALF_TRACK**2 + half_base**2)
    simulator = make(half_base=half_base)
    assert settled_turn(simulator, wanted) == pytest.approx(expected, rel=5e-3)
    assert math.hypot(*simulator.state.base_pose[:2]) < 0.01


def quasi_static(wanted: float, half_base: float, loads: tuple[float, float]) -> tuple[float, float, float]:
    """Return vx, vy, w at which Coulomb friction on four wheels with these loads (front, rear) has no resultant."""
    points = [(along * half_base, across * HALF_TRACK) for along in (1, -1) for across in (1, -1)]
    velocity = np.zeros(3)
    for _ in range(200_000):
        force = np.zeros(3)
        for x, y in points:
            load = loads[0] if x > 0 else loads[1]
            surface = -wanted * math.copysign(HALF_TRACK, y)
            slip = np.array([velocity[0] - velocity[2] * y - surface, velocity[1] + velocity[2] * x])
            push = -load * slip / (np.linalg.norm(slip) + 1e-12)
            force += (push[0], push[1], x * push[1] - y * push[0])
        velocity += 2e-4 * force
        if np.abs(force).max() < 1e-9:
            break
    return float(velocity[0]), float(velocity[1]), float(velocity[2])


@pytest.mark.slow
def test_with_the_weight_in_front_it_turns_about_another_point(make: Make) -> None:
    half_base, centre = 0.2, 0.06
    shift = 6.0 * centre / MASS  # of the whole robot's centre of mass
    front = (half_base + shift) / (4 * half_base)
    vx, vy, w = quasi_static(1.0, half_base, (front, 0.5 - front))
    simulator = make(half_base=half_base, centre=centre)
    assert settled_turn(simulator, 1.0) == pytest.approx(w, rel=0.01)
    state = simulator.state
    heading = yaw(simulator)
    along = math.cos(heading) * state.base_velocity[0] + math.sin(heading) * state.base_velocity[1]
    across = math.cos(heading) * state.base_velocity[1] - math.sin(heading) * state.base_velocity[0]
    assert along == pytest.approx(vx, abs=2e-3)
    assert across == pytest.approx(vy, abs=3e-3)
    assert abs(vy) > 0.01


@pytest.mark.parametrize("half_base", [0.1, 0.2])
def test_encoders_overestimate_the_turn(make: Make, half_base: float) -> None:
    simulator = make(PAIRS, "libgazebo_ros_diff_drive.so", half_base=half_base)
    turned = settled_turn(simulator, 0.8)
    before = simulator.odometry()["odom"][1]
    simulator.run(1.0)
    after = simulator.odometry()["odom"][1]
    believed = math.remainder(2 * (math.atan2(*after[2:]) - math.atan2(*before[2:])), 2 * math.pi)
    assert believed == pytest.approx(0.8, rel=1e-3)
    assert believed / turned == pytest.approx(1 + (half_base / HALF_TRACK) ** 2, rel=5e-3)


def test_straight_on_it_is_a_robot_on_wheels(make: Make) -> None:
    simulator = make()
    for part in range(1, 11):
        simulator.command((0.05 * part, 0, 0), (0, 0, 0))
        simulator.run(0.1)
    simulator.run(1.0)
    assert simulator.state.base_velocity[0] == pytest.approx(0.5, abs=1e-6)
    assert simulator.state.base_pose[1] == pytest.approx(0, abs=1e-9)
    for end in ("front", "rear"):
        assert simulator.state.velocity(f"left_{end}_joint") == pytest.approx(5.0, abs=1e-5)


def test_torque_limit(make: Make) -> None:
    simulator = make(SIZES + "<torque>0.02</torque>")
    simulator.command((1.0, 0, 0), (0, 0, 0))
    simulator.run(1.0)
    # 4 · 0.02 N·m / 0.1 m on m + 4·I/r² = 8 + 1 kg
    assert simulator.state.base_velocity[0] == pytest.approx(0.8 / 9, rel=0.01)


def test_topics_frames_and_covariance(make: Make) -> None:
    simulator = make(name="spawned")
    assert simulator.command_topics == ("/cmd_vel",)
    simulator.run(1.0)
    message = simulator.bus.latest("/odom")
    assert (message.header.frame_id, message.child_frame_id) == ("odom", "base_footprint")
    expected = [1e-4, 1e-4, 1e12, 1e12, 1e12, 1e-2]
    assert message.pose.covariance[::7] == pytest.approx(expected)
    assert message.twist.covariance[::7] == pytest.approx(expected)
    assert message.pose.pose.position.z == 0.0
    counts = {topic.name: topic.count for topic in simulator.bus.topics}
    assert counts["/odom"] == 100


def test_namespace_and_transform(make: Make) -> None:
    extra = "<robotNamespace>fleet/a</robotNamespace><broadcastTF>true</broadcastTF><updateRate>20</updateRate>"
    simulator = make(SIZES + extra)
    assert simulator.command_topics == ("/fleet/a/cmd_vel",)
    seen: list[Any] = []
    simulator.subscribe("/tf", TF, seen.append)
    simulator.run(1.0)
    assert simulator.bus.latest("/fleet/a/odom") is not None
    links = [link for message in seen for link in message.transforms if link.header.frame_id == "odom"]
    assert len(links) == 20
    assert links[-1].child_frame_id == "base_footprint"


def test_the_sides_of_the_skid_steer_drive_are_not_swapped_in_indigo(make: Make) -> None:
    simulator = make(ros_distro="indigo")
    assert settled_turn(simulator, 0.5) > 0.2


@pytest.mark.parametrize(
    ("extra", "reported"),
    [
        ("<leftRearJoint>left_rare_joint</leftRearJoint>", "no joint `left_rare_joint` in robot `quad`; did you mean"),
        ("<wheelDiameter>0</wheelDiameter>", "<wheelDiameter> is `0`; it must be a number greater than zero"),
        ("<wheelSeparation>-1</wheelSeparation>", "<wheelSeparation> is `-1`; it must be a number greater than zero"),
    ],
)
def test_wrong_parameters_are_named_with_their_place(make: Make, extra: str, reported: str) -> None:
    with pytest.raises(SimulationError) as caught:
        make(extra, strict=True)
    assert reported in str(caught.value)
    assert "quad.urdf:" in str(caught.value)
