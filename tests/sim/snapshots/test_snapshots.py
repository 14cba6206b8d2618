"""A restored simulation continues as the unbroken one: the same bytes, in this process and in another."""

from __future__ import annotations

import copy
import logging
import pickle
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from tests.sim.snapshots.comparison import command, differences, record, state
from urdfkit.errors import SimulationError
from urdfkit.resources import robot_names
from urdfkit.sim import Drive, Simulator

OTHER_PROCESS = """
import pickle, sys
from pathlib import Path
from tests.sim.snapshots.comparison import record, state
simulator = pickle.loads(Path(sys.argv[1]).read_bytes())
messages = record(simulator)
simulator.run(0.3)
Path(sys.argv[2]).write_bytes(pickle.dumps((messages, state(simulator))))
"""


def quiet(robot: Any, **options: Any) -> Simulator:
    return Simulator(robot, note=lambda _: None, **options)


def continued(simulator: Simulator) -> Any:
    messages = record(simulator)
    simulator.run(0.3)
    return messages, state(simulator)


@pytest.mark.slow
@pytest.mark.parametrize("robot", robot_names())
def test_every_robot_continues_as_without_a_snapshot(robot: str) -> None:
    assert differences(lambda: quiet(robot, seed=7)) == []


@pytest.mark.slow
def test_a_world_with_bodies_in_motion_and_at_rest() -> None:
    def make() -> Simulator:
        simulator = quiet("simpleton", world="house")
        simulator.world.spawn("box", (1, 0, 1))
        return simulator

    assert differences(make, 0.6) == []


@pytest.mark.slow
def test_a_copy_and_another_process_continue_like_the_original(tmp_path: Path) -> None:
    original = quiet("heterogeneous", seed=5)
    command(original)
    original.world.spawn("rrbot", (2, 0, 0), name="second")
    original.run(0.3)
    copied, pickled = copy.deepcopy(original), pickle.dumps(original)
    (tmp_path / "simulator").write_bytes(pickled)
    code = [sys.executable, "-c", OTHER_PROCESS, str(tmp_path / "simulator"), str(tmp_path / "result")]
    subprocess.run(code, check=True, capture_output=True, cwd=Path(__file__).parents[3])
    there = pickle.loads((tmp_path / "result").read_bytes())
    expected = continued(original)
    assert expected[0]
    assert continued(copied) == expected
    assert there == expected
    assert copied.world.names == original.world.names


def test_a_copy_is_independent_and_keeps_entities_that_changed() -> None:
    original = quiet("simpleton", world="house")
    gone = original.world.names[-1]
    original.world.remove(gone)
    original.run(0.05)
    other = copy.deepcopy(original)
    assert gone not in other.world.names
    assert other.world.names == original.world.names
    other.command((0.5, 0, 0), (0, 0, 0))
    other.run(0.2)
    assert original.t == pytest.approx(0.05)
    assert original.motors is not other.motors
    assert original.bus is not other.bus


def test_pushes_goals_and_calls_are_restored() -> None:
    simulator = quiet("seven_dof_arm")
    called: list[float] = []
    simulator.at(0.15, lambda: called.append(simulator.t))
    simulator.every(0.1, lambda: called.append(-simulator.t), start=0.05)
    joint = simulator.kinematics.joint_names[0]
    simulator.motors.hold(joint, 0.4)
    simulator.world.push(simulator.kinematics.link_names[-1], (5, 0, 0), for_seconds=0.12)
    simulator.run(0.1)
    snapshot = simulator.snapshot()
    results = []
    for _ in range(2):
        called.clear()
        simulator.run(0.2)
        results.append((list(called), state(simulator)))
        simulator.restore(snapshot)
        assert simulator.t == pytest.approx(0.1)
    assert results[0] == results[1]
    assert results[0][0] == pytest.approx([0.15, -0.15, -0.25])


def test_messages_are_counted_from_the_snapshot() -> None:
    simulator = quiet("simpleton")
    old = simulator.bus.advertise("/old", "std_msgs/msg/String")
    old.publish("one")
    snapshot = simulator.snapshot()
    new = simulator.bus.advertise("/new", "std_msgs/msg/String")
    for topic in (old, new):
        topic.publish("two")
    simulator.restore(snapshot)
    assert (old.count, new.count) == (1, 0)


def test_a_call_that_the_simulation_does_not_have_is_refused() -> None:
    one, other = quiet("simpleton"), quiet("simpleton")
    one.every(0.5, lambda: None)
    with pytest.raises(SimulationError, match=r"a call at t = 0 s every 0\.5 s; functions cannot be saved: schedule"):
        other.restore(one.snapshot())
    heard: list[int] = []
    other.every(0.5, lambda: heard.append(other.state.step))
    other.restore(one.snapshot())
    other.run(0.7)
    assert heard == [0, 500]


