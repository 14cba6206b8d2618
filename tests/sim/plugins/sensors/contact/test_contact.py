"""Bumpers: what touches them, where, how hard, by the names that Gazebo gives collisions."""

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
from urdfkit.messages import message_type
from urdfkit.sim import Simulator, Spawn

ROS_1 = '<plugin name="b" filename="libgazebo_ros_bumper.so"><bumperTopicName>bump</bumperTopicName>{}</plugin>'
ROS_2 = (
    '<plugin name="b" filename="libgazebo_ros_bumper.so"><ros><namespace>n</namespace>'
    "<remapping>bumper_states:=bump</remapping></ros><frame_name>base</frame_name></plugin>"
)
MASS = 2.0


def bumper(plugin: str = "", collision: str = "base_collision", *, rate: float = 50.0, inside: str = "") -> str:
    return (
        f'<sensor name="s" type="contact"><update_rate>{rate}</update_rate><contact><collision>{collision}</collision>'
        f"{inside}</contact>{plugin}</sensor>"
    )


BOX = '<collision{}><origin xyz="{} 0 0"/><geometry><box size="{} 0.4 0.2"/></geometry></collision>'


@pytest.fixture
def crate(tmp_path: Path) -> Callable[..., Any]:
    """Return what makes a simulator of a crate of 2 kg, 0.4 m wide and 0.2 m high."""

    def make(sensors: str, *, collisions: str = BOX.format("", 0, 0.4), plugin: str = "", **options: Any) -> Simulator:
        (tmp_path / "crate.urdf").write_text(
            f'<robot name="crate"><link name="base"><inertial><mass value="{MASS}"/><inertia ixx="0.1" iyy="0.1" '
            f'izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial>{collisions}</link>'
            f'<gazebo reference="base">{sensors}</gazebo><gazebo>{plugin}</gazebo></robot>'
        )
        options.setdefault("note", lambda _: None)
        return Simulator(load(tmp_path / "crate.urdf"), **options)

    return make


@pytest.mark.parametrize(("plugin", "topic", "frame"), [(ROS_1, "/bump", "world"), (ROS_2, "/n/bump", "base")])
def test_at_rest_the_ground_carries_the_weight(crate, plugin: str, topic: str, frame: str) -> None:
    simulator = crate(bumper(plugin.format("")))
    simulator.run(0.5)
    message = heard(simulator, topic, 0.1)[-1]
    (state,) = message.states
    weight = -MASS * simulator.world.description.gravity[2]
    assert message.header.frame_id == frame
    assert (message.header.stamp.sec, message.header.stamp.nanosec) == (0, 600_000_000)
    assert state.collision1_name == "crate::base::base_collision"
    assert state.collision2_name == "ground_plane::link::collision"
    assert three(state.total_wrench.force) == pytest.approx((0, 0, weight), abs=1e-6)
    assert three(state.total_wrench.torque) == pytest.approx((0, 0, 0), abs=1e-6)
    assert sum(w.force.z for w in state.wrenches) == pytest.approx(weight, abs=1e-6)
    assert len(state.wrenches) == len(state.contact_positions) == len(state.contact_normals) == len(state.depths) > 2
    for position, normal, depth in zip(state.contact_positions, state.contact_normals, state.depths, strict=True):
        assert (abs(position.x), abs(position.y), position.z) == pytest.approx((0.2, 0.2, 0.0), abs=1e-6)
        assert three(normal) == pytest.approx((0, 0, 1))
        assert 0.0 <= depth < 1e-6
    assert "my geom:crate::base::base_collision" in state.info


def test_in_the_air_nothing_is_told_by_the_bumpers_and_nothing_said_by_gz_sims(crate) -> None:
    simulator = crate(bumper(ROS_1.format("")) + bumper(inside="<topic>touches</topic>"), spawn=Spawn(z=5.0))
    messages = heard(simulator, "/bump", 0.2)
    assert len(messages) == 10
    assert not any(message.states for message in messages)
    assert not heard(simulator, "/touches", 0.2)


def test_a_push_off_centre_turns_the_crate_by_what_the_torque_says(crate) -> None:
    simulator = crate(bumper(ROS_1.format("")))
    simulator.run(0.5)
    simulator.world.push("crate", force=(0, 0, -10.0), at=(0.1, 0.0, 0.1))
    state = heard(simulator, "/bump", 0.2)[-1].states[0]
    assert state.total_wrench.force.z == pytest.approx(10.0 - MASS * simulator.world.description.gravity[2], rel=1e-6)
    assert state.total_wrench.torque.y == pytest.approx(-0.1 * 10.0, abs=1e-6)  # balances the push


