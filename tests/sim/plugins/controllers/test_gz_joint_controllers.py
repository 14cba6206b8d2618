"""JointPositionController and JointController of gz sim."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from urdfkit.errors import SimulationError
from urdfkit.messages import FLOAT, from_fields
from urdfkit.sim import Simulator

ARM = Path(__file__).parents[2] / "arm.urdf"  # one elbow about y, 1 kg 0.2 m out along x, 20 N·m, 3 rad/s
WEIGHT = 9.81 * 0.2


def make(tmp_path: Path, kind: str, parameters: str, **options: Any) -> Any:
    name = {"position": "JointPositionController", "velocity": "JointController"}[kind]
    file = {"position": "joint-position-controller", "velocity": "joint-controller"}[kind]
    plugin = (
        f'<gazebo><plugin filename="gz-sim-{file}-system" name="gz::sim::systems::{name}">'
        f"<joint_name>elbow</joint_name>{parameters}</plugin></gazebo></robot>"
    )
    path = tmp_path / "arm.urdf"
    path.write_text(ARM.read_text().replace("</robot>", plugin))
    options.setdefault("note", lambda _: None)
    return Simulator(path, **options)


def send(simulator: Any, topic: str, value: float) -> None:
    simulator.bus.publish(topic, FLOAT, from_fields(FLOAT, {"data": value}))


@pytest.mark.parametrize("dt", [0.001, 0.005])
def test_pid_holds_under_gravity(tmp_path: Path, dt: float) -> None:
    gains = "<p_gain>100</p_gain><i_gain>100</i_gain><d_gain>10</d_gain><i_max>10</i_max><i_min>-10</i_min>"
    simulator = make(tmp_path, "position", gains, dt=dt)
    send(simulator, "/model/arm/joint/elbow/0/cmd_pos", -0.5)
    simulator.run(10.0)
    assert simulator.state.position("elbow") == pytest.approx(-0.5, abs=1e-4)


def test_the_command_is_clamped_and_need_not_be_evenly(tmp_path: Path) -> None:
    gains = "<p_gain>1000</p_gain><i_gain>0</i_gain><d_gain>10</d_gain><cmd_max>1</cmd_max><cmd_min>-0.25</cmd_min>"
    simulator = make(tmp_path, "position", gains, gravity=(0, 0, 0))
    send(simulator, "/model/arm/joint/elbow/0/cmd_pos", 1.0)
    simulator.run(0.01)
    assert simulator.state.tau[0] == pytest.approx(1.0)
    send(simulator, "/model/arm/joint/elbow/0/cmd_pos", -1.0)
    simulator.run(0.01)
    assert simulator.state.tau[0] == pytest.approx(-0.25)


def test_an_offset_is_added(tmp_path: Path) -> None:
    gains = f"<p_gain>100</p_gain><i_gain>0</i_gain><d_gain>10</d_gain><cmd_offset>{-WEIGHT}</cmd_offset>"
    simulator = make(tmp_path, "position", gains)
    simulator.run(5.0)
    assert simulator.state.position("elbow") == pytest.approx(0.0, abs=1e-6)


def test_initial_position_own_topic_and_reset(tmp_path: Path) -> None:
    more = "<p_gain>500</p_gain><d_gain>50</d_gain><initial_position>0.4</initial_position><topic>/elbow</topic>"
    simulator = make(tmp_path, "position", more, gravity=(0, 0, 0))
    simulator.run(3.0)
    assert simulator.state.position("elbow") == pytest.approx(0.4, abs=1e-3)
    send(simulator, "/elbow", -0.4)
    simulator.run(3.0)
    assert simulator.state.position("elbow") == pytest.approx(-0.4, abs=1e-3)
    simulator.reset()
    simulator.run(3.0)
    assert simulator.state.position("elbow") == pytest.approx(0.4, abs=1e-3)


def test_by_velocity(tmp_path: Path) -> None:
    more = "<use_velocity_commands>true</use_velocity_commands><cmd_max>0.5</cmd_max><sub_topic>go</sub_topic>"
    simulator = make(tmp_path, "position", more)
    send(simulator, "/model/arm/go", 1.0)
    simulator.run(1.0)
    assert simulator.state.position("elbow") == pytest.approx(0.5, abs=2e-3)
    simulator.run(3.0)
    assert simulator.state.position("elbow") == pytest.approx(1.0, abs=1e-6)


def test_velocity_by_motor(tmp_path: Path) -> None:
    simulator = make(tmp_path, "velocity", "<initial_velocity>0.2</initial_velocity>")
    simulator.run(0.5)
    assert simulator.state.velocity("elbow") == pytest.approx(0.2)
    send(simulator, "/model/arm/joint/elbow/cmd_vel", -0.5)
    simulator.run(0.5)
    assert simulator.state.velocity("elbow") == pytest.approx(-0.5)


def test_velocity_by_force(tmp_path: Path) -> None:
    gains = "<p_gain>20</p_gain><i_gain>400</i_gain><i_max>20</i_max><i_min>-20</i_min>"
    more = "<use_force_commands>true</use_force_commands>" + gains
    simulator = make(tmp_path, "velocity", more)
    send(simulator, "/model/arm/joint/elbow/cmd_vel", 0.1)
    simulator.run(5.0)
    assert simulator.state.velocity("elbow") == pytest.approx(0.1, abs=2e-3)


@pytest.mark.parametrize(
    ("kind", "parameters", "message"),
    [
        ("position", "<p_gain>-1</p_gain>", "<p_gain> is `-1`; it must be a number, zero or greater"),
        (
            "position",
            "<cmd_max>-1</cmd_max><cmd_min>1</cmd_min>",
            "<cmd_min> is 1 and <cmd_max> is -1; the minimum must not exceed the maximum",
        ),
        ("velocity", "<joint_name>elbo</joint_name>", "no joint `elbo` in robot `arm`; did you mean `elbow`?"),
    ],
)
def test_wrong_parameters(tmp_path: Path, kind: str, parameters: str, message: str) -> None:
    with pytest.raises(SimulationError) as caught:
        make(tmp_path, kind, parameters, strict=True)
    assert message in str(caught.value)
    assert "arm.urdf:" in str(caught.value)
