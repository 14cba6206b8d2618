"""Trajectories as goals: feedback, results, tolerances, cancelling, holding; grippers."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from tests.sim import arm_package
from urdfkit.errors import UrdfkitError
from urdfkit.messages import TRAJECTORY, from_fields
from urdfkit.messages.control import GOAL_ID, GOAL_STATUSES
from urdfkit.sim import Simulator, Spawn

FOLLOW = "control_msgs/msg/FollowJointTrajectory"
GRIP = "control_msgs/msg/GripperCommand"
ACTIVE, PREEMPTED, SUCCEEDED, ABORTED, REJECTED = 1, 2, 3, 4, 5
POSITIONS = "{type: position_controllers/JointTrajectoryController, joints: [shoulder, elbow]MORE}"
EFFORTS = (
    "{type: effort_controllers/JointTrajectoryController, joints: [shoulder, elbow], "
    "gains: {shoulder: {p: 300.0, d: 30.0}, elbow: {p: 300.0, d: 30.0}}MORE}"
)
Make = Callable[..., Any]


@pytest.fixture
def make(tmp_path: Path) -> Make:
    def build(law: str, interface: str = "Position", more: str = "", **options: Any) -> Any:
        arm_package.write_control(tmp_path, f"arm:\n  t: {law.replace('MORE', more)}\n")
        arm = options.pop("arm", {})
        interfaces = (options.pop("shoulder", interface), interface)
        urdf = arm_package.write_arm(tmp_path, arm_package.transmissions(*interfaces), **arm)
        options.setdefault("note", lambda _: None)
        return Simulator(urdf, **options)

    return build


class Client:
    """Sends goals and keeps what comes back."""

    def __init__(self, simulator: Any, base: str = "/arm/t/follow_joint_trajectory", kind: str = FOLLOW) -> None:
        self.simulator, self.base, self.kind = simulator, base, kind
        self.results: list[Any] = []
        self.feedback: list[Any] = []
        simulator.subscribe(f"{base}/result", f"{kind}ActionResult", self.results.append)
        simulator.subscribe(f"{base}/feedback", f"{kind}ActionFeedback", self.feedback.append)

    def send(self, goal: dict[str, Any], name: str = "g") -> None:
        message = from_fields(f"{self.kind}ActionGoal", {"goal_id": {"id": name}, "goal": goal})
        self.simulator.bus.publish(f"{self.base}/goal", f"{self.kind}ActionGoal", message)

    def cancel(self, name: str = "") -> None:
        self.simulator.bus.publish(f"{self.base}/cancel", GOAL_ID, from_fields(GOAL_ID, {"id": name}))

    @property
    def outcome(self) -> tuple[str, int, int]:
        """Return the last goal's name, its state and the error code."""
        last = self.results[-1]
        return last.status.goal_id.id, last.status.status, last.result.error_code


def trajectory(*points: tuple[float, list[float]], start: float = 0.0, velocities: bool = False) -> dict[str, Any]:
    rates = {"velocities": [0.0, 0.0]} if velocities else {}
    return {
        "header": {"stamp": {"sec": int(start), "nanosec": round(start % 1 * 1e9)}},
        "joint_names": ["shoulder", "elbow"],
        "points": [
            {"positions": p, "time_from_start": {"sec": int(t), "nanosec": round(t % 1 * 1e9)}, **rates}
            for t, p in points
        ],
    }


def positions(simulator: Any) -> tuple[float, float]:
    return simulator.state.position("shoulder"), simulator.state.position("elbow")


@pytest.mark.parametrize("velocities", [False, True])
def test_a_goal_succeeds_when_it_is_over(make: Make, velocities: bool) -> None:
    simulator = make(POSITIONS)
    client = Client(simulator)
    statuses: list[int] = []
    simulator.subscribe(
        "/arm/t/follow_joint_trajectory/status", GOAL_STATUSES,
        lambda m: statuses.extend(entry.status for entry in m.status_list),
    )  # fmt: skip
    client.send({"trajectory": trajectory((1.0, [0.5, -0.5]), velocities=velocities)})
    simulator.run(0.99)
    assert client.results == []
    assert set(statuses) == {ACTIVE}
    simulator.run(0.1)
    assert client.outcome == ("g", SUCCEEDED, 0)
    stamp = client.results[-1].header.stamp
    assert (stamp.sec, stamp.nanosec) == (1, 0)
    assert statuses[-1] == SUCCEEDED
    assert positions(simulator) == pytest.approx((0.5, -0.5), abs=1e-6)
    assert len(client.feedback) == 20  # action_monitor_rate
    middle = client.feedback[9]
    assert middle.status.goal_id.id == "g"
    assert middle.feedback.desired.positions == pytest.approx([0.25, -0.25], abs=1e-9)
    assert middle.feedback.error.positions == pytest.approx([0, 0], abs=5e-3)