def test_a_short_touch_between_two_messages_is_reported(crate) -> None:
    simulator = crate(bumper(ROS_1.format(""), rate=2.0), spawn=Spawn(z=0.15))
    messages = heard(simulator, "/bump", 0.5)  # it falls for 0.1 s and lies from then on
    assert messages[0].states
    simulator.world.place("crate", (0.0, 0.0, 9.0))
    (message,) = heard(simulator, "/bump", 0.5)
    assert not message.states


def test_what_it_drives_against_is_named_and_pushes_back(crate) -> None:
    simulator = crate(bumper(ROS_1.format(""), rate=200.0), spawn=Spawn(twist=(1.0, 0, 0, 0, 0, 0)))
    simulator.world.spawn("unit_box", (0.75, 0.0, 0.5), name="thing")
    states = [state for message in heard(simulator, "/bump", 0.2) for state in message.states]
    against = [state for state in states if state.collision2_name.startswith("thing::link::")]
    assert against
    assert against[0].total_wrench.force.x < -1.0
    assert three(against[0].contact_normals[0]) == pytest.approx((-1, 0, 0), abs=1e-3)  # it nods as it brakes


@pytest.mark.parametrize("wanted", ["base_collision_1", "nose", "nose_collision", "crate::base::nose_collision_1"])
def test_one_of_several_collisions_hears_only_its_own(crate, wanted: str) -> None:
    several = BOX.format("", -0.2, 0.4) + BOX.format(' name="nose"', 0.2, 0.4)
    simulator = crate(bumper(ROS_1.format(""), wanted), collisions=several)
    simulator.run(0.5)
    (state,) = heard(simulator, "/bump", 0.1)[-1].states
    assert state.collision1_name == "crate::base::nose_collision_1"
    assert all(position.x >= -1e-6 for position in state.contact_positions)


def test_a_collision_on_the_very_place_of_another_hears_its_own_points(crate) -> None:
    twice = BOX.format("", 0, 0.4) + BOX.format(' name="copy"', 0, 0.4)
    for wanted in ("base_collision", "copy"):
        simulator = crate(bumper(ROS_1.format(""), wanted), collisions=twice)
        simulator.run(0.3)
        (state,) = heard(simulator, "/bump", 0.1)[-1].states
        assert len(state.contact_positions) == 4
        assert sum(contact.depth >= 0.0 or any(contact.force) for contact in simulator.state.contacts) == 8


def test_which_collision_of_a_body_was_touched_is_reported(crate, tmp_path: Path) -> None:
    felt = (
        '<collision name="{}"><pose>{} 0 0.05 0 0 0</pose><geometry><box><size>1 1 0.1</size></box></geometry>'
        "</collision>"
    )
    (tmp_path / "mat.sdf").write_text(
        '<sdf version="1.9"><model name="mat"><static>true</static><link name="l">'
        f"{felt.format('far', 1.5)}{felt.format('under', 0)}</link></model></sdf>"
    )
    simulator = crate(bumper(ROS_1.format("")), spawn=Spawn(z=0.21))
    simulator.world.spawn(tmp_path / "mat.sdf")
    simulator.run(0.5)
    assert {state.collision2_name for state in heard(simulator, "/bump", 0.1)[-1].states} == {"mat::l::under"}


def test_gz_sim_tells_contacts_with_both_wrenches(crate) -> None:
    simulator = crate(bumper())
    simulator.run(0.5)
    messages = heard(simulator, "/world/empty/model/crate/link/base/sensor/s/contact", 0.01)
    assert len(messages) == 10  # at every step, whatever the rate
    (contact,) = messages[-1].contacts
    assert (contact.collision1.name, contact.collision1.type) == ("crate::base::base_collision", 5)
    up = sum(wrench.body_1_wrench.force.z for wrench in contact.wrenches)
    assert up == pytest.approx(-MASS * simulator.world.description.gravity[2], abs=1e-6)
    assert up == pytest.approx(-sum(wrench.body_2_wrench.force.z for wrench in contact.wrenches))


def test_nothing_is_looked_at_for_nobody_but_the_last_one_can_be_had(crate) -> None:
    simulator = crate(bumper(ROS_1.format("")))
    simulator.run(1.0)
    topic = next(each for each in simulator.bus.topics if each.name == "/bump")
    assert topic.count == 50
    assert topic.latest.states[0].total_wrench.force.z == pytest.approx(
        -MASS * simulator.world.description.gravity[2], abs=1e-6
    )


