"""What is due is asked once and kept: nothing else comes of a simulation than if it were asked before every step."""

from __future__ import annotations

import pickle
from collections.abc import Callable
from pathlib import Path

import pytest

from urdfkit.messages import FLOAT, TWIST, from_fields, twist
from urdfkit.sim import Simulator
from urdfkit.sim.state.periodic_steps import NEVER
from urdfkit.sim.state.pid import Gains
from urdfkit.sim.world.live_tuning import Tuning

WHEN = 137
"""A step at which nothing falls due by itself."""


def told(robot: str, act: Callable[[Simulator], None], *, asking: bool) -> list[object]:
    """Return what a simulation has published, and where it is, after each step."""
    simulator = Simulator(robot, seed=4, note=lambda text: None)
    found: list[object] = []
    for k in range(300):
        if k == WHEN:
            act(simulator)
        if asking:
            simulator.world.scheduler.invalidate()
        simulator.step()
        if k % 7 == 0 or (k > WHEN and k % 3 == 0):
            found += [(topic.name, topic.count) for topic in simulator.bus.topics]
        found.append(simulator.state.q.tobytes() + simulator.state.v.tobytes())
    found += [(topic.name, pickle.dumps(topic.latest)) for topic in simulator.bus.topics]
    return found


def command(simulator: Simulator) -> None:
    simulator.command((0.3, 0, 0), (0, 0, 0.5))


ARM = (Path(__file__).parents[1] / "arm.urdf").read_text()
SERVO = """<gazebo><plugin filename="gz-sim-joint-position-controller-system"
  name="gz::sim::systems::JointPositionController"><joint_name>elbow</joint_name><topic>/wish</topic>
  <p_gain>40</p_gain><d_gain>4</d_gain></plugin></gazebo>"""


def wish(simulator: Simulator) -> None:
    simulator.bus.publish("/wish", FLOAT, from_fields(FLOAT, {"data": 0.4}))


def hold(simulator: Simulator) -> None:
    simulator.motors.hold(simulator.kinematics.joint_names[0], 0.4)


def call(simulator: Simulator) -> None:
    simulator.at(simulator.t, lambda: command(simulator))
    simulator.every(0.0213, lambda: command(simulator), start=simulator.t + 0.0042)


def listen(simulator: Simulator) -> None:
    heard: list[object] = []
    for topic in simulator.bus.topics:
        if topic.name in ("/clock", "/joint_states", "/tf", "/gazebo/model_states"):
            simulator.subscribe(topic.name, topic.type, heard.append)


def switch(simulator: Simulator) -> None:
    running = [status.name for status in simulator.controllers.list() if status.state in ("running", "active")]
    assert running
    simulator.controllers.stop(*running)
    simulator.controllers.unload(running[0])


def gains(simulator: Simulator) -> None:
    tuning = Tuning(simulator.world)
    tuning.set_gains(next(iter(tuning.gains)), Gains(30.0, 0.0, 1.0))


def spawn(simulator: Simulator) -> None:
    simulator.world.spawn("simpleton", (3, 0, 0), name="newcomer")
    simulator.bus.publish("/newcomer/cmd_vel", TWIST, twist((0.2, 0, 0), (0, 0, 0)))


def push(simulator: Simulator) -> None:
    simulator.world.push(simulator.name, (5, 0, 0), for_seconds=0.0335)


def reset(simulator: Simulator) -> None:
    command(simulator)
    simulator.reset()


@pytest.mark.slow
@pytest.mark.parametrize(
    ("robot", "act"),
    [
        (ARM.replace("</robot>", SERVO + "</robot>"), wish),
        (ARM, hold),
        ("simpleton", command),
        ("simpleton", call),
        ("simpleton", listen),
        ("simpleton", spawn),
        ("simpleton", push),
        ("simpleton", reset),
        ("bot", command),
        ("heterogeneous", command),
        ("rrbot", switch),
        ("seven_dof_arm", switch),
    ],
)
def test_nothing_is_missed(tmp_path: Path, robot: str, act: Callable[[Simulator], None]) -> None:
    if robot.startswith("<"):
        (tmp_path / "robot.urdf").write_text(robot)
        robot = str(tmp_path / "robot.urdf")
    assert told(robot, act, asking=False) == told(robot, act, asking=True)


@pytest.mark.parametrize(("robot", "act"), [("rrbot", switch), ("simpleton", call), ("rrbot", gains)])
def test_what_may_be_due_sooner_is_looked_at(robot: str, act: Callable[[Simulator], None]) -> None:
    simulator = Simulator(robot, note=lambda text: None)
    simulator.step(WHEN)
    simulator.world.scheduler.write_due = simulator.world.scheduler.read_due = NEVER
    act(simulator)
    assert simulator.world.scheduler.write_due <= WHEN
    assert simulator.world.scheduler.read_due <= WHEN


def test_between_what_is_due_nobody_is_asked(monkeypatch: pytest.MonkeyPatch) -> None:
    simulator = Simulator("simpleton", note=lambda text: None)
    simulator.run(0.1)
    asked: list[int] = []
    for phase in ("write", "read"):
        ask = getattr(simulator.world.scheduler, phase)
        monkeypatch.setattr(
            simulator.world.scheduler, phase, lambda ask=ask: (asked.append(simulator.state.step), ask())
        )
    for _ in range(60):
        simulator.step()
    # Odometry and clock at 100 Hz, the laser at 30: nothing else, and nothing in between.
    assert {step % 10 for step in asked if step % 10} <= {4, 7}
    assert len(asked) <= 16


def test_whoever_raises_is_asked_again() -> None:
    simulator = Simulator("simpleton", note=lambda text: None)
    simulator.run(0.05)
    happened: list[float] = []

    def fail() -> None:
        raise RuntimeError("on purpose")

    simulator.at(0.053, fail)
    simulator.at(0.053, lambda: happened.append(simulator.t))
    with pytest.raises(RuntimeError, match="on purpose"):
        simulator.run(0.01)
    simulator.step()
    assert happened == pytest.approx([0.053])
