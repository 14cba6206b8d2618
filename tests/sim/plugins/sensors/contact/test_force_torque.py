"""Force and torque at a joint, next to closed forms: a load on an arm, a pendulum that swings, a load that rests."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.sim.plugins.sensors.conftest import heard
from tests.sim.plugins.sensors.test_point_motion import three
from tests.suggestions import contains
from urdfkit.description import load
from urdfkit.sim import Simulator, Spawn
from urdfkit.sim.state.quaternion import rotate

G = 9.8
ROS_1 = (
    '<plugin name="ft" filename="libgazebo_ros_ft_sensor.so"><jointName>{joint}</jointName><topicName>ft</topicName>'
    "<updateRate>100</updateRate>{more}</plugin>"
)
ROS_2 = (
    '<plugin name="ft" filename="libgazebo_ros_ft_sensor.so"><ros><namespace>n</namespace><remapping>wrench:=ft'
    "</remapping></ros><joint_name>{joint}</joint_name><update_rate>100</update_rate></plugin>"
)
GZ = '<sensor name="s" type="force_torque"><update_rate>100</update_rate><topic>ft</topic>{}</sensor>'


def inertial(mass: float, at: str = "0 0 0") -> str:
    return (
        f'<inertial><origin xyz="{at}"/><mass value="{mass}"/><inertia ixx="0.02" iyy="0.03" izz="0.04" ixy="0" '
        'ixz="0" iyz="0"/></inertial>'
    )


ARM = f"""<robot name="arm"><link name="world"/><link name="upper">{inertial(1.5, "0.2 0 0")}</link>
<link name="hand">{inertial(0.5, "0.1 0.05 0")}<collision><geometry><sphere radius="0.02"/></geometry>
</collision></link>
<joint name="shoulder" type="{{shoulder}}"><parent link="world"/><child link="upper"/><origin xyz="0 0 {{height}}"/>
<axis xyz="0 1 0"/><limit lower="-9" upper="9" effort="100" velocity="100"/></joint>
<joint name="wrist" type="fixed"><parent link="upper"/><child link="hand"/>
<origin xyz="0.4 0 0" rpy="0 0 1.5707963267948966"/></joint>
<link name="tip"/><joint name="end" type="fixed"><parent link="hand"/><child link="tip"/></joint>
<gazebo>{{plugin}}</gazebo><gazebo reference="{{joint}}">{{sensor}}</gazebo></robot>"""


@pytest.fixture
def arm(tmp_path: Path) -> Callable[..., Any]:
    """Return what makes a simulator of an arm that turns about y at its shoulder, so high above the ground [m]."""

    def make(
        plugin: str = "",
        sensor: str = "",
        *,
        shoulder: str = "fixed",
        joint: str = "shoulder",
        height=1.0,
        **options: Any,
    ) -> Simulator:
        plugin = plugin.format(joint=joint, more="")
        (tmp_path / "arm.urdf").write_text(
            ARM.format(shoulder=shoulder, plugin=plugin, sensor=sensor, joint=joint, height=height)
        )
        options = {"world": "void", "gravity": (0, 0, -G), "note": lambda _: None, **options}
        return Simulator(load(tmp_path / "arm.urdf"), **options)

    return make


def wrench(message: Any) -> tuple[tuple[float, float, float], tuple[float, float, float]]:
    return three(message.wrench.force), three(message.wrench.torque)


@pytest.mark.parametrize(("plugin", "topic"), [(ROS_1, "/ft"), (ROS_2, "/n/ft")])
def test_an_arm_that_is_held_out_weighs_what_it_weighs(arm, plugin: str, topic: str) -> None:
    message = heard(arm(plugin), topic, 0.05)[-1]
    force, torque = wrench(message)
    # Centres of mass: 1.5 kg at x = 0.2 m; 0.5 kg at x = 0.4 - 0.05, y = 0.1 m.
    assert message.header.frame_id == "upper"
    assert force == pytest.approx((0, 0, -2.0 * G), abs=1e-9)
    assert torque == pytest.approx((-0.5 * G * 0.1, G * (1.5 * 0.2 + 0.5 * 0.35), 0), abs=1e-9)


def test_a_fixed_joint_further_out_tells_in_the_axes_of_its_child(arm) -> None:
    message = heard(arm(ROS_1, joint="wrist"), "/ft", 0.05)[-1]
    force, torque = wrench(message)
    assert message.header.frame_id == "hand"
    assert force == pytest.approx((0, 0, -0.5 * G), abs=1e-9)
    assert torque == pytest.approx((-0.05 * 0.5 * G, 0.1 * 0.5 * G, 0), abs=1e-9)


@pytest.mark.parametrize(
    ("inside", "sign", "turn"),
    [
        ("", -1.0, "child"),
        ("<force_torque><measure_direction>parent_to_child</measure_direction></force_torque>", 1.0, "child"),
        ("<force_torque><frame>parent</frame></force_torque>", -1.0, "parent"),
        ("<pose>0 0 0 0 0 0.5</pose><force_torque><frame>sensor</frame></force_torque>", -1.0, "sensor"),
    ],
)
def test_gz_sim_has_directions_and_frames(arm, inside: str, sign: float, turn: str) -> None:
    message = heard(arm(sensor=GZ.format(inside), joint="wrist"), "/ft", 0.05)[-1]
    force, torque = wrench(message)
    angle = {"child": 0.0, "parent": -np.pi / 2, "sensor": 0.5}[turn]
    x, y = sign * 0.05 * 0.5 * G, -sign * 0.1 * 0.5 * G
    assert message.header.frame_id == "arm/wrist/s"
    assert force == pytest.approx((0, 0, sign * 0.5 * G), abs=1e-9)
    expected = (np.cos(angle) * x + np.sin(angle) * y, np.cos(angle) * y - np.sin(angle) * x, 0)
    assert torque == pytest.approx(expected, abs=1e-9)


def test_a_pendulum_pulls_by_its_weight_and_its_turning(arm) -> None:
    simulator = arm(ROS_1, shoulder="continuous", spawn=Spawn(z=0.0, joints={"shoulder": 0.3}))
    messages = heard(simulator, "/ft", 0.5)
    # About the shoulder, as Pinocchio has it: a physical pendulum of 2 kg.
    model, data = simulator.kinematics.model, simulator.kinematics.data
    import pinocchio as pin

    pin.crba(model, data, simulator.state.q)
    about = data.M[0, 0]
    first = 1.5 * 0.2 + 0.5 * 0.35  # kg·m along the arm; the rest is along the axis
    q, v = simulator.state.position("shoulder"), simulator.state.velocity("shoulder")
    a = first * G * np.cos(q) / about
    half = 0.5 * simulator.dt  # it tells the mean over the last step
    q, v, a = q - half * v, v - half * a, first * G * np.cos(q - half * v) / about
    force, torque = wrench(messages[-1])
    assert v > 3.0
    assert force[0] == pytest.approx(first * v**2 + 2.0 * G * np.sin(q), rel=1e-5)  # outwards, by centripetal force
    assert force[2] == pytest.approx(-2.0 * G * np.cos(q) + first * a, rel=1e-4)
    assert torque[1] == pytest.approx(0.0, abs=1e-4)  # nothing holds it about its axis
    assert force[1] == pytest.approx(0.0, abs=1e-6)


def test_a_motor_that_holds_it_is_felt_about_the_axis(arm) -> None:
    simulator = arm(ROS_1, shoulder="revolute")
    simulator.motors.hold("shoulder", 0.0)
    simulator.run(2.0)
    torque = wrench(heard(simulator, "/ft", 0.05)[-1])[1]
    assert torque[1] == pytest.approx(G * (1.5 * 0.2 + 0.5 * 0.35), rel=1e-3)
    assert torque[1] == pytest.approx(-simulator.state.effort("shoulder"), rel=1e-6)


def test_what_lies_on_the_ground_and_what_is_pushed_counts(arm) -> None:
    simulator = arm(ROS_1, shoulder="continuous", world="empty", height=0.25)
    simulator.run(3.0)  # the hand lies on the ground, the arm leans on it
    assert simulator.state.contacts
    simulator.world.push("hand", force=(0.0, 3.0, 0.0))
    force, torque = wrench(heard(simulator, "/ft", 0.05)[-1])
    contacts = [(np.array(contact.position), np.array(contact.force)) for contact in simulator.state.contacts]
    ground, push = sum(force for _, force in contacts), np.array([0.0, 3.0, 0.0])
    upper, hand = simulator.link_poses()[1:3]
    assert ground[2] > 5.0
    assert rotate(upper[3:], force) == pytest.approx(ground + push + [0.0, 0.0, -2.0 * G], abs=1e-6)
    centres = [np.array(rotate(upper[3:], (0.2, 0.0, 0.0))), hand[:3] + rotate(hand[3:], (0.1, 0.05, 0.0)) - upper[:3]]
    moment = sum(np.cross(position - upper[:3], force) for position, force in contacts)
    moment += np.cross(hand[:3] - upper[:3], push)
    moment += sum(np.cross(at, [0.0, 0.0, -m * G]) for at, m in zip(centres, (1.5, 0.5), strict=True))
    assert rotate(upper[3:], torque) == pytest.approx(moment, abs=1e-6)


@pytest.mark.slow
def test_noise_is_on_all_six(arm) -> None:
    simulator = arm(ROS_1.replace("{more}", "<gaussianNoise>0.5</gaussianNoise>"))
    messages = heard(simulator, "/ft", 10.0)
    values = np.array([[*three(m.wrench.force), *three(m.wrench.torque)] for m in messages])
    assert len(values) == 1000
    assert values.std(axis=0) == pytest.approx(np.full(6, 0.5), rel=0.12)
    assert values[:, 2].mean() == pytest.approx(-2.0 * G, abs=5 * 0.5 / np.sqrt(1000))


@pytest.mark.parametrize(
    ("plugin", "sensor", "joint", "reported"),
    [
        (ROS_1, "", "sholder", "no joint `sholder` in robot `arm`; did you mean `shoulder`?"),
        (ROS_1.replace("<topicName>ft</topicName>", ""), "", "wrist", "gazebo_ros_ft_sensor has no <topicName>"),
        (ROS_1.replace("<jointName>{joint}</jointName>", ""), "", "wrist", "has no <jointName>"),
        (ROS_2.replace("joint_name", "body_name"), "", "hand", "on a link (<body_name>) is not simulated"),
        ("", GZ.format(""), "hand", "must be in the <gazebo reference=…> of a joint; `hand` is a link"),
        ("", GZ.format("<force_torque><frame>chidl</frame></force_torque>"), "wrist", "did you mean `child`?"),
    ],
)
def test_what_makes_no_sense_is_left_out_by_name(arm, plugin: str, sensor: str, joint: str, reported: str) -> None:
    notes: list[str] = []
    arm(plugin, sensor, joint=joint, note=notes.append)
    (note,) = [each for each in notes if "is ignored" in each]
    assert contains(note, reported)
    assert "arm.urdf:" in note