def test_another_robots_bumper_hears_its_own_link_and_names_the_first_one(crate, tmp_path: Path) -> None:
    simulator = crate(bumper(ROS_1.format("")), spawn=Spawn(z=0.1))
    text = (tmp_path / "crate.urdf").read_text().replace("bump<", "second<")
    (tmp_path / "second.urdf").write_text(text)
    simulator.world.spawn(tmp_path / "second.urdf", (0.0, 0.0, 0.31), name="upper")
    simulator.run(0.5)
    (state,) = heard(simulator, "/second", 0.1)[-1].states
    assert state.collision1_name == "upper::base::base_collision"
    assert state.collision2_name == "crate::base::base_collision"
    assert state.total_wrench.force.z == pytest.approx(-MASS * simulator.world.description.gravity[2], rel=1e-4)
    lower = {each.collision2_name: each for each in heard(simulator, "/bump", 0.1)[-1].states}
    assert lower["upper::base::base_collision"].total_wrench.force.z == pytest.approx(
        MASS * simulator.world.description.gravity[2], rel=1e-4
    )
    assert np.isclose(
        lower["ground_plane::link::collision"].total_wrench.force.z,
        -2 * MASS * simulator.world.description.gravity[2],
        rtol=1e-4,
    )


@pytest.mark.parametrize(
    ("wrong", "reported"),
    [
        (bumper(ROS_1.format(""), "base_colision"), "no collision `base_colision`; did you mean `base_collision`?"),
        (bumper().replace("<collision>base_collision</collision>", ""), "lacks the <collision> in its <contact>"),
        (bumper(ROS_1.format(""), rate=-5), "<update_rate> is `-5`; it must be a finite number, 0 or greater"),
    ],
)
def test_what_makes_no_sense_is_left_out_by_name(crate, wrong: str, reported: str) -> None:
    notes: list[str] = []
    crate(wrong, note=notes.append)
    (note,) = [each for each in notes if "is ignored" in each]
    assert contains(note, reported)
    assert "crate.urdf:1:" in note
    assert "; sensor `s` is ignored" in note


def test_a_models_own_bumper_in_a_world_goes_by_the_names_of_its_file(crate, tmp_path: Path) -> None:
    (tmp_path / "mat.sdf").write_text(
        '<sdf version="1.9"><model name="mat"><link name="l"><pose>0 0 0.05 0 0 0</pose><inertial><mass>3</mass>'
        '</inertial><collision name="felt"><geometry><box><size>1 1 0.1</size></box></geometry></collision>'
        '<sensor name="s" type="contact"><contact><collision>felt</collision><topic>mat</topic></contact></sensor>'
        "</link></model></sdf>"
    )
    simulator = crate("", spawn=Spawn(z=0.21))
    simulator.world.spawn(tmp_path / "mat.sdf")
    simulator.run(0.5)
    contacts = {each.collision2.name: each for each in heard(simulator, "/mat", 0.01)[-1].contacts}
    on_it = contacts["crate::base::base_collision"]
    assert on_it.collision1.name == "mat::l::felt"
    down = sum(each.body_1_wrench.force.z for each in on_it.wrenches)
    assert down == pytest.approx(MASS * simulator.world.description.gravity[2], rel=1e-4)


def test_who_listens_changes_nothing(crate) -> None:
    def last(listen: bool) -> Any:
        simulator = crate(bumper(ROS_1.format("")), spawn=Spawn(z=0.3))
        if listen:
            return heard(simulator, "/bump", 0.5)[-1]
        simulator.run(0.5)
        return simulator.bus.latest("/bump")

    assert repr(last(True)) == repr(last(False))


TOUCH = (
    '<plugin filename="gz-sim-touchplugin-system" name="gz::sim::systems::TouchPlugin"><target>{target}</target>'
    "<time>0.2</time><namespace>goal</namespace>{more}</plugin>"
)


def test_the_touch_plugin_says_so_once_and_when_it_is_asked_again(crate) -> None:
    plugin = TOUCH.format(target="ground_plane", more="<enabled>true</enabled>")
    simulator = crate(bumper(), plugin=plugin, spawn=Spawn(z=0.2))
    when: list[float] = []
    simulator.subscribe("/goal/touched", "std_msgs/msg/Bool", lambda message: when.append(simulator.t))
    simulator.run(1.0)
    falls = np.sqrt(2 * 0.1 / -simulator.world.description.gravity[2])
    assert when == [pytest.approx(falls + 0.2, abs=0.005)]
    simulator.bus.publish("/goal/enable", "std_msgs/msg/Bool", message_type("std_msgs/msg/Bool")(True))
    simulator.run(0.5)
    assert when[1:] == [pytest.approx(1.2, abs=0.005)]


@pytest.mark.parametrize(
    ("target", "more"), [("ground_plane", ""), ("wall", "<enabled>true</enabled>")], ids=["not enabled", "elsewhere"]
)
def test_the_touch_plugin_is_silent_otherwise(crate, target: str, more: str) -> None:
    simulator = crate(bumper(), plugin=TOUCH.format(target=target, more=more))
    assert not heard(simulator, "/goal/touched", 0.5)
