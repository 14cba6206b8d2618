"""The mecanum drive and the odometry publisher of gz sim."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from urdfkit.errors import SimulationError
from urdfkit.messages import ODOMETRY, TF
from urdfkit.sim import Simulator, Spawn

WHEEL = """
  <link name="{corner}_wheel">
    <collision><geometry><sphere radius="0.1"/></geometry></collision>
    <inertial><mass value="0.5"/><inertia ixx="0.002" ixy="0" ixz="0" iyy="0.002" iyz="0" izz="0.002"/></inertial>
  </link>
  <joint name="{corner}_joint" type="continuous">
    <parent link="base"/><child link="{corner}_wheel"/><origin xyz="{x} {y} 0.1"/><axis xyz="0 1 0"/>
  </joint>
"""
ROBOT = """<robot name="platform">
  <link name="base">
    <inertial><origin xyz="0 0 0.1"/><mass value="6"/>
      <inertia ixx="0.1" ixy="0" ixz="0" iyy="0.2" iyz="0" izz="0.25"/></inertial>
  </link>
  {wheels}
  <gazebo>
{plugins}
  </gazebo>
</robot>
"""
MECANUM = '<plugin name="gz::sim::systems::MecanumDrive" filename="gz-sim-mecanum-drive-system">{}</plugin>'
PUBLISHER = '<plugin name="gz::sim::systems::OdometryPublisher" filename="gz-sim-odometry-publisher-system">{}</plugin>'
SIZES = "<wheel_separation>0.5</wheel_separation><wheelbase>0.3</wheelbase><wheel_radius>0.1</wheel_radius>"
CORNERS = ("front_left", "front_right", "back_left", "back_right")
JOINTS = "".join(f"<{corner}_joint>{corner}_joint</{corner}_joint>" for corner in CORNERS)
IN_THE_AIR: dict[str, Any] = {"fixed_base": True, "spawn": Spawn(z=1.0)}
REACH = 0.4

Make = Callable[..., Any]


@pytest.fixture
def make(tmp_path: Path) -> Make:
    """Make a simulator of a platform on four wheels."""

    def build(plugins: str, **options: Any) -> Simulator:
        wheels = "".join(
            WHEEL.format(corner=corner, x=0.15 if "front" in corner else -0.15, y=0.25 if "left" in corner else -0.25)
            for corner in CORNERS
        )
        path = tmp_path / "platform.urdf"
        path.write_text(ROBOT.format(wheels=wheels, plugins=plugins))
        return Simulator(path, **options)

    return build


def drive(extra: str = "") -> str:
    return MECANUM.format(extra + JOINTS + SIZES)


@pytest.mark.parametrize("command", [(0.5, 0, 0), (0, 0.3, 0), (0, 0, 1.0), (0.2, -0.1, 0.4)])
def test_wheels_turn_as_the_inverse_kinematics_say(make: Make, command: tuple[float, float, float]) -> None:
    simulator = make(drive(), **IN_THE_AIR)
    vx, vy, w = command
    simulator.command((vx, vy, 0), (0, 0, w))
    simulator.run(0.1)
    rates = {corner: simulator.state.velocity(f"{corner}_joint") * 0.1 for corner in CORNERS}
    assert rates == pytest.approx(
        {
            "front_left": vx - vy - w * REACH,
            "front_right": vx + vy + w * REACH,
            "back_left": vx + vy - w * REACH,
            "back_right": vx - vy + w * REACH,
        }
    )


def test_odometry_is_that_of_a_holonomic_body(make: Make) -> None:
    vx, vy, w = 0.4, -0.2, 0.5
    simulator = make(drive(), name="p", **IN_THE_AIR)
    simulator.command((vx, vy, 0), (0, 0, w))
    simulator.run(5.0)
    angle = w * 5.0
    s, c = math.sin(angle) / w, (1 - math.cos(angle)) / w
    position, quaternion = simulator.odometry()["p/odom"]
    assert position == pytest.approx((vx * s - vy * c, vx * c + vy * s, 0), abs=2e-3)
    assert 2 * math.atan2(quaternion[2], quaternion[3]) == pytest.approx(angle, abs=1e-3)
    message = simulator.bus.latest("/model/p/odometry")
    linear = message.twist.twist.linear
    assert (linear.x, linear.y) == pytest.approx((vx, vy))
    assert message.twist.twist.angular.z == pytest.approx(w)
    assert (message.header.frame_id, message.child_frame_id) == ("p/odom", "p/base")


def test_limits_are_those_of_each_direction(make: Make) -> None:
    simulator = make(drive("<max_linear_acceleration>0.5</max_linear_acceleration>"), **IN_THE_AIR)
    simulator.command((1.0, 1.0, 0), (0, 0, 0))
    simulator.run(0.4)
    assert simulator.state.velocity("front_right_joint") * 0.1 == pytest.approx(0.4, abs=2e-3)
    assert simulator.state.velocity("front_left_joint") == pytest.approx(0, abs=1e-9)


def test_commands_hold_and_are_forgotten_by_a_reset(make: Make) -> None:
    simulator = make(drive(), **IN_THE_AIR)
    simulator.command((0.3, 0, 0), (0, 0, 0))
    simulator.run(2.0)
    assert simulator.state.velocity("back_left_joint") == pytest.approx(3.0)
    simulator.reset()
    simulator.run(0.1)
    assert simulator.state.velocity("back_left_joint") == 0.0
    assert next(iter(simulator.odometry().values()))[0] == (0, 0, 0)


@pytest.mark.parametrize(
    ("plugins", "reported"),
    [
        (MECANUM.format("<front_left_joint>front_left_joint</front_left_joint>"), "no <front_right_joint>; this drive"),
        (drive("<back_left_joint>back_lft_joint</back_left_joint>"), "no joint `back_lft_joint` in robot `platform`"),
        (MECANUM.format(JOINTS + "<wheelbase>0</wheelbase>"), "<wheelbase> is `0`; it must be a number greater than"),
        (PUBLISHER.format("<dimensions>4</dimensions>"), "<dimensions> is `4`; it must be 2 or 3"),
        (PUBLISHER.format("<xyz_offset>1</xyz_offset>"), "<xyz_offset> is `1`; it must be 3 finite numbers"),
    ],
)
def test_wrong_parameters_are_named_with_their_place(make: Make, plugins: str, reported: str) -> None:
    with pytest.raises(SimulationError) as caught:
        make(plugins, strict=True)
    assert reported in str(caught.value)
    assert "platform.urdf:" in str(caught.value)


# The odometry publisher

ROLLING = Spawn(x=2.0, yaw=math.pi / 2, twist=(0, 0.5, 0, 0, 0, 0), velocities={f"{c}_joint": 5.0 for c in CORNERS})


def test_it_publishes_the_truth(make: Make) -> None:
    simulator = make(PUBLISHER.format(""), name="p", spawn=ROLLING)
    seen: list[Any] = []
    simulator.subscribe("/model/p/pose", TF, seen.append)
    simulator.run(1.0)
    for topic in ("/model/p/odometry", "/model/p/odometry_with_covariance"):
        message = simulator.bus.latest(topic)
        assert (message.header.frame_id, message.child_frame_id) == ("p/odom", "p/base_footprint")
        at = message.pose.pose.position
        assert (at.x, at.y, at.z) == pytest.approx((2.0, 0.5, 0), abs=1e-3)
        assert message.twist.twist.linear.x == pytest.approx(0.5, abs=1e-3)
        assert not message.pose.covariance.any()
    assert len(seen) == 50
    assert simulator.command_topics == ()


def test_in_three_dimensions_with_an_offset(make: Make) -> None:
    tags = """<dimensions>3</dimensions><xyz_offset>1 0 0.2</xyz_offset><odom_topic>/o</odom_topic>
    <odom_frame>map</odom_frame><robot_base_frame>tip</robot_base_frame>"""
    spin = Spawn(z=1.0, twist=(0, 0, 0.1, 0, 0, 0.5))
    simulator = make(PUBLISHER.format(tags), world="void", gravity=(0, 0, 0), spawn=spin)
    simulator.run(1.0)
    message = simulator.bus.latest("/o")
    at, linear = message.pose.pose.position, message.twist.twist.linear
    assert (message.header.frame_id, message.child_frame_id) == ("map", "tip")
    assert (at.x, at.y, at.z) == pytest.approx((math.cos(0.5), math.sin(0.5), 1.3), abs=2e-3)
    assert (linear.x, linear.y, linear.z) == pytest.approx((0, 0.5, 0.1), abs=2e-3)


def test_noise_has_its_deviation_and_its_seed(make: Make) -> None:
    def velocities(seed: int) -> list[float]:
        simulator = make(PUBLISHER.format("<gaussian_noise>0.1</gaussian_noise>"), name="p", seed=seed)
        found: list[float] = []
        simulator.subscribe("/model/p/odometry", ODOMETRY, lambda m: found.append(m.twist.twist.linear.x))
        simulator.run(20.0)
        covariance = simulator.bus.latest("/model/p/odometry_with_covariance").pose.covariance
        assert covariance[::7] == pytest.approx([0.01] * 6)
        return found

    first = velocities(1)
    deviation = math.sqrt(sum(v * v for v in first) / len(first))
    assert deviation == pytest.approx(0.1, rel=0.1)
    assert first == velocities(1)
    assert first != velocities(2)
