"""four_wheel_steering_controller of ROS 1: its law, its odometry next to where the robot really is, errors."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from urdfkit.errors import UrdfkitError
from urdfkit.sim import Simulator

RADIUS, TRACK, BASE, OFFSET = 0.1, 0.5, 0.6, 0.05
"""Track is of the wheels; the knuckles are nearer to the middle by the offset."""

LINK = """
  <link name="{name}">{collision}
    <inertial><mass value="0.5"/><inertia ixx="0.002" ixy="0" ixz="0" iyy="0.002" iyz="0" izz="0.002"/></inertial>
  </link>
  <joint name="{name}_joint" type="{type}">
    <parent link="{parent}"/><child link="{name}"/><origin xyz="{x} {y} {z}"/><axis xyz="{axis}"/>
    <limit lower="-1.5" upper="1.5" effort="50" velocity="40"/>
  </joint>
  <transmission name="t_{name}"><type>transmission_interface/SimpleTransmission</type><joint name="{name}_joint">
    <hardwareInterface>hardware_interface/{kind}JointInterface</hardwareInterface></joint></transmission>
"""
SPHERE = f'<collision><geometry><sphere radius="{RADIUS}"/></geometry></collision>'
BODY = """<robot name="car"><link name="base">
  <inertial><origin xyz="0 0 0.12"/><mass value="10"/>
    <inertia ixx="0.2" ixy="0" ixz="0" iyy="0.5" iyz="0" izz="0.6"/></inertial></link>
"""
PARAMETERS = """car:
  base:
    type: four_wheel_steering_controller/FourWheelSteeringController
    front_wheel: [front_left_joint, front_right_joint]
    rear_wheel: [rear_left_joint, rear_right_joint]
    front_steering: [front_left_knuckle_joint, front_right_knuckle_joint]
    rear_steering: [rear_left_knuckle_joint, rear_right_knuckle_joint]
    pose_covariance_diagonal: [0, 0, 0, 0, 0, 0]
    twist_covariance_diagonal: [0, 0, 0, 0, 0, 0]
"""
Make = Callable[..., Any]


@pytest.fixture
def make(tmp_path: Path) -> Make:
    def build(parameters: str = PARAMETERS, *, strict: bool = False) -> Any:
        body, knuckles = BODY, TRACK / 2 - OFFSET
        for end, x in (("front", BASE / 2), ("rear", -BASE / 2)):
            for side, sign in (("left", 1), ("right", -1)):
                name = f"{end}_{side}"
                body += LINK.format(
                    name=f"{name}_knuckle", type="revolute", parent="base", x=x, y=sign * knuckles, z=RADIUS,
                    axis="0 0 1", collision="", kind="Position",
                )  # fmt: skip
                body += LINK.format(
                    name=name, type="continuous", parent=f"{name}_knuckle", x=0, y=sign * OFFSET, z=0,
                    axis="0 1 0", collision=SPHERE, kind="Velocity",
                )  # fmt: skip
        body += '<gazebo><plugin name="c" filename="libgazebo_ros_control.so"/></gazebo></robot>'
        (tmp_path / "car.urdf").write_text(body)
        (tmp_path / "control.yaml").write_text(parameters)
        return Simulator(
            tmp_path / "car.urdf", controllers=[tmp_path / "control.yaml"], note=lambda _: None, strict=strict
        )

    return build


def drive(simulator: Any, v: float, w: float, seconds: float) -> None:
    """Command a twist, which grows for a second."""
    for k in range(round(seconds / 0.1)):
        share = min(1.0, k / 10)
        simulator.command((share * v, 0, 0), (0, 0, share * w))
        simulator.run(0.1)


def test_wheels_and_steering(make: Make) -> None:
    simulator = make()
    simulator.run(0.5)  # before the first command
    assert simulator.state.position("front_left_knuckle_joint") == pytest.approx(0.0, abs=1e-3)
    assert simulator.state.velocity("front_left_joint") == pytest.approx(0.0, abs=1e-3)
    drive(simulator, 0.5, 0.4, 3.0)
    inside, outside = (0.5 - side * 0.4 * (TRACK / 2 - OFFSET) for side in (1, -1))
    left, right = math.atan(0.4 * BASE / 2 / inside), math.atan(0.4 * BASE / 2 / outside)
    steered = [simulator.state.position(f"{name}_knuckle_joint") for name in ("front_left", "front_right", "rear_left")]
    assert steered == pytest.approx([left, right, -left], abs=1e-3)
    rates = [simulator.state.velocity(f"{name}_joint") for name in ("front_left", "rear_right")]
    across = 0.4 * BASE / 2
    expected = [math.hypot(inside, across) - 0.4 * OFFSET, math.hypot(outside, across) + 0.4 * OFFSET]
    assert rates == pytest.approx([rate / RADIUS for rate in expected], rel=1e-3)


@pytest.mark.slow
@pytest.mark.parametrize(("v", "w"), [(0.5, 0.0), (0.5, 0.5), (-0.4, 0.3), (0.3, -0.4)])
def test_goes_where_it_is_told_and_knows_where_it_is(make: Make, v: float, w: float) -> None:
    simulator = make()
    drive(simulator, v, w, 4.5)
    t = 4.5 - 0.55
    there = (v * math.sin(w * t) / w, v * (1 - math.cos(w * t)) / w) if w else (v * t, 0.0)
    x, y, *_ = simulator.state.base_pose
    assert math.dist((x, y), there) < 0.01 * abs(v) * t
    odometry = simulator.bus.latest("/car/base/odom")
    place = odometry.pose.pose.position
    assert math.dist((place.x, place.y), (x, y)) < 0.01 * abs(v) * t
    twist = odometry.twist.twist
    assert (twist.linear.x, twist.linear.y, twist.angular.z) == pytest.approx((v, 0, w), abs=2e-3)


def test_stops_and_steers_straight_when_commands_cease(make: Make) -> None:
    simulator = make()
    drive(simulator, 0.5, 0.4, 2.0)
    simulator.run(1.5)
    assert simulator.state.velocity("front_left_joint") == pytest.approx(0, abs=1e-6)
    assert simulator.state.position("front_left_knuckle_joint") == pytest.approx(0, abs=1e-4)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("front_wheel: [front_left_joint, front_right_joint]", "front_wheel: [front_left_joint]", "names 1 joints"),
        ("rear_steering: [rear_left", "rear_steering: [raer_left", "did you mean `rear_left_knuckle_joint`"),
        ("    type:", "    wheel_radius: 0\n    type:", "`wheel_radius` is 0 m; it must be greater than zero"),
        ("    front_wheel: [front_left_joint, front_right_joint]\n", "", "has no `front_wheel`"),
    ],
)
def test_wrong_parameters_are_refused_at_their_place(make: Make, old: str, new: str, message: str) -> None:
    assert old in PARAMETERS
    with pytest.raises(UrdfkitError) as caught:
        make(PARAMETERS.replace(old, new), strict=True)
    assert "control.yaml:" in str(caught.value)
    assert message in str(caught.value)