def test_a_goal_ends_when_a_joint_strays(make: Make) -> None:
    simulator = make(EFFORTS, "Effort", ", constraints: {shoulder: {trajectory: 0.05}}", arm={"effort": 3.0})
    client = Client(simulator)
    client.send({"trajectory": trajectory((1.0, [1.2, 0.0]))})
    simulator.run(1.0)
    assert client.outcome == ("g", ABORTED, -4)
    assert "joint `shoulder` is off by 0.05" in client.results[-1].result.error_string


def test_a_goal_ends_when_its_end_is_not_reached_in_time(make: Make) -> None:
    constraints = ", constraints: {goal_time: 0.5, shoulder: {goal: 0.01}}"
    simulator = make(EFFORTS, "Effort", constraints)  # sags by more than 0.01 rad: there is no integral
    client = Client(simulator)
    client.send({"trajectory": trajectory((1.0, [1.2, 0.0]))})
    simulator.run(1.45)
    assert client.results == []
    simulator.run(0.1)
    assert client.outcome == ("g", ABORTED, -5)
    tolerance = [{"name": "shoulder", "position": -1.0}]  # lifted by the goal itself
    client.send({"trajectory": trajectory((1.0, [1.2, 0.0])), "goal_tolerance": tolerance})
    simulator.run(1.6)
    assert client.outcome == ("g", SUCCEEDED, 0)


def test_cancelling_stops_the_joints_where_they_are(make: Make) -> None:
    simulator = make(POSITIONS)
    client = Client(simulator)
    client.send({"trajectory": trajectory((1.0, [1.0, 0.0]))})
    simulator.run(0.5)
    client.cancel("another")
    assert client.results == []
    client.cancel("g")
    assert client.outcome == ("g", PREEMPTED, 0)
    simulator.run(1.0)
    assert positions(simulator)[0] == pytest.approx(0.5, abs=0.01)


def test_stopping_takes_as_long_as_it_is_told(make: Make) -> None:
    """The path of setHoldPosition: from v to rest within 0.4 s, half way of a swing there and back."""
    simulator = make(POSITIONS, more=", stop_trajectory_duration: 0.4")
    client = Client(simulator)
    client.send({"trajectory": trajectory((1.0, [1.0, 0.0]))})
    simulator.run(0.5)
    start = positions(simulator)[0]
    client.cancel()
    simulator.run(0.2)
    assert simulator.state.velocity("shoulder") > 0.1
    simulator.run(0.4)
    end = positions(simulator)[0]
    assert simulator.state.velocity("shoulder") == pytest.approx(0.0, abs=1e-6)
    assert end - start == pytest.approx(1.0 * 0.4 * 5 / 8, abs=0.01)  # the quintic's 5/16 of twice the time


def test_what_takes_the_place_of_a_goal(make: Make) -> None:
    simulator = make(POSITIONS)
    client = Client(simulator)
    client.send({"trajectory": trajectory((1.0, [0.5, 0.0]))}, "first")
    simulator.run(0.2)
    client.send({"trajectory": trajectory((1.0, [0.4, 0.0]))}, "second")
    assert client.outcome == ("first", PREEMPTED, 0)
    simulator.run(0.2)
    message = from_fields(TRAJECTORY, trajectory((0.5, [0.1, 0.0])))
    simulator.bus.publish("/arm/t/command", TRAJECTORY, message)
    assert client.outcome == ("second", PREEMPTED, 0)
    client.send({"trajectory": trajectory((1.0, [0.4, 0.0]))}, "third")
    simulator.controllers.stop("t")
    assert client.outcome == ("third", PREEMPTED, 0)