@pytest.mark.parametrize(
    ("change", "reported"),
    [
        (lambda _: b"", "not a snapshot: use the bytes that `snapshot` returned"),
        (lambda _: b"x" * 500, "not a snapshot"),
        (lambda found: found[:-10], r"the snapshot is damaged: it has \d+ bytes of \d+"),
        (lambda found: found[:16] + b"\x63" + found[17:], "the snapshot has format 99; this version of urdfkit reads"),
        (lambda found: found[:-50] + bytes(50), "the snapshot is damaged"),
    ],
)
def test_other_bytes_are_refused_in_one_line(change: Any, reported: str) -> None:
    simulator = quiet("simpleton")
    simulator.run(0.01)
    before = state(simulator)
    with pytest.raises(SimulationError, match=reported) as caught:
        simulator.restore(change(simulator.snapshot()))
    assert "\n" not in str(caught.value)
    assert state(simulator) == before


def test_the_snapshot_of_another_model_or_world_is_refused() -> None:
    simulator = quiet("simpleton")
    with pytest.raises(
        SimulationError, match="the snapshot contains mybot, ground_plane in world empty, not simpleton, "
    ):
        simulator.restore(quiet("mybot").snapshot())
    for other in (quiet("simpleton", dt=0.002), quiet("simpleton", fixed_base=True)):
        with pytest.raises(SimulationError, match="with other descriptions, options or live parameters"):
            simulator.restore(other.snapshot())
    before = simulator.snapshot()
    simulator.world.spawn("simpleton", (1, 0, 0), name="second")
    with pytest.raises(
        SimulationError,
        match=r"the snapshot contains simpleton, ground_plane in .*, second in",
    ):
        simulator.restore(before)


def test_a_snapshot_cannot_run_code() -> None:
    simulator = quiet("simpleton")
    found = simulator.snapshot()

    class Attack:
        def __reduce__(self) -> Any:
            return logging.getLogger, ("attack",)

    evil = pickle.dumps({"objects": Attack()})
    from urdfkit.sim.snapshots.snapshot import HEADER

    *head, size = HEADER.unpack_from(found)
    with pytest.raises(SimulationError, match=r"a snapshot does not contain `logging\.getLogger`"):
        simulator.restore(HEADER.pack(*head, len(evil)) + found[HEADER.size : len(found) - size] + evil)


def test_controllers_that_were_switched() -> None:
    simulator = quiet("rrbot")
    names = [each.name for each in simulator.controllers.list() if "position" in each.name]
    before = simulator.controllers.list()
    start = simulator.snapshot()
    simulator.controllers.stop(names[0])
    simulator.controllers.unload(names[0])
    changed, without = simulator.controllers.list(), simulator.snapshot()
    assert changed != before
    simulator.restore(start)
    assert simulator.controllers.list() == before
    simulator.restore(without)
    assert simulator.controllers.list() == changed
    other = quiet("rrbot")
    other.restore(without)
    assert other.controllers.list() == changed


class Forgetful(Drive):
    """A drive with a counter that is an attribute, or hidden in the class."""

    kind = "planar_move"
    hidden = False
    count = 0

    def configure(self, setup: Any) -> None:
        self.topic = setup.bus.advertise("/count", "std_msgs/msg/Float64")

    def write(self, state: Any, motors: Any) -> None:
        owner: Any = Forgetful if self.hidden else self
        owner.count += 1

    def read(self, state: Any) -> None:
        from urdfkit.messages import FLOAT, message_type

        self.topic.publish(message_type(FLOAT)(float(self.count)))

    def reset(self) -> None:
        self.count = 0


@pytest.mark.parametrize("hidden", [False, True])
def test_the_comparison_finds_a_plugin_with_state_that_is_not_saved(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, hidden: bool
) -> None:
    monkeypatch.setattr(Forgetful, "hidden", hidden)
    monkeypatch.setattr(Forgetful, "reset", lambda self: None)
    monkeypatch.setattr("urdfkit.sim.plugins.installer.DRIVES", (Forgetful,))
    file = tmp_path / "box.urdf"
    file.write_text(
        '<robot name="box"><link name="base"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" '
        'ixz="0" iyz="0"/></inertial></link><gazebo><plugin name="p" filename="libgazebo_ros_planar_move.so"/></gazebo>'
        "</robot>"
    )
    assert bool(differences(lambda: quiet(file), 0.05)) is hidden
