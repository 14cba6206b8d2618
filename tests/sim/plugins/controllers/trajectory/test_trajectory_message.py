"""JointTrajectory messages: points in the order of the joints, the time of the start, and what is rejected."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from urdfkit.messages import TRAJECTORY, from_fields
from urdfkit.sim.plugins.controllers.actions.action_goal import RefusalError
from urdfkit.sim.plugins.controllers.trajectory.spline import Trajectory, Waypoint
from urdfkit.sim.plugins.controllers.trajectory.trajectory_message import TrajectoryReader, point_of

HERE = Trajectory([Waypoint(0.0, np.array([0.1, 0.2]))])


def reader(**options: Any) -> TrajectoryReader:
    usual = {"turning": [False, False], "partial": False, "waits": True, "ends_at_rest": False}
    return TrajectoryReader(["a", "b"], **(usual | options))


def point(t: float, positions: list[float], **more: list[float]) -> dict[str, Any]:
    return {"positions": positions, "time_from_start": {"sec": int(t), "nanosec": round(t % 1 * 1e9)}, **more}


def message(*points: dict[str, Any], names: tuple[str, ...] = ("a", "b"), stamp: float = 0.0) -> Any:
    header = {"stamp": {"sec": int(stamp), "nanosec": round(stamp % 1 * 1e9)}}
    return from_fields(TRAJECTORY, {"header": header, "joint_names": list(names), "points": list(points)})


def test_values_are_in_the_order_of_the_joints_of_the_controller() -> None:
    read = reader().read(
        message(point(1.5, [1.0, 2.0], velocities=[3.0, 4.0], accelerations=[5.0, 6.0]), names=("b", "a")), 10.0, HERE
    )
    start, end = read.waypoints
    assert (start.t, start.positions.tolist(), end.t) == (10.0, [0.1, 0.2], 11.5)
    assert end.velocities is not None
    assert end.accelerations is not None
    assert [each.tolist() for each in (end.positions, end.velocities, end.accelerations)] == [[2, 1], [4, 3], [6, 5]]
    assert read.before is None


def test_a_trajectory_begins_at_its_stamp_and_drops_points_of_the_past() -> None:
    points = [point(t, [t, t]) for t in (1.0, 2.0, 3.0)]
    later = reader().read(message(*points, stamp=12.0), 10.0, HERE)
    assert [each.t for each in later.waypoints] == [12.0, 13.0, 14.0, 15.0]
    assert later.before is HERE
    at_once = reader(waits=False).read(message(*points, stamp=12.0), 10.0, HERE)
    assert [each.t for each in at_once.waypoints] == [10.0, 13.0, 14.0, 15.0]
    assert at_once.before is None
    late = reader().read(message(*points, stamp=8.0), 10.0, HERE)
    assert [each.t for each in late.waypoints] == [10.0, 11.0]
    with pytest.raises(RefusalError, match="all of its points are in the past") as refused:
        reader().read(message(*points, stamp=7.0), 10.0, HERE)
    assert refused.value.result == {"error_code": -3, "error_string": "all of its points are in the past"}


def test_a_joint_that_is_not_named_keeps_its_position() -> None:
    read = reader(partial=True).read(message(point(1.0, [1.0], velocities=[0.5]), names=("b",)), 0.0, HERE)
    end = read.waypoints[-1]
    assert end.velocities is not None
    assert (end.positions.tolist(), end.velocities.tolist()) == ([0.1, 1.0], [0.0, 0.5])


def test_continuous_joints_turn_to_the_nearest_angle() -> None:
    points = [point(1.0, [6.0, 6.0]), point(2.0, [12.0, 12.0])]
    read = reader(turning=[True, False]).read(message(*points), 0.0, HERE)
    first, second = (each.positions for each in read.waypoints[1:])
    assert first == pytest.approx([6.0 - 2 * np.pi, 6.0])
    assert second == pytest.approx([12.0 - 2 * np.pi, 12.0])


@pytest.mark.parametrize(
    ("sent", "options", "code", "reason"),
    [
        (message(point(1, [0, 0]), names=("a", "c")), {}, -2, "unknown joint `c`"),
        (message(point(1, [0]), names=("a",)), {}, -2, "it must name each joint exactly once, unlike `b`"),
        (
            message(point(1, [0, 0]), names=("a", "a")),
            {"partial": True},
            -2,
            "it must name each joint exactly once, unlike `b`",
        ),
        (message(), {}, -1, "it has no points"),
        (message(point(1, [0, 0]), point(1, [1, 1])), {}, -1, "point 2 must be later than the previous point"),
        (message(point(1, [])), {}, -1, "point 1 has no positions"),
        (message(point(1, [0, 0, 0])), {}, -1, "a point needs 2 finite numbers, at most"),
        (message(point(1, [0, np.nan])), {}, -1, "a point needs 2 finite numbers, at most"),
        (
            message(point(1, [0, 0], velocities=[0.0, 1e-8])),
            {"ends_at_rest": True},
            -1,
            "it is not at rest at its end (see allow_nonzero_velocity_at_trajectory_end)",
        ),
    ],
)
def test_what_is_rejected(sent: Any, options: dict[str, Any], code: int, reason: str) -> None:
    with pytest.raises(RefusalError) as refused:
        reader(**options).read(sent, 0.0, HERE)
    assert refused.value.result["error_code"] == code
    assert str(refused.value).startswith(reason)


def test_a_trajectory_may_end_at_rest() -> None:
    sent = message(point(1, [0, 0], velocities=[1.0, 1.0]), point(2, [0, 0], velocities=[0.0, 1e-10]))
    assert len(reader(ends_at_rest=True).read(sent, 0.0, HERE).waypoints) == 3


def test_a_point_has_the_values_that_are_known() -> None:
    one, two, three, four = (np.array([each, -each]) for each in (1.0, 2.0, 3.0, 4.0))
    plain, full = point_of(one, two), point_of(one, two, three, four)
    fields = ("positions", "velocities", "accelerations", "effort")
    assert [getattr(plain, name).tolist() for name in fields] == [[1, -1], [2, -2], [], []]
    assert [getattr(full, name).tolist() for name in fields] == [[1, -1], [2, -2], [3, -3], [4, -4]]
    assert (full.time_from_start.sec, full.time_from_start.nanosec) == (0, 0)
