import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfkit.teleop import ARROWS, HELD_LAYOUT, HELD_SPEEDS, MOVES, SPEEDS, STOP, WASD, Motion, Teleop

# (key, x, y, z, turn): the table of teleop_twist_keyboard, written out a second time.
TABLE = """
i 1 0 0 0 | o 1 0 0 -1 | j 0 0 0 1 | l 0 0 0 -1 | u 1 0 0 1 | , -1 0 0 0 | . -1 0 0 1 | m -1 0 0 -1
O 1 -1 0 0 | I 1 0 0 0 | J 0 1 0 0 | L 0 -1 0 0 | U 1 1 0 0 | < -1 0 0 0 | > -1 -1 0 0 | M -1 1 0 0
t 0 0 1 0 | b 0 0 -1 0
"""
ROWS = [row.split() for line in TABLE.strip().splitlines() for row in line.split(" | ")]


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row[0])
def test_motion_keys_are_those_of_teleop_twist_keyboard(row: list[str]) -> None:
    x, y, z, turn = (float(part) for part in row[1:])
    assert Teleop().key(row[0]) == Motion((0.5 * x, 0.5 * y, 0.5 * z), (0.0, 0.0, turn))


def test_the_table_is_complete() -> None:
    assert {row[0] for row in ROWS} == set(MOVES)


@pytest.mark.parametrize(
    ("key", "speed", "turn"),
    [("q", 0.55, 1.1), ("z", 0.45, 0.9), ("w", 0.55, 1), ("x", 0.45, 1), ("e", 0.5, 1.1), ("c", 0.5, 0.9)],
)
def test_speed_keys_scale_and_go_on_with_the_present_motion(key: str, speed: float, turn: float) -> None:
    teleop = Teleop()
    teleop.key("u")
    motion = teleop.key(key)
    assert motion.linear[0] == pytest.approx(speed)
    assert motion.angular[2] == pytest.approx(turn)
    assert teleop.status() == f"currently:\tspeed {speed:.3g}\tturn {turn:.3g} "


def test_any_other_key_stops() -> None:
    teleop = Teleop()
    teleop.key("i")
    assert teleop.key("k") == STOP
    teleop.key("i")
    assert teleop.key(" ") == STOP


def test_speed_limits_hold() -> None:
    teleop = Teleop(speed_limit=0.6, turn_limit=1.05)
    for _ in range(10):
        teleop.key("q")
    assert (teleop.speed, teleop.turn) == (0.6, 1.05)


def test_held_keys_add_up_and_are_clamped() -> None:
    teleop = Teleop()
    assert teleop.held({"w", "a"}) == Motion((0.5, 0.0, 0.0), (0.0, 0.0, 1.0))
    assert teleop.held({"w", "ArrowUp", "i"}) == teleop.held({"w"})
    assert teleop.held({"w", "s"}) == STOP
    assert teleop.held(set()) == STOP
    assert teleop.held({"Shift", "?"}) == STOP


def test_browser_speed_keys_leave_driving_keys_alone() -> None:
    assert set(SPEEDS) - set(HELD_SPEEDS) == {"w", "x"}
    assert all(HELD_LAYOUT[key] == way for key, way in (ARROWS | WASD).items())


@given(st.lists(st.floats(-5, 5), min_size=4, max_size=4))
def test_axes_are_clamped(values: list[float]) -> None:
    motion = Teleop().axes(*values)
    assert motion is not None
    assert all(abs(part) <= 0.5 for part in motion.linear)
    assert abs(motion.angular[2]) <= 1.0


@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf])
def test_axes_that_are_not_finite_are_dropped(bad: float) -> None:
    assert Teleop().axes(bad, 0.0) is None
    assert Teleop().axes(0.0, bad) is None


def test_a_motion_becomes_a_twist() -> None:
    message = Teleop().key("u").message()
    assert (message.linear.x, message.angular.z) == (0.5, 1.0)