@pytest.mark.parametrize(
    ("change", "code"),
    [({"joint_names": ["shoulder", "elbw"]}, -2), ({"header": {"stamp": {"sec": 1}}}, -3)],
)
def test_goals_that_cannot_be_pursued_are_refused(make: Make, change: dict[str, Any], code: int) -> None:
    simulator = make(POSITIONS)
    client = Client(simulator)
    simulator.run(5.0)
    client.send({"trajectory": {**trajectory((1.0, [0.5, 0.0])), **change}})
    assert client.outcome == ("g", REJECTED, code)


def test_an_empty_trajectory_stops_the_joints(make: Make) -> None:
    simulator = make(POSITIONS)
    message = from_fields(TRAJECTORY, trajectory((1.0, [1.0, 0.0])))
    simulator.bus.publish("/arm/t/command", TRAJECTORY, message)
    simulator.run(0.5)
    simulator.bus.publish("/arm/t/command", TRAJECTORY, from_fields(TRAJECTORY, None))
    simulator.run(1.0)
    assert positions(simulator)[0] == pytest.approx(0.5, abs=0.01)


def test_one_that_starts_later_lets_the_present_one_go_on(make: Make) -> None:
    """init_joint_trajectory.h: up to the new one's start the old one is followed, then the way to the first point."""
    simulator = make(POSITIONS)
    publish = simulator.bus.publish
    publish("/arm/t/command", TRAJECTORY, from_fields(TRAJECTORY, trajectory((1.0, [0.5, 0.0]))))
    simulator.run(0.2)
    publish("/arm/t/command", TRAJECTORY, from_fields(TRAJECTORY, trajectory((1.0, [0.0, 0.4]), start=2.0)))
    simulator.run(0.8)
    assert positions(simulator) == pytest.approx((0.5, 0.0), abs=1e-6)
    simulator.run(1.0)
    assert positions(simulator) == pytest.approx((0.5, 0.0), abs=1e-6)
    simulator.run(0.5)
    assert positions(simulator) == pytest.approx((0.25, 0.2), abs=1e-2)
    simulator.run(0.6)
    assert positions(simulator) == pytest.approx((0.0, 0.4), abs=1e-6)


POSITION_GRIPPER = "{type: position_controllers/GripperActionController, joint: elbowMORE}"
EFFORT_GRIPPER = (
    "{type: effort_controllers/GripperActionController, joint: elbow, gains: {elbow: {p: 60.0, d: 6.0}}MORE}"
)


@pytest.mark.parametrize(("law", "interface"), [(POSITION_GRIPPER, "Position"), (EFFORT_GRIPPER, "Effort")])
def test_a_gripper_reaches_its_goal(make: Make, law: str, interface: str) -> None:
    simulator = make(law, interface, gravity=(0, 0, 0))
    client = Client(simulator, "/arm/t/gripper_cmd", GRIP)
    client.send({"command": {"position": 0.6, "max_effort": 10.0}})
    simulator.run(3.0)
    last = client.results[-1]
    assert last.status.status == SUCCEEDED
    assert (last.result.reached_goal, last.result.stalled) == (True, False)
    assert last.result.position == pytest.approx(0.6, abs=0.01)
    assert client.feedback
    assert simulator.state.position("elbow") == pytest.approx(0.6, abs=0.01)


def test_a_gripper_that_is_too_weak_stalls(make: Make) -> None:
    """The fore link weighs 9.81 N and lies level, 0.2 m from joint to centre: 1 N·m does not lift it."""
    simulator = make(EFFORT_GRIPPER, "Effort", shoulder="Position", spawn=Spawn(z=0.0, joints={"elbow": 1.57}))
    client = Client(simulator, "/arm/t/gripper_cmd", GRIP)
    client.send({"command": {"position": 0.5, "max_effort": 1.0}})
    largest = 0.0
    for _ in range(1000):
        simulator.run(0.01)
        largest = max(largest, abs(simulator.state.effort("elbow")))
    assert largest == pytest.approx(1.0, abs=1e-9)
    last = client.results[-1]
    assert (last.status.status, last.result.stalled, last.result.reached_goal) == (ABORTED, True, False)
    assert last.result.effort == pytest.approx(-1.0)


def test_an_effort_gripper_needs_gains(make: Make) -> None:
    with pytest.raises(UrdfkitError, match=r"arm\.yaml:2:3.*`t` has no `gains/elbow`"):
        make("{type: effort_controllers/GripperActionController, joint: elbow}", "Effort", strict=True)
